/* Does slip chatter? Not asked of Euler with the naive rule: that is the plain method as it is found elsewhere, to be timed. */
#include "kernel/plain_inside.h"
#include "kernel/watch.h"

/* Where several contacts hold a floe few of them swing all the way to their caps. */
static const double NEAR_CAP = 0.3;

void fw_plain_watch(fw_plain *p, fw_world *w)
{
    for (size_t q = 0; q < p->neighbours.n_near; q++) {
        fw_plain_meeting      c;
        struct fw_plain_slip *was = &p->slip[q], now = {0};
        if (fw_plain_meets(p, w, q, &c)) {
            now.normal = c.normal, now.slip = c.slip;
            now.jumped = fw_watch_jump(&p->law[q], NEAR_CAP, was->slip, was->normal, now.slip, now.normal);
            w->ledger.contact_steps++;
            if (now.jumped && now.jumped == -was->jumped) w->ledger.chatter++;
        }
        *was = now;
    }
}
