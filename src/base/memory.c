#include "base/memory.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

fw_status fw_alloc(void *out, size_t n, size_t size, const char *what, fw_msg *m)
{
    bool  fits = size == 0 || n <= PTRDIFF_MAX / size; /* calloc checks too, but a sanitizer's calloc aborts there */
    void *p = fits ? calloc(n ? n : 1, size ? size : 1) : NULL;

    memcpy(out, &p, sizeof p); /* out is a T**: a copy of the bytes breaks no aliasing rule */
    FW_CHECK(p, m, FW_E_NOMEM, "out of memory: %s, %zu times %zu bytes", what, n, size);
    return FW_OK;
}

fw_status fw_grow_now(void *p, size_t *capacity, size_t wanted, size_t size, const char *what, fw_msg *m)
{
    void  *old, *new;
    size_t n = *capacity ? *capacity : 8;

    while (n < wanted) n = n > SIZE_MAX / 2 ? wanted : 2 * n;
    FW_CHECK(size == 0 || n <= PTRDIFF_MAX / size, m, FW_E_NOMEM, "out of memory: %s, %zu times %zu bytes", what, n,
             size);
    memcpy(&old, p, sizeof old);
    new = realloc(old, size ? n * size : 1);
    FW_CHECK(new, m, FW_E_NOMEM, "out of memory: %s, %zu times %zu bytes", what, n, size);
    memset((char *)new + *capacity *size, 0, (n - *capacity) * size);
    memcpy(p, &new, sizeof new);
    *capacity = n;
    return FW_OK;
}

char *fw_strdup(const char *s)
{
    size_t n = strlen(s) + 1;
    char  *copy = malloc(n);

    return copy ? memcpy(copy, s, n) : NULL;
}
