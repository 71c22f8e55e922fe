#ifndef FW_BASE_VERSION_H
#define FW_BASE_VERSION_H
const char *fw_version(void);      /* "0.1.0" */
const char *fw_git_revision(void); /* "1a2b3c4" or "unknown", fixed when built */
#endif
