/* The bytes of a journal; everything is little-endian.
 *
 *   header   0    magic "floewear journal"                     16
 *            16   format version                                4
 *            20   byte order mark 0x01020304                    4
 *            24   hash of the settings                          8
 *            32   seed                                          8
 *            40   n_arcs, n_laws                                4 + 4
 *            48   packed size of a record                       8
 *            56   name, filled up with NUL                      64
 *            120  length of the settings text                   8
 *            128  settings text                                 n
 *                 CRC32C of all bytes above                     4
 *   slot          max_realisations, CRC32C of these 8 bytes     8 + 4
 *   block    0    length of the whole block                     4
 *   (many)   4    status                                        4
 *            8    id                                            8
 *            16   packed record (fw_record_pack)                n
 *                 CRC32C of all bytes of the block above        4
 *
 * The slot lies outside the header's CRC because it is the one thing that a later call may change (a run continued to a
 * finer precision): a slot torn by a power cut costs the total in `floewear status`, not the campaign.
 * All blocks of a journal have one size, so that a damaged length cannot hide the blocks behind it. */
#ifndef FW_STORE_JOURNAL_FORMAT_H
#define FW_STORE_JOURNAL_FORMAT_H

#include "floewear/campaign.h"

enum { FW_JOURNAL_VERSION = 1, FW_JOURNAL_SLOT_SIZE = 12, FW_JOURNAL_BLOCK_HEAD = 16 };

typedef struct fw_journal_header {
    uint64_t hash, seed;
    uint64_t max_realisations; /* 0: the slot is torn */
    size_t   n_arcs, n_laws;
    char     name[64];
    char    *settings; /* owned */
    uint64_t size;     /* bytes in the file before the first block, slot included */
} fw_journal_header;

fw_status fw_journal_header_of(fw_journal_header *h, const fw_campaign *c, fw_msg *m);
void      fw_journal_header_free(fw_journal_header *h);

/* All bytes before the first block; *bytes is allocated, the caller frees; *n = h->size. */
fw_status fw_journal_header_write(const fw_journal_header *h, unsigned char **bytes, size_t *n, fw_msg *m);
/* From an open file. FW_E_FORMAT: another kind of file, another version, damaged. */
fw_status fw_journal_header_read(fw_journal_header *h, int fd, const char *path, fw_msg *m);
void      fw_journal_slot_write(unsigned char bytes[FW_JOURNAL_SLOT_SIZE], uint64_t max_realisations);

/* FW_E_MISMATCH with the differing settings, at most five, both values of each. */
fw_status fw_journal_header_match(const fw_journal_header *there, const fw_journal_header *wanted, const char *path,
                                  fw_msg *m);

size_t    fw_journal_block_size(size_t n_arcs, size_t n_laws);
void      fw_journal_block_write(unsigned char *block, const fw_record *r);
/* Is this a whole, undamaged block of this size? */
bool      fw_journal_block_is_good(const unsigned char *block, size_t block_size);
uint64_t  fw_journal_block_id(const unsigned char *block);
uint32_t  fw_journal_block_status(const unsigned char *block);
fw_status fw_journal_block_read(const unsigned char *block, size_t block_size, fw_record *r, fw_msg *m);

/* Everything that campaign and id decide has the same bits (NaN equals itself here); what has host, cpu or wall in its
 * name may differ. Both have the same sizes. */
bool fw_journal_has_same_bits(const fw_record *a, const fw_record *b);

#endif
