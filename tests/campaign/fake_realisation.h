/* A stand-in for the simulation: same contract as fw_realise, but a record costs what the test asks for and holds
 * numbers drawn from its own stream. Linked before fw_realisation, so that the archive's fw_realise is never pulled
 * in. */
#ifndef TESTS_CAMPAIGN_FAKE_REALISATION_H
#define TESTS_CAMPAIGN_FAKE_REALISATION_H

#include "floewear/campaign.h"
#include "floewear/realisation.h"

typedef struct fw_fake {
    double  cost_s;      /* processor time of a realisation, ticks not counted [s] */
    double  cost_spread; /* 0: all cost the same; 1: uniform in 0 .. 2 cost_s, by id */
    int64_t fail_every;  /* > 0: ids divisible by it fail */
    int64_t nomem_id;    /* >= 0: this id ends with FW_E_NOMEM and no record */
    int64_t n_calls;     /* counted */
} fw_fake;

extern fw_fake fw_fake_settings;

/* Read FAKE_COST_MS, FAKE_SPREAD, FAKE_FAIL_EVERY, FAKE_NOMEM_ID, where they are set. */
void fw_fake_from_environment(void);

/* A campaign over the fake: 72 arcs, one law, speed uniform in [0.5, 1.5] m/s, concentration 20 to 60 %, two mixes with
 * probabilities 0.25 and 0.75, three points. Free with fw_campaign_free. */
fw_status fw_fake_campaign(fw_campaign *c, uint64_t seed, uint64_t max_realisations, fw_msg *m);

#endif
