/* NAME.h5: the product made from the journal, and read back for reports; and the trajectory of a scene.
 *
 * Written as PATH.tmp, fsynced, renamed, folder fsynced: PATH is the old file or the whole new one, whatever happens.
 * Its last 32 bytes are a seal (length and CRC32C) that HDF5 ignores; a file without it or with a wrong one is not
 * read.
 * Rings are not packed: a million records of 360 arcs are 11.5 GB, read in seconds (results_block.h says why).
 *
 *   attributes of /   filetype, format_version, code_version, git_revision, name, campaign (the file's text), sets
 *                     (--set, list), settings, settings_hash, seed, host_name, host_system, host_wall_time
 *   /realisations     id, ascending: 0 .. n-1 of a whole campaign; of a part, or of merged parts, theirs   (n)
 *                     status, cause, every column of FW_RECORD_LIST   (n)
 *                     path [km]   (n x arcs);  angle_deg, middles of the arcs   (arcs)
 *                     wear_load, wear_load_impact, wear_load_high   (n x laws x arcs), attributes exponents and laws
 *   /TABLE            one group per fw_table, its columns as datasets   (n_rows)
 *
 * Every dataset has units and long_name. Two files of one campaign differ in nothing but what has host, cpu or wall in
 * its name: no object times, no order of arrival.
 * One thread; of all folders only this one knows HDF5. */
#ifndef FW_STORE_RESULTS_H
#define FW_STORE_RESULTS_H

#include "floewear/campaign.h"
#include "floewear/records.h"

/* A finished table: a group of one-dimensional datasets of equal length. One of number, integer, text is set. */
typedef struct fw_column {
    const char        *name, *unit, *long_name; /* unit NULL: "1"; long_name NULL: name */
    const double      *number;                  /* (n_rows), NAN: does not exist */
    const int64_t     *integer;                 /* (n_rows) */
    const char *const *text;                    /* (n_rows), NULL: empty */
} fw_column;
typedef struct fw_table {
    const char *name; /* "percentiles", "service_life", "ledger" */
    size_t      n_rows, n_columns;
    fw_column  *columns;
} fw_table;

/* Records are asked for once each, in order of their index, and go through memory in blocks of about 2 MiB per law.
 * Errors: FW_E_IO: unwritable, disk full (message names path and bytes), PATH.tmp in use by another run; what the
 * source says; FW_E_ARG; FW_E_INTERNAL: ids that do not ascend. On error PATH is as it was and PATH.tmp is gone. */
fw_status fw_results_write(const char *path, const fw_campaign *c, const fw_record_source *records, size_t n_tables,
                           const fw_table *tables, fw_msg *m);

typedef struct fw_results fw_results;
/* FW_E_IO: cannot be read. FW_E_FORMAT: no results file of ours, damaged (checked by its seal before HDF5 sees a byte
 * of it), datasets missing, of other shapes or types, or with values in other files. FW_E_MISMATCH: whole, but of another version. On error *out is NULL. */
fw_status   fw_results_open(fw_results **out, const char *path, fw_msg *m);
void        fw_results_close(fw_results *r);                                /* NULL is fine */
const char *fw_results_campaign_text(const fw_results *r);                  /* as the file was read; sets not applied */
size_t      fw_results_sets(const fw_results *r, const char *const **sets); /* borrowed, for fw_config_campaign_text */
int64_t     fw_results_seed(const fw_results *r);
/* Its tables, for fw_tables_numbers and the like; valid until r is closed. */
const struct fw_tables *fw_results_tables(const fw_results *r);
fw_status   fw_results_ids(const fw_results *r, uint64_t *ids, fw_msg *m); /* all of them, ascending; before rows are lent */
const char *fw_results_settings(const fw_results *r); /* that name the campaign, as fw_campaign has them */
/* Reading in order of id is fast, any other order is possible. Records of other sizes than the file's: FW_E_FORMAT. */
fw_record_source fw_results_records(fw_results *r); /* valid until r is closed */

/* Trajectory of a scene (HDF5): /time (frames), /x /y /vx /vy /spin (frames x floes), /diameter /thickness (floes);
 * root attributes filetype "floewear trajectory", structure_radius_m, current_speed_m_s, temperature_degC, duration_s.
 * Published by close, like results: sealed, renamed from PATH.tmp. Frames go through memory in blocks of some 100
 * kB. Of what is there already only a trajectory is replaced: else FW_E_MISMATCH, or FW_E_IO for a device or folder. */
typedef struct fw_trajectory fw_trajectory;
fw_status     fw_trajectory_create(fw_trajectory **out, const char *path, const fw_scene *s, fw_msg *m);
fw_frame_sink fw_trajectory_sink(fw_trajectory *t, double interval); /* [s]; FW_E_ARG: another number of floes */
fw_status     fw_trajectory_close(fw_trajectory *t, fw_msg *m);      /* NULL is fine; frees even on error */
void          fw_trajectory_abandon(fw_trajectory *t);               /* give up what was written; NULL is fine */

#endif
