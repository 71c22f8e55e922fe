/* CRC32C (Castagnoli) for journal records and seals of files, FNV-1a 64 for names of campaigns. */
#ifndef FW_BASE_HASH_H
#define FW_BASE_HASH_H

#include <stddef.h>
#include <stdint.h>

uint32_t fw_crc32c(uint32_t crc, const void *bytes, size_t n); /* start with 0; check: "123456789" -> 0xe3069283 */
/* The same without the processor's own instruction, which fw_crc32c takes where there is one (ten times as fast). */
uint32_t fw_crc32c_by_table(uint32_t crc, const void *bytes, size_t n);
/* check: "" -> 0xcbf29ce484222325, "a" -> 0xaf63dc4c8601ec8c */
uint64_t fw_fnv1a64(const void *bytes, size_t n);

#endif
