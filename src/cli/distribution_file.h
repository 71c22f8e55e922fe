/* A distribution as a file says it:
 *
 *     2 m/s                                               a constant
 *     {constant: 2 m/s}
 *     {uniform: [0.1 m/s, 2 m/s]}                         or {low, high}
 *     {normal: {mean: -5 degC, sd: 2 K}}
 *     {lognormal: {mean: 0.4 m/s, cv: 60 %}}              mean and cv of x itself; or {median, sigma of ln x}
 *     {weibull: {scale: 0.4 m/s, shape: 1.6}}
 *     {gamma: {shape: 2, scale: 0.2 m/s}}
 *     {beta: {alpha: 2, beta: 3, min: 10 %, max: 60 %}}   min and max are the ends of the law; 0 and 1 when left out
 *     {triangular: [10 %, 30 %, 60 %]}                    or {low, mode, high}
 *     {values: [20 %, 40 %], probabilities: [0.3, 0.7]}   without probabilities: equal ones
 *     {table: file.csv}                                   columns value, probability
 *     {rose: {0 deg: 1, 90 deg: 2}}                       directions only; weights are divided by their sum
 *
 * min and max cut any law, inside its map or beside its name (for beta beside it). */
#ifndef FW_CLI_DISTRIBUTION_FILE_H
#define FW_CLI_DISTRIBUTION_FILE_H

#include "cli/reader.h"
#include "floewear/distribution.h"

/* unit: "m/s", "1", "degC" (spreads are then in K) or "deg" (a direction; single values are brought to [0, 360)).
 * The law is checked in itself; its range is the caller's to check. *out owns memory only when FW_OK. */
fw_status fw_read_distribution(const fw_reader *r, const fw_node *n, const char *path, const char *unit,
                               fw_distribution *out);

/* The reference of the laws for `floewear keys`: i from 0; NULL behind the last. */
const char *fw_distribution_file_law(size_t i, const char **shape);

#endif
