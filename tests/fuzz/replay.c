/* The fuzz targets without a fuzzer: every file of the folders given, in order of name, through the target that this is
 * linked with. A law that is broken aborts; the last name printed is the input. */
#include <dirent.h>

#include "fuzz/fuzz.h"

enum { MAX_INPUT = 1 << 22 };

static int is_input(const struct dirent *d) { return d->d_name[0] != '.'; }

static bool replay(const char *path)
{
    FILE *f = fopen(path, "rb");
    char *bytes = malloc(MAX_INPUT);
    if (f == NULL || bytes == NULL) return false;
    size_t n = fread(bytes, 1, MAX_INPUT, f);
    bool   is_whole = n < MAX_INPUT && ferror(f) == 0;
    fclose(f);
    char *copy = fuzz_copy(bytes, n);
    free(bytes);
    printf("%s\n", path);
    fflush(stdout);
    if (is_whole) LLVMFuzzerTestOneInput((const uint8_t *)copy, n);
    free(copy);
    return is_whole;
}

static bool replay_folder(const char *folder, size_t *n)
{
    struct dirent **names;
    int             n_names = scandir(folder, &names, is_input, alphasort);
    bool            is_good = n_names >= 0;
    for (int i = 0; i < n_names; i++) {
        char path[1024];
        snprintf(path, sizeof path, "%s/%s", folder, names[i]->d_name);
        is_good = is_good && replay(path);
        free(names[i]);
    }
    if (n_names >= 0) free(names);
    if (!is_good) fprintf(stderr, "%s cannot be read\n", folder);
    *n += is_good ? (size_t)n_names : 0;
    return is_good;
}

int main(int argc, char **argv)
{
    size_t n = 0;
    for (int i = 1; i < argc; i++) {
        if (!replay_folder(argv[i], &n)) return 1;
    }
    printf("%zu inputs\n", n);
    return n > 0 ? 0 : 1; /* an empty corpus tests nothing */
}
