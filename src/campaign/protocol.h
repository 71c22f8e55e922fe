/* What ranks say to each other. All traffic is between rank 0 (the master) and one worker; a message's meaning is
 * its tag.
 *
 *   master                                   worker
 *     | ---- BEGIN {hash, is_work} ----------> |     is_work false: leave, nothing to do
 *     | <--- READY {hash, status, text} ------ |     the worker's own reading of the campaign
 *     | ---- LEASE id, LEASE id -------------> |     one to compute and at least one in hand
 *     | <--- RECORD packed bytes ------------- |     each is answered with the next lease, if there is one
 *     | <--- ERROR {hash, status, text} ------ |     no record can be made; the master ends the campaign
 *     | ---- STOP ---------------------------> |     finish sending, drop the rest
 *     | <--- LEFT ---------------------------- |
 *     | ---- BYE ----------------------------> |     in fw_ranks_stop: only now MPI_Finalize, which busy-waits
 *
 * Open MPI busy-polls in every blocking call, which steals a core from whoever shares it, so whoever waits probes and
 * naps (fw_nap), and nobody blocks on a message that has not arrived. */
#ifndef FW_CAMPAIGN_PROTOCOL_H
#define FW_CAMPAIGN_PROTOCOL_H

#include <stdbool.h>
#include <stdint.h>

#include "floewear/status.h"

enum fw_tag {
    FW_TAG_BEGIN = 1,
    FW_TAG_READY,
    FW_TAG_LEASE,
    FW_TAG_RECORD,
    FW_TAG_ERROR,
    FW_TAG_STOP,
    FW_TAG_LEFT,
    FW_TAG_BYE
};

typedef struct fw_begin {
    uint64_t hash;
    uint64_t is_work;
} fw_begin;

typedef struct fw_word { /* READY and ERROR */
    uint64_t hash;
    int32_t  status; /* fw_status */
    char     host[64];
    char     text[1024];
} fw_word;

void fw_word_fill(fw_word *w, uint64_t hash, fw_status status, const char *text);

bool fw_protocol_is_on(void);  /* MPI is initialised and not finalised; else this process is the only rank */
int  fw_protocol_rank(void);   /* 0 without MPI */
int  fw_protocol_ranks(void);  /* 1 without MPI */
void fw_protocol_begin(uint64_t hash, bool is_work); /* rank 0: BEGIN to every worker */

/* Waits that get longer while nothing happens: 0.1 ms up to 1 ms. A signal cuts one short. */
typedef struct fw_nap {
    long nanoseconds; /* start with 0; set to 0 when something happened */
} fw_nap;
void fw_nap_take(fw_nap *n);

#endif
