/* Memory runs out while campaign and scene files are read. */
#include "cli/config.h"
#include "memory/inject.h"

#define GOOD      FW_SOURCE_DIR "/tests/cli/good/"
#define CAMPAIGNS FW_SOURCE_DIR "/campaigns/"

typedef struct reading {
    const char        *path, *text; /* text NULL: read the file */
    size_t             n_sets;
    const char *const *sets;
    fw_campaign        campaign;
    fw_scene           scene;
} reading;

static uint64_t hash_law(uint64_t h, const fw_distribution *d)
{
    double plain[] = {(double)d->kind, d->a, d->b, d->c, d->d, d->low, d->high, (double)d->n};
    h = inject_hash(h, plain, sizeof plain);
    if (d->n) h = inject_hash(inject_hash(h, d->values, d->n * sizeof(double)), d->weights, d->n * sizeof(double));
    return h;
}

static uint64_t hash_campaign(const fw_campaign *c)
{
    uint64_t h = inject_hash(0, c->settings, strlen(c->settings));
    h = inject_hash(h, c->text, strlen(c->text));
    h = inject_hash(h, c->name, strlen(c->name));
    h = inject_hash(h, c->points.bearing, c->points.n * sizeof(double));
    h = hash_law(hash_law(h, &c->site.temperature), &c->site.direction);
    h = hash_law(hash_law(h, &c->site.speed), &c->site.concentration);
    for (size_t i = 0; i < c->site.n_cells; i++) {
        h = inject_hash(h, &c->site.cells[i].probability, sizeof(double));
        h = hash_law(h, &c->site.cells[i].direction);
    }
    for (size_t i = 0; i < c->n_sets; i++) h = inject_hash(h, c->sets[i], strlen(c->sets[i]));
    for (size_t i = 0; i < c->n_not_applied; i++)
        h = inject_hash(h, c->not_applied[i], strlen(c->not_applied[i]));
    return h;
}

static fw_status read_campaign(void *self, fw_msg *m)
{
    reading *r = self;
    if (r->text)
        return fw_config_campaign_text(&r->campaign, r->path, r->text, strlen(r->text), r->n_sets, r->sets, -1, m);
    return fw_config_campaign(&r->campaign, r->path, r->n_sets, r->sets, -1, m);
}

static uint64_t end_campaign(void *self, fw_status status)
{
    reading *r = self;
    uint64_t h = status == FW_OK ? hash_campaign(&r->campaign) : 0;
    fw_campaign_free(&r->campaign); /* after a failure too: it is empty then */
    return h;
}

static fw_status read_scene(void *self, fw_msg *m)
{
    reading *r = self;
    return fw_config_scene(&r->scene, r->path, r->n_sets, r->sets, m);
}

static uint64_t end_scene(void *self, fw_status status)
{
    reading *r = self;
    uint64_t h = status == FW_OK ? inject_hash(0, r->scene.floes, r->scene.n_floes * sizeof *r->scene.floes) : 0;
    fw_scene_free(&r->scene);
    return h;
}

static void campaigns(void **state)
{
    (void)state;
    static const char *const files[] = {GOOD "minimal.yaml",         GOOD "sketch.yaml",      GOOD "joint.yaml",
                                        GOOD "joint-thickness.yaml", CAMPAIGNS "raahe.yaml", CAMPAIGNS "ci.yaml", GOOD "effects.yaml"};
    for (size_t i = 0; i < sizeof files / sizeof files[0]; i++) {
        reading r = {.path = files[i]};
        inject_walk(&(inject_case){
            .name = strrchr(files[i], '/') + 1, .run = read_campaign, .end = end_campaign, .self = &r});
    }
}

static void overrides(void **state)
{
    (void)state;
    static const char *const sets[] = {"ice.concentration={uniform: [20 %, 40 %]}", "numerics.tolerance=0.001",
                                       "service={life: 50 year, ice_hours_per_year: 1200 h, year_to_year_cv: 0.3}",
                                       "current.speed={table: speeds.csv}", "abrasion.laws=[bekker2011, archard]"};
    reading r = {.path = GOOD "minimal.yaml", .n_sets = sizeof sets / sizeof sets[0], .sets = sets};
    inject_walk(&(inject_case){
        .name = "minimal.yaml with --set", .run = read_campaign, .end = end_campaign, .self = &r, .stride = 1});
}

/* Every kind of law: closed forms, given values, a rose, a table of its own. */
static void distributions(void **state)
{
    (void)state;
    static const char text[] = "ice:\n"
                               "  temperature: {values: [-3 degC, -7 degC, -5 degC], probabilities: [0.2, 0.5, 0.3]}\n"
                               "  concentration: {beta: {alpha: 2, beta: 3, min: 10 %, max: 60 %}}\n"
                               "current:\n"
                               "  speed: {table: speeds.csv}\n"
                               "  direction: {rose: {0 deg: 1, 90 deg: 2, 91 deg: 0.5}}\n";
    reading r = {.path = GOOD "made.yaml", .text = text};
    inject_walk(&(inject_case){
        .name = "distributions", .run = read_campaign, .end = end_campaign, .self = &r, .stride = 1});
}

static void scenes(void **state)
{
    (void)state;
    static const char *const sets[] = {"duration=2 s", "contact.friction=0.2"};
    reading r = {.path = GOOD "scene.yaml"};
    inject_walk(&(inject_case){.name = "scene.yaml", .run = read_scene, .end = end_scene, .self = &r});
    r = (reading){.path = GOOD "scene-effects.yaml"}; /* with a table of its own */
    inject_walk(&(inject_case){.name = "scene-effects.yaml", .run = read_scene, .end = end_scene, .self = &r});
    r = (reading){.path = FW_SOURCE_DIR "/tests/cli/commands/scene-raft.yaml", .n_sets = 2, .sets = sets};
    inject_walk(
        &(inject_case){.name = "scene-raft.yaml with --set", .run = read_scene, .end = end_scene, .self = &r});
}

static fw_status read_duration(void *self, fw_msg *m) { return fw_config_duration("90 min", self, m); }

static uint64_t end_duration(void *self, fw_status status)
{
    return status == FW_OK ? inject_hash(0, self, sizeof(double)) : 0;
}

static void durations(void **state)
{
    (void)state;
    double seconds = 0;
    inject_walk(&(inject_case){
        .name = "duration", .run = read_duration, .end = end_duration, .self = &seconds, .stride = 1});
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(campaigns), cmocka_unit_test(overrides), cmocka_unit_test(distributions),
        cmocka_unit_test(scenes),    cmocka_unit_test(durations),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
