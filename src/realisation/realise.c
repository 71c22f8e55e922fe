/* One realisation: field -> world -> kernel -> wear -> record, and once more with finer steps where that may cure a failure. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/clock.h"
#include "realisation/accuracy.h"
#include "realisation/outcome.h"
#include "realisation/verdict.h"
#include "realisation/window.h"

static void describe(fw_record *rec, const fw_window_run *r, const fw_scenario *sc, double warm_up)
{
    fw_record_take_scenario(rec, sc);
    rec->window = r->model->window;
    rec->warm_up = warm_up;
    if (!r->ice.field) return;
    fw_field_census c = fw_field_count(r->ice.field);
    rec->floes_made = (double)c.n_floes;
    if (c.tile_area > 0) rec->concentration_achieved = c.ice_area / c.tile_area;
    if (c.n_floes > 0) rec->mean_diameter = c.sum_diameter / (double)c.n_floes;
    rec->mean_diameter_wanted = c.mean_diameter_wanted;
}

/* One try. Its evaluations count on from those that out has seen already. A failure of the physics or of its limits is a record; no memory,
 * a full disk or a stop are not. */
static fw_status run_once(const fw_model *model, const fw_scenario *sc, const fw_tick *tick, fw_record *out, bool *may_be_cured, fw_msg *m)
{
    double    warm_up = fw_accuracy_warm_up(model, sc->speed), t_all = warm_up + model->window, steps = out->steps;
    fw_window_run r;
    fw_status s = fw_window_open(&r, model, sc, m);
    if (s == FW_OK) {
        r.world->ledger.force_evaluations = out->force_evaluations;
        s = fw_window_go(&r, warm_up, t_all, tick, m);
    }
    bool is_judged = model->numerics.scheme == FW_SCHEME_EVENTS && !model->numerics.order;
    if (s == FW_OK && warm_up > 0) { /* its books; its balance may be that of a few touches */
        fw_outcome_fill(out, r.world, &r.wear, warm_up);
        s = fw_verdict(out, r.world, INFINITY, m);
        if (s != FW_OK) fw_msg_prefix(m, "in the warm-up: ");
    }
    if (s == FW_OK) {
        double spent = r.world->ledger.force_evaluations;
        steps += r.world->ledger.steps;
        fw_world_open_ledger(r.world);
        r.world->ledger.force_evaluations = spent; /* cost counts from the start */
        r.wear.rule = model->numerics.wear_rule;
        r.wear.is_open = true;
        s = fw_window_go(&r, t_all, t_all, tick, m);
        fw_wear_finish(&r.wear);
    }
    bool is_run = s == FW_OK, is_failure = r.stopped == FW_OK && (s == FW_E_NUMERIC || s == FW_E_LIMIT);
    if (is_run || is_failure) describe(out, &r, sc, warm_up);
    if (is_run) {
        fw_outcome_fill(out, r.world, &r.wear, model->window);
        s = fw_verdict(out, r.world, is_judged ? r.setup.energy_tolerance : INFINITY, m);
    }
    if (s != FW_OK) out->failed_at = fw_window_now(&r);
    *may_be_cured = s == FW_E_NUMERIC && !r.is_ice && model->numerics.scheme == FW_SCHEME_EVENTS; /* a limit is passed all the sooner */
    if (r.world) out->force_evaluations = r.world->ledger.force_evaluations, out->steps = steps + r.world->ledger.steps;
    fw_window_close(&r);
    if (!is_run && !is_failure) return s;
    out->status = s;
    return FW_OK;
}

fw_status fw_realise(const fw_model *model, const fw_scenario *sc, const fw_tick *tick, fw_record *out, fw_msg *m)
{
    fw_msg own = {""};
    if (!m) m = &own;
    memset(out, 0, sizeof *out);
    FW_TRY(fw_model_check(model, m));
    FW_CHECK(sc->speed > 0 && isfinite(sc->speed), m, FW_E_ARG, "current speed %g m/s: wanted more than 0", sc->speed);
    FW_CHECK(sc->mix < model->n_mixes, m, FW_E_ARG, "thickness mix %u of %zu", sc->mix, model->n_mixes);
    FW_TRY(fw_record_init(out, model->n_arcs, model->n_laws, m));

    fw_scenario at = *sc;
    at.speed = fmax(at.speed, FW_SLOWEST);
    double    cpu = fw_cpu_seconds();
    bool      may_be_cured = false;
    fw_status s = run_once(model, &at, tick, out, &may_be_cured, m);
    out->tries = 1;
    if (s == FW_OK && may_be_cured) {
        fw_model finer = fw_accuracy_finer(model);
        fw_outcome_begin_again(out, m);
        s = run_once(&finer, &at, tick, out, &may_be_cured, m);
    }
    if (s != FW_OK) {
        fw_record_free(out);
        return s;
    }
    fw_outcome_say(out, m);
    out->speed = sc->speed;
    out->host_cpu_s = fw_cpu_seconds() - cpu;
    return FW_OK;
}
