/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The error that every room of the language reports: raised where it is seen, worded in wording.c. */
#ifndef TEXT_ERROR_H
#define TEXT_ERROR_H

#include <signal.h>
#include <stdbool.h>
#include <stddef.h>

#include "fret/status.h"
#include "text/words.h"

enum { CALC_ERROR_TEXT = 512 };

typedef enum error_kind {
    ERROR_WORDS,  /* text says it */
    ERROR_STATUS, /* status: of the mechanics, or of an input's range */
    ERROR_MISSING /* the input has no value in this scene */
} error_kind;

/* What went wrong, and where in the statement: bytes at .. at+len, len 0: not known yet. */
typedef struct calc_error {
    bool raised;
    bool stop;    /* interrupted, or memory is out: trying something else instead is no use */
    bool refused; /* by the system: no word of the language is to blame */
    bool circle;  /* a live definition that needs itself */
    bool strange; /* dimensions do not fit: no other value would help */
    bool worded;  /* wording.c has been here */
    error_kind kind;
    int input; /* of ERROR_MISSING, and of a status without a name; else -1 */
    size_t at, len;
    fret_status status;
    char text[CALC_ERROR_TEXT];
} calc_error;

/* One that is ready to be raised. */
#define ERROR_NONE                                                                                           \
    { .input = -1 }
/* Again; where a million may begin, too, whose texts need not be cleared. */
void error_clear(calc_error *error);
/* For what may fail quietly: an error of the block it stands in, cleared each time, that nobody reports. */
#define error_quiet() (&(calc_error)ERROR_NONE)

/* These record the first error only. */
LIKE_PRINTF(4, 5)
void calc_raise(calc_error *error, size_t at, size_t len, const char *format, ...);
void calc_raise_missing(calc_error *error, int input);
/* What the system refused: the words, and its own behind them. */
LIKE_PRINTF(3, 4)
void calc_raise_errno(calc_error *error, int code, const char *format, ...);
/* Gives the error a place where it has none. */
void calc_put_place(calc_error *error, size_t at, size_t len);

/* The same as an answer: false, which compilers see too where `made || calc_no_memory(error)` stands. */
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

/* Is the flag up? Then the error says so. */
bool calc_stopped(const volatile sig_atomic_t *stop, calc_error *error);

/* True where the status is fine. */
bool calc_status(calc_error *error, fret_status status);
/* The same for an input of the scene, which wording.c names. */
bool calc_input_status(calc_error *error, int input, fret_status status);

#endif
