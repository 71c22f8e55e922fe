/* The group /realisations, and blocks of its rows in memory: what results_write fills and results_read empties.
 *
 *   id, status, cause, every column of FW_RECORD_LIST   (n)
 *   path                                                (n x arcs)
 *   wear_load, wear_load_impact, wear_load_high         (n x laws x arcs)
 *   angle_deg                                           (arcs)   written once, not part of a block
 *
 * Rows are written and read a block at a time, so memory does not grow with the number of realisations. Scalars and rings have blocks of their own:
 * thousands of rows of 8 bytes, some hundred rows of rings.
 *
 * Rings lie in one piece and unpacked, row after row: a block of them is one write or read straight between memory and file. 400 records of 360 arcs
 * are 4.6 MB, a million 11.5 GB. Deflate would leave half of that (mantissas do not shrink, arcs without wear do) and cost a minute whenever a
 * million records are read. Who wants a small copy for other programs makes it by h5repack; floewear itself reads only what bears its seal. Scalars are chunked, shuffled and deflated, a block a chunk: each is packed and unpacked once, and most of
 * them is causes that are empty. */
#ifndef FW_STORE_RESULTS_BLOCK_H
#define FW_STORE_RESULTS_BLOCK_H

#include "floewear/record.h"
#include "store/h5_data.h"

#define FW_RESULTS_FILETYPE "floewear results"
enum { FW_RESULTS_VERSION = 7 }; /* 2: awake_floes, reach; 3: watch-dogs, tries; 4: mean_diameter_wanted;
                                * 5: wind, tide_phase, wear_thickness; 6: weight, randomisation; 7: ids of a part, rings unpacked */
enum { FW_RESULTS_CAUSE = sizeof((fw_record *)0)->cause };

typedef struct fw_results_datasets {
    hid_t  id, status, cause, path, rings[FW_RINGS_PER_LAW];
    hid_t *columns; /* (fw_n_record_columns), owned */
} fw_results_datasets;

typedef struct fw_results_scalars {
    size_t    capacity; /* rows */
    uint64_t  first;    /* row of the datasets that is row 0 here */
    size_t    n;        /* rows in use */
    uint64_t *id;       /* (capacity) */
    int32_t  *status;   /* (capacity) */
    char     *cause;    /* (capacity x FW_RESULTS_CAUSE) */
    double   *columns;  /* (fw_n_record_columns x capacity) */
} fw_results_scalars;

typedef struct fw_results_rings {
    size_t   n_arcs, n_laws;
    size_t   capacity;                /* rows */
    uint64_t first;                   /* row of the datasets that is row 0 here */
    size_t   n;                       /* rows in use */
    double  *path;                    /* (capacity x n_arcs) [km] */
    double  *load[FW_RINGS_PER_LAW];  /* (capacity x n_laws x n_arcs) [MPa^m km] */
} fw_results_rings;

extern const char *const fw_results_ring_names[FW_RINGS_PER_LAW]; /* datasets, in the order of FW_RING_LOAD .. */
extern const char *const fw_results_ring_long_names[FW_RINGS_PER_LAW];

enum { FW_RESULTS_SCALAR_ROWS = 8192 };
size_t fw_results_ring_rows(size_t n_arcs); /* of a block: half a MiB per dataset and law, which the processor's cache holds */

/* Room for at most as many rows as there are, n. */
fw_status fw_results_scalars_create(fw_results_scalars *b, uint64_t n, fw_msg *m);
void      fw_results_scalars_free(fw_results_scalars *b);
void      fw_results_scalars_put(fw_results_scalars *b, size_t row, const fw_record *r);
/* All of r but its sizes and rings. FW_E_FORMAT: unknown status, or a cause without end. */
fw_status fw_results_scalars_get(const fw_results_scalars *b, size_t row, fw_record *r, fw_msg *m);

fw_status fw_results_rings_create(fw_results_rings *b, uint64_t n, size_t n_arcs, size_t n_laws, fw_msg *m);
void      fw_results_rings_free(fw_results_rings *b);
void      fw_results_rings_put(fw_results_rings *b, size_t row, const fw_record *r);
void      fw_results_rings_get(const fw_results_rings *b, size_t row, fw_record *r);

fw_status fw_results_datasets_create(fw_results_datasets *d, fw_msg *m); /* all closed */
void      fw_results_datasets_close(fw_results_datasets *d);
/* Rows [b->first, b->first + b->n) */
fw_status fw_results_scalars_write(const fw_h5_file *f, const fw_results_datasets *d, const fw_results_scalars *b,
                                   fw_msg *m);
fw_status fw_results_scalars_read(const fw_h5_file *f, const fw_results_datasets *d, fw_results_scalars *b, fw_msg *m);
fw_status fw_results_rings_write(const fw_h5_file *f, const fw_results_datasets *d, const fw_results_rings *b, fw_msg *m);
fw_status fw_results_rings_read(const fw_h5_file *f, const fw_results_datasets *d, fw_results_rings *b, fw_msg *m);

#endif
