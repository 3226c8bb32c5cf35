/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Commands of the load program: press, step, cycle, follow, and the ways back. Each reads everything, then
 * changes everything or nothing. */
#include <string.h>

#include "calc/csv.h"
#include "shell/command.h"
#include "shell/output.h"
#include "shell/progress.h"

/* ---- reports ----------------------------------------------------------------------------------- */

enum { REPORTED = 8 }; /* quantities at most */

/* Events are data where answers are JSON; else they are for who types. */
static bool reports(const shell *sh) {
    return sh->set.report == REPORT_ON ||
           (sh->set.report == REPORT_AUTO &&
            (sh->interactive || sh->replaying || sh->set.format == FORMAT_JSON));
}

/* What they are is found first: it may take its time, and show that. */
static void report_event(shell *sh, const char *event, const char *const *names) {
    const quantity *of[REPORTED];
    value v[REPORTED];
    size_t count = 0;
    if (!reports(sh))
        return;
    for (; *names; names++) {
        calc_error error;
        error_clear(&error);
        of[count] = quantity_find(*names, strlen(*names));
        v[count] = (value){0, of[count]->d};
        count += quantity_get(of[count], &sh->calc.scene, &v[count].v, &error);
    }
    progress_wipe();
    const bool json = sh->set.format == FORMAT_JSON;
    if (!json && sh->set.report == REPORT_AUTO)
        shell_aside(sh, sh->out);
    if (json)
        fprintf(sh->out, "{\"event\":\"%s\"", event);
    for (size_t i = 0; i < count; i++) {
        char text[160];
        format_value(&sh->set, v[i], text, sizeof text);
        if (json)
            fprintf(sh->out, ",\"%s\":%.17g", of[i]->name, (double)v[i].v);
        else
            fprintf(sh->out, "%s%s = %s", i ? ", " : "  ", of[i]->name, text);
    }
    fputs(json ? "}\n" : "\n", sh->out);
}

/* ---- press, step, cycle ------------------------------------------------------------------------ */

static load_by by_of(const char *name) {
    return *name == 'F' ? BY_FORCE : *name == 'd' ? BY_DISPLACEMENT : BY_RADIUS;
}

/* What a step or a cycle was given. last: the target that the error of the load belongs to. */
static void load_of(const arg_list *list, const arg_value v[ARGS], load_step *step, cycle_extra *extra,
                    const arg_value **last) {
    *last = NULL;
    for (const arg *a = list->args; a->kind; a++) {
        const arg_value *x = &v[a - list->args];
        if (!x->given)
            continue;
        if (a->kind == ARG_COUNT) {
            *(a->name[0] == 's' ? &step->points : &extra->times) = x->count;
        } else if (a->group == GROUP_TANGENTIAL) {
            step->tangential = (unsigned char)by_of(a->name);
            step->tangential_value = (double)x->v.v;
            step->relative |= x->increment ? RELATIVE_TANGENTIAL : 0;
        } else if (a->group == GROUP_NORMAL) {
            step->normal = (unsigned char)by_of(a->name);
            step->normal_value = (double)x->v.v;
            step->relative |= x->increment ? RELATIVE_NORMAL : 0;
        } else {
            *(a->in == 1 + IN_PHASE ? &extra->phase : &step->normal_value) = (double)x->v.v;
        }
        if (a->group && (!*last || x->at > (*last)->at))
            *last = x;
    }
}

/* A live amplitude has its value in the scene as it is. */
static bool live_values(shell *sh, lexer *lx, const arg_list *list, arg_value v[ARGS]) {
    for (const arg *a = list->args; a->kind; a++) {
        arg_value *x = &v[a - list->args];
        if (!x->live)
            continue;
        if (!definition_value(&sh->calc, (definition *)x->live, &x->v, lx->error) ||
            !value_dim(lx, a->name, x->value_at, x->value_len, x->v,
                       quantity_of_input((input)(a->in - 1))->d))
            return arg_place(lx->error, x);
        fret_status st = input_status((input)(a->in - 1), (double)x->v.v);
        if (!calc_input_status(lx->error, a->in - 1, &st))
            return arg_place(lx->error, x);
    }
    return true;
}

static bool read_targets(shell *sh, lexer *lx, const command *self, arg_value v[ARGS], load_step *step,
                         cycle_extra *extra, const arg_value **last) {
    const arg_list list = command_args(self);
    const bool cycle = self->run == do_cycle;
    *step = (load_step){.kind = cycle ? LOAD_CYCLE : LOAD_STEP};
    *extra = (cycle_extra){.times = 1};
    if (!args_read_some(sh, lx, &list, v, NULL)) {
        args_drop(&list, v);
        return false;
    }
    bool ok = !cycle || live_values(sh, lx, &list, v);
    load_of(&list, v, step, extra, last);
    if (ok && (cycle ? !step->tangential : !step->tangential && !step->normal))
        ok = lex_fail(lx, "%s usage: %s %s", cycle ? "cycle by what amplitude?" : "step to where?",
                      self->name, self->usage);
    if (!ok)
        args_drop(&list, v);
    return ok;
}

bool read_load(shell *sh, lexer *lx, load_step *step, cycle_extra *extra, counted *bound[INPUTS]) {
    const command *c = command_find(lx->text + lx->at, lx->len);
    arg_value v[ARGS];
    const arg_value *last;
    lex_next(lx);
    if (!read_targets(sh, lx, c, v, step, extra, &last))
        return false;
    for (const arg *a = c->args; a->kind; a++)
        if (v[a - c->args].live)
            bound[a->in - 1] = v[a - c->args].live;
    return true;
}

bool do_press(shell *sh, lexer *lx, const command *self) {
    static const char *const names[] = {"FN", "a", "dz", NULL};
    const arg_list list = command_args(self);
    arg_value v[ARGS];
    if (!at_argument(lx))
        return lex_fail(lx, "press by what? usage: %s %s", self->name, self->usage);
    if (!args_read(sh, lx, &list, v, NULL))
        return false;
    size_t i = 0;
    while (!v[i].given)
        i++;
    const load_step step = {.kind = LOAD_PRESS,
                            .normal = (unsigned char)by_of(self->args[i].name),
                            .normal_value = (double)v[i].v.v};
    if (!scene_load(&sh->calc.scene, &step, NULL, lx->error)) {
        const char *of = lx->error->kind == ERROR_STATUS ? lx->error->status.quantity : NULL;
        return of && !strcmp(of, self->args[i].name) ? arg_place(lx->error, &v[i]) : false;
    }
    report_event(sh, "press", names);
    return true;
}

bool do_step(shell *sh, lexer *lx, const command *self) {
    static const char *const names[] = {"Fx", "dx", "c", NULL}, *const oblique[] = {"FN", "Fx", "dx", "c",
                                                                                    NULL};
    arg_value v[ARGS];
    load_step step;
    cycle_extra extra;
    const arg_value *last;
    const arg_list list = command_args(self);
    if (!read_targets(sh, lx, self, v, &step, &extra, &last) || !args_end(lx, &list))
        return false;
    if (!scene_load(&sh->calc.scene, &step, NULL, lx->error))
        return arg_place(lx->error, last);
    if (reports(sh)) /* a step may wait until it is asked for */
        report_event(sh, "step", step.normal ? oblique : names);
    if (shell_stop) { /* run_command takes back what other loads are */
        calc_undo(&sh->calc);
        return calc_interrupted(lx->error);
    }
    shell_pressed(sh, &step);
    return true;
}

static void bind_all(inputs *in, void *context) {
    counted **bound = context;
    for (input i = 0; i < INPUTS; i++)
        if (bound[i])
            inputs_bind(in, i, counted_hold(bound[i]));
}

bool do_cycle(shell *sh, lexer *lx, const command *self) {
    static const char *const names[] = {"dW", "Fx", "dx", "c", NULL};
    arg_value v[ARGS];
    load_step step;
    cycle_extra extra;
    const arg_value *last;
    const arg_list list = command_args(self);
    counted *bound[INPUTS] = {NULL};
    bool live = false;
    if (!read_targets(sh, lx, self, v, &step, &extra, &last))
        return false;
    scene_mark before;
    scene_save(&sh->calc.scene, &before, false);
    bool ok = args_end(lx, &list) &&
              (scene_load(&sh->calc.scene, &step, &extra, lx->error) || arg_place(lx->error, last));
    const bool loaded = ok;
    for (const arg *a = self->args; ok && a->kind; a++)
        if (v[a - self->args].live) {
            bound[a->in - 1] = v[a - self->args].live;
            live = true;
        }
    if (ok && live)
        ok = scene_edit(&sh->calc.scene, bind_all, bound, lx->error);
    if (loaded && !ok)
        scene_back(&sh->calc.scene, &before);
    else
        scene_drop(&before);
    args_drop(&list, v);
    if (ok)
        report_event(sh, "cycle", names);
    return ok;
}

/* ---- follow ------------------------------------------------------------------------------------ */

/* What the columns of a history may be. */
typedef struct followed {
    const char *name[2];
    unsigned char by;
    dim d;
    const char *example;
} followed;

static const followed kinds[] = {{{"FN", "Fx"}, BY_FORCE, {1, 0, 0}, "FN [N],Fx [N]"},
                                 {{"dz", "dx"}, BY_DISPLACEMENT, {0, 1, 0}, "dz [um],dx [um]"}};

enum { AT_ONCE = 4096 }; /* rows; then it is told how far it has come */

/* Rows become steps; the first one presses where nothing is pressed yet. */
static bool follow_rows(shell *sh, const csv *data, const followed *kind, const double *normal,
                        const double *tangential, calc_error *error) {
    scene *s = &sh->calc.scene;
    load_step step = {.kind = LOAD_STEP, .normal = kind->by, .tangential = kind->by};
    size_t row = 0;
    if (!s->end.steps) {
        const load_step press = {.kind = LOAD_PRESS, .normal = kind->by, .normal_value = normal[0]};
        if (!(normal[0] > 0) || tangential[0] != 0)
            return calc_fail(
                error, 0, 0,
                "%s: there is no load yet: press first, or begin with a row that presses (%s > 0, %s = 0)",
                data->path, kind->name[0], kind->name[1]);
        if (!scene_load(s, &press, NULL, error))
            return false;
        row = 1;
    }
    for (size_t count; row < data->rows; row += count) {
        size_t bad;
        count = data->rows - row < AT_ONCE ? data->rows - row : AT_ONCE;
        progress_part((double)row / (double)data->rows);
        bool ok = scene_load_rows(s, step, normal + row, tangential + row, count, &bad, error);
        if (ok && shell_stop)
            ok = calc_interrupted(error);
        if (!ok) {
            if (!error->stop)
                calc_append(&sh->calc, error, " (row %zu of %.200s)", row + bad + 1, data->path);
            return false;
        }
    }
    progress_part(-1); /* what springs make of it is not known yet */
    return true;
}

static bool of_dimension(const csv *data, const csv_values *read, const followed *kind, calc_error *error) {
    char wants[128], is[128];
    if (dim_equal(read->d, kind->d))
        return true;
    if (!read->has_unit)
        return calc_fail(error, 0, 0, "%s: the columns need units in the header, such as %s", data->path,
                         kind->example);
    dim_describe(kind->d, wants, sizeof wants);
    dim_describe(read->d, is, sizeof is);
    return calc_fail(error, 0, 0, "%s: column %s is %s, not %s, by the unit in the header", data->path,
                     read->name, is, wants);
}

static bool follow(shell *sh, const csv *data, calc_error *error) {
    const followed *kind =
        csv_has(data, kinds[1].name[0]) && csv_has(data, kinds[1].name[1]) ? &kinds[1] : &kinds[0];
    char names[CALC_ERROR_TEXT / 2];
    scene_mark before;
    double mu;
    csv_names(data, names, sizeof names);
    if (!csv_has(data, kind->name[0]) || !csv_has(data, kind->name[1]))
        return calc_fail(error, 0, 0, "%s: the columns must be FN,Fx or dz,dx, not %s", data->path, names);
    if (kind == &kinds[1] && csv_has(data, "FN") && csv_has(data, "Fx"))
        return calc_fail(error, 0, 0, "%s has FN,Fx and dz,dx: leave one pair", data->path);
    const csv_values *normal = csv_column(data, kind->name[0], error),
                     *tangential = normal ? csv_column(data, kind->name[1], error) : NULL;
    if (!tangential)
        return false;
    if (!of_dimension(data, normal, kind, error) || !of_dimension(data, tangential, kind, error))
        return false;
    if (!sh->calc.scene.in.bound[IN_MU] && !scene_friction(&sh->calc.scene, &mu, error))
        return false; /* a live one may depend on the press that is to come */
    scene_save(&sh->calc.scene, &before, false);
    if (!follow_rows(sh, data, kind, normal->v, tangential->v, error)) {
        scene_back(&sh->calc.scene, &before);
        return false;
    }
    scene_drop(&before);
    return true;
}

bool do_follow(shell *sh, lexer *lx, const command *self) {
    static const char *const names[] = {"FN", "Fx", "dx", "c", NULL};
    const arg_list list = command_args(self);
    char name[ARG_FILE_NAME];
    arg_value v[ARGS];
    csv data;
    if (!args_read(sh, lx, &list, v, name))
        return false;
    bool ok = csv_read(name, &shell_stop, &data, lx->error) && follow(sh, &data, lx->error);
    csv_free(&data);
    if (!ok) {
        lx->error->at = v[0].value_at;
        lx->error->len = v[0].value_len;
        return false;
    }
    report_event(sh, "follow", names);
    return true;
}

/* ---- the ways back ----------------------------------------------------------------------------- */

bool do_reset(shell *sh, lexer *lx, const command *self) {
    const arg_list list = command_args(self);
    arg_value v[ARGS];
    if (!args_read(sh, lx, &list, v, NULL))
        return false;
    scene_reset(&sh->calc.scene, v[0].given);
    return true;
}

bool do_undo(shell *sh, lexer *lx, const command *self) {
    (void)self;
    return at_end(lx) && (calc_undo(&sh->calc) || lex_fail(lx, "there is nothing to take back"));
}
