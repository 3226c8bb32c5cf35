/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Commands that change the scene. Each reads everything, then changes everything or nothing. */
#include <math.h>
#include <string.h>

#include "calc/csv.h"
#include "number/real.h"
#include "shell/command.h"
#include "shell/output.h"

/* ---- material, second body, friction ----------------------------------------------------------- */

static const struct {
    const char *name;
    double E0, nu;
} presets[] = {
    {"steel", 210e9, 0.3},   {"aluminium", 70e9, 0.33}, {"aluminum", 70e9, 0.33}, {"titanium", 114e9, 0.34},
    {"copper", 120e9, 0.34}, {"glass", 70e9, 0.22},     {"alumina", 370e9, 0.22}, {"rubber", 5e6, 0.5},
};
enum { PRESETS = sizeof presets / sizeof *presets };

static const char *preset_name(size_t i) {
    return i < PRESETS ? presets[i].name : NULL;
}

/* Changes to a scene gathered before any is made. */
typedef struct edit {
    bool has[INPUTS];
    double v[INPUTS];
    bool clear_material, clear_second;
    second_body second;
    const geometry *geometry;
    fret_gap sum;
} edit;

static void put(edit *e, input in, long double v) {
    e->has[in] = true;
    e->v[in] = (double)v;
}

/* Points the error at the argument's value. */
static bool at_value(lexer *lx, const argument *a) {
    lx->error->at = a->value_at;
    lx->error->len = a->value_len;
    return false;
}

static bool put_argument(shell *sh, lexer *lx, edit *e, input in, const argument *a) {
    put(e, in, a->v.v);
    return scene_check(&sh->calc.scene, in, e->v[in], lx->error) || at_value(lx, a);
}

static void apply(scene *s, void *context) {
    const edit *e = context;
    if (e->clear_material)
        s->in[IN_K] = 0, s->set[IN_K] = s->set[IN_C0] = false;
    if (e->clear_second)
        s->second = e->second, s->set[IN_E0_2] = s->set[IN_NU_2] = false;
    if (e->geometry) {
        s->geometry = e->geometry;
        s->sum = e->sum;
        for (input in = IN_N; in < INPUTS; in++)
            s->set[in] = false;
    }
    for (input in = 0; in < INPUTS; in++)
        if (e->has[in])
            scene_put(s, in, e->v[in]);
}

/* Reads NAME=EXPR ... for the inputs allowed, by the names of the quantity table. */
static bool read_inputs(shell *sh, lexer *lx, const command *c, const input *allowed, size_t count, edit *e) {
    while (at_argument(lx)) {
        argument a;
        const quantity *q = quantity_find(lx->text + lx->at, lx->len);
        if (!read_argument(sh, lx, &a))
            return false;
        size_t i = 0;
        while (i < count && (!q || q->in != (int)allowed[i]))
            i++;
        if (i == count || a.increment)
            return unknown_argument(lx, &a, c);
        if (e->has[allowed[i]])
            return calc_fail(lx->error, a.at, a.len, "%s is given twice", q->name);
        if (!argument_dim(lx, &a, q->d))
            return false;
        if (!put_argument(sh, lx, e, allowed[i], &a))
            return false;
    }
    return at_end(lx);
}

bool do_material(shell *sh, lexer *lx) {
    const command *c = command_find("material", 8);
    edit e = {.clear_material = true};
    static const input allowed[] = {IN_E0, IN_NU, IN_K, IN_C0};
    if (lx->kind == T_NAME && !at_argument(lx)) {
        char word[64];
        snprintf(word, sizeof word, "%.*s", (int)(lx->len < 60 ? lx->len : 60), lx->text + lx->at);
        size_t i = 0;
        while (i < PRESETS && strcmp(presets[i].name, word))
            i++;
        if (i == PRESETS) {
            const char *near = suggest(word, preset_name);
            return lex_fail(
                lx,
                near ? "unknown material '%s': did you mean %s?"
                     : "unknown material '%s' (steel, aluminium, titanium, copper, glass, alumina, rubber)",
                word, near);
        }
        lex_next(lx);
        put(&e, IN_E0, presets[i].E0);
        put(&e, IN_NU, presets[i].nu);
    }
    bool preset = e.has[IN_E0];
    e.has[IN_E0] = e.has[IN_NU] = false;
    double E0 = e.v[IN_E0], nu = e.v[IN_NU];
    if (!read_inputs(sh, lx, c, allowed, 4, &e))
        return false;
    if (preset && !e.has[IN_E0])
        put(&e, IN_E0, E0);
    if (preset && !e.has[IN_NU])
        put(&e, IN_NU, nu);
    if (!e.has[IN_E0] || !e.has[IN_NU])
        return lex_fail(lx, "%s is missing; usage: material %s", e.has[IN_E0] ? "nu" : "E0", c->usage);
    if (e.has[IN_K] && e.v[IN_K] != 0 && !e.has[IN_C0])
        return lex_fail(lx, "c0 is missing: with k = %g the depth where E = E0 matters", e.v[IN_K]);
    sh->warned_dissimilar = false;
    return scene_edit(&sh->calc.scene, apply, &e, lx->error);
}

bool do_second(shell *sh, lexer *lx) {
    edit e = {.clear_second = true, .second = SECOND_GIVEN};
    static const input allowed[] = {IN_E0, IN_NU, IN_E0_2, IN_NU_2};
    if (lex_is(lx, "rigid") || lex_is(lx, "same")) {
        e.second = lex_is(lx, "rigid") ? SECOND_RIGID : SECOND_SAME;
        lex_next(lx);
        if (!at_end(lx))
            return false;
    } else {
        if (!read_inputs(sh, lx, command_find("second", 6), allowed, 4, &e))
            return false;
        for (int i = 0; i < 2; i++)
            if (e.has[allowed[i]]) {
                put(&e, allowed[i + 2], e.v[allowed[i]]);
                e.has[allowed[i]] = false;
            }
        if (!e.has[IN_E0_2] && !e.has[IN_NU_2])
            return lex_fail(lx, "expected E0=... nu=..., rigid or same");
    }
    sh->warned_dissimilar = false;
    return scene_edit(&sh->calc.scene, apply, &e, lx->error);
}

bool do_friction(shell *sh, lexer *lx) {
    value v;
    size_t at = lx->at;
    if (lex_is(lx, "mu") && at_argument(lx)) {
        lex_next(lx);
        lex_next(lx);
        at = lx->at;
    }
    if (!expr_value(&sh->calc, lx, &v) || !value_dim(lx, "mu", at, lx->last - at, v, DIM_NONE) || !at_end(lx))
        return false;
    if (scene_set(&sh->calc.scene, IN_MU, (double)v.v, lx->error))
        return true;
    lx->error->at = at;
    lx->error->len = lx->last - at;
    return false;
}

/* ---- geometry ---------------------------------------------------------------------------------- */

static const char *geometry_name(size_t i) {
    const geometry *g = geometry_row(i);
    return g ? g->name : NULL;
}

static bool read_sum(shell *sh, lexer *lx, edit *e) {
    e->sum = (fret_gap){.kind = FRET_GAP_SUM};
    do {
        value n, A;
        if (e->sum.terms == FRET_GAP_TERMS)
            return lex_fail(lx, "a sum has at most %d terms", FRET_GAP_TERMS);
        if (e->sum.terms)
            lex_next(lx);
        size_t at = lx->at;
        if (!expr_value(&sh->calc, lx, &n) || !value_dim(lx, "the exponent", at, lx->last - at, n, DIM_NONE))
            return false;
        if (!(n.v > 0))
            return calc_fail(lx->error, at, lx->last - at, "n = %Lg must be positive", n.v);
        if (lx->kind != T_COLON)
            return lex_fail(lx, "expected `:` between exponent and coefficient, such as 2:50 m^-1");
        lex_next(lx);
        at = lx->at;
        if (!expr_value(&sh->calc, lx, &A) ||
            !value_dim(lx, "the coefficient", at, lx->last - at, A, (dim){0, (double)(1 - n.v)}))
            return false;
        e->sum.power[e->sum.terms++] = (fret_power){(double)n.v, (double)A.v, 1};
    } while (lx->kind == T_COMMA);
    return at_end(lx);
}

/* Columns r and f, in either order. */
static bool read_gap_file(shell *sh, lexer *lx) {
    char name[4000];
    size_t at = lx->at;
    csv data;
    if (!lex_filename(lx, name, sizeof name) || !at_end(lx))
        return false;
    lx->error->at = at;
    lx->error->len = strlen(name);
    if (!csv_read(name, &data, lx->error))
        goto placed;
    int r = !strcmp(data.name[1], "r");
    if (strcmp(data.name[r], "r") || strcmp(data.name[1 - r], "f")) {
        calc_fail(lx->error, 0, 0, "%s: the columns must be named r and f, not %s and %s", name, data.name[0],
                  data.name[1]);
    } else if (!dim_equal(data.d[0], DIM_LENGTH) || !dim_equal(data.d[1], DIM_LENGTH)) {
        calc_fail(lx->error, 0, 0,
                  "%s: r and f are lengths and need units in the header, such as r [mm],f [um]", name);
    } else {
        struct fret_table *gap;
        fret_status st = fret_table_make(data.column[r], data.column[1 - r], data.count, &gap);
        if (scene_status(&sh->calc.scene, lx->error, &st) &&
            scene_set_table(&sh->calc.scene, gap, name, lx->error)) {
            csv_free(&data);
            return true;
        }
    }
    csv_free(&data);
placed:
    lx->error->at = at;
    lx->error->len = strlen(name);
    return false;
}

bool do_geometry(shell *sh, lexer *lx) {
    /* names with a hyphen are several tokens to the lexer */
    size_t begin = lx->at, len = 0;
    while (begin + len < lx->end && lx->text[begin + len] != ' ' && lx->text[begin + len] != '\t' &&
           lx->text[begin + len] != '\n' && lx->text[begin + len] != '\r')
        len++;
    const geometry *g = geometry_find(lx->text + begin, len);
    if (!g) {
        char word[64];
        snprintf(word, sizeof word, "%.*s", (int)(len < 60 ? len : 60), lx->text + begin);
        if (!len)
            return lex_fail(lx, "which geometry? try: help geometry");
        const char *near = suggest(word, geometry_name);
        return calc_fail(lx->error, begin, len,
                         near ? "unknown geometry '%s': did you mean %s?"
                              : "unknown geometry '%s'; try: help geometry",
                         word, near);
    }
    lex_seek(lx, begin + len);
    edit e = {.geometry = g};
    if (g->kind == FRET_GAP_TABLE)
        return read_gap_file(sh, lx);
    if (g->kind == FRET_GAP_SUM) {
        if (!read_sum(sh, lx, &e))
            return false;
        return scene_edit(&sh->calc.scene, apply, &e, lx->error);
    }
    while (at_argument(lx)) {
        argument a;
        const quantity *q = quantity_find(lx->text + lx->at, lx->len);
        if (!read_argument(sh, lx, &a))
            return false;
        bool takes_slope = g->required[0] == IN_SLOPE || g->required[1] == IN_SLOPE;
        if (takes_slope && argument_is(&a, "angle")) {
            if (!value_dim(lx, "angle", a.value_at, a.value_len, a.v, DIM_NONE))
                return false;
            if (!(a.v.v > 0 && a.v.v < 1.5707963267948966 /* 90 deg as a double */))
                return calc_fail(lx->error, a.value_at, a.value_len, "angle must lie between 0 and 90 deg");
            put(&e, IN_SLOPE, fret_sin(a.v.v) / fret_cos(a.v.v));
            continue;
        }
        bool takes =
            q && q->in >= 0 &&
            (g->required[0] == (input)q->in || g->required[1] == (input)q->in ||
             (g->kind == FRET_GAP_POWER && g->n == 0 && (q->in == IN_A || q->in == IN_H || q->in == IN_R0)));
        if (!takes || a.increment)
            return calc_fail(lx->error, a.at, a.len, "%s has no parameter '%.*s'; usage: geometry %s",
                             g->name, (int)(a.len < 60 ? a.len : 60), a.name, g->usage);
        dim d = q->d;
        if (q->in == IN_A) {
            if (!e.has[IN_N])
                return calc_fail(lx->error, a.at, a.len, "give n before A: the dimension of A depends on it");
            d = (dim){0, 1 - e.v[IN_N]};
        }
        if (!argument_dim(lx, &a, d))
            return false;
        if (q->in == IN_A &&
            !(a.v.v > 0)) { /* said here: the dimension of A is not that of the scene as it stands */
            char text[160];
            format_value(sh, (value){a.v.v, d}, text, sizeof text);
            return calc_fail(lx->error, a.value_at, a.value_len, "A = %s must be positive", text);
        }
        if (!put_argument(sh, lx, &e, (input)q->in, &a))
            return false;
    }
    if (!at_end(lx))
        return false;
    for (int i = 0; i < 3; i++)
        if (g->required[i] != INPUTS && !e.has[g->required[i]])
            return lex_fail(lx, "a parameter is missing; usage: geometry %s", g->usage);
    if (g->kind == FRET_GAP_POWER && g->n == 0 && e.has[IN_A] == (e.has[IN_H] && e.has[IN_R0]))
        return lex_fail(lx, "give either A or both h and r0; usage: geometry %s", g->usage);
    return scene_edit(&sh->calc.scene, apply, &e, lx->error);
}

/* ---- the load program -------------------------------------------------------------------------- */

static bool reports(const shell *sh) {
    return sh->set.report == REPORT_ON || (sh->set.report == REPORT_AUTO && sh->interactive);
}

static void report_event(shell *sh, const char *event, const char *const *names) {
    if (!reports(sh))
        return;
    bool json = sh->set.format == FORMAT_JSON;
    if (json)
        fprintf(sh->out, "{\"event\":\"%s\"", event);
    for (bool first = true; *names; names++) {
        const quantity *q = quantity_find(*names, strlen(*names));
        calc_error error = {0};
        value v = {0, q->d};
        char text[160];
        if (!q->get(&sh->calc.scene, &v.v, &error))
            continue;
        format_value(sh, v, text, sizeof text);
        if (json)
            fprintf(sh->out, ",\"%s\":%.17g", *names, (double)v.v);
        else
            fprintf(sh->out, "%s%s = %s", first ? "  " : ", ", *names, text);
        first = false;
    }
    fputs(json ? "}\n" : "\n", sh->out);
}

/* The theory leaves coupling out: said once a pair of bodies. */
static void warn_dissimilar(shell *sh) {
    const fret_normal *normal;
    calc_error ignored = {0};
    if (sh->warned_dissimilar || !scene_normal(&sh->calc.scene, &normal, &ignored) ||
        fret_normal_foundation(normal)->similar)
        return;
    sh->warned_dissimilar = true;
    fflush(sh->out);
    fprintf(
        sh->err,
        "warning: the bodies are elastically dissimilar (mismatch %.3g): normal and tangential contact are "
        "coupled, and these results are an approximation\n",
        (double)fret_normal_foundation(normal)->mismatch);
}

bool do_press(shell *sh, lexer *lx) {
    const command *c = command_find("press", 5);
    load_step step = {.kind = LOAD_PRESS};
    argument a;
    if (!at_argument(lx))
        return lex_fail(lx, "press by what? usage: press %s", c->usage);
    if (!read_argument(sh, lx, &a))
        return false;
    dim d = argument_is(&a, "FN") ? DIM_FORCE : DIM_LENGTH;
    if (a.increment || !(argument_is(&a, "FN") || argument_is(&a, "dz") || argument_is(&a, "a")))
        return unknown_argument(lx, &a, c);
    if (!argument_dim(lx, &a, d) || !at_end(lx))
        return false;
    char name[8];
    snprintf(name, sizeof name, "%.*s", (int)a.len, a.name);
    double v = (double)a.v.v;
    if (!(v > 0)) {
        fret_status st = {FRET_NOT_POSITIVE, name, v, 0};
        scene_status(&sh->calc.scene, lx->error, &st);
        return at_value(lx, &a);
    }
    step.normal = argument_is(&a, "FN") ? BY_FORCE : argument_is(&a, "dz") ? BY_DISPLACEMENT : BY_RADIUS;
    step.normal_value = v;
    if (!scene_load(&sh->calc.scene, &step, NULL, lx->error)) {
        return lx->error->len || strncmp(lx->error->text, name, a.len) ? false : at_value(lx, &a);
    }
    warn_dissimilar(sh);
    static const char *const names[] = {"FN", "a", "dz", NULL};
    report_event(sh, "press", names);
    return true;
}

static bool twice(lexer *lx, const argument *a) {
    return calc_fail(lx->error, a->at, a->len, "two targets in one direction");
}

bool do_step(shell *sh, lexer *lx) {
    const command *c = command_find("step", 4);
    load_step step = {.kind = LOAD_STEP};
    size_t at = 0, len = 0;
    for (;;) {
        if (at_argument(lx)) {
            argument a;
            if (!read_argument(sh, lx, &a))
                return false;
            bool force = argument_is(&a, "FN") || argument_is(&a, "Fx");
            bool normal = argument_is(&a, "FN") || argument_is(&a, "dz");
            if (!force && !normal && !argument_is(&a, "dx"))
                return unknown_argument(lx, &a, c);
            if (!argument_dim(lx, &a, force ? DIM_FORCE : DIM_LENGTH))
                return false;
            if (normal ? step.normal : step.tangential)
                return twice(lx, &a);
            if (normal) {
                step.normal = force ? BY_FORCE : BY_DISPLACEMENT;
                step.normal_value = (double)a.v.v;
            } else {
                step.tangential = force ? BY_FORCE : BY_DISPLACEMENT;
                step.tangential_value = (double)a.v.v;
            }
            if (a.increment)
                step.relative |= normal ? 1 : 2;
            at = a.value_at, len = a.value_len;
        } else if (lex_accept(lx, "steps")) {
            if (!read_count(sh, lx, "steps", 1000000, &step.points))
                return false;
        } else {
            break;
        }
    }
    if (!step.normal && !step.tangential && !lx->error->raised)
        return lex_fail(lx, "step to where? usage: step %s", c->usage);
    if (!at_end(lx))
        return false;
    if (!scene_load(&sh->calc.scene, &step, NULL, lx->error)) {
        if (lx->error->len == 0)
            lx->error->at = at, lx->error->len = len;
        return false;
    }
    if (reports(sh)) {
        static const char *const names[] = {"Fx", "dx", "c", NULL}, *const oblique[] = {"FN", "Fx", "dx", "c",
                                                                                        NULL};
        report_event(sh, "step", step.normal ? oblique : names);
    }
    return true;
}

bool do_cycle(shell *sh, lexer *lx) {
    const command *c = command_find("cycle", 5);
    load_step step = {.kind = LOAD_CYCLE};
    cycle_extra extra = {.times = 1};
    size_t at = 0, len = 0;
    for (;;) {
        if (at_argument(lx)) {
            argument a;
            if (!read_argument(sh, lx, &a))
                return false;
            bool FA = argument_is(&a, "FA"), dxA = argument_is(&a, "dxA"), FNA = argument_is(&a, "FNA");
            if (a.increment || !(FA || dxA || FNA || argument_is(&a, "phase")))
                return unknown_argument(lx, &a, c);
            if (!argument_dim(lx, &a, FA || FNA ? DIM_FORCE : dxA ? DIM_LENGTH : DIM_NONE))
                return false;
            if (FA || dxA || FNA) {
                char name[8];
                snprintf(name, sizeof name, "%.*s", (int)a.len, a.name);
                fret_status st = {FRET_NOT_POSITIVE, name, (double)a.v.v, 0};
                if (!(a.v.v > 0)) {
                    scene_status(&sh->calc.scene, lx->error, &st);
                    return at_value(lx, &a);
                }
            }
            if (FA || dxA) {
                if (step.tangential)
                    return twice(lx, &a);
                step.tangential = FA ? BY_FORCE : BY_DISPLACEMENT;
                step.tangential_value = (double)a.v.v;
                at = a.value_at, len = a.value_len;
            } else if (FNA) {
                step.normal_value = (double)a.v.v;
            } else {
                extra.phase = (double)a.v.v;
            }
        } else if (lex_accept(lx, "times")) {
            if (!read_count(sh, lx, "times", 1000000, &extra.times))
                return false;
        } else if (lex_accept(lx, "steps")) {
            if (!read_count(sh, lx, "steps", 1000000, &step.points))
                return false;
        } else {
            break;
        }
    }
    if (!step.tangential && !lx->error->raised)
        return lex_fail(lx, "cycle by what amplitude? usage: cycle %s", c->usage);
    if (!at_end(lx))
        return false;
    if (!scene_load(&sh->calc.scene, &step, &extra, lx->error)) {
        if (lx->error->len == 0)
            lx->error->at = at, lx->error->len = len;
        return false;
    }
    static const char *const names[] = {"dW", "Fx", "dx", "c", NULL};
    report_event(sh, "cycle", names);
    return true;
}

/* Rows FN,Fx or dz,dx become steps; all of them, or none. */
bool do_follow(shell *sh, lexer *lx) {
    static const struct {
        const char *name[2];
        unsigned char by;
        dim d;
    } kinds[] = {{{"FN", "Fx"}, BY_FORCE, {1, 0}}, {{"dz", "dx"}, BY_DISPLACEMENT, {0, 1}}};
    char name[4000];
    size_t at = lx->at;
    csv data;
    if (!lex_filename(lx, name, sizeof name) || !at_end(lx))
        return false;
    bool ok = csv_read(name, &data, lx->error);
    if (ok) {
        int kind = strcmp(data.name[0], "FN") ? 1 : 0;
        if (strcmp(data.name[0], kinds[kind].name[0]) || strcmp(data.name[1], kinds[kind].name[1]))
            ok = calc_fail(lx->error, 0, 0, "%s: the columns must be FN,Fx or dz,dx, not %s,%s", name,
                           data.name[0], data.name[1]);
        else if (!dim_equal(data.d[0], kinds[kind].d) || !dim_equal(data.d[1], kinds[kind].d))
            ok = calc_fail(lx->error, 0, 0, "%s: the columns need units in the header, such as %s", name,
                           kind ? "dz [um],dx [um]" : "FN [N],Fx [N]");
        size_t row = 0;
        load_step step = {.kind = LOAD_STEP, .normal = kinds[kind].by, .tangential = kinds[kind].by};
        scene *s = &sh->calc.scene;
        bool fresh = !s->steps; /* then the first row presses */
        if (ok && fresh) {
            load_step press = {
                .kind = LOAD_PRESS, .normal = kinds[kind].by, .normal_value = data.column[0][0]};
            if (!(data.column[0][0] > 0) || data.column[1][0] != 0)
                ok = calc_fail(lx->error, 0, 0,
                               "%s: there is no load yet: press first, or begin with a row that presses (%s "
                               "> 0, %s = 0)",
                               name, data.name[0], data.name[1]);
            ok = ok && scene_load(s, &press, NULL, lx->error);
            row = 1;
        }
        ok = ok && scene_begin(s, lx->error);
        bool begun = ok;
        for (; ok && row < data.count; row++) {
            step.normal_value = data.column[0][row];
            step.tangential_value = data.column[1][row];
            ok = scene_load(s, &step, NULL, lx->error);
            if (ok && shell_stop) {
                lx->error->stop = true;
                ok = calc_fail(lx->error, 0, 0, "interrupted");
            }
            if (!ok && !lx->error->stop) {
                size_t n = strlen(lx->error->text);
                snprintf(lx->error->text + n, sizeof lx->error->text - n, " (row %zu of %.200s)", row + 1,
                         name);
            }
        }
        if (!ok && fresh)
            scene_reset(s, false);
        else if (!ok && begun)
            scene_roll_back(s);
        csv_free(&data);
    }
    lx->error->at = at;
    lx->error->len = strlen(name);
    if (!ok)
        return false;
    lx->error->at = lx->error->len = 0;
    static const char *const names[] = {"FN", "Fx", "dx", "c", NULL};
    report_event(sh, "follow", names);
    return true;
}

bool do_reset(shell *sh, lexer *lx) {
    bool all = lex_accept(lx, "all");
    if (!at_end(lx))
        return false;
    scene_reset(&sh->calc.scene, all);
    sh->warned_dissimilar = false;
    return true;
}
