/* A failed realisation as a scene file: its floes shortly before, where the failure happens without what went before. */
#ifndef FW_CLI_FAILED_SCENE_H
#define FW_CLI_FAILED_SCENE_H

#include <stdbool.h>

#include "floewear/campaign.h"

/* r: the failed record. Writes PATH when `floewear scene PATH` fails by one of the kernel's laws as well; *is_written says so. */
fw_status fw_failed_scene_write(const fw_campaign *c, const fw_record *r, const char *path, bool *is_written, fw_msg *m);

#endif
