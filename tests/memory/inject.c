#include "memory/inject.h"

#include <dirent.h>
#include <unistd.h>

#include "base/hash.h"

void *__real_malloc(size_t n);
void *__real_calloc(size_t n, size_t size);
void *__real_realloc(void *p, size_t n);
void  __real_free(void *p);
void *__wrap_malloc(size_t n);
void *__wrap_calloc(size_t n, size_t size);
void *__wrap_realloc(void *p, size_t n);
void  __wrap_free(void *p);

/* ---- the allocator ---- */

static long n_live;       /* blocks that our code has and has not given back */
static long n_asked;      /* allocations since the run began */
static long fails_at;     /* this one fails; 0: none */
static bool fails_after;  /* and all after it */
static bool is_counting;

static bool is_refused(void)
{
    if (!is_counting) return false;
    n_asked++;
    return fails_at > 0 && (n_asked == fails_at || (fails_after && n_asked > fails_at));
}

void *__wrap_malloc(size_t n)
{
    void *p = is_refused() ? NULL : __real_malloc(n);
    n_live += p != NULL;
    return p;
}

void *__wrap_calloc(size_t n, size_t size)
{
    void *p = is_refused() ? NULL : __real_calloc(n, size);
    n_live += p != NULL;
    return p;
}

void *__wrap_realloc(void *old, size_t n)
{
    void *p = is_refused() ? NULL : __real_realloc(old, n);
    n_live += p != NULL && old == NULL;
    return p;
}

void __wrap_free(void *p)
{
    n_live -= p != NULL;
    __real_free(p);
}

/* ---- the walk ---- */

#ifdef __SANITIZE_ADDRESS__ /* ten times slower and more */
enum { EVERY = 20, STEP = 4 };
#else
enum { EVERY = 64, STEP = 10 };
#endif

static int count_open_files(void)
{
    int  n = 0;
    DIR *folder = opendir("/proc/self/fd");
    if (folder == NULL) return 0;
    while (readdir(folder) != NULL) n++;
    closedir(folder);
    return n;
}

typedef struct outcome {
    fw_status status;
    uint64_t  hash;
    long      n_asked;
    fw_msg    m;
} outcome;

static outcome run_once(const inject_case *c, long n, bool and_all_after)
{
    outcome o = {.m = {.text = ""}};
    long    live = n_live;
    int     open = count_open_files();
    if (c->begin) c->begin(c->self);
    n_asked = 0, fails_at = n, fails_after = and_all_after;
    is_counting = true;
    o.status = c->run(c->self, &o.m);
    is_counting = false;
    o.n_asked = n_asked;
    o.hash = c->end(c->self, o.status);
    if (n_live != live)
        fail_msg("%s, allocation %ld%s: %ld blocks were not given back (%s)", c->name, n, and_all_after ? " on" : "",
                 n_live - live, o.m.text);
    if (count_open_files() != open) fail_msg("%s, allocation %ld: a file was left open (%s)", c->name, n, o.m.text);
    return o;
}

static void check_failure(const inject_case *c, long n, const char *which, uint64_t wanted, const outcome *o)
{
    if (c->may_go_on && o->status == FW_OK && o->hash == wanted) return;
    if (o->status != FW_E_NOMEM)
        fail_msg("%s: allocation %ld%s fails and the status is %s: \"%s\"", c->name, n, which, fw_status_name(o->status),
                 o->m.text);
    if (strstr(o->m.text, "memory") == NULL)
        fail_msg("%s: allocation %ld%s fails and the sentence is \"%s\"", c->name, n, which, o->m.text);
}

static void check_success(const inject_case *c, long n, const char *when, uint64_t wanted, const outcome *o)
{
    if (o->status != FW_OK)
        fail_msg("%s, %s allocation %ld: %s: %s", c->name, when, n, fw_status_name(o->status), o->m.text);
    if (o->hash != wanted) fail_msg("%s, %s allocation %ld: another result than undisturbed", c->name, when, n);
}

void inject_walk(const inject_case *c)
{
    long    n_failed = 0, n = 1;
    outcome first = run_once(c, 0, false);
    check_success(c, 0, "undisturbed,", first.hash, &first);
    outcome again = run_once(c, 0, false); /* libraries have made their tables by now */
    check_success(c, 0, "undisturbed again,", first.hash, &again);
    while (n <= again.n_asked) {
        outcome alone = run_once(c, n, false), on = run_once(c, n, true);
        check_failure(c, n, "", first.hash, &alone);
        check_failure(c, n, " and all after it", first.hash, &on);
        outcome next = run_once(c, 0, false);
        check_success(c, n, "after a failure of", first.hash, &next);
        n_failed += 2;
        n += c->stride > 0 ? c->stride : n < EVERY ? 1 : n / STEP;
    }
    outcome last = run_once(c, again.n_asked + 1, true);
    check_success(c, again.n_asked + 1, "with a failure beyond the last,", first.hash, &last);
    print_message("%-44s %6ld allocations, %5ld made to fail\n", c->name, again.n_asked, n_failed);
}

/* ---- helps ---- */

uint64_t inject_hash(uint64_t hash, const void *bytes, size_t n)
{
    uint64_t parts[2] = {hash, fw_fnv1a64(bytes, n)};
    return fw_fnv1a64(parts, sizeof parts);
}

uint64_t inject_hash_file(uint64_t hash, const char *path)
{
    char   bytes[4096];
    size_t n;
    FILE  *f = fopen(path, "rb");
    if (f == NULL) return inject_hash(hash, "absent", 6);
    while ((n = fread(bytes, 1, sizeof bytes, f)) > 0) hash = inject_hash(hash, bytes, n);
    fclose(f);
    return inject_hash(hash, "end", 3);
}
