#include "validation/hard_case.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double PI = 3.14159265358979323846, ACCURACY = 0.01, SHIFT[3] = {1, -0.7, 0.3};
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
    if (!(c->fastest > 0)) c->fastest = 1e-3; /* nothing moves: any scale will do */
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

const hard_image hard_images[HARD_N_RUNS] = {
    [HARD_BASE] = {1, 0, 1, 0, 1, 1, false},
    [HARD_FINE] = {1, 0, 1, 0, 1, 1, false},
    [HARD_MIRROR] = {-1, 0, 1, 0, 1, 1, false},
    [HARD_QUARTER] = {1, 90, 0, 1, 1, 1, false},
    [HARD_TURNED] = {1, 37, 0.79863551004729283, 0.60181502315204827, 1, 1, false},
    [HARD_REVERSED] = {1, 0, 1, 0, 1, 1, true},
    [HARD_WATCHED] = {1, 0, 1, 0, 1, 1, false},
    [HARD_LIGHT] = {1, 0, 1, 0, 1, 0.25, false},
    [HARD_SWIFT] = {1, 0, 1, 0, 2, 4, false},
    [HARD_SHIFTED] = {1, 0, 1, 0, 1, 1, false},
};

/* The start of HARD_BASE becomes that of its image. */
static void move_scene(fw_floe *f, size_t n, const hard_image *to)
{
    double c = to->cosine, s = to->sine, v = to->velocity;
    for (size_t i = 0; i < n; i++) {
        fw_floe *p = &f[i], o = *p;
        o.y *= to->flip, o.vy *= to->flip, o.spin *= to->flip;
        p->x = c * o.x - s * o.y, p->y = s * o.x + c * o.y;
        p->vx = v * (c * o.vx - s * o.vy), p->vy = v * (s * o.vx + c * o.vy), p->spin = v * o.spin;
    }
    for (size_t i = 0; to->is_reversed && i < n / 2; i++) {
        fw_floe o = f[i];
        f[i] = f[n - 1 - i], f[n - 1 - i] = o;
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
    const hard_image *to = &hard_images[which];
    r->start = floes_of(s, &r->n);
    move_scene(r->start, r->n, to);
    fw_scene        scene = {.model = c->model, .speed = s->speed * to->velocity, .temperature = -10, .duration = s->duration / to->velocity, .n_floes = r->n, .floes = r->start};
    fw_scene_result result;
    fw_msg          m = {""};
    watch           w = {c, r};
    fw_frame_sink   frames = {see, &w, s->duration / (r->n > MANY ? 10 : N_SAMPLES)};
    if (which == HARD_FINE || which == HARD_SHIFTED) scene.model.accuracy = 0.1 * c->accuracy;
    for (size_t i = 0; which == HARD_SHIFTED && i < r->n; i++) r->start[i].y += 1e-3 * SHIFT[i % 3];
    if (which == HARD_LIGHT) scene.model.ice_density *= 0.25, scene.model.water_density *= 0.25;
    scene.model.stiffness *= to->force;
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
