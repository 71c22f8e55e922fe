/* Watch-dogs inside the kernel. A step is judged when it is tried, while it may still be repeated with half its length; floes and touches as
 * they come. What only a whole run shows (its books, its energy balance) is judged by who runs it (realisation/verdict.h). */
#ifndef FW_KERNEL_WATCH_H
#define FW_KERNEL_WATCH_H

#include "kernel/cluster.h"

/* Does a tried and weighed step of length h break a law that a finer one may keep? Energy: its imbalance against what the cluster has
 * dissipated so far. Slip: it jumps from one cap of friction to the other, again. */
bool fw_watch_step(const fw_cluster *c, const fw_setup *set, double h);
/* +-1: slip goes from one cap of friction, or this share of it, to the other between two instants of a contact, up or down; 0: no such jump. */
int  fw_watch_jump(const fw_contact_constants *law, double share, double slip0, double normal0, double slip1, double normal1);
/* The committed step: remembers jumps of slip, counts those that went to and fro. */
void fw_watch_slip(fw_cluster *c, const fw_setup *set, fw_ledger *l);

/* A floe after a step: finite, its centre outside the structure. FW_E_NUMERIC names it, and when. */
fw_status fw_watch_body(const fw_setup *set, const fw_body *b, fw_msg *m);
/* A closed contact after a step: overlap below the smaller radius, where discs would go through each other. other: NULL, the structure. */
fw_status fw_watch_overlap(const fw_setup *set, const fw_body *b, const fw_body *other, double depth, double t, fw_msg *m);
/* The same contact's law was broken at some stage: there was tension, or friction beyond its cap. */
fw_status fw_watch_unlawful(const fw_body *b, double t, fw_msg *m);
/* A touch found when rims overlap already by more than a tolerance explains: a contact that was missed. */
fw_status fw_watch_late(const fw_setup *set, fw_ledger *l, const fw_body *b, double other_radius, double depth, double t, fw_msg *m);

#endif
