#include "validation/hard_case.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double PI = 3.14159265358979323846, ACCURACY = 0.01;
enum { MAX_FLOES = 20000, N_SAMPLES = 200, MANY = 1000 };

static double changed(double now, double change) { return change == 0 ? now : change == NONE ? 0 : change; }

static void fail_hard(const char *what)
{
    fprintf(stderr, "hard cases: %s\n", what);
    exit(1);
}

static fw_floe *floes_of(const hard_scene *s, size_t *n)
{
    fw_floe *f = calloc(MAX_FLOES, sizeof *f);
    if (!f) fail_hard("out of memory");
    *n = s->n;
    if (s->layout)
        *n = s->layout(f, MAX_FLOES, s->p);
    else if (s->n)
        memcpy(f, s->floes, s->n * sizeof *f);
    if (*n > MAX_FLOES) fail_hard(s->name);
    return f;
}

void hard_case_open(hard_case *c, const hard_scene *s)
{
    *c = (hard_case){.scene = s, .accuracy = ACCURACY, .fastest = s->speed};
    fw_model *m = &c->model;
    fw_model_defaults(m);
    m->stiffness = changed(m->stiffness, s->change.stiffness);
    m->damping_ratio = changed(m->damping_ratio, s->change.damping);
    m->friction = changed(m->friction, s->change.friction);
    m->slip_damping_ratio = changed(m->slip_damping_ratio, s->change.slip_damping);
    m->structure_radius = changed(m->structure_radius, s->change.radius);
    m->effects &= ~s->change.off;
    m->accuracy = ACCURACY;
    if (hard_is_window(s)) return;
    size_t   n;
    fw_floe *f = floes_of(s, &n);
    for (size_t i = 0; i < n; i++) c->fastest = fmax(c->fastest, hypot(f[i].vx, f[i].vy));
    free(f);
}

void hard_case_close(hard_case *c)
{
    for (int i = 0; i < HARD_N_RUNS; i++) {
        fw_record_free(&c->runs[i].record);
        free(c->runs[i].start);
        free(c->runs[i].end);
    }
}

double hard_mass(const hard_case *c, const fw_floe *f) { return c->model.ice_density * PI / 4 * f->diameter * f->diameter * f->thickness; }

double hard_energy(const hard_case *c, size_t n, const fw_floe *floes)
{
    double k = c->model.stiffness, e = 0;
    bool   has_pairs = (c->model.effects & FW_EFFECT_FLOE_CONTACT) != 0;
    for (size_t i = 0; i < n; i++) {
        const fw_floe *f = &floes[i];
        double         r = 0.5 * f->diameter, wall = fmax(0, r + c->model.structure_radius - hypot(f->x, f->y));
        double         turning = c->model.effects & FW_EFFECT_ROTATION ? 0.5 * r * r * f->spin * f->spin : 0;
        e += 0.5 * hard_mass(c, f) * (f->vx * f->vx + f->vy * f->vy + turning) + 0.5 * k * wall * wall;
        for (size_t j = 0; has_pairs && j < i; j++) {
            double dx = f->x - floes[j].x, dy = f->y - floes[j].y, reach = r + 0.5 * floes[j].diameter;
            if (dx * dx + dy * dy >= reach * reach) continue;
            double d = reach - hypot(dx, dy);
            e += 0.5 * k * d * d;
        }
    }
    return e;
}

int hard_degrees(hard_which which) { return which == HARD_QUARTER ? 90 : which == HARD_TURNED ? 37 : 0; }

static void move_scene(fw_floe *f, size_t n, hard_which which)
{
    double a = hard_degrees(which) * PI / 180, c = which == HARD_QUARTER ? 0 : cos(a), s = which == HARD_QUARTER ? 1 : sin(a);
    for (size_t i = 0; i < n; i++) {
        fw_floe o = f[i];
        if (which == HARD_MIRROR) f[i].y = -o.y, f[i].vy = -o.vy, f[i].spin = -o.spin;
        if (hard_degrees(which) == 0) continue;
        f[i].x = c * o.x - s * o.y, f[i].y = s * o.x + c * o.y;
        f[i].vx = c * o.vx - s * o.vy, f[i].vy = s * o.vx + c * o.vy;
    }
}

typedef struct watch {
    const hard_case *c;
    hard_run        *run;
} watch;

static fw_status see(void *self, double t, size_t n, const fw_floe *floes, fw_msg *m)
{
    (void)t, (void)m;
    watch *w = self;
    w->run->highest = fmax(w->run->highest, hard_energy(w->c, n, floes));
    return FW_OK;
}

static void run_scene(hard_case *c, hard_which which, hard_run *r)
{
    const hard_scene *s = c->scene;
    r->start = floes_of(s, &r->n);
    move_scene(r->start, r->n, which);
    fw_scene        scene = {.model = c->model, .speed = s->speed, .temperature = -10, .duration = s->duration, .n_floes = r->n, .floes = r->start};
    fw_scene_result result;
    fw_msg          m = {""};
    watch           w = {c, r};
    fw_frame_sink   frames = {see, &w, s->duration / (r->n > MANY ? 10 : N_SAMPLES)};
    if (which == HARD_FINE) scene.model.accuracy = 0.1 * c->accuracy;
    r->energy[0] = hard_energy(c, r->n, r->start);
    r->status = fw_scene_run(&scene, NULL, which == HARD_WATCHED ? &frames : NULL, &result, &m);
    snprintf(r->cause, sizeof r->cause, "%.*s", (int)sizeof r->cause - 1, m.text);
    if (r->status != FW_OK && !result.floes) return;
    r->record = result.record, r->end = result.floes;
    r->depth = result.depth_x_wall, r->path = result.path, r->max_overlap = result.max_overlap;
    r->energy[1] = hard_energy(c, r->n, r->end);
    r->highest = fmax(r->highest, r->energy[1]);
}

static void run_window(hard_case *c, hard_which which, hard_run *r)
{
    fw_model    m = c->model;
    fw_scenario s = {.seed = 20260101, .id = 1, .concentration = c->scene->concentration, .speed = c->scene->speed};
    fw_msg      msg = {""};
    m.window = c->scene->duration;
    if (which == HARD_FINE) m.accuracy = 0.1 * c->accuracy;
    r->status = fw_realise(&m, &s, NULL, &r->record, &msg);
    if (r->status == FW_OK) r->status = r->record.status;
    snprintf(r->cause, sizeof r->cause, "%.*s", (int)sizeof r->cause - 1, msg.text[0] ? msg.text : r->record.cause);
    for (size_t k = 0; k < r->record.n_arcs; k++) r->depth += fw_record_load(&r->record, 0, FW_RING_LOAD)[k] / (double)r->record.n_arcs;
    for (size_t k = 0; k < r->record.n_arcs; k++) r->path += fw_record_path(&r->record)[k];
}

const hard_run *hard_case_run(hard_case *c, hard_which which)
{
    hard_run *r = &c->runs[which];
    if (r->is_made) return r;
    r->is_made = true;
    if (hard_is_window(c->scene))
        run_window(c, which, r);
    else
        run_scene(c, which, r);
    c->cpu_s += r->record.host_cpu_s;
    return r;
}
