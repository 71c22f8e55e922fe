#include "cli/distribution_file.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "cli/csv.h"

enum { MAX_PARAMETERS = 4, MAX_VALUES = 20000 };

/* What a parameter is measured in. */
typedef enum role { VALUE, SPREAD, PLAIN } role;

typedef struct parameter {
    const char *name;
    role        role;
} parameter;

typedef struct law {
    const char          *name;
    fw_distribution_kind kind;
    bool                 is_list;  /* may be a list of its parameters in order */
    size_t               n_needed; /* the first ones must be there; lognormal says more below */
    size_t               n;
    parameter            parameters[MAX_PARAMETERS];
    const char          *shape;
} law;

enum { BETA_MIN = 2, BETA_MAX = 3 };

static const law LAWS[] = {
    {"uniform", FW_DIST_UNIFORM, true, 2, 2, {{"low", VALUE}, {"high", VALUE}}, "[low, high]"},
    {"normal", FW_DIST_NORMAL, false, 2, 2, {{"mean", VALUE}, {"sd", SPREAD}}, "{mean, sd}"},
    {"lognormal",
     FW_DIST_LOGNORMAL,
     false,
     0,
     4,
     {{"mean", VALUE}, {"cv", PLAIN}, {"median", VALUE}, {"sigma", PLAIN}},
     "{mean, cv} of the value itself, or {median, sigma} with sigma of its logarithm"},
    {"weibull",
     FW_DIST_WEIBULL,
     false,
     2,
     3,
     {{"scale", SPREAD}, {"shape", PLAIN}, {"location", VALUE}},
     "{scale, shape}, with {location} three parameters: no value below it, 0 when left out"},
    {"gamma", FW_DIST_GAMMA, false, 2, 2, {{"shape", PLAIN}, {"scale", SPREAD}}, "{shape, scale}"},
    {"beta",
     FW_DIST_BETA,
     false,
     2,
     4,
     {{"alpha", PLAIN}, {"beta", PLAIN}, {"min", VALUE}, {"max", VALUE}},
     "{alpha, beta, min, max}: from min to max, 0 to 1 when left out"},
    {"triangular",
     FW_DIST_TRIANGULAR,
     true,
     3,
     3,
     {{"low", VALUE}, {"mode", VALUE}, {"high", VALUE}},
     "[low, mode, high]"},
};
enum { N_LAWS = sizeof LAWS / sizeof LAWS[0] };

static const char *const WORDS[][2] = {
    {"constant", "one value; a plain value says the same"},
    {"values", "[values], with probabilities: [...] beside it, equal ones without"},
    {"table", "file name of a CSV table with columns value, probability"},
    {"rose", "{bearing: weight, ...}, for a direction"},
    {"min", "beside any law or inside its map: cuts the law below"},
    {"max", "beside any law or inside its map: cuts the law above"},
};
enum { N_WORDS = sizeof WORDS / sizeof WORDS[0] };

const char *fw_distribution_file_law(size_t i, const char **shape)
{
    if (i < N_LAWS) {
        *shape = LAWS[i].shape;
        return LAWS[i].name;
    }
    i -= N_LAWS;
    if (i >= N_WORDS) return NULL;
    *shape = WORDS[i][1];
    return WORDS[i][0];
}

static const law *find_law(const char *name)
{
    for (size_t i = 0; i < N_LAWS; i++) {
        if (strcmp(LAWS[i].name, name) == 0) return &LAWS[i];
    }
    return NULL;
}

/* ---- one law's own parameters ----------------------------------------------------------------------------------- */

typedef struct asked {
    const fw_reader *r;
    const char      *path, *unit;
} asked;

static const char *unit_of(const asked *a, role of)
{
    if (of == PLAIN) return "1";
    return of == SPREAD && strcmp(a->unit, "degC") == 0 ? "K" : a->unit;
}

static fw_status read_value(const asked *a, const fw_node *n, const char *key, role of, double *x)
{
    char path[200];

    fw_read_path(path, sizeof path, a->path, key);
    return fw_read_quantity(a->r, n, path, unit_of(a, of), x);
}

static fw_status read_list(const asked *a, const law *l, const fw_node *n, double x[MAX_PARAMETERS])
{
    if (n->n != l->n) {
        return fw_yaml_fail(n, a->r->m, "%s.%s: %zu values, wanted %zu: %s", a->path, l->name, n->n, l->n, l->shape);
    }
    for (size_t i = 0; i < l->n; i++) FW_TRY(read_value(a, n->values[i], l->name, l->parameters[i].role, &x[i]));
    return FW_OK;
}

static fw_status read_map(const asked *a, const law *l, const fw_node *n, double x[MAX_PARAMETERS],
                          fw_distribution *out)
{
    const char *names[MAX_PARAMETERS + 2] = {NULL};

    for (size_t k = 0; k < l->n; k++) names[k] = l->parameters[k].name;
    names[l->n] = "min";
    names[l->n + 1] = "max";
    for (size_t i = 0; i < n->n; i++) {
        const char *key = n->keys[i]->text;
        size_t      k = 0;
        while (k < l->n + 2 && strcmp(names[k], key) != 0) k++;
        if (k < l->n) {
            FW_TRY(read_value(a, n->values[i], key, l->parameters[k].role, &x[k]));
        } else if (k < l->n + 2) {
            FW_TRY(read_value(a, n->values[i], key, VALUE, k == l->n ? &out->low : &out->high));
        } else {
            const char *nearest = fw_keys_nearest_word(l->n + 2, names, key);
            return fw_yaml_fail(n->keys[i], a->r->m, "%s.%s: unknown key \"%.60s\", %s%s%s", a->path, l->name, key,
                                nearest ? "did you mean \"" : "wanted ", nearest ? nearest : l->shape,
                                nearest ? "\"?" : "");
        }
    }
    return FW_OK;
}

/* Parameters in file order to those of fw_distribution. */
static fw_status set_parameters(const asked *a, const law *l, const fw_node *at, double x[MAX_PARAMETERS],
                                fw_distribution *out)
{
    bool is_mean = !isnan(x[0]) && !isnan(x[1]) && isnan(x[2]) && isnan(x[3]);
    bool is_median = isnan(x[0]) && isnan(x[1]) && !isnan(x[2]) && !isnan(x[3]);

    for (size_t k = 0; k < l->n_needed; k++) {
        if (isnan(x[k])) {
            return fw_yaml_fail(at, a->r->m, "%s.%s: %s is missing, wanted %s", a->path, l->name, l->parameters[k].name,
                                l->shape);
        }
    }
    switch (l->kind) {
    case FW_DIST_LOGNORMAL:
        if (!is_mean && !is_median) return fw_yaml_fail(at, a->r->m, "%s.lognormal: wanted %s", a->path, l->shape);
        if (!((is_mean ? x[0] : x[2]) > 0)) {
            return fw_yaml_fail(at, a->r->m, "%s.lognormal: the %s has to be more than 0", a->path,
                                is_mean ? "mean" : "median");
        }
        /* mean = exp(mu + s^2/2), 1 + cv^2 = exp(s^2) */
        out->b = is_mean ? sqrt(log1p(x[1] * x[1])) : x[3];
        out->a = is_mean ? log(x[0]) - 0.5 * out->b * out->b : log(x[2]);
        if (is_mean && !(x[1] > 0)) out->b = x[1]; /* refused by the check, which names it */
        return FW_OK;
    case FW_DIST_BETA:
        out->a = x[0];
        out->b = x[1];
        out->c = isnan(x[BETA_MIN]) ? 0 : x[BETA_MIN];
        out->d = isnan(x[BETA_MAX]) ? 1 : x[BETA_MAX];
        return FW_OK;
    case FW_DIST_WEIBULL:
        out->a = x[0];
        out->b = x[1];
        out->c = isnan(x[2]) ? 0 : x[2];
        return FW_OK;
    default:
        out->a = x[0];
        out->b = l->n > 1 ? x[1] : 0;
        out->c = l->n > 2 ? x[2] : 0;
        return FW_OK;
    }
}

static fw_status read_law(const asked *a, const law *l, const fw_node *n, fw_distribution *out)
{
    double x[MAX_PARAMETERS] = {NAN, NAN, NAN, NAN};

    out->kind = l->kind;
    if (n->kind == FW_NODE_MAP) {
        FW_TRY(read_map(a, l, n, x, out));
    } else if (n->kind == FW_NODE_LIST && l->is_list) {
        FW_TRY(read_list(a, l, n, x));
    } else {
        return fw_yaml_fail(n, a->r->m, "%s.%s: wanted %s", a->path, l->name, l->shape);
    }
    return set_parameters(a, l, n, x, out);
}

/* ---- given values ----------------------------------------------------------------------------------------------- */

static double turned(double degrees)
{
    double x = fmod(degrees, 360);

    x = x < 0 ? x + 360 : x;
    return x >= 360 ? 0 : x; /* -1e-20 + 360 rounds to 360 */
}

/* Both arrays (n); is_weights: divide by the sum instead of asking for 1. */
static fw_status set_values(const asked *a, const fw_node *at, size_t n, double *values, double *weights,
                            bool is_weights, fw_distribution *out)
{
    double sum = 0, low = out->low, high = out->high;

    for (size_t i = 0; i < n; i++) {
        if (!(weights[i] >= 0)) return fw_yaml_fail(at, a->r->m, "%s: the weight %g is negative", a->path, weights[i]);
        sum += weights[i];
        if (strcmp(a->unit, "deg") == 0) values[i] = turned(values[i]);
    }
    if (is_weights && !(sum > 0 && sum < INFINITY))
        return fw_yaml_fail(at, a->r->m, "%s: the weights sum to %g", a->path, sum);
    if (!is_weights && !(fabs(sum - 1) <= 1e-6)) {
        return fw_yaml_fail(at, a->r->m, "%s: the probabilities sum to %.9g, wanted 1", a->path, sum);
    }
    for (size_t i = 0; is_weights && i < n; i++) weights[i] /= sum;
    fw_status status = fw_distribution_values(out, n, values, weights, a->r->m);
    out->low = low;
    out->high = high;
    return status == FW_OK ? FW_OK : fw_yaml_blame(at, a->path, status, a->r->m);
}

/* values: list; probabilities: list or NULL. Arrays are freed by the caller. */
static fw_status fill_values(const asked *a, const fw_node *list, const fw_node *probabilities, double *values,
                             double *weights)
{
    for (size_t i = 0; i < list->n; i++) {
        FW_TRY(read_value(a, list->values[i], "values", VALUE, &values[i]));
        weights[i] = 1;
        if (probabilities) FW_TRY(read_value(a, probabilities->values[i], "probabilities", PLAIN, &weights[i]));
    }
    return FW_OK;
}

static fw_status read_values(const asked *a, const fw_node *list, const fw_node *probabilities, fw_distribution *out)
{
    double *values = NULL, *weights = NULL;

    if (list->kind != FW_NODE_LIST || list->n == 0) {
        return fw_yaml_fail(list, a->r->m, "%s.values: wanted a list of at least one value", a->path);
    }
    if (list->n > MAX_VALUES) return fw_yaml_fail(list, a->r->m, "%s.values: more than %d values", a->path, MAX_VALUES);
    if (probabilities && (probabilities->kind != FW_NODE_LIST || probabilities->n != list->n)) {
        return fw_yaml_fail(probabilities, a->r->m,
                            "%s.probabilities: wanted a list of %zu, as many as there are values", a->path, list->n);
    }
    fw_status status = fw_alloc(&values, list->n, sizeof *values, "values", a->r->m);
    if (status == FW_OK) status = fw_alloc(&weights, list->n, sizeof *weights, "weights", a->r->m);
    if (status == FW_OK) status = fill_values(a, list, probabilities, values, weights);
    if (status == FW_OK) status = set_values(a, list, list->n, values, weights, !probabilities, out);
    free(values);
    free(weights);
    return status;
}

static fw_status read_rose(const asked *a, const fw_node *map, fw_distribution *out)
{
    double values[FW_YAML_MAX_KEYS], weights[FW_YAML_MAX_KEYS];

    if (strcmp(a->unit, "deg") != 0) return fw_yaml_fail(map, a->r->m, "%s.rose: a rose is for directions", a->path);
    if (map->kind != FW_NODE_MAP || map->n == 0) {
        return fw_yaml_fail(map, a->r->m, "%s.rose: wanted a map like {0 deg: 1, 90 deg: 2}", a->path);
    }
    for (size_t i = 0; i < map->n; i++) {
        FW_TRY(read_value(a, map->keys[i], "rose", VALUE, &values[i]));
        FW_TRY(read_value(a, map->values[i], "rose", PLAIN, &weights[i]));
    }
    return set_values(a, map, map->n, values, weights, true, out);
}

static fw_status read_table(const asked *a, const fw_node *n, fw_distribution *out)
{
    const fw_csv_column columns[2] = {{"value", a->unit, false}, {"probability", "1", false}};
    const char         *file = NULL;
    double             *values = NULL, *weights = NULL;
    fw_csv              t;
    char                path[200];

    fw_read_path(path, sizeof path, a->path, "table");
    FW_TRY(fw_read_text(a->r, n, path, &file));
    FW_TRY(fw_csv_read(a->r, n, path, file, 2, columns, &t));
    fw_status status = fw_alloc(&values, t.n_rows, sizeof *values, "values", a->r->m);
    if (status == FW_OK) status = fw_alloc(&weights, t.n_rows, sizeof *weights, "weights", a->r->m);
    for (size_t i = 0; status == FW_OK && i < t.n_rows; i++) {
        values[i] = t.cells[2 * i];
        weights[i] = t.cells[2 * i + 1];
    }
    if (status == FW_OK) status = set_values(a, n, t.n_rows, values, weights, false, out);
    free(values);
    free(weights);
    fw_csv_free(&t);
    return status;
}

/* ---- the whole -------------------------------------------------------------------------------------------------- */

static fw_status refuse_word(const asked *a, const fw_node *key)
{
    const char *names[N_LAWS + N_WORDS + 1], *shape;
    size_t      n = 0;

    while (n < N_LAWS + N_WORDS && (names[n] = fw_distribution_file_law(n, &shape))) n++;
    names[n++] = "probabilities";
    const char *nearest = fw_keys_nearest_word(n, names, key->text);
    return fw_yaml_fail(key, a->r->m, "%s: unknown distribution \"%.60s\", %s%s%s", a->path, key->text,
                        nearest ? "did you mean \""
                                : "wanted constant, uniform, normal, lognormal, weibull, gamma, beta, "
                                  "triangular, values, table",
                        nearest ? nearest : "", nearest ? "\"?" : "");
}

static fw_status read_choice(const asked *a, const fw_node *map, fw_distribution *out)
{
    const fw_node *named = NULL, *node = NULL, *probabilities = NULL;
    const law     *l = NULL;

    for (size_t i = 0; i < map->n; i++) {
        const fw_node *key = map->keys[i];
        const char    *word = key->text;
        bool is_other = strcmp(word, "constant") == 0 || strcmp(word, "values") == 0 || strcmp(word, "table") == 0 ||
                        strcmp(word, "rose") == 0;
        if (strcmp(word, "probabilities") == 0) {
            probabilities = map->values[i];
        } else if (strcmp(word, "min") == 0) {
            FW_TRY(read_value(a, map->values[i], word, VALUE, &out->low));
        } else if (strcmp(word, "max") == 0) {
            FW_TRY(read_value(a, map->values[i], word, VALUE, &out->high));
        } else if (is_other || find_law(word)) {
            if (named) return fw_yaml_fail(key, a->r->m, "%s: both %s and %s, wanted one", a->path, named->text, word);
            named = key;
            node = map->values[i];
            l = find_law(word);
        } else {
            return refuse_word(a, key);
        }
    }
    if (!named) {
        return fw_yaml_fail(map, a->r->m, "%s: wanted a value or a distribution, like {uniform: [low, high]}", a->path);
    }
    if (probabilities && strcmp(named->text, "values") != 0) {
        return fw_yaml_fail(probabilities, a->r->m, "%s.probabilities: wanted beside values only", a->path);
    }
    if (l) return read_law(a, l, node, out);
    if (strcmp(named->text, "values") == 0) return read_values(a, node, probabilities, out);
    if (strcmp(named->text, "table") == 0) return read_table(a, node, out);
    if (strcmp(named->text, "rose") == 0) return read_rose(a, node, out);
    return read_value(a, node, "constant", VALUE, &out->a);
}

fw_status fw_read_distribution(const fw_reader *r, const fw_node *n, const char *path, const char *unit,
                               fw_distribution *out)
{
    const asked a = {r, path, unit};
    fw_status   status;

    fw_distribution_constant(out, 0);
    if (n->kind == FW_NODE_LIST)
        return fw_yaml_fail(n, r->m, "%s: wanted {values: [...]} or one value, not a list", path);
    status = n->kind == FW_NODE_MAP ? read_choice(&a, n, out) : fw_read_quantity(r, n, path, unit, &out->a);
    if (status == FW_OK) {
        status = fw_distribution_check(out, r->m);
        if (status != FW_OK) {
            fw_yaml_blame(n, path, status, r->m);
            status = FW_E_INPUT;
        }
    }
    if (status == FW_OK && out->kind == FW_DIST_CONSTANT && strcmp(unit, "deg") == 0) out->a = turned(out->a);
    if (status != FW_OK) fw_distribution_free(out);
    return status;
}
