/* The unit database is read from XML at every fw_units_open, once a program; with sanitizers that takes a tenth of a
 * second, and a fuzzer would do nothing else. Linked with --wrap, so that the readers' own code is what it always is:
 * they only look units up, so one database serves all inputs. */
#include <stddef.h>
#include <stdlib.h>
#include <udunits2.h>

/* The names are the linker's. */
ut_system *__real_ut_read_xml(const char *path);
ut_system *__wrap_ut_read_xml(const char *path);
void       __real_ut_free_system(ut_system *system);
void       __wrap_ut_free_system(ut_system *system);

static ut_system *only;

static void free_only(void) { __real_ut_free_system(only); }

ut_system *__wrap_ut_read_xml(const char *path)
{
    if (only == NULL && (only = __real_ut_read_xml(path)) != NULL) atexit(free_only);
    return only;
}

void __wrap_ut_free_system(ut_system *system) { (void)system; }
