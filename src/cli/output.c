#include "cli/output.h"

#include <errno.h>
#include <stdio.h>
#include <string.h>

fw_status fw_output_finish(fw_msg *m)
{
    errno = 0;
    FW_CHECK(fflush(stdout) == 0 && !ferror(stdout), m, FW_E_IO, "standard output cannot be written: %s",
             errno ? strerror(errno) : "an earlier write failed");
    return FW_OK;
}

int fw_output_end(const char *name)
{
    fw_msg    m = {""};
    fw_status s = fw_output_finish(&m);
    if (s != FW_OK) fprintf(stderr, "%s: %s\n", name, m.text);
    return fw_status_exit_code(s);
}
