/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Raising errors. Depends on nothing but the error itself. */
#include "text/error.h"

#include <errno.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

void error_clear(calc_error *error) {
    error->raised = error->stop = error->refused = error->circle = error->strange = error->worded = false;
    error->kind = ERROR_WORDS;
    error->input = -1;
    error->at = error->len = 0;
    error->text[0] = 0;
}

static bool raise_first(calc_error *error, error_kind kind) {
    if (error->raised)
        return false;
    error->raised = true;
    error->worded = false;
    error->kind = kind;
    error->input = -1;
    error->text[0] = 0;
    return true;
}

void calc_raise(calc_error *error, size_t at, size_t len, const char *format, ...) {
    if (!raise_first(error, ERROR_WORDS))
        return;
    va_list args;
    va_start(args, format);
    vsnprintf(error->text, sizeof error->text, format, args);
    va_end(args);
    error->at = at;
    error->len = len;
}

bool calc_stopped(const volatile sig_atomic_t *stop, calc_error *error) {
    return *stop && !calc_interrupted(error);
}

void calc_raise_missing(calc_error *error, int input) {
    if (raise_first(error, ERROR_MISSING))
        error->input = input;
}

void calc_raise_errno(calc_error *error, int code, const char *format, ...) {
    char words[CALC_ERROR_TEXT - 64]; /* leaves room for the system's reason */
    va_list args;
    va_start(args, format);
    vsnprintf(words, sizeof words, format, args);
    va_end(args);
    error->stop = error->stop || code == ENOMEM;
    error->refused = true;
    calc_raise(error, 0, 0, "%s: %s", words, code == ENOMEM ? "out of memory" : strerror(code));
}

bool calc_input_status(calc_error *error, int input, fret_status status) {
    if (!status.code)
        return true;
    if (status.code == FRET_INTERRUPTED || status.code == FRET_NO_MEMORY)
        error->stop = true;
    if (raise_first(error, ERROR_STATUS)) {
        error->status = status;
        error->input = input;
    }
    return false;
}

bool calc_status(calc_error *error, fret_status status) {
    return calc_input_status(error, -1, status);
}

void calc_put_place(calc_error *error, size_t at, size_t len) {
    if (error->len == 0) {
        error->at = at;
        error->len = len;
    }
}
