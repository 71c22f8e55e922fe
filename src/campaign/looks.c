#include "campaign/looks.h"

uint64_t fw_looks_first(uint64_t max)
{
    return max < 100 ? max : 100;
}

uint64_t fw_looks_next(uint64_t look, uint64_t max)
{
    uint64_t half = look / 2 + look % 2;

    return look >= max || half >= max - look ? max : look + half;
}
