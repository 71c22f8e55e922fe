/* The whole program with memory that runs out: linked with src/cli/main.c. FLOEWEAR_FAILS_AT=N makes the N-th allocation of our own
 * code fail and all after it; what is linked as a shared library keeps its own memory (see inject.h). */
#include <stddef.h>
#include <stdlib.h>

void *__real_malloc(size_t n);
void *__real_calloc(size_t n, size_t size);
void *__real_realloc(void *p, size_t n);
void *__wrap_malloc(size_t n);
void *__wrap_calloc(size_t n, size_t size);
void *__wrap_realloc(void *p, size_t n);

static long n_left = -1; /* before the first failure; < 0: not asked yet */

static int is_refused(void)
{
    if (n_left < 0) {
        const char *n = getenv("FLOEWEAR_FAILS_AT");
        n_left = n ? strtol(n, NULL, 10) : 1L << 60;
    }
    if (n_left > 0) n_left--;
    return n_left == 0;
}

void *__wrap_malloc(size_t n) { return is_refused() ? NULL : __real_malloc(n); }
void *__wrap_calloc(size_t n, size_t size) { return is_refused() ? NULL : __real_calloc(n, size); }
void *__wrap_realloc(void *p, size_t n) { return is_refused() ? NULL : __real_realloc(p, n); }
