/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The texts of the codes, and the checks of arguments. Writes into the caller's buffer alone. */
#include "fret/status.h"

#include <stdbool.h>
#include <stdio.h>

#include "law/check.h"

static const struct {
    fret_category category;
    const char *rule;
} codes[FRET_CODES] = {
    [FRET_OK] = {FRET_CAT_NONE, "is fine"},
    [FRET_NOT_FINITE] = {FRET_CAT_INPUT, "must be a finite number"},
    [FRET_BAD_K] = {FRET_CAT_INPUT, "must lie in -1 < k < 1"},
    [FRET_BAD_NU] = {FRET_CAT_INPUT, "must lie in -1 < nu <= 0.5"},
    [FRET_NOT_POSITIVE] = {FRET_CAT_INPUT, "must be positive"},
    [FRET_NEGATIVE] = {FRET_CAT_INPUT, "must not be negative"},
    [FRET_BOTH_RIGID] = {FRET_CAT_INPUT, "both bodies are rigid: one must be elastic"},
    [FRET_GROSS_SLIP] = {FRET_CAT_STATE, "exceeds the friction limit: gross slip"},
    [FRET_OUTSIDE] = {FRET_CAT_INPUT, "lies outside the range of the function"},
    [FRET_NOT_MONOTONE] = {FRET_CAT_INPUT, "is where g(x) begins to fall: the contact would not be a disc"},
    [FRET_TABLE_SHORT] = {FRET_CAT_STATE, "is too large: the contact would reach the end of the gap"},
    [FRET_BAD_TABLE] = {FRET_CAT_INPUT,
                        "makes no gap: two rows or more are needed, r and f from 0, and growing r"},
    [FRET_OVERFLOW] = {FRET_CAT_NUMERIC, "a result is beyond the range of floating-point numbers"},
    [FRET_NO_MEMORY] = {FRET_CAT_SYSTEM, "out of memory"},
    [FRET_SINGULAR] = {FRET_CAT_INPUT, "is a singularity: the field is infinite there"},
    [FRET_INTERRUPTED] = {FRET_CAT_SYSTEM, "interrupted"},
};

static bool known(fret_code code) {
    return (unsigned)code < FRET_CODES && codes[code].rule; /* withdrawn codes have none */
}

fret_category fret_status_category(fret_code code) {
    return known(code) ? codes[code].category : FRET_CAT_INPUT;
}

const char *fret_status_rule(fret_code code) {
    return known(code) ? codes[code].rule : "has an unknown status";
}

int fret_status_text(const fret_status *status, char *buf, size_t size) {
    if (!status->quantity)
        return snprintf(buf, size, "%s", fret_status_rule(status->code));
    const bool sentence = fret_status_category(status->code) >= FRET_CAT_NUMERIC; /* a sentence of its own */
    return snprintf(buf, size, "%s = %.6g%s %s", status->quantity, status->value, sentence ? ":" : "",
                    fret_status_rule(status->code));
}

fret_status fret_check_positive(const char *quantity, double value) {
    if (!isfinite(value))
        return fret_fail(FRET_NOT_FINITE, quantity, value, 0);
    if (value <= 0)
        return fret_fail(FRET_NOT_POSITIVE, quantity, value, 0);
    return fret_ok();
}

fret_status fret_check_k(double k) {
    if (!isfinite(k))
        return fret_fail(FRET_NOT_FINITE, "k", k, 0);
    if (k <= -1 || k >= 1)
        return fret_fail(FRET_BAD_K, "k", k, k < 0 ? -1 : 1);
    return fret_ok();
}

fret_status fret_check_not_negative(const char *quantity, double value) {
    if (!isfinite(value))
        return fret_fail(FRET_NOT_FINITE, quantity, value, 0);
    if (value < 0)
        return fret_fail(FRET_NEGATIVE, quantity, value, 0);
    return fret_ok();
}
