/* floewear/status.h: what a function that can fail gives back, and the sentence that goes with it.
 *
 * Every function that can fail returns an fw_status and takes a caller-owned fw_msg (NULL is allowed). On failure the
 * message names what the reader has to change: file and line or floe, key, value, wanted range and unit.
 * Nothing below the command line prints or exits. */
#ifndef FLOEWEAR_STATUS_H
#define FLOEWEAR_STATUS_H

#include <stdbool.h>

/* name, exit code of the program, sentence */
#define FW_STATUS_LIST(X)                                                                                              \
    X(FW_OK, 0, "done")                                                                                                \
    X(FW_E_ARG, 2, "an argument is outside its range")                                                                 \
    X(FW_E_INPUT, 2, "the input file or the command line is wrong")                                                    \
    X(FW_E_UNSUPPORTED, 2, "this feature is not in this version")                                                      \
    X(FW_E_MISMATCH, 4, "the results on disk belong to another campaign")                                              \
    X(FW_E_IO, 4, "a file could not be read or written")                                                               \
    X(FW_E_FORMAT, 4, "a file on disk is damaged or of another kind")                                                  \
    X(FW_E_NUMERIC, 3, "a simulation broke one of its own laws")                                                       \
    X(FW_E_LIMIT, 3, "a simulation reached its limit of force evaluations")                                            \
    X(FW_E_FAILURES, 3, "too many realisations failed")                                                                \
    X(FW_E_STOPPED, 75, "stopped early in good order; run again to go on")                                             \
    X(FW_E_NOMEM, 5, "out of memory")                                                                                  \
    X(FW_E_INTERNAL, 5, "an internal promise was broken")

typedef enum fw_status {
#define X(name, exit_code, sentence) name,
    FW_STATUS_LIST(X)
#undef X
        FW_N_STATUS
} fw_status;

/* The sentence that went wrong, filled by FW_CHECK or fw_fail; empty after success. */
typedef struct fw_msg {
    char text[1024];
} fw_msg;

const char *fw_status_name(fw_status s);      /* "FW_E_IO" */
const char *fw_status_sentence(fw_status s);  /* "a file could not be read or written" */
int         fw_status_exit_code(fw_status s); /* 4 */

/* Write the message (truncated with an ellipsis when too long) and return code, so that `return fw_fail(...)` reads well. */
fw_status fw_fail(fw_msg *m, fw_status code, const char *fmt, ...) __attribute__((format(printf, 3, 4)));

/* Put a prefix ("realisation 17: ") before what m already says. */
void fw_msg_prefix(fw_msg *m, const char *fmt, ...) __attribute__((format(printf, 2, 3)));

#define FW_TRY(call)                                                                                                   \
    do {                                                                                                               \
        fw_status fw_try_ = (call);                                                                                    \
        if (fw_try_ != FW_OK) return fw_try_;                                                                          \
    } while (0)

#define FW_CHECK(cond, msg, code, ...)                                                                                 \
    do {                                                                                                               \
        if (!(cond)) return fw_fail((msg), (code), __VA_ARGS__);                                                       \
    } while (0)

#endif
