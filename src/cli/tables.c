#include "cli/tables.h"

#include <math.h>

#include "floewear/realisation.h"

#define AT(member) offsetof(fw_values, member)
#define ANY        -INFINITY, INFINITY, false
#define AT_LEAST(a)   (a), INFINITY, false
#define MORE_THAN(a)  (a), INFINITY, true
#define FROM_TO(a, b) (a), (b), false
#define ABOVE_TO(a, b) (a), (b), true
#define NUMBER(name, member, unit, fallback, range, meaning) \
    {name, FW_KEY_NUMBER, AT(member), unit, fallback, range, NULL, meaning}
#define AUTO(name, member, unit, fallback, range, meaning) \
    {name, FW_KEY_AUTO, AT(member), unit, fallback, range, NULL, meaning}
#define FLAG(name, member, fallback, meaning) {name, FW_KEY_FLAG, AT(member), NULL, fallback, ANY, NULL, meaning}
#define COUNT(name, member, fallback, range, meaning) \
    {name, FW_KEY_COUNT, AT(member), NULL, fallback, range, NULL, meaning}
#define SHAPED(name, fallback, shape, meaning) {name, FW_KEY_SHAPED, 0, NULL, fallback, ANY, shape, meaning}
#define SECTION(variable, name, meaning, rows) \
    const fw_section variable = {name, meaning, sizeof(rows) / sizeof(rows)[0], rows}

static const char COURSE_MEANING[] =
    "CSV with columns time, factor, turn: the current in the course of a window, times its speed, turned clockwise; straight between rows";

/* ---- both files ------------------------------------------------------------------------------------------------- */

static const fw_key CONTACT[] = {
    {"law", FW_KEY_CHOICE, AT(contact_law), NULL, "spring", ANY, "spring|crush",
     "on the structure: spring and dashpot, or ice that crushes and keeps its flat"},
    {"stiffness", FW_KEY_AUTO, AT(stiffness), "N/m", "2000 kN/m", FROM_TO(1e3, 1e12), "from_pressure",
     "spring of a contact; from_pressure: as deep an overlap as ice of contact.pressure would crush"},
    NUMBER("damping_ratio", damping_ratio, "1", "1", FROM_TO(0, 100),
           "dashpot over the critical one, c = ratio 2 sqrt(k m)"),
    NUMBER("friction", friction, "1", "0.1", FROM_TO(0, 10), "Coulomb coefficient"),
    NUMBER("slip_damping_ratio", slip_damping_ratio, "1", "1", FROM_TO(0, 100),
           "viscous part of the friction over the normal dashpot"),
    NUMBER("pressure", pressure, "Pa", "1.1 MPa", FROM_TO(1e3, 1e9), "of ice that crushes, on a contact area of 1 m2"),
    NUMBER("pressure_exponent", pressure_exponent, "1", "0", FROM_TO(0, 0.8),
           "q: pressure (area / 1 m2)^-q on the area chord times thickness; 0: the same on every area"),
    FLAG("flat", has_flat, "on", "crush: the flat that is left turns the floe with it, by a moment up to force times half its width"),
    AUTO("unloading_stiffness", unloading, "1", "auto", FROM_TO(1, 1e6),
         "crush: slope of the unloading line over force / deepest overlap; auto: restitution 0.135 head-on"),
    AUTO("floe_stiffness", floe_stiffness, "N/m", "auto", FROM_TO(1e3, 1e12), "spring between two floes; auto: the structure's"),
    AUTO("floe_friction", floe_friction, "1", "auto", FROM_TO(0, 10), "Coulomb coefficient between two floes; auto: the structure's"),
};
SECTION(fw_table_contact, "contact", "contact of a floe with the structure and with another floe", CONTACT);

static const fw_key WATER[] = {
    NUMBER("density", water_density, "kg/m3", "1025 kg/m3", FROM_TO(100, 2000), "density of the water"),
    NUMBER("form_drag", form_drag, "1", "10", FROM_TO(0, 1000),
           "drag coefficient on a floe's side area, diameter times thickness"),
    NUMBER("skin_drag", skin_drag, "1", "0.0055", FROM_TO(0, 1),
           "drag coefficient on a floe's lower face; acts where it is given, or where there is no form drag"),
    FLAG("added_mass", has_added_mass, "off", "the water round a floe is moved with it"),
    FLAG("deflected_flow", has_deflected_flow, "off", "the current goes round the structure instead of through it"),
    SHAPED("level", "", "distribution in m",
           "of the water about its mean; spreads a campaign's wear over height, after the run; left out: none is worked out"),
};
SECTION(fw_table_water, "water", "water and what it does to a floe", WATER);

static const fw_key RING[] = {
    AUTO("arcs", n_arcs, "1", "auto", FROM_TO(72, 3600),
         "arcs that the wear is collected in all round the structure; auto: 360, at accuracies below 1 % more"),
};
SECTION(fw_table_ring, "ring", "resolution of the wear round the structure", RING);

static const fw_key ABRASION[] = {
    SHAPED("laws", "[bekker2011]", "list of names, {archard: {...}} or {power: {...}}",
           "abrasion laws; the first one governs the stop rule and the report"),
    SHAPED("crushing_limit", "", "{pressure, exponent}", "largest pressure that wears; left out: pressures of a first touch have no bound"),
    SHAPED("scatter", "", "distribution of a factor",
           "on the law's rate: a row of the ledger and life percentiles with it, no part of a window's; left out: not measured"),
    SHAPED("uncertainty", "", "{coefficient, exponent}", "how well the first law is known, the same over a life; acts like scatter"),
};
SECTION(fw_table_abrasion, "abrasion", "from contact pressure and sliding path to depth", ABRASION);

static const fw_key UNCERTAINTY[] = {
    SHAPED("coefficient", "", "distribution of a factor", "on the first law's coefficient; left out: known"),
    SHAPED("exponent", "", "distribution", "of the first law's exponent, within those of the campaign's laws, between which ln(depth) is interpolated; left out: known"),
};
SECTION(fw_table_uncertainty, "abrasion.uncertainty", "how well the first abrasion law is known", UNCERTAINTY);

static const fw_key CRUSHING_LIMIT[] = {
    NUMBER("pressure", limit_pressure, "Pa", NULL, FROM_TO(1e3, 1e8), "on a contact area of 1 m2"),
    NUMBER("exponent", limit_exponent, "1", "0", FROM_TO(0, 0.99), "q: pressure (area / 1 m2)^-q; 0: the same on every area"),
};
SECTION(fw_table_crushing_limit, "abrasion.crushing_limit", "pressure at which ice crushes under the contact", CRUSHING_LIMIT);

static const fw_key POWER[] = {
    {"coefficient", FW_KEY_NUMBER, offsetof(fw_law_values, coefficient), "mm/km", NULL, MORE_THAN(0), NULL,
     "depth per path at 1 MPa (and 1 K below zero)"},
    {"exponent", FW_KEY_NUMBER, offsetof(fw_law_values, exponent), "1", NULL, ANY, NULL,
     "of the pressure in MPa, more than 0 and less than 2, with a crushing limit less than 4 and, times the limit's exponent, less than 2"},
    {"uses_temperature", FW_KEY_FLAG, offsetof(fw_law_values, uses_temperature), NULL, "off", ANY, NULL,
     "on: pressure over the degrees below zero, as in bekker2011"},
};
SECTION(fw_table_power, "abrasion.laws[].power", "a power law of one's own", POWER);

static const fw_key ARCHARD[] = {
    {"coefficient", FW_KEY_NUMBER, offsetof(fw_law_values, coefficient), "mm/km", NULL, MORE_THAN(0), NULL,
     "depth per path at 1 MPa"},
};
SECTION(fw_table_archard, "abrasion.laws[].archard", "depth proportional to pressure and path", ARCHARD);

/* ---- campaign files --------------------------------------------------------------------------------------------- */

static const fw_key CAMPAIGN[] = {
    {"name", FW_KEY_TEXT, AT(name), NULL, "", ANY, NULL, "names the results; the file's own name when left out"},
    SHAPED("structure", "", "map", "the structure and its measuring points"),
    SHAPED("ice", NULL, "map", "ice and its statistics"),
    SHAPED("current", NULL, "map", "statistics of the current"),
    SHAPED("wind", "", "map", "statistics of the wind; left out: there is none"),
    SHAPED("contact", "", "map", "contact of floes"),
    SHAPED("water", "", "map", "water"),
    SHAPED("effects", "auto", "auto, list of names, or {name: on/off}", "effects that act in the simulation"),
    NUMBER("effects_tolerance", effects_tolerance, "1", "0 %", FROM_TO(0, 1),
           "auto drops an effect whose measured change of depth is below this; 0: none is dropped"),
    SHAPED("abrasion", "", "map", "abrasion laws"),
    SHAPED("exposure", "", "map", "what one realisation simulates"),
    SHAPED("field", "", "map", "extent of the simulated ice"),
    SHAPED("ring", "", "map", "resolution round the structure"),
    NUMBER("accuracy", accuracy, "1", "1 %", FROM_TO(1e-4, 0.1), "wanted discretisation error of a window's depth"),
    SHAPED("numerics", "", "map", "how a window is computed; left out: accuracy chooses"),
    SHAPED("sampling", "", "map", "how scenarios are drawn; left out: a pilot chooses"),
    SHAPED("precision", "", "map", "when there are enough realisations"),
    SHAPED("service", "", "map", "service life; left out: none is worked out"),
    COUNT("seed", seed, "1", FROM_TO(0, 1e18), "of every random number"),
};
SECTION(fw_table_campaign, "", "a campaign file", CAMPAIGN);

static const fw_key STRUCTURE[] = {
    NUMBER("diameter", diameter, "m", "7.4 m", FROM_TO(0.1, 1000), "at the waterline"),
    SHAPED("measuring_points", "24", "number all round, or {count, spacing}",
           "where depth is reported, numbered from 1 clockwise"),
    NUMBER("first_bearing", first_bearing, "deg", "0 deg", FROM_TO(-360, 360),
           "bearing of point 1: its outward normal, clockwise from north"),
};
SECTION(fw_table_structure, "structure", "the structure and its measuring points", STRUCTURE);

static const fw_key POINTS[] = {
    {"count", FW_KEY_COUNT, offsetof(fw_points_values, count), NULL, NULL, FROM_TO(1, 3600), NULL, "number of points"},
    {"spacing", FW_KEY_NUMBER, offsetof(fw_points_values, spacing), "deg", NULL, ABOVE_TO(0, 360), NULL,
     "bearing from one point to the next"},
};
SECTION(fw_table_points, "structure.measuring_points", "points over a part of the structure", POINTS);

static const fw_key ICE[] = {
    NUMBER("density", ice_density, "kg/m3", "900 kg/m3", FROM_TO(100, 1100), "density of the ice"),
    SHAPED("temperature", NULL, "distribution in degC",
           "of the ice at the contact; integrated exactly, never simulated"),
    NUMBER("temperature_floor", temperature_floor, "K", "1.8 K", ABOVE_TO(0, 50),
           "least distance of a temperature from 0 degC: the abrasion law is singular there"),
    SHAPED("thickness_mixes", "[{probability: 1, classes: {0.5 m: 1, 0.7 m: 1, 0.9 m: 1, 1.1 m: 1, 1.3 m: 1}}]",
           "list of {probability, classes, by}", "mixes of thickness; a realisation draws one"),
    SHAPED("floe_diameter", "{distribution: uniform}", "map", "law of the diameter inside [4h, sqrt(130h - 11)]"),
    SHAPED("concentration", "", "distribution", "share of the water that ice covers, more than 0 and at most 80 %"),
};
SECTION(fw_table_ice, "ice", "ice and its statistics", ICE);

static const fw_key MIX[] = {
    {"probability", FW_KEY_NUMBER, offsetof(fw_mix_values, probability), "1", NULL, FROM_TO(0, 1), NULL,
     "of this mix; they sum to 1"},
    SHAPED("classes", NULL, "{thickness: share}", "share of every thickness class; shares are divided by their sum"),
    {"by", FW_KEY_CHOICE, offsetof(fw_mix_values, by), NULL, "number", ANY, "number|area",
     "what shares are of: the number of floes, or the ice area"},
};
SECTION(fw_table_mix, "ice.thickness_mixes[]", "one mix of thickness classes", MIX);

static const fw_key FLOE_DIAMETER[] = {
    {"distribution", FW_KEY_CHOICE, AT(floe_distribution), NULL, "uniform", ANY, "uniform|power-law|lognormal",
     "law of the diameter, cut to [4h, sqrt(130h - 11)]"},
    NUMBER("exponent", floe_exponent, "1", "2", FROM_TO(-10, 10),
           "power-law: density proportional to diameter^-exponent"),
    NUMBER("median", floe_median, "m", "5 m", ABOVE_TO(0, 1000), "lognormal: median before the cut"),
    NUMBER("sigma", floe_sigma, "1", "0.5", ABOVE_TO(0, 10), "lognormal: standard deviation of ln(diameter)"),
};
SECTION(fw_table_floe_diameter, "ice.floe_diameter", "law of floe diameters", FLOE_DIAMETER);

static const fw_key CURRENT[] = {
    SHAPED("speed", "", "distribution in m/s", "of the current, more than 0"),
    SHAPED("direction", "0 deg", "distribution in deg, or {rose: {bearing: weight}}",
           "where the current flows to, clockwise from north; integrated exactly, never simulated"),
    SHAPED("joint", "", "file name",
           "CSV with columns speed, direction, concentration, (thickness), probability; instead of the single laws"),
    SHAPED("tide", "", "{period, minor_ratio, phase}", "the current turns with a tide within a window; its speed is then the tide's largest"),
    SHAPED("course", "", "file name", COURSE_MEANING),
};
SECTION(fw_table_current, "current", "statistics of the current", CURRENT);

#define TIDE_PERIOD NUMBER("period", tide_period, "s", "12.42 h", FROM_TO(60, 1e9), "of the tide; M2 has 12.42 h")
#define TIDE_RATIO                                                                                                     \
    NUMBER("minor_ratio", tide_minor_ratio, "1", "0", FROM_TO(-1, 1),                                                  \
           "smallest over largest current; negative: it turns clockwise seen from above; 0: to and fro")
static const fw_key TIDE[] = {
    TIDE_PERIOD,
    TIDE_RATIO,
    AUTO("phase", tide_phase, "deg", "auto", FROM_TO(0, 360),
         "of the window's middle, 0 deg: the largest current; auto: drawn for every window, evenly over the period"),
};
SECTION(fw_table_tide, "current.tide", "a tide that turns the current", TIDE);

#define WIND_DRAGS                                                                                                     \
    NUMBER("air_density", air_density, "kg/m3", "1.3 kg/m3", ABOVE_TO(0, 10), "density of the air"),                    \
        NUMBER("skin_drag", wind_skin_drag, "1", "0.0018", FROM_TO(0, 1), "drag coefficient on a floe's upper face"),   \
        NUMBER("form_drag", wind_form_drag, "1", "1.1", FROM_TO(0, 100),                                               \
               "drag coefficient on the side of a floe's freeboard")
static const fw_key WIND[] = {
    SHAPED("speed", "", "distribution in m/s", "of the wind, over the floes; a window draws one"),
    SHAPED("angle", "0 deg", "distribution in deg",
           "where the wind blows to, from where the current flows to, clockwise seen from above"),
    WIND_DRAGS,
};
SECTION(fw_table_wind, "wind", "statistics of the wind", WIND);

static const fw_key EXPOSURE[] = {
    NUMBER("window", window, "s", "3 h", FROM_TO(1e-3, 1e9), "time that one realisation collects wear over"),
    AUTO("warm_up", warm_up, "s", "auto", FROM_TO(0, 1e9),
         "time simulated before the window; 0 s: starts in a placed field"),
    AUTO("max_force_evaluations", max_evaluations, "1", "auto", FROM_TO(1, 1e18),
         "a realisation that takes more fails; auto: 100 times what is expected of it, 1e9 at least"),
};
SECTION(fw_table_exposure, "exposure", "what one realisation simulates", EXPOSURE);

static const fw_key FIELD[] = {
    AUTO("strip_width", strip_width, "m", "auto", ABOVE_TO(0, 1e5), "width of the strip of ice that drifts past"),
    AUTO("downstream", downstream, "m", "auto", ABOVE_TO(0, 1e5), "floes are forgotten this far behind the structure"),
};
SECTION(fw_table_field, "field", "extent of the simulated ice", FIELD);

static const fw_key NUMERICS[] = {
    AUTO("order", order, "1", "auto", FROM_TO(2, 4), "of the integrator of a contact: 2 (TR-BDF2), 3 or 4"),
    AUTO("tolerance", tolerance, "1", "auto", FROM_TO(1e-12, 0.1),
         "local error of velocity in a sub-step, over the current's speed"),
    AUTO("wear_tolerance", wear_tolerance, "1", "auto", FROM_TO(1e-12, 0.1),
         "error of a sub-step's wear, over the wear of its touch so far"),
    AUTO("first_step", first_step, "1", "auto", FROM_TO(1e-4, 10), "after a touch, in 1/w with w = sqrt(stiffness / mass)"),
    AUTO("growth", growth, "1", "auto", FROM_TO(1.1, 100), "largest factor from one sub-step to the next"),
};
SECTION(fw_table_numerics, "numerics", "how a window is computed, instead of what accuracy and its study choose", NUMERICS);

static const fw_key SAMPLING[] = {
    {"design", FW_KEY_CHOICE, AT(design), NULL, "auto", ANY, "auto|plain|stratified|latin_hypercube|sobol",
     "how scenarios are drawn; auto: as the pilot of floewear plan chose, else plain"},
    COUNT("randomisations", n_randomisations, "32", FROM_TO(16, 1024), "independent ones of a design that is not plain; intervals are made from their scatter"),
    {"scramble", FW_KEY_CHOICE, AT(scramble), NULL, "owen", ANY, "owen|digital_shift", "of Sobol points"},
    SHAPED("allocation", "", "list of shares", "stratified: share of the realisations for every stratum, as OUT.plan.h5 lists them; left out: as often as the site has it"),
};
SECTION(fw_table_sampling, "sampling", "how scenarios are drawn", SAMPLING);

static const fw_key PRECISION[] = {
    {"quantity", FW_KEY_TEXT, AT(quantity), NULL, "P90", ANY, NULL,
     "what has to be precise: mean, or a percentile like P90"},
    NUMBER("half_width", half_width, "1", "0 %", FROM_TO(0, 10),
           "relative half-width of its interval at the worst point; 0: run max_realisations"),
    SHAPED("points", "", "list of measuring points", "the points that it is asked of; all of them when left out"),
    NUMBER("confidence", confidence, "1", "95 %", FROM_TO(0.5, 0.9999), "of the interval"),
    COUNT("max_realisations", max_realisations, "1000", FROM_TO(1, 1e12), "the run ends here at the latest"),
    COUNT("max_failed", max_failed, "", FROM_TO(1, 1e12),
          "more failed realisations end the run with exit code 3; 1 % of max_realisations when left out"),
};
SECTION(fw_table_precision, "precision", "when there are enough realisations", PRECISION);

static const fw_key SERVICE[] = {
    NUMBER("life", life, "year", NULL, ABOVE_TO(0, 1e4), "service life"),
    NUMBER("ice_hours_per_year", ice_hours_per_year, "h", "", ABOVE_TO(0, 8784),
           "hours a year with ice at the structure; unless service.years gives them"),
    NUMBER("year_to_year_cv", year_to_year_cv, "1", "0", FROM_TO(0, 10),
           "coefficient of variation of a year's lognormal factor of mean 1 on depth"),
    SHAPED("years", "", "file name",
           "CSV with columns (year), ice_hours, (factor): whole years of a site, drawn with replacement, factor on depth; instead of the two above"),
    NUMBER("persistence", persistence, "1", "0", FROM_TO(0, 0.9999),
           "correlation of the normal scores of one window's depth and the next one's; a winter starts afresh"),
    NUMBER("allowance", allowance, "mm", "0 mm", AT_LEAST(0), "depth that may wear off; 0: none given"),
};
SECTION(fw_table_service, "service", "service life", SERVICE);

/* ---- scene files ------------------------------------------------------------------------------------------------ */

static const fw_key SCENE[] = {
    {"name", FW_KEY_TEXT, AT(name), NULL, "", ANY, NULL, "for the reader"},
    SHAPED("structure", "", "map", "the structure"),
    SHAPED("ice", "", "map", "density and temperature"),
    SHAPED("current", NULL, "map", "current"),
    SHAPED("wind", "", "map", "wind; left out: there is none"),
    SHAPED("contact", "", "map", "contact of floes"),
    SHAPED("water", "", "map", "water"),
    SHAPED("effects", "auto", "auto, list of names, or {name: on/off}", "effects that act in the simulation"),
    SHAPED("abrasion", "", "map", "abrasion laws"),
    SHAPED("ring", "", "map", "resolution round the structure"),
    NUMBER("duration", duration, "s", NULL, FROM_TO(1e-3, 1e9), "time to simulate"),
    NUMBER("accuracy", accuracy, "1", "1 %", FROM_TO(1e-4, 0.1), "wanted discretisation error of the depth"),
    SHAPED("floes", NULL, "list of {x, y, diameter, thickness, vx, vy, spin}", "the floes at the start"),
};
SECTION(fw_table_scene, "", "a scene file", SCENE);

static const fw_key SCENE_STRUCTURE[] = {
    NUMBER("diameter", diameter, "m", "7.4 m", FROM_TO(0.1, 1000), "at the waterline; its centre is the origin"),
};
SECTION(fw_table_scene_structure, "structure", "the structure", SCENE_STRUCTURE);

static const fw_key SCENE_ICE[] = {
    NUMBER("density", ice_density, "kg/m3", "900 kg/m3", FROM_TO(100, 1100), "density of the ice"),
    NUMBER("temperature", temperature, "degC", "-10 degC", FROM_TO(-100, 0), "of the ice at the contact"),
    NUMBER("temperature_floor", temperature_floor, "K", "1.8 K", ABOVE_TO(0, 50),
           "least distance of the temperature from 0 degC"),
};
SECTION(fw_table_scene_ice, "ice", "ice", SCENE_ICE);

static const fw_key SCENE_CURRENT[] = {
    NUMBER("speed", speed, "m/s", NULL, FROM_TO(0, 20), "along +x"),
    SHAPED("tide", "", "{period, minor_ratio, phase}", "the current turns with a tide; its speed is then the tide's largest, along +x"),
    SHAPED("course", "", "file name", COURSE_MEANING),
};
SECTION(fw_table_scene_current, "current", "current", SCENE_CURRENT);

static const fw_key SCENE_TIDE[] = {
    TIDE_PERIOD,
    TIDE_RATIO,
    NUMBER("phase", tide_phase, "deg", "0 deg", FROM_TO(0, 360), "of the middle of the duration, 0 deg: the largest current"),
};
SECTION(fw_table_scene_tide, "current.tide", "a tide that turns the current", SCENE_TIDE);

static const fw_key SCENE_WIND[] = {
    NUMBER("speed", wind_speed, "m/s", "0 m/s", FROM_TO(0, 100), "of the wind"),
    NUMBER("angle", wind_angle, "deg", "0 deg", FROM_TO(-360, 360), "where it blows to, from +x, clockwise seen from above"),
    WIND_DRAGS,
};
SECTION(fw_table_scene_wind, "wind", "wind", SCENE_WIND);

#define FLOE(name, member, unit, fallback, range, meaning) \
    {name, FW_KEY_NUMBER, offsetof(fw_floe, member), unit, fallback, range, NULL, meaning}
static const fw_key SCENE_FLOE[] = {
    FLOE("x", x, "m", NULL, FROM_TO(-1e6, 1e6), "centre, along the current"),
    FLOE("y", y, "m", NULL, FROM_TO(-1e6, 1e6), "centre, to the left of the current"),
    FLOE("diameter", diameter, "m", NULL, ABOVE_TO(0, 1000), "at most sqrt(130h - 11)"),
    FLOE("thickness", thickness, "m", NULL, FROM_TO(0.0855, 8.04), "thickness h"),
    FLOE("vx", vx, "m/s", "0 m/s", FROM_TO(-100, 100), "velocity along the current"),
    FLOE("vy", vy, "m/s", "0 m/s", FROM_TO(-100, 100), "velocity to the left of the current"),
    FLOE("spin", spin, "rad/s", "0 rad/s", FROM_TO(-1000, 1000), "anticlockwise"),
};
SECTION(fw_table_scene_floe, "floes[]", "one floe", SCENE_FLOE);

const fw_table_listed fw_tables[] = {
    {"campaign", &fw_table_campaign},
    {"campaign", &fw_table_structure},
    {"campaign", &fw_table_points},
    {"campaign", &fw_table_ice},
    {"campaign", &fw_table_mix},
    {"campaign", &fw_table_floe_diameter},
    {"campaign", &fw_table_current},
    {"campaign", &fw_table_tide},
    {"campaign", &fw_table_wind},
    {"both", &fw_table_contact},
    {"both", &fw_table_water},
    {"both", &fw_table_abrasion},
    {"both", &fw_table_archard},
    {"both", &fw_table_power},
    {"both", &fw_table_crushing_limit},
    {"campaign", &fw_table_uncertainty},
    {"campaign", &fw_table_exposure},
    {"campaign", &fw_table_field},
    {"both", &fw_table_ring},
    {"campaign", &fw_table_numerics},
    {"campaign", &fw_table_sampling},
    {"campaign", &fw_table_precision},
    {"campaign", &fw_table_service},
    {"scene", &fw_table_scene},
    {"scene", &fw_table_scene_structure},
    {"scene", &fw_table_scene_ice},
    {"scene", &fw_table_scene_current},
    {"scene", &fw_table_scene_tide},
    {"scene", &fw_table_scene_wind},
    {"scene", &fw_table_scene_floe},
};
const size_t fw_n_tables = sizeof fw_tables / sizeof fw_tables[0];
