/* Inside the kernel only: what its files share. kernel.c time; events.c what happens at an event; flock.c clusters come and go; listing.c
 * who may touch whom, anew, and who is forgotten. */
#ifndef FW_KERNEL_INSIDE_H
#define FW_KERNEL_INSIDE_H

#include "kernel/traffic.h"

struct fw_kernel {
    fw_traffic   traffic;
    double       horizon;  /* time between two listings [s] */
    uint64_t     n_events, n_idle; /* in all; since a step was committed or a contact closed */
    double       attended; /* force evaluations when somebody was last attended to */
    fw_cluster **clusters;
    size_t       n_clusters, cluster_capacity;
    fw_cluster **spare; /* emptied ones, with their memory */
    size_t       n_spare, spare_capacity;
    int32_t     *opened, *root, *new_name;
    size_t       opened_capacity, root_capacity, name_capacity;
    size_t       n_seated; /* bodies that have a seat */
    bool        *is_gone;
    size_t       gone_capacity;
};

/* flock.c */
fw_status fw_flock_new(fw_kernel *k, double t, fw_cluster **out, fw_msg *m);
fw_status fw_flock_alone(fw_kernel *k, int32_t body, fw_msg *m); /* a cluster of one, in no contact, from now on */
void      fw_flock_retire(fw_kernel *k, fw_cluster *c); /* emptied; its memory is kept for the next */
void      fw_flock_seat(fw_kernel *k, fw_cluster *c);   /* members' seats name it */
/* Members that nothing holds fly on alone (or go on as clusters of one, forces.h); parts that nothing joins become clusters of their own. The new ones stand at the end
 * of k->clusters, from *first on; c is empty then, and retired. */
fw_status fw_flock_fall_apart(fw_kernel *k, fw_cluster *c, size_t *first, fw_msg *m);

/* listing.c */
fw_status fw_listing_make(fw_kernel *k, double t_end, fw_msg *m);
fw_status fw_listing_contacts(fw_kernel *k, fw_msg *m); /* into the world */

/* events.c */
double    fw_event_step_limit(const fw_kernel *k, const fw_cluster *c, double t_end);
fw_status fw_event_step_ends(fw_kernel *k, fw_cluster *c, double t_end, fw_msg *m);
fw_status fw_event_touch(fw_kernel *k, int32_t candidate, double t_end, fw_msg *m);
void      fw_event_fly(fw_kernel *k, int32_t body, double t); /* a floe in no contact, to t */

/* kernel.c: how far from an awake floe's rim ice has to be known [m] */
double fw_kernel_ice_margin(const fw_kernel *k);

#endif
