/* Memory runs out while NAME.h5, a file of tables and a trajectory are written and read. After a failure PATH is the old
 * file or none, and PATH.tmp is gone. What HDF5 allocates for itself is not counted (inject.h). */
#include "memory/inject.h"
#include "store/store_help.h"
#include "store/tables.h"

enum { N_ARCS = 72, N_LAWS = 2, N_RECORDS = 9, N_FLOES = 5, N_FRAMES = 40 };

static const char path[] = "a.h5", temporary[] = "a.h5.tmp";

typedef struct filing {
    fw_campaign    campaign;
    unsigned char *before; /* (n_before) what stands under PATH; NULL: nothing */
    size_t         n_before;
    fw_results    *results;
    fw_tables     *tables;
    fw_trajectory *trajectory;
    double        *numbers;
    char          *texts;
    uint64_t       hash;
} filing;

static void begin(void *self)
{
    filing *f = self;
    f->hash = 0;
    unlink(path);
    if (f->before) help_save(path, f->before, f->n_before);
}

static void assert_untouched(const filing *f)
{
    assert_false(help_exists(temporary));
    assert_true(help_exists(path) == (f->before != NULL));
    if (!f->before) return;
    size_t         n;
    unsigned char *now = help_load(path, &n);
    assert_int_equal(n, f->n_before);
    assert_memory_equal(now, f->before, n);
    free(now);
}

/* Run once, so that there is a file; its bytes are what later runs begin with. */
static void keep_file(filing *f, fw_status (*write)(void *self, fw_msg *m))
{
    unlink(path);
    assert_ok(write(f, &msg));
    f->before = help_load(path, &f->n_before);
}

/* ---- results ---- */

static fw_status read_made(void *self, uint64_t id, fw_record *r, fw_msg *m)
{
    (void)self, (void)m;
    help_fill(r, id);
    return FW_OK;
}

static const char *const texts[] = {"order statistics", NULL, "sectioning"};
static const double      depths[] = {0.5, NAN, -0.0};
static const int64_t     points[] = {1, 2, 3};
static fw_column         columns[] = {{.name = "depth_mm", .unit = "mm", .number = depths},
                                      {.name = "point", .integer = points},
                                      {.name = "method", .text = texts}};
static const fw_table    table = {.name = "percentiles", .n_rows = 3, .n_columns = 3, .columns = columns};

static fw_status write_results(void *self, fw_msg *m)
{
    filing          *f = self;
    fw_record_source source = {.n = N_RECORDS, .read = read_made};
    return fw_results_write(path, &f->campaign, &source, 1, &table, m);
}

static fw_status read_results(void *self, fw_msg *m)
{
    filing            *f = self;
    const char *const *sets;
    fw_record          r;
    FW_TRY(fw_results_open(&f->results, path, m));
    const char *text = fw_results_campaign_text(f->results);
    size_t      n_sets = fw_results_sets(f->results, &sets);
    f->hash = inject_hash(0, text, strlen(text));
    for (size_t i = 0; i < n_sets; i++) f->hash = inject_hash(f->hash, sets[i], strlen(sets[i]));
    FW_TRY(fw_record_init(&r, N_ARCS, N_LAWS, m));
    fw_record_source source = fw_results_records(f->results);
    fw_status        status = FW_OK;
    for (uint64_t id = 0; id < source.n && status == FW_OK; id++) {
        status = source.read(source.self, id, &r, m);
        f->hash = inject_hash(f->hash, r.rings, fw_record_n_rings(N_ARCS, N_LAWS) * sizeof(double));
        f->hash = inject_hash(f->hash, r.cause, strlen(r.cause));
    }
    const fw_record *lent;
    size_t           n_lent = 0;
    for (uint64_t at = 0; at < source.n && status == FW_OK; at += n_lent) {
        status = fw_records_lend(&source, at, &r, &lent, &n_lent, m);
        if (status != FW_OK) break;
        f->hash = inject_hash(f->hash, lent[0].rings, n_lent * fw_record_n_rings(N_ARCS, N_LAWS) * sizeof(double)); /* they lie in one piece */
        f->hash = inject_hash(f->hash, lent[0].cause, strlen(lent[0].cause));
    }
    fw_record_free(&r);
    return status;
}

static uint64_t end_read_results(void *self, fw_status status)
{
    filing *f = self;
    fw_results_close(f->results);
    f->results = NULL;
    assert_untouched(f);
    return status == FW_OK ? f->hash : 0;
}

static uint64_t end_write_results(void *self, fw_status status)
{
    filing *f = self;
    if (status != FW_OK) {
        assert_untouched(f);
        return 0;
    }
    assert_false(help_exists(temporary));
    assert_ok(read_results(f, &msg)); /* its bytes name host and hour: what is in it counts */
    fw_results_close(f->results);
    f->results = NULL;
    return f->hash;
}

static void results(void **state)
{
    (void)state;
    char   first[] = "ice.concentration=60%", second[] = "seed=7", *sets[] = {first, second};
    filing f = {.campaign = help_campaign(N_ARCS, N_LAWS)};
    f.campaign.sets = sets;
    f.campaign.n_sets = 2;
    inject_walk(&(inject_case){
        .name = "results, new", .begin = begin, .run = write_results, .end = end_write_results, .self = &f, .stride = 1});
    keep_file(&f, write_results);
    inject_walk(&(inject_case){.name = "results in the place of older ones",
                               .begin = begin,
                               .run = write_results,
                               .end = end_write_results,
                               .self = &f,
                               .stride = 1});
    inject_walk(&(inject_case){
        .name = "results, read", .begin = begin, .run = read_results, .end = end_read_results, .self = &f, .stride = 1});
    free(f.before);
}

/* ---- files of tables ---- */

static fw_status write_tables(void *self, fw_msg *m)
{
    filing *f = self;
    return fw_tables_write(path, FW_ACCURACY_FILETYPE, &f->campaign, 1, &table, m);
}

static fw_status read_tables(void *self, fw_msg *m)
{
    filing *f = self;
    size_t  n, width;
    FW_TRY(fw_tables_open(&f->tables, path, FW_ACCURACY_FILETYPE, m));
    FW_TRY(fw_tables_numbers(f->tables, "percentiles", "depth_mm", 10, &n, &f->numbers, m));
    f->hash = inject_hash(0, f->numbers, n * sizeof *f->numbers);
    FW_TRY(fw_tables_texts(f->tables, "percentiles", "method", 10, &n, &width, &f->texts, m));
    f->hash = inject_hash(f->hash, f->texts, n * width);
    return FW_OK;
}

static void free_tables(filing *f)
{
    fw_tables_close(f->tables);
    free(f->numbers);
    free(f->texts);
    f->tables = NULL;
    f->numbers = NULL;
    f->texts = NULL;
}

static uint64_t end_read_tables(void *self, fw_status status)
{
    filing *f = self;
    free_tables(f);
    assert_untouched(f);
    return status == FW_OK ? f->hash : 0;
}

static uint64_t end_write_tables(void *self, fw_status status)
{
    filing *f = self;
    if (status != FW_OK) {
        assert_untouched(f);
        return 0;
    }
    assert_false(help_exists(temporary));
    assert_ok(read_tables(f, &msg));
    free_tables(f);
    return f->hash;
}

static void tables(void **state)
{
    (void)state;
    filing f = {.campaign = help_campaign(N_ARCS, N_LAWS)};
    inject_walk(&(inject_case){
        .name = "tables, new", .begin = begin, .run = write_tables, .end = end_write_tables, .self = &f, .stride = 1});
    keep_file(&f, write_tables);
    inject_walk(&(inject_case){.name = "tables in the place of older ones",
                               .begin = begin,
                               .run = write_tables,
                               .end = end_write_tables,
                               .self = &f,
                               .stride = 1});
    inject_walk(&(inject_case){
        .name = "tables, read", .begin = begin, .run = read_tables, .end = end_read_tables, .self = &f, .stride = 1});
    free(f.before);
}

/* ---- trajectories ---- */

static fw_status write_trajectory(void *self, fw_msg *m)
{
    filing  *f = self;
    fw_floe  floes[N_FLOES];
    fw_scene scene = {.speed = 2, .temperature = -10, .duration = 8, .n_floes = N_FLOES, .floes = floes};
    for (int i = 0; i < N_FLOES; i++) floes[i] = (fw_floe){.x = i, .y = -i, .diameter = 2.5 + i, .thickness = 0.5};
    FW_TRY(fw_trajectory_create(&f->trajectory, path, &scene, m));
    fw_frame_sink sink = fw_trajectory_sink(f->trajectory, 0.25);
    fw_status     status = FW_OK;
    for (int frame = 0; frame < N_FRAMES && status == FW_OK; frame++) {
        floes[0].x = frame;
        status = sink.frame(sink.self, 0.25 * frame, N_FLOES, floes, m);
    }
    if (status == FW_OK)
        status = fw_trajectory_close(f->trajectory, m);
    else
        fw_trajectory_abandon(f->trajectory);
    f->trajectory = NULL;
    return status;
}

static uint64_t end_trajectory(void *self, fw_status status)
{
    filing *f = self;
    if (status != FW_OK) {
        assert_untouched(f);
        return 0;
    }
    assert_false(help_exists(temporary));
    struct stat s;
    assert_int_equal(stat(path, &s), 0);
    return (uint64_t)s.st_size; /* store.trajectory looks inside */
}

static void trajectories(void **state)
{
    (void)state;
    filing f = {.before = NULL};
    inject_walk(&(inject_case){.name = "trajectory, new",
                               .begin = begin,
                               .run = write_trajectory,
                               .end = end_trajectory,
                               .self = &f,
                               .stride = 1});
    keep_file(&f, write_trajectory);
    inject_walk(&(inject_case){.name = "trajectory in the place of an older one",
                               .begin = begin,
                               .run = write_trajectory,
                               .end = end_trajectory,
                               .self = &f,
                               .stride = 1});
    free(f.before);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(results),
        cmocka_unit_test(tables),
        cmocka_unit_test(trajectories),
    };
    return cmocka_run_group_tests(tests, help_enter_folder, help_leave_folder);
}
