/* Inside the kernel only: who may touch whom, and when at the earliest.
 *
 *   listing (every `horizon`): each awake floe is given a line that it will keep to within a margin; whoever's line comes near
 *   another's becomes a candidate pair. A floe that leaves its line (it was hit) gets a new one, and its candidates anew.
 *   check (whenever one of the two has a new path): when does the pair touch?
 *
 * Untouched ice takes part as it lies in its blocks: it is woken by the touch itself, not before. */
#ifndef FW_KERNEL_TRAFFIC_H
#define FW_KERNEL_TRAFFIC_H

#include "kernel/path.h"

enum { FW_ICE = -2 }; /* in the place of a body: an untouched floe */

typedef struct fw_candidate {
    int32_t i, j;           /* body; body, FW_WALL or FW_ICE */
    int32_t next_i, next_j; /* next candidate of i, of j; -1: the last */
    int32_t block, row;     /* of the untouched floe */
    bool    is_closed;      /* in contact: its cluster has it */
    double  touch;          /* next touch, as far as paths are known; INFINITY: none */
    double  clear;          /* no touch before this unless somebody is faster than `swift` */
} fw_candidate;

/* A line that a floe keeps to within a margin, and where it sits. */
typedef struct fw_seat {
    fw_cluster *cluster; /* NULL: in no contact */
    int32_t     member;
    int32_t     first; /* candidate */
    double      t, x, y, vx, vy; /* the line: where it was at t */
    double      margin, reach;   /* how far it may leave it; with its radius */
} fw_seat;

typedef struct fw_traffic {
    fw_setup      setup;
    fw_books      books;
    fw_world     *world;
    double        now, until; /* [s] now; candidates are complete up to until */
    double        swift;      /* [m/s] relative to the water, for fw_candidate.clear */
    bool          is_listed;
    uint64_t      blocks_listed;
    fw_candidate *candidates;
    size_t        n_candidates, candidate_capacity;
    fw_seat      *seats; /* (n_bodies) */
    size_t        seat_capacity;
    struct fw_edge {
        double  left, right;
        int32_t body;
    } * edges;
    size_t   edge_capacity;
    int32_t *some; /* workspace: bodies or rows of ice that may be near */
    size_t   some_capacity;
    int32_t soonest; /* candidate with the earliest touch; -1: none; */
    bool    is_soonest_known;
} fw_traffic;

void    fw_traffic_free(fw_traffic *t);
fw_path fw_traffic_path(const fw_traffic *t, int32_t body);
fw_path fw_traffic_path_of_other(const fw_traffic *t, const fw_candidate *c); /* of j */

/* Everything anew from now to until. Seats of all bodies have their clusters set. */
fw_status fw_traffic_list(fw_traffic *t, fw_msg *m);
/* Body i gets a new line from now on, and the candidates that come with it. */
fw_status fw_traffic_list_body(fw_traffic *t, int32_t i, fw_msg *m);
/* The same if it leaves its line within its path as known. */
fw_status fw_traffic_follow(fw_traffic *t, int32_t i, fw_msg *m);
/* The untouched floe of candidate c is body j now: every candidate that named it follows. */
void      fw_traffic_woken(fw_traffic *t, int32_t c, int32_t j);

void    fw_traffic_check(fw_traffic *t, int32_t c);
void    fw_traffic_check_body(fw_traffic *t, int32_t i); /* all its candidates; those within its cluster once */
void    fw_traffic_touches_at(fw_traffic *t, int32_t c, double touch); /* found by somebody who knows better */
int32_t fw_traffic_soonest(fw_traffic *t);                             /* -1: nobody touches as far as is known */
int32_t fw_traffic_find(const fw_traffic *t, int32_t i, int32_t j);    /* -1: no such candidate */

fw_status fw_traffic_add(fw_traffic *t, int32_t i, int32_t j, int32_t *name, fw_msg *m); /* whatever their lines say */

static inline int32_t fw_traffic_next(const fw_candidate *c, int32_t body)
{
    return c->i == body ? c->next_i : c->next_j;
}

#endif
