/* Memory runs out in a whole campaign as `floewear run` has it, alone: the choices of numerics and effects, files opened, windows
 * simulated into the journal, the answer, NAME.h5. After every failure the same run goes on and gives the same results.
 * MPI is not started. */
#include "cli/choice.h"
#include "cli/config.h"
#include "cli/effects_tables.h"
#include "cli/report_tables_h5.h"
#include "cli/run_files.h"
#include "memory/inject.h"
#include "store/store_help.h"

static const char text[] = "name: small\n"
                           "structure: {measuring_points: 4}\n"
                           "ice: {temperature: {uniform: [-12 degC, -2 degC]}, concentration: 40 %, thickness_mixes: [{probability: 1, classes: {0.5 m: 1}}]}\n"
                           "current: {speed: {uniform: [1 m/s, 2 m/s]}, direction: {rose: {0 deg: 1, 90 deg: 2}}}\n"
                           "exposure: {window: 5 s, warm_up: 1 s}\n"
                           "precision: {max_realisations: 4}\n"
                           "service: {life: 50 year, ice_hours_per_year: 1200 h}\n"
                           "effects_tolerance: 2 %\n"
                           "seed: 3\n";
static const char file[] = "small.yaml", results[] = "small.h5", journal[] = "small.journal";

typedef struct session {
    bool         is_resumed;
    fw_campaign  campaign;
    fw_choice    choice;
    fw_run_files files;
    fw_answer    answer;
    uint64_t     settings; /* hash of the settings when all went well; a failure must not lead to others */
} session;

static fw_status look(void *self, uint64_t n, bool *is_enough, fw_msg *m)
{
    session         *s = self;
    fw_answer_source source = fw_run_files_answer(&s->files, n);
    fw_reached       reached;
    FW_TRY(fw_answer_reached(&s->campaign, &source, &reached, m));
    *is_enough = false;
    return FW_OK;
}

static fw_status run_on(session *s, fw_msg *m)
{
    fw_run_result result;
    FW_TRY(fw_run_files_open(&s->files, &s->campaign, NULL, false, false, 0, m));
    fw_run run = {.campaign = &s->campaign,
                  .have = s->files.have,
                  .n_have = s->files.n_have,
                  .have_failed = s->files.have_failed,
                  .n_have_failed = s->files.n_have_failed,
                  .sink = fw_run_files_sink(&s->files),
                  .stop = {.look = look, .self = s},
                  .only_id = -1};
    FW_TRY(fw_campaign_run(&run, &result, m));
    fw_answer_source  source = fw_run_files_answer(&s->files, result.n_prefix);
    fw_record_source  records = fw_run_files_records(&s->files, result.n_prefix);
    fw_answer_options o = {.measured = &s->choice.measured, .effects = &s->choice.effects};
    FW_TRY(fw_answer_make(&s->answer, &s->campaign, &source, &o, m));
    return fw_report_write(results, &s->campaign, &records, &s->answer, m);
}

/* As run_lead in cmd_run.c. */
static fw_status run(void *self, fw_msg *m)
{
    session         *s = self;
    fw_choice_wanted wanted = {.campaign = file, .seed = -1};
    FW_TRY(fw_choice_campaign(&s->campaign, &wanted, &s->choice, m));
    fw_status status = run_on(s, m);
    fw_msg    own = {.text = ""};
    fw_status closed = fw_run_files_close(&s->files, status == FW_OK ? m : &own);
    return status != FW_OK ? status : closed;
}

/* Its two parts that look at files of earlier runs: without memory neither may take them for absent or for others. */
static fw_status choose(void *self, fw_msg *m)
{
    session         *s = self;
    fw_choice_wanted wanted = {.campaign = file, .seed = -1};
    return fw_choice_campaign(&s->campaign, &wanted, &s->choice, m);
}

static uint64_t end_choose(void *self, fw_status status)
{
    session *s = self;
    uint64_t h = 0;
    if (status == FW_OK) {
        assert_true(s->choice.is_taken && s->choice.dropped == FW_EFFECT_FLOE_CONTACT && s->choice.effects.n_rows == 1);
        h = inject_hash(s->campaign.hash, s->choice.line, strlen(s->choice.line));
        h = inject_hash(h, s->choice.effects_line, strlen(s->choice.effects_line));
    }
    fw_campaign_free(&s->campaign);
    return h;
}

static void begin_files(void *self)
{
    unlink(journal); /* so that the results themselves have to say whose they are */
    assert_ok(choose(self, &msg));
}

static fw_status open_files(void *self, fw_msg *m)
{
    session *s = self;
    return fw_run_files_open(&s->files, &s->campaign, NULL, false, false, 0, m);
}

static uint64_t end_files(void *self, fw_status status)
{
    session *s = self;
    assert_ok(fw_run_files_close(&s->files, &msg));
    if (status != FW_OK) assert_false(help_exists("small.journal.tmp"));
    fw_campaign_free(&s->campaign);
    return 1;
}

static void begin(void *self)
{
    session *s = self;
    unlink(journal);
    if (!s->is_resumed) unlink(results); /* else: results without their journal, made again */
}

static uint64_t hash_session(const session *s)
{
    uint64_t h = inject_hash(s->answer.n, s->campaign.settings, strlen(s->campaign.settings));
    for (size_t i = 0; i < s->answer.n_percentiles; i++)
        h = inject_hash(h, &s->answer.percentiles[i].depth_mm, sizeof(double));
    return inject_hash(h, s->answer.points, s->answer.n_points * sizeof *s->answer.points);
}

static void free_session(session *s)
{
    fw_answer_free(&s->answer);
    fw_campaign_free(&s->campaign);
}

static uint64_t end(void *self, fw_status status)
{
    session *s = self;
    assert_false(help_exists("small.h5.tmp") || help_exists("small.journal.tmp"));
    assert_true(status == FW_OK || s->is_resumed || !help_exists(results));
    free_session(s);
    /* whatever was there before and whatever the failure left: the next run goes on from it */
    assert_ok(run(s, &msg));
    uint64_t h = hash_session(s);
    if (s->settings == 0) s->settings = h;
    assert_true(h == s->settings);
    free_session(s);
    return h;
}

static void make_choice(void)
{
    fw_campaign c;
    fw_accuracy a = {.choice = {.numerics = {.order = 3,
                                             .tolerance = 3e-4,
                                             .wear_tolerance = 1e-3,
                                             .first_step = 0.05,
                                             .growth = 2},
                                .n_arcs = 720,
                                .strip_width = -1,
                                .downstream = -1,
                                .warm_up = -1}};
    assert_ok(fw_config_campaign(&c, file, 0, NULL, -1, &msg));
    fw_measured_default(&a.measured, &c.model);
    assert_ok(fw_accuracy_file_write("small.accuracy.h5", &c, &a, &msg));
    static fw_effects_ledger l = {.n_windows = 4, .point = 1, .n_rows = 1, .rows = {{.name = "floe_contact", .is_effect = true, .was_on = true, .cpu_saved = 0.5}}};
    assert_ok(fw_effects_tables_write("small.effects.h5", &c, &l, &msg));
    fw_campaign_free(&c);
}

static void whole(void **state)
{
    (void)state;
    help_save(file, (const unsigned char *)text, strlen(text));
    session s = {.is_resumed = false};
    inject_walk(&(inject_case){.name = "campaign", .begin = begin, .run = run, .end = end, .self = &s, .stride = 41});
    s = (session){.is_resumed = true};
    inject_walk(
        &(inject_case){.name = "campaign made again", .begin = begin, .run = run, .end = end, .self = &s, .stride = 97});
    unlink(results);
    make_choice();
    s = (session){.is_resumed = false};
    inject_walk(&(inject_case){
        .name = "campaign with chosen numerics and effects", .begin = begin, .run = run, .end = end, .self = &s, .stride = 89});
    inject_walk(&(inject_case){.name = "choice of numerics and effects", .run = choose, .end = end_choose, .self = &s});
    inject_walk(&(inject_case){
        .name = "files of a campaign", .begin = begin_files, .run = open_files, .end = end_files, .self = &s});
}

int main(void)
{
    const struct CMUnitTest tests[] = {cmocka_unit_test(whole)};
    return cmocka_run_group_tests(tests, help_enter_folder, help_leave_folder);
}
