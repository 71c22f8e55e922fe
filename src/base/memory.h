/* Allocation with the out-of-memory status, and arrays that double. Nothing here is called inside the contact loop. */
#ifndef FW_BASE_MEMORY_H
#define FW_BASE_MEMORY_H

#include <stddef.h>

#include "floewear/status.h"

/* Zeroed n * size bytes (n = 0 gives a valid pointer too); FW_E_NOMEM names `what` and the bytes. *out is a T**. */
fw_status fw_alloc(void *out, size_t n, size_t size, const char *what, fw_msg *m);
/* Grow array *p (a T**) from *capacity to at least wanted elements by doubling; contents kept, new part zeroed. */
/* Inlined as far as the question: it is asked at every step and answered by yes a few times in a window. */
fw_status fw_grow_now(void *p, size_t *capacity, size_t wanted, size_t size, const char *what, fw_msg *m);
static inline fw_status fw_grow(void *p, size_t *capacity, size_t wanted, size_t size, const char *what, fw_msg *m)
{
    return wanted <= *capacity ? FW_OK : fw_grow_now(p, capacity, wanted, size, what, m);
}
char     *fw_strdup(const char *s); /* NULL when out of memory */

#endif
