/* Memory runs out while records become answers, and in the statistics below them. */
#include "campaign/leases.h"
#include "memory/inject.h"
#include "statistics/mixture.h"
#include "study/accuracy.h"
#include "study/effects_ledger.h"
#include "study/made_up.h"

/* ---- answers ---- */

typedef struct asking {
    fw_campaign      campaign;
    double           bearings[24];
    made_up          records;
    fw_answer_source source;
    fw_answer        answer;
    fw_reached       reached;
} asking;

static uint64_t hash_answer(const fw_answer *a)
{
    uint64_t h = inject_hash(a->governing_point, &a->half_width, sizeof a->half_width);
    for (size_t i = 0; i < a->n_percentiles; i++) {
        const fw_percentile_row *p = &a->percentiles[i];
        double                   row[] = {p->bearing_deg, p->percentile, p->depth_mm, p->low_mm, p->high_mm, p->coverage};
        h = inject_hash(h, row, sizeof row);
    }
    h = inject_hash(h, a->points, a->n_points * sizeof *a->points);
    if (a->n_life) h = inject_hash(h, a->life, a->n_life * sizeof *a->life);
    for (size_t i = 0; i < a->n_ledger; i++) h = inject_hash(h, &a->ledger[i].amount, sizeof a->ledger[i].amount);
    return h;
}

static fw_status make_answer(void *self, fw_msg *m)
{
    asking *q = self;
    return fw_answer_make(&q->answer, &q->campaign, &q->source, NULL, m);
}

static uint64_t end_answer(void *self, fw_status status)
{
    asking  *q = self;
    uint64_t h = status == FW_OK ? hash_answer(&q->answer) : 0;
    if (status != FW_OK) assert_true(q->answer.percentiles == NULL && q->answer.ledger == NULL && q->answer.n == 0);
    fw_answer_free(&q->answer);
    return h;
}

static fw_status ask_half_width(void *self, fw_msg *m)
{
    asking *q = self;
    return fw_answer_reached(&q->campaign, &q->source, &q->reached, m);
}

static uint64_t end_half_width(void *self, fw_status status)
{
    asking *q = self;
    double  all[] = {q->reached.half_width, q->reached.value_mm, (double)q->reached.point};
    if (status != FW_OK) assert_true(q->reached.half_width == INFINITY); /* never taken for enough */
    return status == FW_OK ? inject_hash(0, all, sizeof all) : 0;
}

static void ask(const char *name, asking *q, uint64_t n)
{
    q->records.campaign = &q->campaign;
    q->source = made_up_source(&q->records, n);
    inject_walk(&(inject_case){.name = name, .run = make_answer, .end = end_answer, .self = q});
    inject_walk(&(inject_case){
        .name = "half-width of the same", .run = ask_half_width, .end = end_half_width, .self = q, .stride = 1});
}

static void answers(void **state)
{
    (void)state;
    asking q = {.records = {.sigma = 1, .fail_every = 20}};
    q.campaign = made_up_campaign(q.bearings);
    ask("answer of constant scenes", &q, 100);
    q.campaign.points.n = 2;
    q.campaign.site.temperature = made_up_law(FW_DIST_UNIFORM, -12, -2);
    q.campaign.site.direction = made_up_law(FW_DIST_NORMAL, 20, 25);
    q.campaign.service.allowance = 20;
    ask("answer of scattered scenes", &q, 60);
    fw_service_year table[] = {{15, 1}, {9, 2}};
    fw_service      alone = q.campaign.service;
    q.campaign.points.n = 1;
    q.campaign.service = (fw_service){.is_asked = true, .life_years = 1, .ice_hours_per_year = 12, .persistence = 0.9, .n_table = 2, .table = table};
    q.campaign.model.n_laws = 2;
    q.campaign.model.laws[1] = (fw_abrasion_law){"power", 0.1, 1.3, true};
    q.campaign.after.has_law_exponent = true;
    q.campaign.after.law_exponent = made_up_law(FW_DIST_UNIFORM, 1.15, 1.25);
    ask("answer with lives that are simulated", &q, 60);
    q.campaign.after.has_law_exponent = false;
    q.campaign.model.n_laws = 1, q.campaign.points.n = 2, q.campaign.service = alone;
    q.campaign.service.is_asked = false;
    ask("answer of 120 records", &q, 120); /* beyond 20000 entries: joined in bins */
    q.campaign.precision.quantity = FW_QUANTITY_MEAN;
    q.campaign.model.ice_density = 900, q.campaign.model.water_density = 1025;
    q.campaign.after.has_water_level = true;
    fw_distribution_constant(&q.campaign.after.water_level, 0);
    ask("answer about a mean, over height", &q, 30);
}

/* ---- accuracy ---- */

enum { N_RECORDS = 12 };

typedef struct judging {
    fw_campaign campaign;
    double      bearings[24];
    fw_record   records[N_RECORDS];
    double      error, value;
    char        name[32];
} judging;

static fw_status judge_percentile(void *self, fw_msg *m)
{
    judging *j = self;
    return fw_accuracy_percentile_error(&j->campaign, N_RECORDS, j->records, 0.9, 4, &j->error, &j->value, m);
}

static fw_status judge_hits(void *self, fw_msg *m)
{
    judging *j = self;
    return fw_accuracy_hits(0.1, NULL, &j->error, j->name, sizeof j->name, m);
}

static uint64_t end_judging(void *self, fw_status status)
{
    judging *j = self;
    return status == FW_OK ? inject_hash(inject_hash(0, &j->error, sizeof j->error), &j->value, sizeof j->value) : 0;
}

/* A few windows at every level of everything that is studied, by one law. */
static void sparse_scenario(const fw_campaign *c, uint64_t id, fw_scenario *out)
{
    *out = (fw_scenario){.seed = c->seed, .id = id, .weight = 1, .randomisation = -1, .concentration = 0.1, .speed = 1};
}

static fw_status study_all(void *self, fw_msg *m)
{
    judging            *j = self;
    fw_accuracy         a;
    fw_accuracy_options o = {.scenario = sparse_scenario, .cpu_budget_s = 0};
    fw_status           s = fw_accuracy_study(&a, &j->campaign, &o, m);
    if (s == FW_OK) fw_accuracy_free(&a);
    return s;
}

static void accuracy(void **state)
{
    (void)state;
    judging j = {.value = 0};
    j.campaign = made_up_campaign(j.bearings);
    made_up source = {.campaign = &j.campaign, .sigma = 1};
    for (uint64_t id = 0; id < N_RECORDS; id++) {
        assert_int_equal(fw_record_init(&j.records[id], 360, 1, NULL), FW_OK);
        assert_int_equal(made_up_read(&source, id, &j.records[id], NULL), FW_OK);
    }
    inject_walk(&(inject_case){
        .name = "error of a percentile", .run = judge_percentile, .end = end_judging, .self = &j});
    fw_model_defaults(&j.campaign.model);
    j.campaign.model.window = 60, j.campaign.model.warm_up = 0, j.campaign.seed = 3;
    inject_walk(&(inject_case){.name = "whole accuracy study", .run = study_all, .end = end_judging, .self = &j});
    inject_walk(&(inject_case){.name = "embedded hits", .run = judge_hits, .end = end_judging, .self = &j});
    for (size_t id = 0; id < N_RECORDS; id++) fw_record_free(&j.records[id]);
}

/* ---- effects ledger ---- */

typedef struct switching {
    fw_campaign       campaign;
    double            bearings[24];
    fw_effects_ledger ledger;
} switching;

static fw_status switch_all(void *self, fw_msg *m)
{
    static const fw_effects_switch SWITCHES[] = {{"floe_contact", FW_EFFECT_FLOE_CONTACT, NULL, "of course"},
                                                 {"friction", FW_EFFECT_FRICTION, NULL, "of course"},
                                                 {"rotation", FW_EFFECT_ROTATION, NULL, "of course"},
                                                 {"form_drag", FW_EFFECT_FORM_DRAG, NULL, "of course"}};
    switching         *w = self;
    fw_effects_options o = {.scenario = sparse_scenario, .n_switches = 4, .switches = SWITCHES, .n_windows = 3, .way = 60};
    return fw_effects_ledger_make(&w->ledger, &w->campaign, &o, m);
}

static uint64_t end_switching(void *self, fw_status status)
{
    switching *w = self;
    uint64_t   h = inject_hash(w->ledger.n_rows, &w->ledger.percentile_mm, sizeof(double));
    for (size_t i = 0; i < w->ledger.n_rows; i++) h = inject_hash(h, &w->ledger.rows[i].mean, sizeof w->ledger.rows[i].mean);
    if (status != FW_OK) assert_true(w->ledger.n_rows == 0);
    return h;
}

static void effects(void **state)
{
    (void)state;
    static switching w;
    w.campaign = made_up_campaign(w.bearings);
    fw_model_defaults(&w.campaign.model);
    w.campaign.model.window = 60, w.campaign.model.warm_up = 0, w.campaign.seed = 3;
    inject_walk(&(inject_case){.name = "effects ledger", .run = switch_all, .end = end_switching, .self = &w, .may_go_on = true});
}

/* ---- statistics ---- */

typedef struct law_case {
    fw_distribution law, copy;
    fw_scale        scale;
    fw_mixture      mixture;
} law_case;

static fw_status make_laws(void *self, fw_msg *m)
{
    static const double    values[] = {-3, -7, -5, -3}, weights[] = {0.2, 0.5, 0.2, 0.1};
    const fw_mixture_entry entries[] = {{.load = 2, .weight = 1}, {.load = 0, .weight = 1}, {.load = 1, .weight = 3}};
    law_case              *l = self;
    FW_TRY(fw_distribution_values(&l->law, 4, values, weights, m));
    FW_TRY(fw_distribution_copy(&l->copy, &l->law, m));
    FW_TRY(fw_scale_make(&l->scale, 0.116, 1.121, &l->copy, m));
    return fw_mixture_make(&l->mixture, &l->scale, 3, entries, m);
}

static uint64_t end_laws(void *self, fw_status status)
{
    law_case *l = self;
    uint64_t  h = 0;
    if (status == FW_OK) {
        double at[] = {fw_distribution_quantile(&l->copy, 0.35), fw_mixture_quantile(&l->mixture, 0.9)};
        h = inject_hash(0, at, sizeof at);
    }
    fw_mixture_free(&l->mixture);
    fw_scale_free(&l->scale);
    fw_distribution_free(&l->copy);
    fw_distribution_free(&l->law);
    return h;
}

static void statistics(void **state)
{
    (void)state;
    law_case l = {.scale = {.n = 0}};
    inject_walk(&(inject_case){
        .name = "laws of given values", .run = make_laws, .end = end_laws, .self = &l, .stride = 1});
}

/* ---- leases ---- */

enum { N_IDS = 40 };

static fw_status lease(void *self, fw_msg *m)
{
    static const uint64_t have[] = {0, 1, 4, 9}, failed[] = {1, 9};
    fw_leases            *l = self;
    uint64_t              id;
    FW_TRY(fw_leases_create(l, 2, 0, N_IDS, N_IDS, false, 4, have, 2, failed, m));
    for (int rank = 0; fw_leases_take(l, rank, &id); rank = !rank)
        FW_TRY(fw_leases_done(l, rank, id, id % 2 ? "why" : NULL, m));
    return FW_OK;
}

static uint64_t end_lease(void *self, fw_status status)
{
    fw_leases *l = self;
    uint64_t   h = 0;
    if (status == FW_OK) {
        assert_int_equal(fw_leases_prefix(l), N_IDS);
        h = inject_hash(l->n_done, l->failed, l->n_failed * sizeof *l->failed);
    }
    fw_leases_destroy(l);
    return h;
}

static void leases(void **state)
{
    (void)state;
    fw_leases l = {.n_ranks = 0};
    inject_walk(&(inject_case){.name = "leases", .run = lease, .end = end_lease, .self = &l, .stride = 1});
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(answers),
        cmocka_unit_test(accuracy),
        cmocka_unit_test(effects),
        cmocka_unit_test(statistics),
        cmocka_unit_test(leases),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
