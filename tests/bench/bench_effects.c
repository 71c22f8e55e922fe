/* What each effect costs and moves: windows with it switched, against the same windows without or with, on the same ice in turn. */
#include <math.h>
#include <stdio.h>

#include "bench/bench.h"

enum { MAX_IDS = 64 };

static const double SPEED = 1; /* [m/s] */
static const double PI = 3.14159265358979323846;

static void with(fw_model *m, uint32_t bits) { m->effects |= bits; }
static void without(fw_model *m, uint32_t bits) { m->effects &= ~bits; }

static void no_floe_contact(fw_model *m, fw_scenario *s) { (void)s, without(m, FW_EFFECT_FLOE_CONTACT); }
static void no_friction(fw_model *m, fw_scenario *s) { (void)s, without(m, FW_EFFECT_FRICTION | FW_EFFECT_ROTATION); }
static void locked(fw_model *m, fw_scenario *s) { (void)s, without(m, FW_EFFECT_ROTATION); }
static void drag_of_a_side(fw_model *m, fw_scenario *s) { (void)s, m->form_drag = 0.9; }
static void skin_drag(fw_model *m, fw_scenario *s) { (void)s, with(m, FW_EFFECT_SKIN_DRAG); }
static void wind_along(fw_model *m, fw_scenario *s) { with(m, FW_EFFECT_WIND), s->wind_speed = 15; }
static void wind_across(fw_model *m, fw_scenario *s) { with(m, FW_EFFECT_WIND), s->wind_speed = 15, s->wind_angle = 0.5 * PI; }
static void added_mass(fw_model *m, fw_scenario *s) { (void)s, with(m, FW_EFFECT_ADDED_MASS); }
static void tide(fw_model *m, fw_scenario *s) { with(m, FW_EFFECT_TIDE), m->tide.minor_ratio = 0.3, s->tide_phase = 0; }
static void deflected_flow(fw_model *m, fw_scenario *s) { (void)s, with(m, FW_EFFECT_DEFLECTED_FLOW); }
static void crushing_limit(fw_model *m, fw_scenario *s) { (void)s, with(m, FW_EFFECT_CRUSHING_LIMIT), m->crushing_limit = (fw_pressure_law){1e6, 0}; }
static void pressure_area(fw_model *m, fw_scenario *s) { (void)s, with(m, FW_EFFECT_CRUSHING_LIMIT), m->crushing_limit = (fw_pressure_law){1e6, 0.4}; }
static void ice_on_ice(fw_model *m, fw_scenario *s) { (void)s, with(m, FW_EFFECT_ICE_ON_ICE), m->floe_stiffness = 1e6, m->floe_friction = 0.05; }
static void from_pressure(fw_model *m, fw_scenario *s) { (void)s, m->stiffness_from_pressure = true; }
static void crush(fw_model *m, fw_scenario *s) { (void)s, with(m, FW_EFFECT_CRUSH_CONTACT); }
static void crush_without_flat(fw_model *m, fw_scenario *s) { (void)s, with(m, FW_EFFECT_CRUSH_CONTACT), m->crush.has_flat = false; }
static void all_of_water(fw_model *m, fw_scenario *s)
{
    skin_drag(m, s), wind_across(m, s), added_mass(m, s), tide(m, s), deflected_flow(m, s);
}

static const struct row {
    const char *name;
    void (*change)(fw_model *m, fw_scenario *s);
} ROWS[] = {
    {"floe_contact off", no_floe_contact},
    {"friction and rotation off", no_friction},
    {"rotation locked", locked},
    {"form_drag 0.9 instead of 10", drag_of_a_side},
    {"skin_drag, with its torque", skin_drag},
    {"wind 15 m/s along", wind_along},
    {"wind 15 m/s across", wind_across},
    {"added_mass", added_mass},
    {"tide, 12.42 h, ratio 0.3", tide},
    {"deflected_flow", deflected_flow},
    {"skin, wind, added mass, tide, deflected flow together", all_of_water},
    {"crushing_limit 1 MPa", crushing_limit},
    {"crushing_limit 1 MPa at 1 m2, exponent 0.4", pressure_area},
    {"ice_on_ice, 1000 kN/m and 0.05", ice_on_ice},
    {"stiffness from_pressure, 1.1 MPa", from_pressure},
    {"crush_contact 1.1 MPa, with flats", crush},
    {"crush_contact 1.1 MPa, without", crush_without_flat},
};
enum { N_ROWS = sizeof ROWS / sizeof ROWS[0] };

static fw_record run(double concentration, double window, size_t id, const struct row *row)
{
    fw_scenario s = {.seed = 20260101, .id = id, .concentration = concentration, .speed = SPEED};
    fw_model    m;
    fw_record   r;
    fw_msg      msg = {""};
    fw_model_defaults(&m);
    m.window = window;
    if (row) row->change(&m, &s);
    bench_expect(fw_realise(&m, &s, NULL, &r, &msg) == FW_OK && r.status == FW_OK, "%s: %s%s", row ? row->name : "as it is", msg.text, r.cause);
    return r;
}

static void table(double concentration, double window, size_t n_ids)
{
    double cpu[N_ROWS][MAX_IDS], work[N_ROWS][MAX_IDS], plain[MAX_IDS], depth[N_ROWS][MAX_IDS], base[MAX_IDS];
    for (size_t i = 0; i < n_ids; i++) {
        fw_record r = run(concentration, window, i, NULL);
        double    evaluations = r.force_evaluations;
        plain[i] = r.host_cpu_s, base[i] = bench_depth(&r);
        fw_record_free(&r);
        for (size_t k = 0; k < N_ROWS; k++) { /* in turn: whoever else uses the machine slows all of them */
            r = run(concentration, window, i, &ROWS[k]);
            cpu[k][i] = r.host_cpu_s, work[k][i] = r.force_evaluations / evaluations, depth[k][i] = bench_depth(&r);
            fw_record_free(&r);
        }
    }
    double mean = bench_mean(n_ids, base);
    for (size_t k = 0; k < N_ROWS; k++) {
        double ratio[MAX_IDS], change[MAX_IDS];
        for (size_t i = 0; i < n_ids; i++) ratio[i] = cpu[k][i] / plain[i], change[i] = depth[k][i] / mean;
        double by = bench_mean(n_ids, depth[k]) / mean;
        for (size_t i = 0; i < n_ids; i++) change[i] -= by * base[i] / mean; /* of the ratio of means */
        printf("| %g %% | %s | %.2f | %.2f | x %.3g +- %.1g |\n", 100 * concentration, ROWS[k].name, bench_median(n_ids, ratio),
               bench_median(n_ids, work[k]), by, bench_standard_error(n_ids, change));
        bench_expect(by > 0 && isfinite(by), "%s at %g %%: depth %g", ROWS[k].name, 100 * concentration, by);
    }
}

int main(int argc, char **argv)
{
    bool   is_quick = bench_start(argc, argv);
    size_t n = is_quick ? 2 : 24;
    double window = is_quick ? 30 : 1200;
    printf("### Effects\n\nWindows of %g s at %g m/s and 1 %%, %zu realisations, each row in turn with the default model on the same ice. CPU and force evaluations: "
           "median ratio to the default; depth: ratio of mean depths with its standard error.\n\n", window, SPEED, n);
    printf("| ice | switched | CPU | force evaluations | depth |\n|---|---|---|---|---|\n");
    table(0.1, window, n);
    table(0.4, window, n);
    printf("\n");
    return bench_end();
}
