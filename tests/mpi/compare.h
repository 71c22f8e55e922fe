/* Two runs of one campaign: is everything the same but what a clock or a host puts in? */
#ifndef TESTS_MPI_COMPARE_H
#define TESTS_MPI_COMPARE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Both results files hold exactly records 0 .. n-1, with the same bits but for host_cpu_s. What differs is printed. */
bool fw_compare_results(const char *path_a, const char *path_b, uint64_t n, size_t n_arcs, size_t n_laws);
/* The same text but for the values of keys with cpu in their names. */
bool fw_compare_json(const char *path_a, const char *path_b);

#endif
