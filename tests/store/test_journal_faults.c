/* The journal when the disk is full, when somebody reads beside the writer, and when the writer is killed. */

#include "journal_help.h"

/* In a child, because a limit once lowered stays: files may not grow beyond `limit` bytes (SIGXFSZ ignored, so that
 * write says EFBIG after a short write, exactly as ENOSPC comes from a full disk). Returns the child's exit code. */
static int under_limit(size_t limit, int (*work)(void))
{
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) {
        struct rlimit l = {.rlim_cur = limit, .rlim_max = limit};
        signal(SIGXFSZ, SIG_IGN);
        _exit(setrlimit(RLIMIT_FSIZE, &l) == 0 ? work() : 99);
    }
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status));
    return WEXITSTATUS(status);
}

static int work_until_full(void)
{
    fw_campaign c = help_campaign(N_ARCS, N_LAWS);
    fw_journal *j;
    fw_record   r;
    if (fw_record_init(&r, N_ARCS, N_LAWS, &msg) != FW_OK) return 98;
    if (fw_journal_open(&j, "i.journal", &c, false, &msg) != FW_OK) return 1;
    for (uint64_t id = 0; id < 40; id++) {
        help_fill(&r, id);
        if (fw_journal_append(j, &r, &msg) != FW_OK) return 2;
        if (id % 4 == 3 && fw_journal_flush(j, &msg) != FW_OK) {
            bool says = strstr(msg.text, "i.journal") != NULL && strstr(msg.text, "bytes") != NULL &&
                        strstr(msg.text, "cut back") != NULL && strstr(msg.text, strerror(EFBIG)) != NULL;
            fw_status still = fw_journal_close(j, &msg);
            fw_record_free(&r);
            return says && still == FW_E_IO ? 3 : 4;
        }
    }
    return 5;
}

static void test_full_disk(void **state)
{
    (void)state;
    fw_campaign c = help_campaign(N_ARCS, N_LAWS);
    size_t      head = header_size(&c), block = block_size();
    for (size_t extra = 0; extra < block; extra += 331) {
        fw_journal *j;
        size_t      n;
        remove_all("i.journal");
        /* commits of four: the third one is torn somewhere in its records 8 to 11; the whole ones before stay */
        size_t whole = 8 + extra / 331 % 4, limit = head + whole * block + extra;
        assert_int_equal(under_limit(limit, work_until_full), 3);
        free(help_load("i.journal", &n));
        assert_int_equal(n, head + whole * block);
        assert_ok(fw_journal_open(&j, "i.journal", &c, false, &msg)); /* resume on a disk with room */
        assert_int_equal(fw_journal_torn(j), 0);
        assert_range(j, whole);
        append_range(j, whole, 40);
        assert_ok(fw_journal_close(j, &msg));
        assert_ok(fw_journal_open(&j, "i.journal", &c, false, &msg));
        assert_range(j, 40);
        assert_ok(fw_journal_close(j, &msg));
    }
    remove_all("i.journal");
    assert_int_equal(under_limit(head - 1, work_until_full), 1); /* not even the header */
    assert_false(help_exists("i.journal"));
    assert_false(help_exists("i.journal.tmp"));
}

static int work_with_second_chance(void)
{
    fw_campaign   c = help_campaign(N_ARCS, N_LAWS);
    fw_journal   *j;
    struct rlimit low;
    if (fw_journal_open(&j, "k.journal", &c, false, &msg) != FW_OK || getrlimit(RLIMIT_FSIZE, &low) != 0) return 1;
    struct rlimit tight = {.rlim_cur = header_size(&c) + block_size() / 2, .rlim_max = low.rlim_max};
    if (setrlimit(RLIMIT_FSIZE, &tight) != 0) return 2;
    append_range(j, 0, 99);
    fw_record r;
    if (fw_record_init(&r, N_ARCS, N_LAWS, &msg) != FW_OK) return 3;
    help_fill(&r, 99);
    if (fw_journal_append(j, &r, &msg) != FW_E_IO) return 4;
    help_fill(&r, 100);
    if (fw_journal_append(j, &r, &msg) != FW_E_IO) return 5; /* the buffer is full: refused, not lost silently */
    tight.rlim_cur += 10 * block_size();                     /* room for ten: they go to disk, the others wait */
    if (setrlimit(RLIMIT_FSIZE, &tight) != 0 || fw_journal_flush(j, &msg) != FW_E_IO) return 6;
    assert_record(j, 9);
    assert_record(j, 10);
    if (setrlimit(RLIMIT_FSIZE, &low) != 0) return 9;
    if (fw_journal_append(j, &r, &msg) != FW_OK) return 7;
    fw_record_free(&r);
    return fw_journal_close(j, &msg) == FW_OK ? 0 : 8;
}

static void test_room_again(void **state)
{
    (void)state;
    fw_campaign c = help_campaign(N_ARCS, N_LAWS);
    fw_journal *j;
    remove_all("k.journal");
    assert_int_equal(under_limit(1 << 24, work_with_second_chance), 0);
    assert_ok(fw_journal_open(&j, "k.journal", &c, false, &msg));
    assert_range(j, 101);
    assert_ok(fw_journal_close(j, &msg));
}

static void test_reader_beside_a_writer(void **state)
{
    (void)state;
    enum { N = 3000 };
    fw_campaign c = help_campaign(N_ARCS, N_LAWS);
    fw_journal *j;
    remove_all("l.journal");
    assert_ok(fw_journal_open(&j, "l.journal", &c, false, &msg));
    pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0) { /* the writer; it has the lock by the same open file */
        fw_record r;
        if (fw_record_init(&r, N_ARCS, N_LAWS, NULL) != FW_OK) _exit(1);
        for (uint64_t id = 0; id < N; id++) {
            help_fill(&r, id);
            if (fw_journal_append(j, &r, NULL) != FW_OK || (id % 17 == 0 && fw_journal_flush(j, NULL) != FW_OK))
                _exit(2);
        }
        fw_record_free(&r);
        _exit(fw_journal_close(j, NULL) == FW_OK ? 0 : 3);
    }
    uint64_t seen = 0;
    while (seen < N) {
        fw_journal *reader;
        size_t      n;
        assert_ok(fw_journal_open_read(&reader, "l.journal", &c, &msg));
        fw_journal_ids(reader, &n);
        assert_true(n >= seen);
        seen = n;
        assert_int_equal(fw_journal_prefix(reader), seen);
        if (seen > 0) assert_record(reader, seen - 1);
        assert_ok(fw_journal_close(reader, &msg));
    }
    int status;
    assert_int_equal(waitpid(child, &status, 0), child);
    assert_true(WIFEXITED(status));
    assert_int_equal(WEXITSTATUS(status), 0);
    assert_ok(fw_journal_close(j, &msg));
}

/* A writer killed at random moments, from before the file exists to the middle of commits: whenever the journal is
 * opened again it holds a prefix of what was appended, and at the end all of it. */
static void test_killed_writer(void **state)
{
    (void)state;
    enum { N = 2000 };
    fw_campaign c = help_campaign(N_ARCS, N_LAWS);
    uint64_t    chaos = 42, kills = 0;
    remove_all("n.journal");
    for (bool is_done = false; !is_done && kills < 500;) {
        pid_t child = fork();
        assert_true(child >= 0);
        if (child == 0) {
            fw_journal *j;
            fw_record   r;
            if (fw_journal_open(&j, "n.journal", &c, false, NULL) != FW_OK) _exit(1);
            if (fw_record_init(&r, N_ARCS, N_LAWS, NULL) != FW_OK) _exit(2);
            for (uint64_t id = fw_journal_prefix(j); id < N; id++) {
                help_fill(&r, id);
                if (fw_journal_append(j, &r, NULL) != FW_OK || (id % 7 == 0 && fw_journal_flush(j, NULL) != FW_OK))
                    _exit(3);
            }
            fw_record_free(&r);
            _exit(fw_journal_close(j, NULL) == FW_OK ? 0 : 4);
        }
        if (kills < 25) {
            nanosleep(&(struct timespec){.tv_nsec = 1000 * (long)(help_next(&chaos) % (kills < 5 ? 400 : 20000))},
                      NULL);
            kill(child, SIGKILL);
            kills++;
        }
        int status;
        assert_int_equal(waitpid(child, &status, 0), child);
        if (WIFEXITED(status)) assert_int_equal(WEXITSTATUS(status), 0);
        is_done = WIFEXITED(status);
        fw_journal *j;
        if (help_exists("n.journal")) {
            size_t n;
            assert_ok(fw_journal_open_read(&j, "n.journal", &c, &msg));
            fw_journal_ids(j, &n);
            assert_int_equal(fw_journal_prefix(j), n);
            assert_ok(fw_journal_close(j, &msg));
        }
    }
    fw_journal *j;
    assert_ok(fw_journal_open(&j, "n.journal", &c, false, &msg));
    assert_range(j, N);
    assert_ok(fw_journal_close(j, &msg));
    assert_false(help_exists("n.journal.tmp"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(test_full_disk),
        cmocka_unit_test(test_room_again),
        cmocka_unit_test(test_reader_beside_a_writer),
        cmocka_unit_test(test_killed_writer),
    };
    return cmocka_run_group_tests(tests, help_enter_folder, help_leave_folder);
}
