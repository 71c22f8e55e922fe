/* The stability sheet: one row per scene, as Markdown for people and as JSON for programs, from one list of columns. */
#ifndef TESTS_HARD_SHEET_H
#define TESTS_HARD_SHEET_H

#include <stdio.h>

#include "validation/hard_laws.h"

typedef enum hard_state { HARD_NOT_ASKED, HARD_HELD, HARD_BROKEN } hard_state;

typedef struct hard_row {
    hard_case    c;
    hard_verdict verdict[HARD_N_LAWS];
    hard_state   state[HARD_N_LAWS];
} hard_row;

void hard_sheet_head(FILE *to);
void hard_sheet_row(FILE *to, const hard_row *r);
void hard_sheet_tail(FILE *to, size_t n, const hard_row *r); /* laws that are not held, each with its number; what the laws say */
void hard_sheet_json(FILE *to, size_t n, const hard_row *r);

#endif
