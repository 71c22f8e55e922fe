#include "base/hash.h"

/* Bit by bit over the reflected Castagnoli polynomial (iSCSI, RFC 3720), a nibble at a time from a table of 16:
 * records are a few ten kB and come at most some hundred a second, so no wider table is worth its cache. */
uint32_t fw_crc32c(uint32_t crc, const void *bytes, size_t n)
{
    static const uint32_t nibble[16] = {0x00000000, 0x105ec76f, 0x20bd8ede, 0x30e349b1, 0x417b1dbc, 0x5125dad3,
                                        0x61c69362, 0x7198540d, 0x82f63b78, 0x92a8fc17, 0xa24bb5a6, 0xb21572c9,
                                        0xc38d26c4, 0xd3d3e1ab, 0xe330a81a, 0xf36e6f75};
    const unsigned char  *p = bytes;

    crc = ~crc;
    for (size_t i = 0; i < n; i++) {
        crc ^= p[i];
        crc = (crc >> 4) ^ nibble[crc & 15];
        crc = (crc >> 4) ^ nibble[crc & 15];
    }
    return ~crc;
}

uint64_t fw_fnv1a64(const void *bytes, size_t n)
{
    const unsigned char *p = bytes;
    uint64_t             h = UINT64_C(0xcbf29ce484222325);

    for (size_t i = 0; i < n; i++) h = (h ^ p[i]) * UINT64_C(0x100000001b3);
    return h;
}
