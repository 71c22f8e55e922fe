/* Results files as orders of bytes: a good file with faults in it, written with HDF5's own functions and sealed as our
 * writer seals.
 *
 *   byte 0, 1, 2   realisations, laws, arcs
 *   4 bytes each   a fault: object, kind, and two bytes that say more (results_builder.c)
 *
 * So every file is one that HDF5 can read, and what is tested is our reader. Damaged bytes inside a sealed file would
 * test libhdf5, which is not ours: 1.10 may crash on them, and the seal is there because of it (store/h5_file.h). */
#ifndef FW_TESTS_FUZZ_RESULTS_BUILDER_H
#define FW_TESTS_FUZZ_RESULTS_BUILDER_H

#include "floewear/record.h"
#include "fuzz/fuzz.h"

#define FUZZ_CAMPAIGN "name: small\ncurrent: {speed: 2 m/s}\n"
enum { FUZZ_N_SETS = 2, FUZZ_SEED = 7 };

typedef struct fuzz_built {
    uint64_t n;
    size_t   n_laws, n_arcs;
    bool     is_good; /* no fault was ordered and the sizes are possible ones */
} fuzz_built;

/* false: HDF5 would not write it. */
bool fuzz_build_results(const char *path, const uint8_t *orders, size_t n_orders, fuzz_built *out);
/* What a good file holds. */
void fuzz_expected_record(const fuzz_built *b, uint64_t id, fw_record *r);

#endif
