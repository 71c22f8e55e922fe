/* Which floes are too strong to break: D <= sqrt(130 h - 11) (Lindseth 2013, as used in the source paper). The field uses
 * 4h <= D as well, so a class exists for 0.0855 <= h <= 8.04 m only. */
#ifndef FW_PHYSICS_UNBREAKABLE_H
#define FW_PHYSICS_UNBREAKABLE_H

#include <stdbool.h>

#define FW_THICKNESS_MIN 0.0855 /* roots of 16 h^2 = 130 h - 11 are 0.08550.. and 8.0395.. */
#define FW_THICKNESS_MAX 8.04

double fw_unbreakable_max_diameter(double thickness); /* 0 when no floe of this thickness is unbreakable */
double fw_unbreakable_min_diameter(double thickness); /* 4h, the paper's smallest floe */
bool   fw_unbreakable_class_exists(double thickness);

#endif
