/* A trajectory holds every frame bit for bit, with units, and appears whole or not at all.
 * Expected values: positions made from frame and floe, read back with HDF5 itself. */
#include <errno.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include "h5_help.h"
#include "store/results.h"

static void make_floes(fw_floe *floes, size_t n, size_t frame)
{
    for (size_t i = 0; i < n; i++) {
        double t = (double)frame / 3.0, k = (double)i;
        floes[i] = (fw_floe){
            .x = t + k, .y = -k, .diameter = 2.5 + k, .thickness = 0.5, .vx = sin(t), .vy = -0.0, .spin = k * t};
    }
}

static fw_status write_frames(const char *path, size_t n_floes, size_t n_frames, fw_msg *m)
{
    fw_floe *floes = calloc(n_floes + 1, sizeof *floes);
    assert_non_null(floes);
    make_floes(floes, n_floes, 0);
    fw_scene       scene = {.speed = 2.0, .temperature = -10.0, .duration = 8.0, .n_floes = n_floes, .floes = floes};
    fw_trajectory *t;
    scene.model.structure_radius = 3.7;
    fw_status status = fw_trajectory_create(&t, path, &scene, m);
    if (status == FW_OK) {
        fw_frame_sink sink = fw_trajectory_sink(t, 0.25);
        assert_true(sink.interval == 0.25);
        for (size_t frame = 0; frame < n_frames; frame++) { /* goes on after an error: it must not run over anything */
            make_floes(floes, n_floes, frame);
            fw_status now = sink.frame(sink.self, 0.25 * (double)frame, n_floes, floes, m);
            if (status == FW_OK) status = now;
        }
        assert_int_equal(sink.frame(sink.self, 0.0, n_floes + 1, floes, NULL), FW_E_ARG);
        fw_status closed = fw_trajectory_close(t, m);
        if (status == FW_OK) status = closed;
    }
    free(floes);
    return status;
}

static void read_all(hid_t file, const char *name, size_t n_rows, size_t n_columns, double *to)
{
    hsize_t dims[2] = {0, 1};
    hid_t   dataset = H5Dopen2(file, name, H5P_DEFAULT), space = H5Dget_space(dataset);
    assert_true(H5Sget_simple_extent_dims(space, dims, NULL) == (n_columns > 0 ? 2 : 1));
    assert_int_equal(dims[0], n_rows);
    if (n_columns > 0) assert_int_equal(dims[1], n_columns);
    if (n_rows > 0) assert_true(H5Dread(dataset, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, to) >= 0);
    H5Sclose(space);
    H5Dclose(dataset);
}

static void test_frames_come_back(void **state)
{
    (void)state;
    enum { N_FLOES = 40, N_FRAMES = 1000 }; /* blocks of 409 frames */
    static double  values[N_FRAMES][N_FLOES], time[N_FRAMES], diameter[N_FLOES];
    static fw_floe floes[N_FLOES];
    assert_ok(write_frames("t.h5", N_FLOES, N_FRAMES, &msg));
    help_census census = help_take_census("t.h5");
    assert_int_equal(census.n_datasets, 8);
    assert_int_equal(census.n_bare, 0);
    assert_int_equal(census.n_timed, 0);
    hid_t file = H5Fopen("t.h5", H5F_ACC_RDONLY, H5P_DEFAULT);
    assert_true(file >= 0);
    read_all(file, "/time", N_FRAMES, 0, time);
    assert_true(time[999] == 249.75);
    read_all(file, "/diameter", N_FLOES, 0, diameter);
    assert_true(diameter[39] == 41.5);
    static const char *const names[] = {"/x", "/y", "/vx", "/vy", "/spin"};
    static const size_t      offsets[] = {offsetof(fw_floe, x), offsetof(fw_floe, y), offsetof(fw_floe, vx),
                                          offsetof(fw_floe, vy), offsetof(fw_floe, spin)};
    for (int k = 0; k < 5; k++) {
        read_all(file, names[k], N_FRAMES, N_FLOES, &values[0][0]);
        for (size_t frame = 0; frame < N_FRAMES; frame++) {
            make_floes(floes, N_FLOES, frame);
            for (size_t i = 0; i < N_FLOES; i++)
                assert_memory_equal(&values[frame][i], (char *)&floes[i] + offsets[k], 8);
        }
    }
    H5Fclose(file);
}

static void test_nothing_to_write(void **state)
{
    (void)state;
    assert_ok(write_frames("u.h5", 0, 3, &msg)); /* water without ice */
    hid_t  file = H5Fopen("u.h5", H5F_ACC_RDONLY, H5P_DEFAULT);
    double time[3];
    assert_true(file >= 0);
    read_all(file, "/time", 3, 0, time);
    assert_true(time[2] == 0.5);
    H5Fclose(file);
    assert_ok(write_frames("u.h5", 5, 0, &msg)); /* a run that ended before its first frame */
    assert_int_equal(help_take_census("u.h5").n_datasets, 8);
    assert_ok(fw_trajectory_close(NULL, &msg));
    fw_trajectory_abandon(NULL);
}

static void test_places_and_giving_up(void **state)
{
    (void)state;
    fw_scene       scene = {.duration = 1.0};
    fw_trajectory *t;
    assert_int_equal(write_frames("missing-folder/t.h5", 3, 3, &msg), FW_E_IO);
    help_save("v.h5", (const unsigned char *)"old", 3); /* somebody's file: its place is not taken */
    assert_int_equal(fw_trajectory_create(&t, "v.h5", &scene, &msg), FW_E_MISMATCH);
    assert_int_equal(fw_trajectory_create(&t, "/dev/null", &scene, &msg), FW_E_IO);
    assert_int_equal(fw_trajectory_create(&t, ".", &scene, &msg), FW_E_IO);
    size_t         n;
    unsigned char *old = help_load("v.h5", &n);
    assert_int_equal(n, 3);
    free(old);
    unlink("v.h5");
    assert_ok(write_frames("v.h5", 3, 3, &msg));
    old = help_load("v.h5", &n);
    assert_ok(fw_trajectory_create(&t, "v.h5", &scene, &msg));
    fw_trajectory *second;
    assert_int_equal(fw_trajectory_create(&second, "v.h5", &scene, &msg), FW_E_IO); /* two at once would mix */
    fw_trajectory_abandon(t);
    assert_false(help_exists("v.h5.tmp"));
    size_t         n_now;
    unsigned char *now = help_load("v.h5", &n_now);
    assert_int_equal(n_now, n);
    assert_memory_equal(now, old, n);
    free(old);
    free(now);
}

static void test_full_disk(void **state)
{
    (void)state;
    size_t n;
    assert_ok(write_frames("w.h5", 40, 1000, &msg));
    free(help_load("w.h5", &n));
    unlink("w.h5");
    for (size_t limit = 1; limit < n; limit += 1 + n / 17) {
        pid_t child = fork();
        assert_true(child >= 0);
        if (child == 0) {
            struct rlimit l = {.rlim_cur = limit, .rlim_max = limit};
            signal(SIGXFSZ, SIG_IGN);
            if (setrlimit(RLIMIT_FSIZE, &l) != 0) _exit(99);
            _exit(write_frames("w.h5", 40, 1000, &msg) == FW_E_IO && strstr(msg.text, strerror(EFBIG)) != NULL ? 1 : 2);
        }
        int status;
        assert_int_equal(waitpid(child, &status, 0), child);
        assert_true(WIFEXITED(status));
        assert_int_equal(WEXITSTATUS(status), 1);
        assert_false(help_exists("w.h5") || help_exists("w.h5.tmp"));
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_frames_come_back),
        cmocka_unit_test(test_nothing_to_write),
        cmocka_unit_test(test_places_and_giving_up),
        cmocka_unit_test(test_full_disk),
    };
    return cmocka_run_group_tests(tests, help_enter_folder, help_leave_folder);
}
