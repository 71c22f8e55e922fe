#include "base/version.h"

#include "revision.h" /* written by revision.cmake at every build, touched only when the revision changes */

const char *fw_version(void) { return FW_VERSION; }

const char *fw_git_revision(void) { return FW_REVISION; }
