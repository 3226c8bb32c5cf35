/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers as text are those of printf, whichever way they are made. */
#include "unit.h"

#define unit calc_unit /* the other one is at work here */
#include "statement/output.h"
#undef unit

static void as_printf(double v) {
    char fast[NUMBER_TEXT], slow[NUMBER_TEXT];
    for (int digits = 1; digits <= 17; digits++) {
        number_text(fast, digits, v);
        snprintf(slow, sizeof slow, "%.*g", digits, v + 0.0);
        if (!CHECK(!strcmp(fast, slow)))
            printf("%a to %d digits: %s, not %s\n", v, digits, fast, slow);
    }
}

/* Ties, carries to the next power of ten, ends of the range, and where it goes over to exponents. */
static void chosen(void) {
    static const double values[] = {0.0,     -0.0,      1,        -1,     0.5,     2.5,     9.5,  0.125,
                                    1e-4,    9.9999e-5, 99999.5,  1e5,    1e17,    1e22,    1e23, 5e-324,
                                    DBL_MIN, DBL_MAX,   INFINITY, 0.1,    1 / 3.0, 2 / 3.0, 1e-5, 999999,
                                    1e6,     9e15,      1e16,     123456, NAN,     -0.05};
    for (size_t i = 0; i < sizeof values / sizeof *values; i++)
        as_printf(values[i]);
}

static void drawn(void) {
    unsigned long long bits = 1;
    for (int i = 0; i < 20000; i++) {
        bits = bits * 6364136223846793005ULL + 1442695040888963407ULL;
        const double part = (double)(bits >> 11) / 9007199254740992.0;
        as_printf(part * pow(10, (double)(i % 61) - 30));
        as_printf(round(part * 1e6) / 1e3); /* few digits, so that fewer of them tie */
    }
}

int main(int argc, char **argv) {
    unit_start("output", argc, argv);
    CASE(chosen());
    CASE(drawn());
    return unit_finish();
}
