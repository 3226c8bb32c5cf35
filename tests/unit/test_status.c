/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "unit.h"

/* Codes are part of the interface: numbers never change. */
static void numbers(void) {
    CHECK(FRET_OK == 0 && FRET_NOT_FINITE == 1 && FRET_BAD_K == 2 && FRET_BAD_NU == 3);
    CHECK(FRET_NOT_POSITIVE == 4 && FRET_NEGATIVE == 5 && FRET_BOTH_RIGID == 6 && FRET_GROSS_SLIP == 7);
    CHECK(FRET_OUTSIDE == 8 && FRET_NOT_MONOTONE == 9 && FRET_TABLE_SHORT == 10 && FRET_BAD_TABLE == 11);
    CHECK(FRET_OVERFLOW == 12 && FRET_NO_MEMORY == 14 && FRET_INTERRUPTED == 15);
    CHECK(FRET_CODES >= 16);
}

static void categories(void) {
    static const fret_code input[] = {FRET_NOT_FINITE,   FRET_BAD_K,        FRET_BAD_NU,
                                      FRET_NOT_POSITIVE, FRET_NEGATIVE,     FRET_BOTH_RIGID,
                                      FRET_OUTSIDE,      FRET_NOT_MONOTONE, FRET_BAD_TABLE};
    CHECK(fret_status_category(FRET_OK) == FRET_CAT_NONE);
    for (size_t i = 0; i < sizeof input / sizeof *input; i++)
        CHECK(fret_status_category(input[i]) == FRET_CAT_INPUT);
    CHECK(fret_status_category(FRET_GROSS_SLIP) == FRET_CAT_STATE);
    CHECK(fret_status_category(FRET_TABLE_SHORT) == FRET_CAT_STATE);
    CHECK(fret_status_category(FRET_OVERFLOW) == FRET_CAT_NUMERIC);
    CHECK(fret_status_category((fret_code)13) == FRET_CAT_INPUT); /* withdrawn */
    CHECK(fret_status_category(FRET_NO_MEMORY) == FRET_CAT_SYSTEM);
    CHECK(fret_status_category(FRET_INTERRUPTED) == FRET_CAT_SYSTEM);
    /* codes of a newer or broken caller are errors, never success */
    CHECK(fret_status_category(FRET_CODES) != FRET_CAT_NONE);
    CHECK(fret_status_category((fret_code)(FRET_CODES + 5)) != FRET_CAT_NONE);
}

static void rules(void) {
    for (int i = 0; i < FRET_CODES; i++) {
        const char *rule = fret_status_rule((fret_code)i);
        if (!CHECK(rule && *rule))
            continue;
        CHECK(rule == fret_status_rule((fret_code)i)); /* static text */
        for (int j = 0; j < i; j++)
            CHECK(strcmp(rule, fret_status_rule((fret_code)j)) != 0);
    }
    CHECK(fret_status_rule((fret_code)(FRET_CODES + 5)) && *fret_status_rule((fret_code)(FRET_CODES + 5)));
    CHECK(!strcmp(fret_status_rule(FRET_CODES), fret_status_rule((fret_code)(FRET_CODES + 5))));
    CHECK(strstr(fret_status_rule(FRET_BAD_K), "-1 < k < 1") != NULL);
}

static void text(void) {
    fret_status st = {FRET_BAD_K, "k", 1.5, 1};
    char whole[256], part[8];
    int length = fret_status_text(&st, whole, sizeof whole);
    CHECK(length == (int)strlen(whole));
    CHECK(strncmp(whole, "k = 1.5 ", 8) == 0);
    CHECK(strstr(whole, fret_status_rule(FRET_BAD_K)) != NULL);
    memset(part, 'x', sizeof part);
    CHECK(fret_status_text(&st, part, sizeof part) == length);
    CHECK(part[7] == 0 && strncmp(part, whole, 7) == 0);
    CHECK(fret_status_text(&st, NULL, 0) == length);
    part[1] = 'x';
    CHECK(fret_status_text(&st, part, 1) == length && part[0] == 0 && part[1] == 'x');
    st = (fret_status){FRET_OVERFLOW, "E0", 1e300, 0}; /* a rule that is a sentence */
    CHECK(fret_status_text(&st, whole, sizeof whole) == (int)strlen(whole));
    CHECK(strncmp(whole, "E0 = 1e+300: ", 13) == 0);
    st = (fret_status){FRET_BAD_TABLE, "f", 1e-7, 0}; /* whichever of r, f and count is to blame */
    fret_status_text(&st, whole, sizeof whole);
    CHECK(
        !strcmp(whole, "f = 1e-07 makes no gap: two rows or more are needed, r and f from 0, and growing r"));
    for (int i = 0; i < FRET_CODES; i++) { /* no quantity */
        st = (fret_status){(fret_code)i, NULL, 0, 0};
        CHECK(fret_status_text(&st, whole, sizeof whole) == (int)strlen(whole) && *whole);
        CHECK(strstr(whole, "(null)") == NULL);
    }
}

int main(int argc, char **argv) {
    unit_start("status", argc, argv);
    CASE(numbers());
    CASE(categories());
    CASE(rules());
    CASE(text());
    return unit_finish();
}
