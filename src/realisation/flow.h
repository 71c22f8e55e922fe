/* Inside realisation: water, wind and untouched ice of a window, and how they change within it.
 *
 * A current that changes is constant over short segments, at the value of each one's middle: second order, and a floe still flies by the closed
 * form of its drag within a segment. Untouched ice moves with the water, and in the wind with the mean floe's free drift; who is near enough to
 * matter is awake and drifts as its own size does (fw_setup.wake_upstream). */
#ifndef FW_REALISATION_FLOW_H
#define FW_REALISATION_FLOW_H

#include "floewear/scenario.h"
#include "kernel/kernel.h"

typedef struct fw_weather {
    const fw_tide *tide;          /* NULL: the current is constant; borrowed */
    double         speed;         /* [m/s] */
    double         phase, middle; /* of the ellipse [rad] at this time [s] */
    double         start;         /* the table's 0 [s] */
    double         turn;          /* change of the current from one segment to the next, over its speed */
    double         wind_x, wind_y; /* [m/s] */
    double         fastest;        /* current of the whole course, or ice that the wind drives through it [m/s] */
    double         drift;         /* free drift of the mean floe through the water, over the wind's speed through it */
} fw_weather;

/* Of a window from start on; fills in set->flow and the awake regions. mix < 0: given floes alone. Borrows the model's tide. */
fw_status fw_weather_init(fw_weather *w, fw_setup *set, const fw_model *model, const fw_scenario *sc, double start, double duration, int mix,
                          fw_msg *m);
fw_flow   fw_weather_flow(const fw_weather *w, double t);        /* of the segment that t lies in */
double    fw_weather_segment_end(const fw_weather *w, double t); /* the first one after t; INFINITY: none */

#endif
