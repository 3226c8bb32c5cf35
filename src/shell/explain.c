/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What a quantity is made of, and how far the last digit of each input moves it. */
#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#include "shell/command.h"
#include "shell/output.h"

static void explain_value(shell *sh, const char *name, value v) {
    char text[160];
    format_value(sh, v, text, sizeof text);
    fprintf(sh->out, "    %s = %s\n", name, text);
}

/* The row of an input. */
static const quantity *row_of(input in) {
    const quantity *q;
    for (size_t i = 0; (q = quantity_row(i)) && q->in != (int)in;)
        i++;
    return q;
}

/* What a change of a cause does to a result. */
typedef enum influence {
    INFLUENCE_NONE,
    INFLUENCE_SMALL,
    INFLUENCE_HIDDEN,
    INFLUENCE_LEFT, /* not looked for: it takes too long */
    INFLUENCE_SHOWN
} influence;

/* One number that a result depends on: an input, or a load of the program. A change in its last digit moves
 * the result by change, both relative. */
typedef struct cause {
    const char *name;
    value v;
    input in;
    double *load;   /* in the probe's own program; NULL: an input */
    bool increment; /* given by += */
    bool refused;   /* one neighbour is no valid input */
    long double digit, change;
    influence influence;
} cause;

enum { CAUSES = INPUTS + 3 };

static void load_cause(cause *out, const char *name, load_by by, double *load, bool increment) {
    *out = (cause){.name = name,
                   .v = {*load, by == BY_FORCE ? DIM_FORCE : DIM_LENGTH},
                   .in = INPUTS,
                   .load = load,
                   .increment = increment};
}

/* The inputs, the press and the last load. */
static size_t find_causes(scene *probe, cause *out) {
    size_t count = 0;
    for (input in = 0; in < INPUTS; in++)
        if (probe->set[in] && probe->in[in] != 0 && (in != IN_FN || probe->steps))
            out[count++] = (cause){
                .name = row_of(in)->name, .v = {probe->in[in], quantity_dim(row_of(in), probe)}, .in = in};
    if (!probe->steps)
        return count;
    load_step *first = &probe->program[0], *last = &probe->program[probe->steps - 1];
    bool cycle = last->kind == LOAD_CYCLE;
    if (first->normal != BY_FORCE)
        load_cause(&out[count++], first->normal == BY_RADIUS ? "a" : "dz", first->normal,
                   &first->normal_value, false);
    if (last != first && last->normal_value != 0) {
        bool force = cycle || last->normal == BY_FORCE;
        load_cause(&out[count++],
                   cycle   ? "FNA"
                   : force ? "step FN"
                           : "step dz",
                   force ? BY_FORCE : last->normal, &last->normal_value, last->relative & 1);
    }
    if (last->tangential && last->tangential_value != 0) {
        static const char *const names[2][2] = {{"Fx", "dx"}, {"FA", "dxA"}};
        load_cause(&out[count++], names[cycle][last->tangential != BY_FORCE], last->tangential,
                   &last->tangential_value, last->relative & 2);
    }
    return count;
}

/* The result with the cause moved to x, everything else as it is; false where that is refused. */
static bool moved_to(const scene *probe, const quantity *q, const cause *c, double x, long double *out,
                     calc_error *error) {
    scene s;
    if (!c->load && !scene_check(probe, c->in, x, error))
        return false;
    scene_clone(&s, probe);
    if (c->load) {
        *c->load = x;
        scene_forget(&s);
    } else {
        scene_put(&s, c->in, x);
    }
    bool ok = q->get(&s, out, error);
    if (c->load)
        *c->load = (double)c->v.v;
    scene_free(&s);
    return ok;
}

/* The first and the second relative difference of the result for steps of h: what the cause does, and what
 * is rounding or curvature. How many of the neighbours are valid? */
static int differences(const scene *probe, const quantity *q, const cause *c, double h, long double result,
                       long double *change, long double *noise, calc_error *error) {
    long double at[2];
    int valid = 0, side = 0;
    for (int sign = -1; sign <= 1 && !error->stop; sign += 2)
        if (moved_to(probe, q, c, (double)c->v.v + sign * h, &at[valid], error)) {
            valid++;
            side = sign;
        }
    if (valid == 1) { /* at the end of its range: both to one side */
        if (!moved_to(probe, q, c, (double)c->v.v + 2 * side * h, &at[1], error))
            return 0;
        *change = fabsl((at[0] - result) / result);
        *noise = fabsl((at[1] - 2 * at[0] + result) / result);
    } else if (valid == 2) {
        *change = fabsl((at[1] - at[0]) / 2 / result);
        *noise = fabsl((at[1] - 2 * result + at[0]) / result);
    }
    return valid;
}

/* Close to a singularity only neighbouring numbers tell the slope; elsewhere a wider step stands out from
 * the rounding of what has passed through a double. Of three steps the least uncertain counts. */
static void find_influence(const scene *probe, const quantity *q, cause *c, long double result,
                           calc_error *error) {
    double x = fabs((double)c->v.v), ulp = nextafter(x, INFINITY) - x;
    long double least = HUGE_VALL; /* uncertainty of change */
    int nearest = 0;
    c->digit = ulp / (long double)x;
    for (int bits = 0; bits <= 24 && !error->stop; bits += 12) {
        long double change, noise, scale = (long double)(1 << bits);
        int valid = differences(probe, q, c, ulp * (double)scale, result, &change, &noise, error);
        if (bits == 0)
            nearest = valid;
        if (valid == 0 || valid < nearest)
            break;
        if (change == 0 && noise == 0)
            continue;
        noise += DBL_EPSILON;
        if (noise / scale < least) {
            least = noise / scale;
            c->change = change / scale;
        }
        if (noise < change / 64)
            break;
    }
    c->refused = nearest < 2;
    c->influence = nearest == 0                           ? INFLUENCE_HIDDEN
                   : least == HUGE_VALL                   ? INFLUENCE_NONE
                   : c->change + least < 0.01L * c->digit ? INFLUENCE_SMALL
                   : least > c->change / 2                ? INFLUENCE_HIDDEN
                                                          : INFLUENCE_SHOWN;
}

enum { CONDITIONING = 3 }; /* seconds of the processor that it may take */

static bool find_influences(shell *sh, const quantity *q, long double result, cause *causes, size_t *count,
                            calc_error *error) {
    const scene *s = &sh->calc.scene;
    *count = 0;
    if (result == 0 || !isfinite(result))
        return true;
    scene probe;
    load_step *program = malloc((s->steps ? s->steps : 1) * sizeof *program);
    if (!program)
        return calc_fail(error, 0, 0, "out of memory");
    scene_clone(&probe, s);
    if (s->steps)
        memcpy(program, s->program, s->steps * sizeof *program);
    probe.program = program;
    *count = find_causes(&probe, causes);
    bool ok = true;
    clock_t start = clock();
    for (size_t i = 0; i < *count && ok; i++) {
        calc_error refused = {0};
        if (clock() - start < CONDITIONING * CLOCKS_PER_SEC)
            find_influence(&probe, q, &causes[i], result, &refused);
        else
            causes[i].influence = INFLUENCE_LEFT;
        ok = !refused.stop && !shell_stop;
    }
    scene_free(&probe);
    free(program);
    if (!ok) {
        error->stop = true;
        return calc_fail(error, 0, 0, "interrupted");
    }
    return true;
}

static void explain_conditioning(shell *sh, const quantity *q, const cause *causes, size_t count) {
    static const char *const not_shown[] = {"no effect", "condition number below 0.01",
                                            "not smooth here, or hidden by rounding",
                                            "left out after 3 seconds"};
    char head[100], moves[100], text[80];
    snprintf(moves, sizeof moves, "moves %s by", q->name);
    bool headed = false;
    for (size_t i = 0; i < count; i++) {
        const cause *c = &causes[i];
        if (c->influence != INFLUENCE_SHOWN)
            continue;
        if (!headed)
            fprintf(sh->out, "    %-20s  last digit  %14s  condition number\n", "conditioning", moves);
        headed = true;
        format_value(sh, c->v, text, sizeof text);
        snprintf(head, sizeof head, "%s %s %s", c->name, c->increment ? "+=" : "=", text);
        fprintf(sh->out, "    %-20s  %10.1Le  %14.1Le  %16.2Lg%s\n", head, c->digit, c->change,
                c->change / c->digit, c->refused ? "  (at the end of its range)" : "");
    }
    for (influence kind = INFLUENCE_SHOWN; kind-- > INFLUENCE_NONE;) {
        const char *separator = NULL;
        for (size_t i = 0; i < count; i++)
            if (causes[i].influence == kind) {
                if (separator)
                    fputs(separator, sh->out);
                else
                    fprintf(sh->out, "    %s: ", not_shown[kind]);
                fputs(causes[i].name, sh->out);
                separator = ", ";
            }
        if (separator)
            fputc('\n', sh->out);
    }
}

/* The inputs that the result was made of. */
static void explain_inputs(shell *sh, const quantity *q, const cause *causes, size_t count) {
    static const input order[] = {IN_E0, IN_NU, IN_E0_2, IN_NU_2, IN_K,      IN_C0, IN_MU,
                                  IN_N,  IN_A,  IN_H,    IN_R0,   IN_RADIUS, IN_B,  IN_SLOPE};
    const scene *s = &sh->calc.scene;
    for (size_t i = 0; i < sizeof order / sizeof *order; i++) {
        const quantity *p = row_of(order[i]);
        bool used = s->set[order[i]] && p != q;
        for (size_t j = 0; j < count; j++)
            if (causes[j].in == order[i] && causes[j].influence == INFLUENCE_NONE)
                used = false;
        if (used)
            explain_value(sh, p->name, (value){s->in[order[i]], quantity_dim(p, s)});
    }
}

bool do_explain(shell *sh, lexer *lx) {
    const quantity *q = lx->kind == T_NAME ? quantity_find(lx->text + lx->at, lx->len) : NULL;
    if (!q && lx->kind == T_NAME) {
        char word[64];
        snprintf(word, sizeof word, "%.*s", (int)(lx->len < 60 ? lx->len : 60), lx->text + lx->at);
        const char *near = suggest(word, quantity_name);
        return lex_fail(
            lx, near ? "'%s' is no quantity: did you mean %s?" : "'%s' is no quantity; try: explain dW", word,
            near);
    }
    if (!q)
        return lex_fail(lx, "explain which quantity? try: explain dW");
    scene *s = &sh->calc.scene;
    size_t at = lx->at, len = lx->len;
    lex_next(lx);
    if (lx->kind != T_END)
        return lex_fail(lx, "explain takes the name of one quantity: explain %s", q->name);
    value v = {0, quantity_dim(q, s)};
    if (q->get && !q->get(s, &v.v, lx->error)) {
        lx->error->at = at, lx->error->len = len;
        return false;
    }
    cause causes[CAUSES];
    size_t count = 0;
    if (q->get && !find_influences(sh, q, v.v, causes, &count, lx->error))
        return false;
    fprintf(sh->out, "%s: %s\n    %s  %s\n", q->name, q->title, q->formula, q->source);
    if (q->in >= 0 && !q->get) {
        if (s->set[q->in])
            explain_value(sh, q->name, (value){s->in[q->in], v.d});
        return true;
    }
    explain_inputs(sh, q, causes, count);
    if (!q->get)
        return true;
    const fret_press *press;
    calc_error ignored = {0};
    bool loaded = count == 0;
    for (size_t i = 0; i < count; i++)
        loaded =
            loaded || (causes[i].influence != INFLUENCE_NONE && (causes[i].load || causes[i].in == IN_FN));
    if (loaded && s->steps && q->in < 0 && scene_press(s, &press, &ignored))
        explain_value(sh, "FN now", (value){press->F, DIM_FORCE});
    static const char *const of_state[] = {"W", "U", "kt"}, *const of_first[] = {"Fx", "dx", "c"};
    bool closed = true;
    for (size_t i = 0; i < 3; i++)
        if (!strcmp(q->name, of_state[i]))
            closed = false;
        else if (!strcmp(q->name, of_first[i]))
            closed = scene_closed_state(s);
    if (!strcmp(q->name, "dW"))
        closed = scene_closed_loss(s);
    fprintf(sh->out, "    model: %s\n", scene_model_name(s, closed));
    explain_value(sh, q->name, v);
    explain_conditioning(sh, q, causes, count);
    return true;
}
