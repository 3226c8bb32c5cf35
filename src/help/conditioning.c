/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes the result of study/influence (conditioning) for `explain`, to readers and to programs. */
#include "help/conditioning.h"

#include <math.h>
#include <string.h>

#include "statement/output.h"

static const char *const not_shown[] = {"no effect", "condition number below 0.01",
                                        "not smooth here, or hidden by rounding", "left out after 3 seconds"};

static void put_shown(answer *out, const cause *c) {
    char head[400], text[160];
    format_column(
        &(column){.d = c->v.d, .row = c->kind == CAUSE_INPUT ? quantity_of_input(c->in)->unit : NULL},
        out->set->digits, c->v.v, text, sizeof text);
    snprintf(head, sizeof head, "%s %s %s", c->name, c->increment ? "+=" : "=", text);
    answer_words(out, "    %s%*.1Le  %14.1Le  %16.2Lg%s\n", head, (int)fmax(32 - (double)strlen(head), 9),
                 c->digit, c->change, c->change / c->digit, c->refused ? "  (at the end of its range)" : "");
    answer_number(out, "last digit", (double)c->digit);
    answer_number(out, "moves", (double)c->change);
    answer_number(out, "condition number", (double)(c->change / c->digit));
    answer_flag(out, "at the end of its range", c->refused);
}

/* For readers: one line with all causes of this kind. */
static void put_others(answer *out, const influence_study *study, influence kind) {
    const char *before = "";
    for (size_t i = 0; i < study->count; i++) {
        const cause *c = &study->cause[i];
        if (c->influence != kind)
            continue;
        if (*before)
            answer_words(out, "%s%s", before, c->name);
        else
            answer_words(out, "    %s: %s", not_shown[kind], c->name);
        before = ", ";
    }
    if (*before)
        answer_words(out, "\n");
}

void conditioning_tell(answer *out, const char *name, const influence_study *study) {
    char moves[100];
    bool headed = false;
    snprintf(moves, sizeof moves, "moves %s by", name);
    answer_items(out, "conditioning");
    for (size_t i = 0; i < study->count; i++) {
        const cause *c = &study->cause[i];
        const bool shown = c->influence == INFLUENCE_SHOWN;
        if (shown && !headed)
            answer_words(out, "    %-20s  last digit  %14s  condition number\n", "conditioning", moves);
        headed = headed || shown;
        answer_item(out);
        answer_string(out, "of", c->name);
        answer_number(out, "value", (double)c->v.v);
        if (shown)
            put_shown(out, c);
        else
            answer_string(out, "not shown", not_shown[c->influence]);
        answer_up(out);
    }
    answer_up(out);
    for (influence kind = INFLUENCE_SHOWN; kind-- > INFLUENCE_NONE;)
        put_others(out, study, kind);
}
