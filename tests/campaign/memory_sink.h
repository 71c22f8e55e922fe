/* A sink that keeps every record in memory as its packed bytes with host_cpu_s set to zero, the one column that a clock
 * puts in: what is left must be the same for any number of ranks and any order. */
#ifndef TESTS_CAMPAIGN_MEMORY_SINK_H
#define TESTS_CAMPAIGN_MEMORY_SINK_H

#include <stdio.h>

#include "floewear/campaign.h"

typedef struct fw_memory_sink {
    size_t         n_bytes; /* of one record */
    size_t         n, capacity;
    uint64_t      *ids;   /* (n) in order of arrival */
    unsigned char *bytes; /* (n x n_bytes) */
    size_t         byte_capacity;
    size_t         n_flushes;
    int64_t        break_at;  /* >= 0: append number break_at fails with FW_E_IO */
    double         longest_gap_s; /* longest time a record waited for a flush */
    double         waiting_since;             /* 0: nothing waits */
} fw_memory_sink;

void    fw_memory_sink_create(fw_memory_sink *k, const fw_campaign *c);
void    fw_memory_sink_destroy(fw_memory_sink *k);
fw_sink fw_memory_sink_of(fw_memory_sink *k);
void    fw_memory_sink_sort(fw_memory_sink *k); /* by id */
bool    fw_memory_sink_equal(const fw_memory_sink *a, const fw_memory_sink *b, size_t n); /* the first n, sorted */

#endif
