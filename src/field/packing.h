/* Places floes in one tile without overlaps: tries at random first, relaxation where trying is hopeless.
 *
 * A packing is a workspace (memory is kept from tile to tile). It holds the tile's own floes, which relaxation may
 * move, and obstacles, the floes of neighbour tiles, which stay. Own centres stay in the box [x0, x1) x [y0, y1); own
 * floes and obstacles may stick out. When the box wraps in y it is its own neighbour above and below.
 *
 * Use: begin, own then obstacles for what is already placed, place for new ones (largest first), then read x and y.
 *
 * A new floe is put down uniformly in the box and refused when it overlaps another. After MAX_TRIES refusals it is put
 * where it overlaps least of a few dozen places; when all floes of the call are down, overlapping pairs are pushed
 * apart, one floe at a time, until the last overlap is gone; a floe that cannot be freed moves to another place.
 * Overlap is tested on the stored doubles with a gap of 1e-6 m to spare. Everything is deterministic given the random
 * stream.
 *
 * Three ways to ask whether a place is taken; the answer is the same, so which one is asked changes no floe:
 *   all discs, several at a time    the first draws of a call: sparse ice needs no more, and nothing has to be built
 *   nearby.h                        once a call has drawn often: crowded ice refuses dozens of places per floe
 *   cover.h                         when floes move: also tells which discs overlap, in an order that results depend on */
#ifndef FW_FIELD_PACKING_H
#define FW_FIELD_PACKING_H

#include <stdint.h>

#include "base/random.h"
#include "field/cover.h"
#include "field/nearby.h"

#define FW_PACKING_GAP 1e-6 /* [m] least distance between rims: far above rounding at 1e8 m from the origin */

typedef struct fw_packing_box {
    double x0, x1, y0, y1; /* [m] */
    bool   wraps_y;
} fw_packing_box;

typedef struct fw_packing_cost {
    uint64_t n_tries;   /* places tried */
    uint64_t n_crowded; /* floes put down overlapping others */
    uint64_t n_pushes;  /* times a floe was looked at to free it */
    uint64_t n_moved;   /* floes moved elsewhere because pushing did not free them */
} fw_packing_cost;

typedef struct fw_packing {
    fw_packing_box  box;
    double          reach;          /* obstacles further than this outside the box are ignored [m] */
    double          rim;            /* discs may lie this far outside the box [m] */
    double          cell;           /* side of the search cells [m] */
    double          x_last, y_last; /* the largest numbers below x1 and y1 */
    double          height;         /* of the box when it wraps, else infinite */
    fw_nearby       nearby;
    fw_cover        cover;
    bool            has_cover;       /* else cover is not built yet */
    size_t          n_own;           /* own floes are discs 0 .. n_own - 1 in the order they came */
    size_t          n_before;        /* of them, those that came before the obstacles */
    size_t          n_most, n_discs; /* obstacles are discs n_most .. n_discs - 1; n_most is rounded up */
    double         *x, *y, *r;       /* (n_discs and a few more, which lie nowhere: x = INFINITY) [m] */
    int32_t        *queue;           /* ring of own floes to be freed */
    size_t          queue_head, n_queued;
    unsigned char  *is_queued;
    size_t          x_capacity, y_capacity, r_capacity, queue_capacity, queued_capacity;
    fw_packing_cost cost; /* since the workspace was zeroed */
} fw_packing;

/* Start a tile that will have at most n_most own floes. cell: side of the search cells [m]. */
fw_status fw_packing_begin(fw_packing *p, const fw_packing_box *box, size_t n_most, double max_radius, double cell,
                           fw_msg *m);
/* Floes that earlier calls placed, in their order. */
fw_status fw_packing_own(fw_packing *p, size_t n, const double *x, const double *y, const double *r, fw_msg *m);
/* Floes of a neighbour; ignored when they are out of reach. In a box that wraps they wrap, too. */
fw_status fw_packing_obstacles(fw_packing *p, size_t n, const double *x, const double *y, const double *r, fw_msg *m);
/* Place n floes of radius r[0..n) as own floes (they follow the ones that were there). n_expected: the tries that a
 * similar call took, 0 when unknown; a wrong number costs time and changes no floe. *n_left: floes that still overlap
 * when everything was tried; 0 means success. FW_E_NOMEM otherwise only. */
fw_status fw_packing_place(fw_packing *p, size_t n, const double *r, uint64_t n_expected, fw_uniforms *random,
                           size_t *n_left, fw_msg *m);
void      fw_packing_free(fw_packing *p);

/* --- for pushing.h and growing.h --- */

/* The exact grid over all discs, listed in the order in which they came; built when has_cover says that it is not. */
fw_status fw_packing_cover(fw_packing *p, fw_msg *m);
/* One more own floe, overlapping or not. */
fw_status fw_packing_add(fw_packing *p, double x, double y, double r, fw_msg *m);

static inline void fw_packing_random_place(const fw_packing *p, fw_uniforms *random, double *x, double *y)
{
    const fw_packing_box *b = &p->box;
    double                tx = b->x0 + (b->x1 - b->x0) * fw_uniforms_next(random);
    double                ty = b->y0 + (b->y1 - b->y0) * fw_uniforms_next(random);
    *x = tx < p->x_last ? tx : p->x_last;
    *y = ty < p->y_last ? ty : p->y_last;
}

#endif
