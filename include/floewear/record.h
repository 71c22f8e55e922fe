/* floewear/record.h: the result of one realisation, and its bytes.
 *
 * A record is a pure function of (campaign, id): everything but host_cpu_s has the same bits for any number of ranks,
 * any order and after any kill and resume. */
#ifndef FLOEWEAR_RECORD_H
#define FLOEWEAR_RECORD_H

#include "floewear/scenario.h"
#include "floewear/status.h"

/* The records of a campaign are those of one generation of the program. Raised by every change that gives a realisation other numbers, and part
 * of what a campaign's hash stands for: runs begun by another generation are refused, not mixed. 2: accuracy levels of
 * November 2026; 3: awake_floes, reach; 4: watch-dogs, second tries; 5: slip watched between
 * floes too; 6: wear of stiff viscous slip, overlaps at their peak, dashpots of long steps; 7: slip of
 * symmetric wedges, a slowest current; 8: mean_diameter_wanted; 9: what a
 * cluster has dissipated is shared out where it falls apart; 10: steps stay cut where a touch that is none was looked for; 11: an energy
 * balance is measured at least against what water, air and floes bring; mean thickness that wore; further effects; 12: weight, randomisation. */
enum { FW_RECORD_GENERATION = 12 };

/* Scalar columns: C type tag, name (also the HDF5 dataset and journal order), unit (UDUNITS), long name.
 * One list, so that packing, HDF5, documentation and comparison cannot drift apart. */
#define FW_RECORD_LIST(X)                                                                                              \
    X(concentration, "1", "ice concentration asked for")                                                               \
    X(speed, "m s-1", "current speed")                                                                                 \
    X(mix, "1", "index of the thickness mix")                                                                          \
    X(cell, "1", "index of the cell of the joint site table")                                                          \
    X(wind_speed, "m s-1", "wind speed; 0 without wind")                                                               \
    X(wind_angle, "rad", "where the wind blows to, from the current's direction, anticlockwise seen from above")       \
    X(tide_phase, "rad", "phase of the tide in the window's middle; 0 without a tide")                                 \
    X(weight, "1", "weight in every average: how often the site has such a scenario over how often the design draws it") \
    X(randomisation, "1", "of the sampling design that the realisation belongs to; -1: it was drawn on its own")        \
    X(concentration_achieved, "1", "ice concentration of the field that was packed")                                   \
    X(mean_diameter, "m", "mean floe diameter of the field that was packed")                                           \
    X(mean_diameter_wanted, "m", "mean floe diameter of the law of sizes")                                             \
    X(window, "s", "exposure that the wear was collected over")                                                        \
    X(warm_up, "s", "time simulated before the window")                                                                \
    X(failed_at, "s", "simulated time that a failed realisation had come to, warm-up included; else 0")        \
    X(hits, "1", "first touches of a floe and the structure after 1 s apart, within the window")                       \
    X(contact_time, "s", "sum over floes of the time with a force on the structure")                                   \
    X(normal_impulse, "N s", "sum over floes of the normal impulse on the structure")                                  \
    X(peak_force, "N", "largest normal force of one floe on the structure")                                            \
    X(max_overlap_share, "1", "largest overlap over the smaller radius")                                               \
    X(overlap_time_share, "1", "share of the window with an overlap beyond a tenth of the smaller radius")             \
    X(overlap_wear_share, "1", "share of the wear load collected in such contacts")                                    \
    X(energy_relative, "1", "energy bookkeeping: impulse times mean velocity against change of kinetic energy")        \
    X(energy_truncation, "1", "energy balance of the trajectory relative to throughput")                               \
    X(momentum_relative, "1", "momentum bookkeeping: impulses against change of momentum")                             \
    X(wear_conservation, "1", "wear load on the ring against the patch integral, relative")                            \
    X(wear_thickness, "m", "mean thickness of the floes that wore, weighted by the first law's load on the wall; 0: none did") \
    X(force_evaluations, "1", "contact force evaluations, one per contact and stage")                                  \
    X(steps, "1", "sub-steps of all islands")                                                                          \
    X(refined_steps, "1", "sub-steps repeated with half their length because a watch-dog saw a law broken")             \
    X(slip_chatter, "1", "share of the contacts' steps whose slip jumped to and fro between the caps of friction") \
    X(late_touches, "1", "touches found only after the rims had overlapped")                                           \
    X(late_overlap, "1", "largest overlap at such a touch over the smaller radius")                                    \
    X(tries, "1", "1; 2 when the first try failed and finer steps were taken from the start")                          \
    X(floes_made, "1", "floes generated")                                                                              \
    X(floes_touched, "1", "floes that were ever touched")                                                              \
    X(awake_floes, "1", "largest number of floes at once that were touched or about to meet the structure")                                  \
    X(reach, "m", "how far upstream of the structure's axis ice was disturbed at most")                                \
    X(host_cpu_s, "s", "processor time on the machine that computed it")

typedef struct fw_record {
    uint64_t  id;
    fw_status status;     /* FW_OK, or why the realisation failed; a failed one is kept, never dropped */
    char      cause[200]; /* why it failed; with FW_OK: empty, or why the first of two tries failed */
#define X(name, unit, long_name) double name;
    FW_RECORD_LIST(X)
#undef X
    size_t  n_arcs, n_laws;
    /* Rings, arc k covers theta in [k, k+1) 2 pi / n_arcs, theta clockwise seen from above from the arc facing the
     * current; load per law is the temperature-free wear load int sigma^m |vt| dt [MPa^m km]. One block, owned:
     *   path (n_arcs) [km] | for each law: load, load_impact, load_high (n_arcs each) [MPa^m km] */
    double *rings;
} fw_record;

enum { FW_RING_LOAD = 0, FW_RING_IMPACT = 1, FW_RING_HIGH = 2, FW_RINGS_PER_LAW = 3 };

static inline size_t fw_record_n_rings(size_t n_arcs, size_t n_laws)
{
    return n_arcs * (1 + FW_RINGS_PER_LAW * n_laws); /* doubles in rings */
}
static inline const double *fw_record_path(const fw_record *r) { return r->rings; }
static inline const double *fw_record_load(const fw_record *r, size_t law, int which)
{
    return r->rings + r->n_arcs * (1 + FW_RINGS_PER_LAW * law + (size_t)which);
}

fw_status fw_record_init(fw_record *r, size_t n_arcs, size_t n_laws, fw_msg *m); /* zeroed rings */
void      fw_record_free(fw_record *r);                                          /* zeroed struct is fine */

/* The scenario's columns of a record, and a scenario from them. */
void        fw_record_take_scenario(fw_record *r, const fw_scenario *s);
fw_scenario fw_record_scenario(const fw_record *r, uint64_t seed);
/* Mean wear load over the ring [MPa^m km]. */
double      fw_record_mean_load(const fw_record *r, size_t law);

/* Little-endian bytes, fixed size for given n_arcs and n_laws. Failed records carry zero rings. */
size_t    fw_record_packed_size(size_t n_arcs, size_t n_laws);
void      fw_record_pack(const fw_record *r, unsigned char *bytes);
/* r must be fw_record_init'ed with the same n_arcs and n_laws. FW_E_FORMAT when the bytes name other sizes or an unknown status. */
fw_status fw_record_unpack(fw_record *r, const unsigned char *bytes, size_t n_bytes, fw_msg *m);

typedef struct fw_record_column {
    const char *name, *unit, *long_name;
    size_t      offset; /* of the double inside fw_record */
} fw_record_column;
extern const fw_record_column fw_record_columns[];
extern const size_t           fw_n_record_columns;

#endif
