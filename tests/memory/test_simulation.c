/* Memory runs out while ice is made, a window is simulated and a scene of given floes is run. */
#include "cli/config.h"
#include "field/field.h"
#include "memory/inject.h"

/* ---- the ice field ---- */

typedef struct laying {
    fw_field_settings settings;
    fw_field         *field;
    uint64_t          hash;
} laying;

static fw_status lay(void *self, fw_msg *m)
{
    laying *l = self;
    FW_TRY(fw_field_create(&l->field, &l->settings, m));
    for (int64_t column = 0; column < 3; column++) {
        for (int64_t row = -1; row <= 1; row++) {
            const fw_tile *t;
            FW_TRY(fw_field_tile(l->field, -column, row, &t, m));
            l->hash = inject_hash(l->hash, t->x, 4 * t->n_floes * sizeof *t->x); /* x, y, radius, thickness in one block */
        }
        fw_field_forget(l->field, 4 - column);
    }
    return FW_OK;
}

static uint64_t end_laying(void *self, fw_status status)
{
    laying  *l = self;
    uint64_t h = status == FW_OK ? l->hash : 0;
    fw_field_destroy(l->field);
    l->field = NULL;
    l->hash = 0;
    return h;
}

static void fields(void **state)
{
    (void)state;
    fw_model m;
    fw_model_defaults(&m);
    static const struct {
        const char *name;
        double      concentration;
        long        stride;
    } cases[] = {{"field of 40 %", 0.4, 1}, {"field of 60 %", 0.6, 0}};
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        laying l = {.settings = {.seed = 7, .id = 3, .concentration = cases[i].concentration, .mix = &m.mixes[0]}};
        inject_walk(&(inject_case){.name = cases[i].name,
                                   .run = lay,
                                   .end = end_laying,
                                   .self = &l,
                                   .stride = cases[i].stride,
                                   .may_go_on = true}); /* forgetting without memory drops nothing */
    }
}

/* A tile that found no memory is made when it is asked for again, with the same floes: the field goes on. */
static fw_status lay_stubbornly(void *self, fw_msg *m)
{
    laying   *l = self;
    fw_status kept = FW_OK;
    FW_TRY(fw_field_create(&l->field, &l->settings, m));
    for (int64_t column = 0; column < 3; column++) {
        const fw_tile *t;
        fw_status      s = fw_field_tile(l->field, -column, 0, &t, m);
        if (s != FW_OK) kept = s;
        if (s != FW_OK) s = fw_field_tile(l->field, -column, 0, &t, NULL);
        FW_TRY(s);
        l->hash = inject_hash(l->hash, t->x, 4 * t->n_floes * sizeof *t->x);
    }
    return kept;
}

static uint64_t wanted_floes;

static uint64_t end_stubborn(void *self, fw_status status)
{
    laying *l = self;
    if (status == FW_OK) wanted_floes = l->hash;
    if (status != FW_OK && l->hash != 0 && l->hash != wanted_floes) {
        /* only a walk of "and all after it" may have broken off on the way */
        const fw_tile *t;
        uint64_t       h = 0;
        for (int64_t column = 0; column < 3; column++) {
            assert_int_equal(fw_field_tile(l->field, -column, 0, &t, NULL), FW_OK);
            h = inject_hash(h, t->x, 4 * t->n_floes * sizeof *t->x);
        }
        assert_true(h == wanted_floes);
    }
    return end_laying(self, status);
}

static void a_field_goes_on(void **state)
{
    (void)state;
    fw_model m;
    fw_model_defaults(&m);
    laying l = {.settings = {.seed = 7, .id = 3, .concentration = 0.5, .mix = &m.mixes[0]}};
    inject_walk(&(inject_case){
        .name = "field asked again", .run = lay_stubbornly, .end = end_stubborn, .self = &l, .stride = 1});
}

/* ---- realisations ---- */

typedef struct window {
    fw_model    model;
    fw_scenario scenario;
    fw_record   record;
} window;

static fw_status realise(void *self, fw_msg *m)
{
    window *w = self;
    return fw_realise(&w->model, &w->scenario, NULL, &w->record, m);
}

static uint64_t hash_record(const fw_record *r)
{
    uint64_t h = inject_hash(0, &r->id, sizeof r->id);
    h = inject_hash(h, &r->status, sizeof r->status);
    for (size_t i = 0; i < fw_n_record_columns; i++) {
        if (strcmp(fw_record_columns[i].name, "host_cpu_s") == 0) continue;
        h = inject_hash(h, (const char *)r + fw_record_columns[i].offset, sizeof(double));
    }
    return inject_hash(h, r->rings, fw_record_n_rings(r->n_arcs, r->n_laws) * sizeof(double));
}

static uint64_t end_window(void *self, fw_status status)
{
    window  *w = self;
    uint64_t h = 0;
    if (status == FW_OK) {
        assert_int_equal(w->record.status, FW_OK);
        h = hash_record(&w->record);
    } else {
        assert_null(w->record.rings); /* no record: nothing that could be taken for one */
    }
    fw_record_free(&w->record);
    return h;
}

static void realisations(void **state)
{
    (void)state;
    static const struct {
        const char  *name;
        double       concentration, window;
        fw_numerics  numerics;
        fw_wear_rule rule;
        long         stride;
    } cases[] = {
        {"realisation, 40 %, 20 s", 0.4, 20, {0}, FW_WEAR_HERMITE, 1},
        {"realisation, 10 %, 900 s", 0.1, 900, {0}, FW_WEAR_HERMITE, 0},
        {"realisation, 60 %, 30 s", 0.6, 30, {0}, FW_WEAR_HERMITE, 0},
        {"realisation, 75 %, 1 s", 0.75, 1, {0}, FW_WEAR_HERMITE, 0},
        {"realisation, Euler, 40 %, 5 s", 0.4, 5, {.scheme = FW_SCHEME_EULER, .step = 1e-3}, FW_WEAR_NAIVE, 0},
        {"realisation, RK4, 40 %, 5 s", 0.4, 5, {.scheme = FW_SCHEME_RK4, .step = 2e-3}, FW_WEAR_HERMITE, 0},
    };
    for (size_t i = 0; i < sizeof cases / sizeof cases[0]; i++) {
        window w = {.scenario = {.seed = 11, .id = 2, .concentration = cases[i].concentration, .speed = 2}};
        fw_model_defaults(&w.model);
        w.model.window = cases[i].window;
        w.model.warm_up = 1;
        w.model.numerics = cases[i].numerics;
        w.model.numerics.wear_rule = cases[i].rule;
        inject_walk(&(inject_case){.name = cases[i].name,
                                   .run = realise,
                                   .end = end_window,
                                   .self = &w,
                                   .stride = cases[i].stride,
                                   .may_go_on = cases[i].window > 60}); /* as in the field: drops nothing */
    }
}

/* ---- an excerpt of a realisation ---- */

typedef struct excerpt {
    fw_model    model;
    fw_scenario scenario;
    fw_scene    scene;
} excerpt;

static fw_status cut_out(void *self, fw_msg *m)
{
    excerpt *e = self;
    return fw_realise_excerpt(&e->model, &e->scenario, 10, 2, NULL, &e->scene, m);
}

static uint64_t end_excerpt(void *self, fw_status status)
{
    excerpt *e = self;
    uint64_t h = 0;
    if (status == FW_OK) {
        assert_true(e->scene.n_floes > 0);
        h = inject_hash(0, e->scene.floes, e->scene.n_floes * sizeof *e->scene.floes);
    }
    fw_scene_free(&e->scene); /* after a failure too: it is empty then */
    return h;
}

static void excerpts(void **state)
{
    (void)state;
    excerpt e = {.scenario = {.seed = 11, .id = 2, .concentration = 0.4, .speed = 2}};
    fw_model_defaults(&e.model);
    e.model.window = 20;
    e.model.warm_up = 1;
    inject_walk(&(inject_case){.name = "excerpt", .run = cut_out, .end = end_excerpt, .self = &e, .stride = 1});
}

/* ---- scenes ---- */

typedef struct scene_case {
    fw_scene        scene;
    fw_scene_result result;
    size_t          n_frames;
    uint64_t        frames;
} scene_case;

static fw_status take_frame(void *self, double t, size_t n_floes, const fw_floe *floes, fw_msg *m)
{
    (void)m;
    scene_case *s = self;
    s->frames = inject_hash(inject_hash(s->frames, &t, sizeof t), floes, n_floes * sizeof *floes);
    s->n_frames++;
    return FW_OK;
}

static fw_status run_scene(void *self, fw_msg *m)
{
    scene_case   *s = self;
    fw_frame_sink sink = {.frame = take_frame, .self = s, .interval = 0.25};
    s->frames = s->n_frames = 0;
    return fw_scene_run(&s->scene, NULL, &sink, &s->result, m);
}

static uint64_t end_scene(void *self, fw_status status)
{
    scene_case *s = self;
    uint64_t    h = 0;
    if (status == FW_OK) {
        assert_true(s->n_frames > 1);
        h = inject_hash(s->frames, s->result.floes, s->result.n_floes * sizeof *s->result.floes);
        h ^= hash_record(&s->result.record);
    } else {
        assert_null(s->result.floes);
        assert_null(s->result.record.rings);
    }
    fw_scene_result_free(&s->result);
    return h;
}

static void scenes(void **state)
{
    (void)state;
    static const char *const names[] = {"scene-M05", "scene-M11", "scene-raft"};
    for (size_t i = 0; i < sizeof names / sizeof names[0]; i++) {
        char       path[512];
        scene_case s = {.n_frames = 0};
        fw_msg     m = {.text = ""};
        snprintf(path, sizeof path, "%s/tests/cli/commands/%s.yaml", FW_SOURCE_DIR, names[i]);
        if (fw_config_scene(&s.scene, path, 0, NULL, &m) != FW_OK) fail_msg("%s", m.text);
        inject_walk(&(inject_case){.name = names[i], .run = run_scene, .end = end_scene, .self = &s});
        fw_scene_free(&s.scene);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(fields),
        cmocka_unit_test(a_field_goes_on),
        cmocka_unit_test(realisations),
        cmocka_unit_test(excerpts),
        cmocka_unit_test(scenes),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
