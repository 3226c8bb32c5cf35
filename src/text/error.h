/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The error that all rooms above the library report, worded by language/wording.c. Depends on fret/status.h.
 */
#ifndef TEXT_ERROR_H
#define TEXT_ERROR_H

#include <signal.h>
#include <stdbool.h>
#include <stddef.h>

#include "fret/status.h"
#include "text/words.h"

enum { CALC_ERROR_TEXT = 512 };

typedef enum error_kind {
    ERROR_WORDS,  /* `text` is the message */
    ERROR_STATUS, /* `status` holds an error of the library or of an input's range */
    ERROR_MISSING /* `input` has no value in this scene */
} error_kind;

/* An error and its place: `len` bytes of the statement from `at`; len 0: the place is not known yet. */
typedef struct calc_error {
    bool raised;
    bool stop;    /* interrupted or out of memory: do not try an alternative */
    bool refused; /* the operating system refused; the statement is not at fault */
    bool circle;  /* a live definition depends on itself */
    bool strange; /* dimensions do not match: no other value would help */
    bool worded;  /* wording.c has written `text` */
    error_kind kind;
    int input; /* the input that ERROR_MISSING, or a status that names none, is about; else -1 */
    size_t at, len;
    fret_status status;
    char text[CALC_ERROR_TEXT];
} calc_error;

/* Initial value of a calc_error. */
#define ERROR_NONE                                                                                           \
    { .input = -1 }
/* Does the same by assignment, faster: it clears only the first byte of the text. */
void error_clear(calc_error *error);
/* A fresh error in the enclosing block, for calls whose error is not reported. */
#define error_quiet() (&(calc_error)ERROR_NONE)

/* Raise an error, unless one is raised already: the first stays. */
LIKE_PRINTF(4, 5)
void calc_raise(calc_error *error, size_t at, size_t len, const char *format, ...);
void calc_raise_missing(calc_error *error, int input);
/* Raises the message followed by the system's words for the error number `code`. */
LIKE_PRINTF(3, 4)
void calc_raise_errno(calc_error *error, int code, const char *format, ...);
/* Gives the error a place unless it has one. */
void calc_put_place(calc_error *error, size_t at, size_t len);

/* The same as expressions of value false; inline, for compilers' analyses of `p || calc_no_memory(error)`. */
#if defined(__GNUC__)
static inline bool calc_refused(void) __attribute__((always_inline));
#endif
static inline bool calc_refused(void) {
    return false;
}
#define calc_fail(...) (calc_raise(__VA_ARGS__), calc_refused())
#define calc_interrupted(error) ((error)->stop = true, calc_fail(error, 0, 0, "interrupted"))
#define calc_missing(error, input) (calc_raise_missing(error, input), calc_refused())
#define calc_no_memory(error) ((error)->stop = true, calc_fail(error, 0, 0, "out of memory"))
#define calc_errno(...) (calc_raise_errno(__VA_ARGS__), calc_refused())
#define calc_place(error, at, len) (calc_put_place(error, at, len), calc_refused())

/* True, with the error "interrupted", if the flag is set. */
bool calc_stopped(const volatile sig_atomic_t *stop, calc_error *error);

static const fret_status status_ok = {FRET_OK, NULL, 0, 0};

/* True if the status is good; else raises it as ERROR_STATUS. */
bool calc_status(calc_error *error, fret_status status);
/* The same for a status about an input of the scene, which wording.c will name. */
bool calc_input_status(calc_error *error, int input, fret_status status);

#endif
