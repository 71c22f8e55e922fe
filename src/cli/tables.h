/* The key tables of campaign and scene files: the only place where names, units, defaults, ranges and meanings
 * stand.
 *
 * Plain values land in one fw_values; nested shapes (lists, distributions) have readers of their own in
 * campaign_file.c, model_file.c, distribution_file.c and scene_file.c. */
#ifndef FW_CLI_TABLES_H
#define FW_CLI_TABLES_H

#include <stdint.h>

#include "base/keys.h"

/* Members in the unit that the table says. */
typedef struct fw_values {
    char     name[FW_KEY_TEXT_SIZE];
    uint64_t seed;
    double   accuracy;
    double   diameter, first_bearing;
    double   ice_density, temperature_floor;
    int      floe_distribution; /* fw_size_law */
    double   floe_exponent, floe_median, floe_sigma;
    int      contact_law;
    double   stiffness, damping_ratio, friction, slip_damping_ratio; /* stiffness < 0: from_pressure */
    double   pressure, pressure_exponent, unloading; /* unloading, floe_*: < 0: auto */
    bool     has_flat;
    double   floe_stiffness, floe_friction;
    double   water_density, form_drag, skin_drag;
    bool     has_added_mass, has_deflected_flow;
    double   wind_speed, wind_angle; /* scenes */
    double   air_density, wind_skin_drag, wind_form_drag;
    double   tide_period, tide_minor_ratio, tide_phase; /* phase < 0: auto */
    double   limit_pressure, limit_exponent;
    double   effects_tolerance;
    double   window, warm_up, max_evaluations;
    double   strip_width, downstream;
    double   n_arcs;
    double   order, tolerance, wear_tolerance, first_step, growth; /* < 0: auto */
    char     quantity[FW_KEY_TEXT_SIZE];
    double   half_width, confidence;
    int      design, scramble;
    uint64_t n_randomisations;
    uint64_t max_realisations, max_failed;
    double   life, ice_hours_per_year, year_to_year_cv, persistence, allowance;
    double   speed, temperature, duration; /* scenes */
} fw_values;

typedef struct fw_mix_values {
    double probability;
    int    by;       /* 0 number, 1 area */
} fw_mix_values;

typedef struct fw_points_values {
    uint64_t count;
    double   spacing; /* [deg] */
} fw_points_values;

typedef struct fw_law_values {
    double coefficient, exponent;
    bool   uses_temperature;
} fw_law_values;

/* Rows of a scene's floes land in an fw_floe (floewear/realisation.h). */

/* Both files. */
extern const fw_section fw_table_contact, fw_table_water, fw_table_ring, fw_table_abrasion, fw_table_power,
    fw_table_archard, fw_table_crushing_limit;
/* Campaign files. */
extern const fw_section fw_table_campaign, fw_table_structure, fw_table_points, fw_table_ice, fw_table_mix,
    fw_table_floe_diameter, fw_table_current, fw_table_tide, fw_table_wind, fw_table_exposure, fw_table_field, fw_table_numerics, fw_table_sampling, fw_table_precision,
    fw_table_service, fw_table_uncertainty;
/* Scene files. */
extern const fw_section fw_table_scene, fw_table_scene_structure, fw_table_scene_ice, fw_table_scene_current,
    fw_table_scene_tide, fw_table_scene_wind, fw_table_scene_floe;

/* All of them, in the order of a file: for `floewear keys` and the tests. */
typedef struct fw_table_listed {
    const char       *file; /* "campaign", "scene" or "both" */
    const fw_section *section;
} fw_table_listed;
extern const fw_table_listed fw_tables[];
extern const size_t          fw_n_tables;

#endif
