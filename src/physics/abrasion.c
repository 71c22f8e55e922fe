#include "physics/abrasion.h"

#include <math.h>
#include <string.h>

static const fw_abrasion_entry ENTRIES[] = {
    {{"bekker2011", 0.116, 1.121, true},
     "rate = 0.116 (|T| / sigma)^-1.121 mm/km, T in degC, sigma in MPa",
     "Bekker (2011), as eq. (1) of the source paper",
     "T from -20 to the floor of 1.8 K below zero, sigma up to 5 MPa",
     "colder ice wears less here, opposite to some laboratory trends"},
    {{"archard", 0.01, 1.0, false},
     "rate = coefficient sigma mm/km, sigma in MPa",
     "Archard (1953): volume worn is proportional to load times path",
     "the coefficient belongs to one concrete and one ice: give your own",
     "no temperature"},
};

size_t fw_abrasion_list(const fw_abrasion_entry **entries)
{
    *entries = ENTRIES;
    return sizeof ENTRIES / sizeof ENTRIES[0];
}

const fw_abrasion_law *fw_abrasion_find(const char *name)
{
    for (size_t i = 0; i < sizeof ENTRIES / sizeof ENTRIES[0]; i++)
        if (strcmp(ENTRIES[i].law.name, name) == 0) return &ENTRIES[i].law;
    return NULL;
}

double fw_abrasion_rate(const fw_abrasion_law *law, double temperature)
{
    return law->uses_temperature ? law->coefficient * pow(fabs(temperature), -law->exponent) : law->coefficient;
}
