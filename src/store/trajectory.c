#include <inttypes.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "base/memory.h"
#include "store/h5_data.h"
#include "store/results.h"

static const char FILETYPE[] = "floewear trajectory";

enum { FORMAT_VERSION = 1, BLOCK_BYTES = 128 * 1024, MAX_BLOCK = 1024 };

/* What changes from frame to frame, by its place in fw_floe. */
static const struct {
    const char *name, *unit, *long_name;
    size_t      offset;
} states[] = {
    {"x", "m", "position of the floe's centre along the current, structure at 0", offsetof(fw_floe, x)},
    {"y", "m", "position of the floe's centre across the current, structure at 0", offsetof(fw_floe, y)},
    {"vx", "m s-1", "velocity along the current", offsetof(fw_floe, vx)},
    {"vy", "m s-1", "velocity across the current", offsetof(fw_floe, vy)},
    {"spin", "rad s-1", "angular velocity, anticlockwise seen from above", offsetof(fw_floe, spin)},
};
enum { N_STATES = sizeof states / sizeof states[0] };

struct fw_trajectory {
    fw_h5_file file;
    size_t     n_floes, n_block; /* frames in a block */
    hid_t      time, datasets[N_STATES];
    uint64_t   n_written;        /* frames */
    size_t     n_held;           /* frames in the block */
    double    *times;            /* (n_block) */
    double    *values[N_STATES]; /* (n_block x n_floes) */
};

static void destroy(fw_trajectory *t)
{
    if (t == NULL) return;
    fw_h5_file_close(&t->file); /* with all that is open in it */
    free(t->times);
    for (int i = 0; i < N_STATES; i++) free(t->values[i]);
    free(t);
}

static double get(const fw_floe *floe, size_t offset)
{
    double v;
    memcpy(&v, (const char *)floe + offset, sizeof v);
    return v;
}

static fw_status put_constant(const fw_trajectory *t, const fw_scene *s, const char *name, const char *long_name,
                              size_t offset, fw_msg *m)
{
    double     *values;
    hid_t       dataset;
    fw_h5_shape shape = {.rank = 1, .dims = {t->n_floes}};
    FW_TRY(fw_alloc(&values, t->n_floes, sizeof *values, name, m));
    for (size_t i = 0; i < t->n_floes; i++) values[i] = get(&s->floes[i], offset);
    fw_status status = fw_h5_create_dataset(&t->file, t->file.id, name, H5T_IEEE_F64LE, &shape, "m", long_name,
                                            &dataset, m);
    if (status == FW_OK) {
        status = fw_h5_write_rows(&t->file, dataset, H5T_NATIVE_DOUBLE, 0, t->n_floes, values, m);
        H5Dclose(dataset);
    }
    free(values);
    return status;
}

static fw_status put_head(fw_trajectory *t, const fw_scene *s, fw_msg *m)
{
    const fw_h5_file *f = &t->file;
    fw_h5_shape       time = {.rank = 1, .dims = {0}, .chunk_rows = MAX_BLOCK, .is_growing = true};
    fw_h5_shape       state = {.rank = 2, .dims = {0, t->n_floes}, .chunk_rows = t->n_block, .is_growing = true};
    FW_TRY(fw_h5_put_origin(f, FILETYPE, FORMAT_VERSION, m));
    FW_TRY(fw_h5_put_double(f, f->id, "structure_radius_m", s->model.structure_radius, m));
    FW_TRY(fw_h5_put_double(f, f->id, "current_speed_m_s", s->speed, m));
    FW_TRY(fw_h5_put_double(f, f->id, "temperature_degC", s->temperature, m));
    FW_TRY(fw_h5_put_double(f, f->id, "duration_s", s->duration, m));
    FW_TRY(put_constant(t, s, "diameter", "diameter of the floe", offsetof(fw_floe, diameter), m));
    FW_TRY(put_constant(t, s, "thickness", "thickness of the floe", offsetof(fw_floe, thickness), m));
    FW_TRY(fw_h5_create_dataset(f, f->id, "time", H5T_IEEE_F64LE, &time, "s", "time since the scene's start", &t->time,
                                m));
    for (int i = 0; i < N_STATES; i++) {
        FW_TRY(fw_h5_create_dataset(f, f->id, states[i].name, H5T_IEEE_F64LE, &state, states[i].unit,
                                    states[i].long_name, &t->datasets[i], m));
    }
    return FW_OK;
}

/* Only an older trajectory is replaced: the rename would take the place of anything, a campaign file or a device too. */
static fw_status check_place(const char *path, fw_msg *m)
{
    struct stat there;
    fw_h5_file  old;
    char       *type = NULL;
    fw_msg      why = {""};
    if (stat(path, &there) != 0) return FW_OK; /* absent, or creating it says what is wrong */
    FW_CHECK(S_ISREG(there.st_mode), m, FW_E_IO, "%s is not a regular file: a trajectory cannot take its place", path);
    fw_status status = fw_h5_file_open(&old, path, &why);
    if (status == FW_OK) {
        status = fw_h5_get_text(&old, "filetype", &type, &why);
        if (status == FW_OK && strcmp(type, FILETYPE) != 0) status = FW_E_FORMAT;
        free(type);
        fw_h5_file_close(&old);
    }
    FW_CHECK(status != FW_E_NOMEM, m, FW_E_NOMEM, "%s", why.text); /* that says nothing of the file */
    FW_CHECK(status == FW_OK, m, FW_E_MISMATCH, "%s is there already and is no trajectory of floewear: choose another name", path);
    return FW_OK;
}

fw_status fw_trajectory_create(fw_trajectory **out, const char *path, const fw_scene *s, fw_msg *m)
{
    fw_trajectory *t;
    *out = NULL;
    FW_TRY(check_place(path, m));
    FW_TRY(fw_alloc(&t, 1, sizeof *t, "a trajectory", m));
    size_t n_block = BLOCK_BYTES / (sizeof(double) * (s->n_floes > 0 ? s->n_floes : 1));
    t->n_floes = s->n_floes;
    t->n_block = n_block < 1 ? 1 : n_block > MAX_BLOCK ? MAX_BLOCK : n_block;
    fw_status status = fw_alloc(&t->times, t->n_block, sizeof *t->times, "times of frames", m);
    for (int i = 0; i < N_STATES && status == FW_OK; i++) {
        status = fw_alloc(&t->values[i], t->n_block * t->n_floes, sizeof *t->values[i], "states of floes", m);
    }
    if (status == FW_OK) status = fw_h5_file_create(&t->file, path, m);
    if (status == FW_OK) status = put_head(t, s, m);
    if (status == FW_OK) status = fw_h5_file_check(&t->file, m);
    if (status == FW_OK)
        *out = t;
    else
        destroy(t);
    return status;
}

static fw_status write_block(fw_trajectory *t, fw_msg *m)
{
    size_t n = t->n_held;
    t->n_held = 0; /* also when it fails: a caller that goes on all the same must not run over the block */
    FW_TRY(fw_h5_write_rows(&t->file, t->time, H5T_NATIVE_DOUBLE, t->n_written, n, t->times, m));
    for (int i = 0; i < N_STATES; i++) {
        FW_TRY(fw_h5_write_rows(&t->file, t->datasets[i], H5T_NATIVE_DOUBLE, t->n_written, n, t->values[i], m));
    }
    t->n_written += n;
    return fw_h5_file_check(&t->file, m);
}

static fw_status take_frame(void *self, double time, size_t n_floes, const fw_floe *floes, fw_msg *m)
{
    fw_trajectory *t = self;
    FW_CHECK(n_floes == t->n_floes, m, FW_E_ARG, "%s: a frame of %zu floes in a trajectory of %zu", t->file.path,
             n_floes, t->n_floes);
    if (time == 0) t->n_written = t->n_held = 0; /* the run is repeated with finer steps */
    t->times[t->n_held] = time;
    for (int s = 0; s < N_STATES; s++) {
        for (size_t i = 0; i < n_floes; i++) t->values[s][t->n_held * n_floes + i] = get(&floes[i], states[s].offset);
    }
    t->n_held++;
    return t->n_held == t->n_block ? write_block(t, m) : FW_OK;
}

fw_frame_sink fw_trajectory_sink(fw_trajectory *t, double interval)
{
    return (fw_frame_sink){.frame = take_frame, .self = t, .interval = interval};
}

fw_status fw_trajectory_close(fw_trajectory *t, fw_msg *m)
{
    if (t == NULL) return FW_OK;
    fw_status status = fw_h5_file_check(&t->file, m); /* an earlier frame may have met a full disk */
    if (status == FW_OK && t->n_held > 0) status = write_block(t, m);
    if (status == FW_OK) {
        H5Dclose(t->time);
        for (int i = 0; i < N_STATES; i++) H5Dclose(t->datasets[i]);
        status = fw_h5_file_finish(&t->file, m);
    }
    destroy(t);
    return status;
}

void fw_trajectory_abandon(fw_trajectory *t) { destroy(t); }
