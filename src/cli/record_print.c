#include "cli/record_print.h"

#include <inttypes.h>
#include <string.h>

#include "cli/json.h"

void fw_record_print_text(FILE *to, const fw_record *r)
{
    fprintf(to, "id %" PRIu64 "\nstatus %s: %s\n", r->id, fw_status_name(r->status),
           r->status == FW_OK ? fw_status_sentence(r->status) : r->cause);
    for (size_t i = 0; i < fw_n_record_columns; i++) {
        const fw_record_column *k = &fw_record_columns[i];
        double                  x;

        memcpy(&x, (const char *)r + k->offset, sizeof x);
        fprintf(to, "%-24s %-12.6g %-6s %s\n", k->name, x, strcmp(k->unit, "1") == 0 ? "" : k->unit, k->long_name);
    }
}

static void record_print_ring(fw_json *j, const char *key, const double *ring, size_t n)
{
    fw_json_key(j, key);
    fw_json_begin_array(j);
    for (size_t i = 0; i < n; i++) fw_json_number(j, ring[i]);
    fw_json_end(j);
}

void fw_record_print_json(FILE *to, const fw_campaign *c, const fw_record *r)
{
    fw_json j = fw_json_onto(to);

    fw_json_begin_object(&j);
    fw_json_put_string(&j, "campaign", c->name);
    fw_json_put_integer(&j, "seed", (int64_t)c->seed);
    fw_json_put_integer(&j, "id", (int64_t)r->id);
    fw_json_put_string(&j, "status", r->status == FW_OK ? "ok" : fw_status_name(r->status));
    fw_json_put_string(&j, "cause", r->cause);
    for (size_t i = 0; i < fw_n_record_columns; i++) {
        double x;

        memcpy(&x, (const char *)r + fw_record_columns[i].offset, sizeof x);
        fw_json_key(&j, fw_record_columns[i].name);
        fw_json_number(&j, x);
    }
    record_print_ring(&j, "path_km", fw_record_path(r), r->n_arcs);
    fw_json_key(&j, "laws");
    fw_json_begin_array(&j);
    for (size_t k = 0; k < r->n_laws; k++) {
        fw_json_begin_object(&j);
        fw_json_put_string(&j, "name", c->model.laws[k].name);
        fw_json_put_number(&j, "exponent", c->model.laws[k].exponent);
        record_print_ring(&j, "wear_load", fw_record_load(r, k, FW_RING_LOAD), r->n_arcs);
        fw_json_end(&j);
    }
    fw_json_end(&j);
    fw_json_end(&j);
}
