/* `floewear scene SCENE.yaml`: given floes, no sampling: the deterministic kernel alone. */
#include <argp.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "cli/commands.h"
#include "cli/config.h"
#include "cli/json.h"
#include "cli/output.h"
#include "effects/effects.h"
#include "floewear/realisation.h"
#include "store/results.h"

enum { MAX_SETS = 64, KEY_SET = 1000, KEY_JSON, KEY_TRAJECTORY, KEY_INTERVAL };

typedef struct arguments {
    const char *scene, *trajectory, *interval;
    const char *sets[MAX_SETS];
    size_t      n_sets;
    bool        is_json;
} arguments;

static error_t parse(int key, char *arg, struct argp_state *state)
{
    arguments *a = state->input;
    switch (key) {
    case KEY_SET:
        if (a->n_sets == MAX_SETS) argp_error(state, "at most %d --set", (int)MAX_SETS);
        a->sets[a->n_sets++] = arg;
        return 0;
    case KEY_JSON: a->is_json = true; return 0;
    case KEY_TRAJECTORY: a->trajectory = arg; return 0;
    case KEY_INTERVAL: a->interval = arg; return 0;
    case ARGP_KEY_ARG:
        if (a->scene) argp_error(state, "one scene file, not also '%s'", arg);
        a->scene = arg;
        return 0;
    case ARGP_KEY_NO_ARGS: argp_error(state, "a scene file is needed"); return 0;
    default: return ARGP_ERR_UNKNOWN;
    }
}

static const struct argp_option OPTIONS[] = {
    {"trajectory", KEY_TRAJECTORY, "FILE.h5", 0, "write the floes' states over time", 0},
    {"interval", KEY_INTERVAL, "TIME", 0, "between two saved states (default 0.05 s)", 0},
    {"set", KEY_SET, "KEY=VALUE", 0, "override a key by its dotted path", 0},
    {"json", KEY_JSON, NULL, 0, "print JSON", 0},
    {0},
};
static const struct argp ARGP = {
    OPTIONS, parse, "SCENE.yaml", "Runs given floes through the kernel: no sampling, no statistics.", NULL, NULL, NULL};

static double arc_angle(size_t k, size_t n) { return ((double)k + 0.5) * 360 / (double)n; }

static void print_json(const fw_scene *s, const fw_scene_result *r)
{
    const fw_record *c = &r->record;
    double           rate = fw_abrasion_rate(&s->model.laws[0], s->temperature);
    fw_json          j = fw_json_onto(stdout);
    fw_json_begin_object(&j);
#define NUMBER(name, value) fw_json_key(&j, name), fw_json_number(&j, value)
    fw_json_key(&j, "structure");
    fw_json_begin_object(&j);
    NUMBER("normal_impulse_N_s", c->normal_impulse);
    NUMBER("peak_force_N", c->peak_force);
    NUMBER("contacts", c->hits);
    NUMBER("contact_time_s", c->contact_time);
    NUMBER("path_m", r->path);
    NUMBER("depth_along_contact_mm", r->depth_along_contact);
    NUMBER("depth_x_wall_mm_m", r->depth_x_wall);
    NUMBER("depth_impact_mm", r->depth_impact);
    fw_json_end(&j);
    fw_json_key(&j, "arcs");
    fw_json_begin_object(&j);
    fw_json_key(&j, "angle_deg");
    fw_json_begin_array(&j);
    for (size_t k = 0; k < c->n_arcs; k++) fw_json_number(&j, arc_angle(k, c->n_arcs));
    fw_json_end(&j);
    fw_json_key(&j, "path_m");
    fw_json_begin_array(&j);
    for (size_t k = 0; k < c->n_arcs; k++) fw_json_number(&j, fw_record_path(c)[k] * 1e3);
    fw_json_end(&j);
    fw_json_key(&j, "depth_mm");
    fw_json_begin_array(&j);
    for (size_t k = 0; k < c->n_arcs; k++) fw_json_number(&j, fw_record_load(c, 0, FW_RING_LOAD)[k] * rate);
    fw_json_end(&j);
    fw_json_end(&j);
    fw_json_key(&j, "floes");
    fw_json_begin_array(&j);
    for (size_t i = 0; i < r->n_floes; i++) {
        const fw_floe *f = &r->floes[i];
        fw_json_begin_object(&j);
        NUMBER("x_m", f->x);
        NUMBER("y_m", f->y);
        NUMBER("vx_m_s", f->vx);
        NUMBER("vy_m_s", f->vy);
        NUMBER("spin_rad_s", f->spin);
        fw_json_end(&j);
    }
    fw_json_end(&j);
    fw_json_key(&j, "ledger");
    fw_json_begin_object(&j);
    NUMBER("energy_relative", c->energy_relative);
    NUMBER("energy_truncation", c->energy_truncation);
    NUMBER("momentum_relative", c->momentum_relative);
    NUMBER("wear_conservation", c->wear_conservation);
    NUMBER("max_overlap_m", r->max_overlap);
    NUMBER("overlap_beyond_range_share", c->overlap_time_share);
    fw_json_end(&j);
    fw_json_key(&j, "cost");
    fw_json_begin_object(&j);
    NUMBER("force_evaluations", c->force_evaluations);
    NUMBER("steps", c->steps);
    NUMBER("cpu_s", c->host_cpu_s);
    fw_json_end(&j);
#undef NUMBER
    fw_json_key(&j, "effects");
    fw_json_begin_array(&j);
    const fw_effect *const *e;
    size_t                  n = fw_effects_list(&e);
    for (size_t i = 0; i < n; i++)
        if (fw_effects_have(&s->model, e[i]->bit)) fw_json_string(&j, e[i]->name);
    fw_json_end(&j);
    fw_json_put_string(&j, "status", c->status == FW_OK ? "ok" : fw_status_name(c->status));
    if (c->status != FW_OK) {
        fw_json_put_string(&j, "cause", c->cause);
    }
    fw_json_end(&j);
}

static void print_text(const fw_scene *s, const fw_scene_result *r)
{
    const fw_record *c = &r->record;
    printf("structure, %g s at %g degC, law %s\n", s->duration, s->temperature, s->model.laws[0].name);
    printf("  hits %.0f, contact time %.4g s, normal impulse %.6g N s, peak force %.6g N\n", c->hits, c->contact_time,
           c->normal_impulse, c->peak_force);
    printf("  path %.6g m, depth along the contact %.6g mm, depth x wall %.6g mm m\n", r->path, r->depth_along_contact,
           r->depth_x_wall);
    double rate = fw_abrasion_rate(&s->model.laws[0], s->temperature), worst = 0;
    size_t at = 0;
    for (size_t k = 0; k < c->n_arcs; k++)
        if (fw_record_load(c, 0, FW_RING_LOAD)[k] > worst) worst = fw_record_load(c, 0, FW_RING_LOAD)[k], at = k;
    if (worst > 0)
        printf("  deepest arc %.6g mm at %.4g deg from the current, clockwise seen from above\n", worst * rate,
               arc_angle(at, c->n_arcs));
    printf("floes at the end\n  %4s %12s %12s %12s %12s %12s\n", "no.", "x m", "y m", "vx m/s", "vy m/s", "spin rad/s");
    for (size_t i = 0; i < r->n_floes; i++) {
        const fw_floe *f = &r->floes[i];
        printf("  %4zu %12.6f %12.6f %12.6f %12.6f %12.6f\n", i + 1, f->x, f->y, f->vx, f->vy, f->spin);
    }
    printf("ledger\n  bookkeeping: energy %.1e, momentum %.1e, wear on the ring %.1e\n", c->energy_relative,
           c->momentum_relative, c->wear_conservation);
    printf("  energy balance of the trajectory %.2e (wanted %.2g); largest overlap %.4g m, %.3g %% of the time beyond "
           "the rigid-disc range\n",
           c->energy_truncation, s->model.accuracy, r->max_overlap, 100 * c->overlap_time_share);
    printf("cost\n  %.0f force evaluations, %.0f steps, %.3g CPU s\n", c->force_evaluations, c->steps, c->host_cpu_s);
    if (c->status != FW_OK) printf("FAILED: %s\n", c->cause);
}

int fw_cmd_scene(int argc, char **argv)
{
    arguments a = {.interval = "0.05 s"};
    argp_parse(&ARGP, argc, argv, 0, NULL, &a);
    fw_scene        scene = {0};
    fw_scene_result result = {0};
    fw_trajectory  *file = NULL;
    fw_frame_sink   sink = {0};
    fw_msg          m = {""};
    double          dt = 0;
    fw_status       s = fw_config_scene(&scene, a.scene, a.n_sets, a.sets, &m);
    if (s == FW_OK && a.trajectory) {
        s = fw_config_duration(a.interval, &dt, &m);
        if (s == FW_OK) s = fw_trajectory_create(&file, a.trajectory, &scene, &m);
        if (s == FW_OK) sink = fw_trajectory_sink(file, dt);
    }
    if (s == FW_OK) s = fw_scene_run(&scene, NULL, file ? &sink : NULL, &result, &m);
    fw_msg    close_msg = {""};
    fw_status close_state = fw_trajectory_close(file, &close_msg);
    if (s == FW_OK && close_state != FW_OK) s = close_state, m = close_msg;
    if (result.record.rings) {
        if (a.is_json)
            print_json(&scene, &result);
        else
            print_text(&scene, &result);
    }
    if (s == FW_OK) s = fw_output_finish(&m);
    if (s != FW_OK) fprintf(stderr, "floewear scene: %s\n", m.text[0] ? m.text : fw_status_sentence(s));
    fw_scene_result_free(&result);
    fw_scene_free(&scene);
    return fw_status_exit_code(s);
}
