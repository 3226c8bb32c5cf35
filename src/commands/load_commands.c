/* SPDX-License-Identifier: GPL-3.0-or-later */
/* press, step, cycle, follow, reset, undo. Each reads all, then changes the scene or nothing. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "commands/columns.h"
#include "statement/answer.h"
#include "statement/command.h"
#include "statement/progress.h"

/* ---- reports ----------------------------------------------------------------------------------- */

enum { REPORTED = 8 }; /* the most quantities of a report */

/* Are load commands reported? `set report auto`: at the prompt, and to programs. */
static bool reports(const shell *sh) {
    return sh->set.report == REPORT_ON || (sh->set.report == REPORT_AUTO && !sh->on_screen &&
                                           (sh->interactive || sh->replaying || answer_is_data(&sh->set)));
}

/* Computes all quantities before it writes, since that may take long and show its progress. */
void report_event(shell *sh, const char *event, const char *const *names) {
    const quantity *of[REPORTED];
    value v[REPORTED];
    size_t count = 0;
    if (!reports(sh))
        return;
    for (; *names; names++) {
        of[count] = quantity_find(*names, strlen(*names));
        v[count] = (value){0, of[count]->d};
        count += quantity_get(of[count], &sh->calc.scene, &v[count].v, error_quiet());
    }
    if (sh->set.report == REPORT_AUTO && !answer_is_data(&sh->set))
        shell_aside(sh, sh->out);
    answer a;
    answer_begin(&a, &sh->set, sh->out);
    answer_report(&a, event);
    for (size_t i = 0; i < count; i++)
        answer_quantity(&a, of[i]->name, v[i]);
    answer_done(&a);
    answer_end(&a, true);
}

/* ---- press, step, cycle ------------------------------------------------------------------------ */

/* Notes that a new load has set Nw to 0, if there was wear. */
static void note_unworn(shell *sh, bool worn) {
    if (worn && !inputs_any(&sh->calc.scene.in, INPUT_BIT(IN_NW)))
        shell_note(sh, "Nw is 0 again: wear is that of the last cycle alone");
}

/* The targets of a step, and the amplitudes of a cycle. */
static const struct {
    const char *name;
    bool normal;
    load_by by;
} targets[] = {{"Fx", false, BY_FORCE}, {"dx", false, BY_DISPLACEMENT},  {"drig", false, BY_RIG},
               {"FA", false, BY_FORCE}, {"dxA", false, BY_DISPLACEMENT}, {"drigA", false, BY_RIG},
               {"FN", true, BY_FORCE},  {"dz", true, BY_DISPLACEMENT}};

static void take_target(load_step *step, const given_clause *h, bool normal, load_by by) {
    *(normal ? &step->normal : &step->tangential) = (unsigned char)by;
    *(normal ? &step->normal_value : &step->tangential_value) = (double)h->v.v;
    if (h->increment)
        step->relative |= normal ? RELATIVE_NORMAL : RELATIVE_TANGENTIAL;
}

/* Fills in a step or cycle from its arguments. *last: the last target, which errors of the load point at. */
static void load_of(parsed *s, load_step *step, cycle_extra *extra, const given_clause **last) {
    const given_clause *FNA = parsed_clause(s, "FNA", 0), *phase = parsed_clause(s, "phase", 0),
                       *steps = parsed_clause(s, "steps", 0), *times = parsed_clause(s, "times", 0);
    *last = NULL;
    for (const given_clause *h = s->list; h < s->list + s->count; h++)
        for (size_t i = 0; i < sizeof targets / sizeof *targets; i++)
            if (!strcmp(h->of->name, targets[i].name)) {
                take_target(step, h, targets[i].normal, targets[i].by);
                *last = h;
            }
    if (FNA)
        step->normal_value = (double)FNA->v.v;
    if (phase)
        extra->phase = (double)phase->v.v;
    if (steps)
        step->points = steps->count;
    if (times)
        extra->times = times->count;
}

/* Evaluates live amplitudes in the present scene. */
static bool evaluate_live(shell *sh, lexer *lx, parsed *s) {
    for (given_clause *h = s->list; h < s->list + s->count; h++) {
        const clause *a = h->of;
        if (!h->live)
            continue;
        if (!definition_value(&sh->calc, (definition *)h->live, &h->v, lx->error) ||
            !value_dim(lx, a->name, h->hole[0].at, h->hole[0].len, h->v, a->d) ||
            !input_check((input)(a->in - 1), (double)h->v.v, lx->error))
            return given_place(lx->error, h);
    }
    return true;
}

/* Makes a step or cycle of the clauses; an error if it has no target. */
static bool read_targets(shell *sh, lexer *lx, bool cycle, parsed *s, load_step *step, cycle_extra *extra,
                         const given_clause **last) {
    *step = (load_step){.kind = cycle ? LOAD_CYCLE : LOAD_STEP};
    *extra = (cycle_extra){.times = 1};
    if (cycle && !evaluate_live(sh, lx, s))
        return false;
    load_of(s, step, extra, last);
    return step->tangential || (!cycle && step->normal) ||
           lex_fail(lx, cycle ? "cycle by what amplitude?" : "step to where?") || add_usage(lx->error, s->by);
}

bool read_load(shell *sh, lexer *lx, load_step *step, cycle_extra *extra, counted *bound[INPUTS]) {
    const command *c = command_find(lx->text + lx->at, lx->len);
    parsed s;
    const given_clause *last;
    const bool cycle = lex_is(lx, "cycle");
    lex_next(lx);
    bool ok =
        parsed_read_some(sh, lx, command_form(c), &s) && read_targets(sh, lx, cycle, &s, step, extra, &last);
    for (given_clause *h = s.list; ok && h < s.list + s.count; h++)
        if (h->live)
            bound[h->of->in - 1] = counted_hold(h->live);
    parsed_drop(sh, &s);
    return ok;
}

bool do_press(shell *sh, lexer *lx, parsed *all) {
    static const char *const names[] = {"FN", "a", "dz", NULL};
    if (!all->count)
        return lex_fail(lx, "press by what?") || add_usage(lx->error, all->by);
    const given_clause *by = &all->list[0];
    const bool worn = inputs_any(&sh->calc.scene.in, INPUT_BIT(IN_NW));
    const load_step step = {.kind = LOAD_PRESS,
                            .normal = (unsigned char)press_by((input)(by->of->in - 1)),
                            .normal_value = (double)by->v.v};
    if (!scene_load(&sh->calc.scene, &step, NULL, lx->error)) {
        const char *of = lx->error->kind == ERROR_STATUS ? lx->error->status.quantity : NULL;
        return of && !strcmp(of, by->of->name) ? given_place(lx->error, by) : false;
    }
    report_event(sh, "press", names);
    note_unworn(sh, worn);
    return true;
}

bool do_step(shell *sh, lexer *lx, parsed *all) {
    static const char *const names[] = {"Fx", "dx", "c", "drig", NULL}, *const oblique[] = {"FN",   "Fx",
                                                                                            "dx",   "c",
                                                                                            "drig", NULL};
    load_step step;
    cycle_extra extra;
    const given_clause *last;
    if (!read_targets(sh, lx, false, all, &step, &extra, &last))
        return false;
    if (!scene_load(&sh->calc.scene, &step, NULL, lx->error))
        return given_place(lx->error, last);
    if (reports(sh)) /* else scene_load may leave the step to be run later */
        report_event(sh, "step", step.normal ? oblique : names);
    if (shell_stop) { /* `step` has no undo mark in run_row, which takes back other commands */
        calc_undo(&sh->calc);
        return calc_interrupted(lx->error);
    }
    shell_warn_load(sh, &step);
    return true;
}

static void bind_all(inputs *in, void *context) {
    counted **bound = context;
    for (input i = 0; i < INPUTS; i++)
        if (bound[i])
            inputs_bind(in, i, counted_hold(bound[i]));
}

bool do_cycle(shell *sh, lexer *lx, parsed *all) {
    static const char *const names[] = {"dW", "Fx", "dx", "c", "drig", NULL};
    load_step step;
    cycle_extra extra;
    const given_clause *last;
    counted *bound[INPUTS] = {NULL};
    const bool worn = inputs_any(&sh->calc.scene.in, INPUT_BIT(IN_NW));
    bool live = false;
    if (!read_targets(sh, lx, true, all, &step, &extra, &last))
        return false;
    for (const given_clause *h = all->list; h < all->list + all->count; h++)
        if (h->live) {
            bound[h->of->in - 1] = h->live;
            live = true;
        }
    const bool ok = (scene_load(&sh->calc.scene, &step, &extra, lx->error) || given_place(lx->error, last)) &&
                    (!live || scene_edit(&sh->calc.scene, bind_all, bound, lx->error));
    if (ok && parsed_clause(all, "phase", 0) && !parsed_clause(all, "FNA", 0))
        shell_note(sh, "phase has no effect without FNA");
    if (ok)
        report_event(sh, "cycle", names);
    note_unworn(sh, ok && worn);
    return ok;
}

/* ---- follow ------------------------------------------------------------------------------------ */

enum { AT_ONCE = 4096 }; /* rows between reports of progress */
#define SAME 1e-4        /* relative; rounding to the digits of a text table may change so much */

/* The rows of a file and what drives the contact: FN and Fx; or dz and dx; or dx at constant F_N, with Fx
 * compared. If the file has both pairs, as `history` writes them, the forces drive and dx is compared. */
typedef struct rows {
    csv *data;
    load_by normal_by, by;
    csv_values *normal, *Fx, *dx; /* NULL: not used */
    bool rig;                     /* dx is read at the rig */
    double mu;
} rows;

/* Presses by the first row, if there is no load yet. */
static bool follow_press(shell *sh, const rows *w, calc_error *error) {
    const bool force = w->normal_by == BY_FORCE;
    const load_step press = {
        .kind = LOAD_PRESS, .normal = (unsigned char)w->normal_by, .normal_value = w->normal->v[0]};
    if (!(press.normal_value > 0) || (force ? w->Fx : w->dx)->v[0] != 0)
        return calc_fail(
            error, 0, 0,
            "%s: there is no load yet: press first, or begin with a row that presses (%s > 0, %s = 0)",
            w->data->path, force ? "FN" : "dz", force ? "Fx" : "dx");
    return scene_load(&sh->calc.scene, &press, NULL, error);
}

/* What drives a row. A force does not tell how far the contact slides in gross slip, nor that dx is held
 * while F_N changes: there dx drives, if the file has it. */
static load_by driver_of(const rows *w, size_t row) {
    if (w->by != BY_FORCE || !w->dx)
        return w->by;
    const double *FN = w->normal->v, *dx = w->dx->v;
    const bool held = row > 0 && dx[row] == dx[row - 1] && FN[row] != FN[row - 1];
    return held || fabs(w->Fx->v[row]) >= w->mu * FN[row] * (1 - SAME) ? BY_DISPLACEMENT : BY_FORCE;
}

/* Appends the rows as steps, in runs with the same driver. */
static bool follow_rows(shell *sh, const rows *w, size_t row, calc_error *error) {
    const csv *data = w->data;
    for (size_t count; row < data->rows; row += count) {
        const load_by by = driver_of(w, row);
        const load_step step = {.kind = LOAD_STEP,
                                .normal = (unsigned char)w->normal_by,
                                .tangential = (unsigned char)(w->rig ? BY_RIG : by)};
        size_t bad;
        for (count = 1; count < AT_ONCE && row + count < data->rows; count++)
            if (driver_of(w, row + count) != by)
                break;
        progress_part((double)row / (double)data->rows);
        bool ok = scene_load_rows(&sh->calc.scene, step, w->normal ? w->normal->v + row : NULL,
                                  (by == BY_FORCE ? w->Fx : w->dx)->v + row, count, &bad, error);
        if (ok && shell_stop)
            ok = calc_interrupted(error);
        if (!ok) {
            if (!error->stop)
                calc_append(&sh->calc, error, " (row %zu of %.200s)", row + bad + 1, data->path);
            return false;
        }
    }
    progress_part(-1); /* the model of springs has yet to run */
    return true;
}

/* Subtracts an offset of the rig from its readings. */
static bool subtract_offset(shell *sh, input offset, csv_values *v, size_t n, calc_error *error) {
    long double by;
    if (!scene_get(&sh->calc.scene, offset, &by, error))
        return false;
    for (size_t i = 0; i < n; i++)
        v->v[i] -= (double)by;
    return true;
}

/* Reads the columns where dx or drig drives at constant F_N and Fx is compared. */
static bool read_compared(shell *sh, csv *data, rows *w, calc_error *error) {
    w->rig = columns_at_rig(sh, data);
    const bool read = columns_of_loop(data, w->rig, &w->dx, &w->Fx, error);
    if (!(csv_find(data, "dx") || w->rig) || !csv_find(data, "Fx"))
        calc_append(&sh->calc, error, " (FN,Fx or dz,dx are followed; dx,Fx or drig,Fx compared)");
    return read && (sh->calc.scene.end.steps || calc_missing(error, IN_FN));
}

/* Reads the columns, and decides what drives. */
static bool read_rows(shell *sh, csv *data, rows *w, calc_error *error) {
    const bool FN = csv_find(data, "FN"), Fx = csv_find(data, "Fx"), dz = csv_find(data, "dz"),
               dx = csv_find(data, "dx");
    /* if one of a pair has its name, columns_take finds the other by dimension */
    const bool forces = FN && (Fx || !dx), places = dz && (dx || !(Fx || FN));
    *w = (rows){.data = data, .by = forces ? BY_FORCE : BY_DISPLACEMENT};
    w->normal_by = forces || places ? w->by : BY_NONE;
    if (forces && (!(w->normal = columns_take(data, "FN", DIM_FORCE, error)) ||
                   !(w->Fx = columns_take(data, "Fx", DIM_FORCE, error))))
        return false;
    if (places && !forces && !(w->normal = columns_take(data, "dz", DIM_LENGTH, error)))
        return false;
    if (places && !(w->dx = columns_take(data, "dx", DIM_LENGTH, error)))
        return false;
    if ((!forces && !places && !read_compared(sh, data, w, error)) || !csv_settle(data, error))
        return false;
    return !w->rig || (subtract_offset(sh, IN_D0, w->dx, data->rows, error) &&
                       subtract_offset(sh, IN_F0, w->Fx, data->rows, error));
}

/* Compares Fx and dx of the file with the states at the steps that its rows have become. */
enum { OF_FX, OF_DX, COMPARED_COLUMNS };

static bool compare_rows(shell *sh, const rows *w, comparison of[COMPARED_COLUMNS], calc_error *error) {
    scene *s = &sh->calc.scene;
    const size_t before = s->end.steps - w->data->rows;
    scene_trace t;
    run_view now;
    of[OF_FX].with = w->Fx;
    of[OF_DX].with = w->dx;
    if (!trace_begin(&t, s, watch_points(1), true, error))
        return false;
    while (trace_next(&t, error)) {
        const size_t at = trace_now(&t)->at.steps;
        run_view_now(t.run, t.levels, &now);
        const long double computed[] = {now.state.Fx, now.state.dx};
        for (int k = 0; k < COMPARED_COLUMNS && at >= before; k++)
            columns_differ(&of[k], at - before, computed[k]);
    }
    trace_end(&t);
    return !error->raised;
}

static void report_compared(shell *sh, const char *name, dim d, double rms) {
    char text[CALC_VALUE_TEXT];
    answer event;
    answer_begin(&event, &sh->set, sh->out);
    answer_event(&event, "compared");
    answer_string(&event, "of", name);
    answer_number(&event, "rms", rms);
    answer_done(&event);
    calc_value_text(d, rms, text);
    shell_note(sh, "%s of the file differs from the computed %s by %s (rms)", name, name, text);
}

/* If the file has both pairs, reports only columns that do not agree: the file may be of another scene. */
static void report_differences(shell *sh, const rows *w, const comparison of[COMPARED_COLUMNS]) {
    static const char *const names[] = {"Fx", "dx"};
    static const dim dims[] = {{1, 0, 0, 0}, {0, 1, 0, 0}};
    const bool both = w->normal_by == BY_FORCE;
    for (int k = 0; k < (both ? COMPARED_COLUMNS : OF_DX); k++) {
        const double rms = (double)columns_rms(&of[k]);
        if (!both || rms > SAME * of[k].largest)
            report_compared(sh, names[k], dims[k], rms);
    }
}

/* Reads mu after the press, on which a live mu may depend. */
static bool follow_file(shell *sh, csv *data, calc_error *error) {
    scene *s = &sh->calc.scene;
    rows w;
    comparison off[COMPARED_COLUMNS] = {{.with = NULL}};
    if (!read_rows(sh, data, &w, error))
        return false;
    const bool compared = w.Fx && w.dx;
    if (compared && !w.normal && columns_opposed(data, w.dx, w.Fx))
        return calc_fail(error, 0, 0,
                         "%s: Fx falls where dx grows: one of them has the other sign in the file",
                         data->path);
    const bool turned = w.normal_by == BY_FORCE && columns_turn_pull(data, w.normal), pressed = s->end.steps;
    if ((!pressed && !follow_press(sh, &w, error)) || !scene_friction(s, &w.mu, error) ||
        !follow_rows(sh, &w, !pressed, error) || (compared && !compare_rows(sh, &w, off, error)))
        return false;
    columns_say(sh, data, turned ? TURNED_FN : "");
    if (compared)
        report_differences(sh, &w, off);
    return true;
}

bool do_follow(shell *sh, lexer *lx, parsed *all) {
    static const char *const names[] = {"FN", "Fx", "dx", "c", NULL};
    csv data;
    const bool ok = columns_read(lx, all, &all->list[0], &data) && follow_file(sh, &data, lx->error);
    csv_free(&data);
    if (!ok)
        return given_place(lx->error, &all->list[0]);
    report_event(sh, "follow", names);
    return true;
}

/* ---- reset and undo ---------------------------------------------------------------------------- */

bool do_reset(shell *sh, lexer *lx, parsed *all) {
    (void)lx;
    scene_reset(&sh->calc.scene, parsed_clause(all, "all", 0) != NULL);
    return true;
}

bool do_undo(shell *sh, lexer *lx, parsed *all) {
    (void)all;
    return calc_undo(&sh->calc) || lex_fail(lx, "there is nothing to undo");
}
