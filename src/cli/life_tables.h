/* Tables of a service life in NAME.h5: /life_points, /life_fan, and where they are asked for /allowance_year and /life_map. */
#ifndef FW_CLI_LIFE_TABLES_H
#define FW_CLI_LIFE_TABLES_H

#include "cli/table_builder.h"
#include "study/service.h"

enum { FW_LIFE_TABLES = 4 };

/* Builds the tables that have rows into b (FW_LIFE_TABLES) and returns their number; a must outlive them. */
size_t fw_life_tables_build(fw_table_builder *b, const fw_service_answer *a, fw_msg *m);

#endif
