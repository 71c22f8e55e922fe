#include "cli/run_answer.h"

#include <stdio.h>

#include "cli/output.h"
#include "cli/report_table.h"

fw_status fw_run_answer(fw_run_files *files, uint64_t n, const fw_measured *measured, const fw_effects_ledger *effects, bool is_json, fw_msg *m)
{
    const fw_campaign *c       = files->campaign;
    fw_answer_source   source  = fw_run_files_answer(files, n);
    fw_answer_options  options = {.confidence = c->precision.confidence, .measured = measured, .effects = effects};
    fw_answer          answer;
    fw_status          status;

    FW_TRY(fw_answer_make(&answer, c, &source, &options, m));
    status = fw_report_write(files->results_path, c, &source.records, &answer, m);
    if (status == FW_OK) {
        if (is_json) {
            fw_report_print_json(stdout, c, &answer);
        } else {
            fw_report_print_table(stdout, c, &answer);
        }
        status = fw_output_finish(m);
    }
    fw_answer_free(&answer);
    return status;
}
