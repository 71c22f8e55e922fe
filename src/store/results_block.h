/* The group /realisations, and a block of its rows in memory: what results_write fills and results_read empties.
 *
 *   id, status, cause, every column of FW_RECORD_LIST   (n)
 *   path                                                (n x arcs)
 *   wear_load, wear_load_impact, wear_load_high         (n x laws x arcs)
 *   angle_deg                                           (arcs)   written once, not part of a block
 *
 * Rows are written and read a block at a time, and a block is a chunk of the rings: each chunk is packed and unpacked
 * once, and memory does not grow with the number of realisations. */
#ifndef FW_STORE_RESULTS_BLOCK_H
#define FW_STORE_RESULTS_BLOCK_H

#include "floewear/record.h"
#include "store/h5_data.h"

#define FW_RESULTS_FILETYPE "floewear results"
enum { FW_RESULTS_VERSION = 6 }; /* 2: awake_floes, reach; 3: watch-dogs, tries; 4: mean_diameter_wanted;
                                * 5: wind, tide_phase, wear_thickness; 6: weight, randomisation */
enum { FW_RESULTS_CAUSE = sizeof((fw_record *)0)->cause };

typedef struct fw_results_datasets {
    hid_t  id, status, cause, path, rings[FW_RINGS_PER_LAW];
    hid_t *columns; /* (fw_n_record_columns), owned */
} fw_results_datasets;

typedef struct fw_results_block {
    size_t    n_arcs, n_laws;
    size_t    capacity;                /* rows */
    uint64_t  first;                   /* id of row 0 */
    size_t    n;                       /* rows in use */
    uint64_t *id;                      /* (capacity) */
    int32_t  *status;                  /* (capacity) */
    char     *cause;                   /* (capacity x FW_RESULTS_CAUSE) */
    double   *columns;                 /* (fw_n_record_columns x capacity) */
    double   *path;                    /* (capacity x n_arcs) [km] */
    double   *rings[FW_RINGS_PER_LAW]; /* (capacity x n_laws x n_arcs) [MPa^m km] */
} fw_results_block;

extern const char *const fw_results_ring_names[FW_RINGS_PER_LAW]; /* datasets, in the order of FW_RING_LOAD .. */
extern const char *const fw_results_ring_long_names[FW_RINGS_PER_LAW];

size_t    fw_results_block_rows(size_t n_arcs); /* a ring chunk stays below half a MiB, so that HDF5's cache holds it */
fw_status fw_results_block_create(fw_results_block *b, size_t capacity, size_t n_arcs, size_t n_laws, fw_msg *m);
void      fw_results_block_free(fw_results_block *b);
void      fw_results_block_put(fw_results_block *b, size_t row, const fw_record *r);
/* FW_E_FORMAT: unknown status, or a cause without end. */
fw_status fw_results_block_get(const fw_results_block *b, size_t row, fw_record *r, fw_msg *m);

fw_status fw_results_datasets_create(fw_results_datasets *d, fw_msg *m); /* all closed */
void      fw_results_datasets_close(fw_results_datasets *d);
/* Rows [b->first, b->first + b->n) */
fw_status fw_results_block_write(const fw_h5_file *f, const fw_results_datasets *d, const fw_results_block *b,
                                 fw_msg *m);
fw_status fw_results_block_read(const fw_h5_file *f, const fw_results_datasets *d, fw_results_block *b, fw_msg *m);

#endif
