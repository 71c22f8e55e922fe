/* Memory that runs out at every place it can: an operation is run again and again, and in run n its n-th allocation
 * fails, until none does.
 *
 * Every run that fails must say FW_E_NOMEM and a sentence, give back all memory and all open files, and leave nothing
 * half done (the case's own `end` looks at files); the next run, with memory, must give the same result as the first.
 * Each n is tried twice: that one allocation fails, and that one with all after it, so that tidying up needs no memory.
 *
 * The linker puts these functions in the place of malloc, calloc, realloc and free (--wrap), in the test program alone:
 * the product has no hook. What is linked as a shared library keeps its own: allocations inside HDF5, libyaml, UDUNITS,
 * GSL, MPI and the C library (fopen, opendir, qsort) are neither counted nor failed. */
#ifndef FW_TESTS_MEMORY_INJECT_H
#define FW_TESTS_MEMORY_INJECT_H

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "floewear/status.h"

typedef struct inject_case {
    const char *name;
    void      (*begin)(void *self);            /* before a run, allocations not counted; may be NULL */
    fw_status (*run)(void *self, fw_msg *m);   /* the operation */
    /* After a run, not counted: what there is to look at after a failure; after success the hash of the result. Frees
     * what begin and run made. */
    uint64_t  (*end)(void *self, fw_status status);
    void       *self;
    long        stride;    /* from one n to the next; 0: every n up to 64 (sanitizers: 20), then steps of a tenth (a quarter) */
    bool        may_go_on; /* some allocations only save work: FW_OK without them, if the result is the same */
} inject_case;

/* Asserts all of the above and prints how many allocations the operation has and how many were made to fail. */
void inject_walk(const inject_case *c);

/* Results as one number: begin with 0. */
uint64_t inject_hash(uint64_t hash, const void *bytes, size_t n);
uint64_t inject_hash_file(uint64_t hash, const char *path); /* its bytes; an absent file counts as such */

#endif
