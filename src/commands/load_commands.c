/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Commands of the load program: press, step, cycle, wear, follow, and the ways back. Each reads everything,
 * then changes everything or nothing. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "commands/columns.h"
#include "statement/answer.h"
#include "statement/command.h"
#include "statement/progress.h"

/* ---- reports ----------------------------------------------------------------------------------- */

enum { REPORTED = 8 }; /* quantities at most */

/* Programs are told of all; else a report is for who types. */
static bool reports(const shell *sh) {
    return sh->set.report == REPORT_ON ||
           (sh->set.report == REPORT_AUTO && (sh->interactive || sh->replaying || answer_is_data(&sh->set)));
}

/* What they are is found first: it may take its time, and show that. */
static void report_event(shell *sh, const char *event, const char *const *names) {
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
    progress_wipe();
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

/* Of another load: what has worn was of the last cycle. */
static void note_unworn(shell *sh, bool worn) {
    if (worn && !inputs_any(&sh->calc.scene.in, INPUT_BIT(IN_NW)))
        shell_note(sh, "Nw = 0 again: wear is that of the last cycle");
}

/* What a step or a cycle is given, by its word. */
typedef enum given { TANGENTIAL, NORMAL, SWING, PHASE, POINTS, TIMES } given;

static const struct given_row {
    const char *name;
    given is;
    load_by by; /* of a target */
} givens[] = {{"Fx", TANGENTIAL, BY_FORCE},
              {"dx", TANGENTIAL, BY_DISPLACEMENT},
              {"drig", TANGENTIAL, BY_RIG},
              {"FN", NORMAL, BY_FORCE},
              {"dz", NORMAL, BY_DISPLACEMENT},
              {"FA", TANGENTIAL, BY_FORCE},
              {"dxA", TANGENTIAL, BY_DISPLACEMENT},
              {"drigA", TANGENTIAL, BY_RIG},
              {"FNA", SWING, BY_NONE},
              {"phase", PHASE, BY_NONE},
              {"steps", POINTS, BY_NONE},
              {"times", TIMES, BY_NONE}};

static const struct given_row *given_of(const clause *a) {
    const struct given_row *row = givens;
    while (strcmp(row->name, a->name))
        row++; /* the rows of `step` and `cycle` have no other words */
    return row;
}

/* What a step or a cycle was given. last: the target that the error of the load belongs to. */
static void load_of(const said *s, load_step *step, cycle_extra *extra, const heard **last) {
    *last = NULL;
    for (const heard *h = s->list; h < s->list + s->count; h++) {
        const struct given_row *row = given_of(h->of);
        const double v = (double)h->v.v;
        *last = row->by ? h : *last;
        switch (row->is) {
        case TANGENTIAL:
            step->tangential = (unsigned char)row->by;
            step->tangential_value = v;
            step->relative |= h->increment ? RELATIVE_TANGENTIAL : 0;
            break;
        case NORMAL:
            step->normal = (unsigned char)row->by;
            step->normal_value = v;
            step->relative |= h->increment ? RELATIVE_NORMAL : 0;
            break;
        case SWING:
            step->normal_value = v;
            break;
        case PHASE:
            extra->phase = v;
            break;
        case POINTS:
            step->points = h->count;
            break;
        default:
            extra->times = h->count;
            break;
        }
    }
}

/* A live amplitude has its value in the scene as it is. */
static bool live_values(shell *sh, lexer *lx, said *s) {
    for (heard *h = s->list; h < s->list + s->count; h++) {
        const clause *a = h->of;
        if (!h->live)
            continue;
        if (!definition_value(&sh->calc, (definition *)h->live, &h->v, lx->error) ||
            !value_dim(lx, a->name, h->hole[0].at, h->hole[0].len, h->v, a->d))
            return heard_place(lx->error, h);
        fret_status st = input_status((input)(a->in - 1), (double)h->v.v);
        if (!calc_input_status(lx->error, a->in - 1, &st))
            return heard_place(lx->error, h);
    }
    return true;
}

static bool read_targets(shell *sh, lexer *lx, bool cycle, said *s, load_step *step, cycle_extra *extra,
                         const heard **last) {
    *step = (load_step){.kind = cycle ? LOAD_CYCLE : LOAD_STEP};
    *extra = (cycle_extra){.times = 1};
    if (cycle && !live_values(sh, lx, s))
        return false;
    load_of(s, step, extra, last);
    return step->tangential || (!cycle && step->normal) ||
           said_lacks(lx, s, cycle ? "cycle by what amplitude?" : "step to where?");
}

bool read_load(shell *sh, lexer *lx, load_step *step, cycle_extra *extra, counted *bound[INPUTS]) {
    const command *c = command_find(lx->text + lx->at, lx->len);
    said s;
    const heard *last;
    const bool cycle = lex_is(lx, "cycle");
    lex_next(lx);
    bool ok =
        said_read_some(sh, lx, command_form(c), &s) && read_targets(sh, lx, cycle, &s, step, extra, &last);
    for (heard *h = s.list; ok && h < s.list + s.count; h++)
        if (h->live)
            bound[h->of->in - 1] = counted_hold(h->live);
    said_drop(sh, &s);
    return ok;
}

bool do_press(shell *sh, lexer *lx, said *all) {
    static const char *const names[] = {"FN", "a", "dz", NULL};
    if (!all->count)
        return said_lacks(lx, all, "press by what?");
    const heard *by = &all->list[0];
    const bool worn = inputs_any(&sh->calc.scene.in, INPUT_BIT(IN_NW));
    const load_step step = {.kind = LOAD_PRESS,
                            .normal = (unsigned char)press_by((input)(by->of->in - 1)),
                            .normal_value = (double)by->v.v};
    if (!scene_load(&sh->calc.scene, &step, NULL, lx->error)) {
        const char *of = lx->error->kind == ERROR_STATUS ? lx->error->status.quantity : NULL;
        return of && !strcmp(of, by->of->name) ? heard_place(lx->error, by) : false;
    }
    report_event(sh, "press", names);
    note_unworn(sh, worn);
    return true;
}

bool do_step(shell *sh, lexer *lx, said *all) {
    static const char *const names[] = {"Fx", "dx", "c", "drig", NULL}, *const oblique[] = {"FN",   "Fx",
                                                                                            "dx",   "c",
                                                                                            "drig", NULL};
    load_step step;
    cycle_extra extra;
    const heard *last;
    if (!read_targets(sh, lx, false, all, &step, &extra, &last))
        return false;
    if (!scene_load(&sh->calc.scene, &step, NULL, lx->error))
        return heard_place(lx->error, last);
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

bool do_cycle(shell *sh, lexer *lx, said *all) {
    static const char *const names[] = {"dW", "Fx", "dx", "c", "drig", NULL};
    load_step step;
    cycle_extra extra;
    const heard *last;
    counted *bound[INPUTS] = {NULL};
    bool live = false, worn = inputs_any(&sh->calc.scene.in, INPUT_BIT(IN_NW));
    if (!read_targets(sh, lx, true, all, &step, &extra, &last))
        return false;
    scene_mark before;
    scene_save(&sh->calc.scene, &before, false);
    bool ok = scene_load(&sh->calc.scene, &step, &extra, lx->error) || heard_place(lx->error, last);
    const bool loaded = ok;
    for (const heard *h = all->list; ok && h < all->list + all->count; h++)
        if (h->live) {
            bound[h->of->in - 1] = h->live;
            live = true;
        }
    if (ok && live)
        ok = scene_edit(&sh->calc.scene, bind_all, bound, lx->error);
    if (loaded && !ok)
        scene_back(&sh->calc.scene, &before);
    else
        scene_drop(&before);
    if (ok && said_of(all, "phase", 0) && !said_of(all, "FNA", 0))
        shell_note(sh, "phase does nothing without FNA");
    if (ok)
        report_event(sh, "cycle", names);
    note_unworn(sh, ok && worn);
    return ok;
}

/* ---- wear -------------------------------------------------------------------------------------- */

/* What is said of it: the law, by a definition or a value, or the cycles. */
typedef struct wearing {
    bool none, law, cycles;
    counted *live;
    double alpha, Nw;
} wearing;

static void put_wear(inputs *in, void *context) {
    const wearing *w = context;
    if (w->none)
        inputs_unset(in, INPUT_BIT(IN_ALPHA_W) | INPUT_BIT(IN_NW));
    if (w->law)
        inputs_put(in, IN_ALPHA_W, w->live ? in->v[IN_ALPHA_W] : w->alpha);
    if (w->live)
        inputs_bind(in, IN_ALPHA_W, counted_hold(w->live));
    if (w->cycles)
        inputs_put(in, IN_NW, w->Nw);
}

/* K/(mu*H) with numbers for K and H, to follow mu. */
static counted *archard(shell *sh, const heard *K, const heard *H, calc_error *error) {
    char text[100];
    counted *out = NULL;
    lexer own;
    snprintf(text, sizeof text, "%.17g/(mu*%.17g Pa)", (double)K->v.v, (double)H->v.v);
    lex_start(&own, text, strlen(text), error);
    calc_bind(&sh->calc, &own, IN_ALPHA_W, &out);
    return out;
}

/* What is left in the end, which changes nothing. */
static bool tell_limit(shell *sh, calc_error *error) {
    scene *s = &sh->calc.scene;
    fret_wear *limit;
    fret_real c, b;
    if (!scene_wear_limit(s, &limit, error))
        return false;
    fret_wear_ring(limit, &c, &b);
    answer a;
    answer_begin(&a, &sh->set, sh->out);
    answer_page(&a, "limit");
    answer_quantity(&a, "c", (value){c, DIM_LENGTH});
    answer_quantity(&a, "a", (value){b, DIM_LENGTH});
    answer_quantity(&a, "Vwear", (value){fret_wear_volume(limit), quantity_find("Vwear", 5)->d});
    answer_done(&a);
    answer_end(&a, true);
    fret_wear_free(limit);
    return true;
}

static bool read_law(shell *sh, lexer *lx, said *s, wearing *w) {
    const heard *K = said_of(s, "K", 0), *H = said_of(s, "H", 0), *alpha = said_of(s, "alpha", 0);
    if (!alpha && !K != !H)
        return lex_fail(lx, "%s is missing: wear K=1e-4 H=2 GPa", K ? "H" : "K");
    w->law = alpha || K;
    if (K)
        w->live = archard(sh, K, H, lx->error);
    else if (alpha)
        w->live = counted_hold(alpha->live);
    w->alpha = alpha ? (double)alpha->v.v : 0;
    return !K || w->live;
}

static bool read_cycles(shell *sh, lexer *lx, const heard *cycles, wearing *w) {
    long double Nw = 0;
    if (!calc_takes(&sh->calc, IN_NW, lx->error) || !scene_get(&sh->calc.scene, IN_NW, &Nw, lx->error))
        return false;
    w->cycles = true;
    w->Nw = (double)Nw + cycles->count;
    return true;
}

bool do_wear(shell *sh, lexer *lx, said *all) {
    static const char *const names[] = {"Nw", "Vwear", "a", "c", "p0", NULL};
    const heard *cycles = said_of(all, "cycles", 0);
    wearing w = {.none = said_of(all, "none", 0)};
    bool ok = all->count || said_lacks(lx, all, "wear by what law?");
    if (said_of(all, "limit", 0))
        ok = tell_limit(sh, lx->error);
    else if (ok)
        ok = (cycles ? read_cycles(sh, lx, cycles, &w) : read_law(sh, lx, all, &w)) &&
             scene_edit(&sh->calc.scene, put_wear, &w, lx->error);
    counted_drop(w.live);
    if (ok && cycles)
        report_event(sh, "wear", names);
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

static const followed kinds[] = {{{"FN", "Fx"}, BY_FORCE, {1, 0, 0, 0}, "FN [N],Fx [N]"},
                                 {{"dz", "dx"}, BY_DISPLACEMENT, {0, 1, 0, 0}, "dz [um],dx [um]"}};
enum { KINDS = sizeof kinds / sizeof *kinds };

enum { AT_ONCE = 4096 }; /* rows; then it is told how far it has come */

/* Rows as they are followed. Of those that have both pairs: loss, their W, and driver, by which pair each is;
 * NULL: all by `kind`. */
typedef struct rows {
    csv *data;
    const followed *kind;
    csv_values *column[KINDS][2], *compared; /* by kind: the normal and the tangential one */
    const double *normal[KINDS], *tangential[KINDS];
    const double *loss;
    const unsigned char *driver;
    bool rig; /* d_x is a reading at it */
} rows;

static bool follow_press(shell *sh, const rows *w, calc_error *error) {
    const followed *kind = w->kind;
    const size_t k = (size_t)(kind - kinds);
    const load_step press = {.kind = LOAD_PRESS, .normal = kind->by, .normal_value = w->normal[k][0]};
    if (!(press.normal_value > 0) || w->tangential[k][0] != 0)
        return calc_fail(
            error, 0, 0,
            "%s: there is no load yet: press first, or begin with a row that presses (%s > 0, %s = 0)",
            w->data->path, kind->name[0], kind->name[1]);
    return scene_load(&sh->calc.scene, &press, NULL, error);
}

/* Rows become steps. */
static bool follow_rows(shell *sh, const rows *w, size_t row, calc_error *error) {
    const csv *data = w->data;
    for (size_t count; row < data->rows; row += count) {
        const size_t k = w->driver ? w->driver[row] : (size_t)(w->kind - kinds);
        const load_step step = {.kind = LOAD_STEP,
                                .normal = w->normal[k] ? kinds[k].by : BY_NONE,
                                .tangential = w->rig ? BY_RIG : kinds[k].by};
        size_t bad;
        for (count = 1; count < AT_ONCE && row + count < data->rows; count++)
            if (w->driver && w->driver[row + count] != k)
                break;
        progress_part((double)row / (double)data->rows);
        bool ok = scene_load_rows(&sh->calc.scene, step, w->normal[k] ? w->normal[k] + row : NULL,
                                  w->tangential[k] + row, count, &bad, error);
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

/* ---- of both pairs, as `history` writes them ---- */

enum { NAMED = 2 * KINDS + 1 };
#define SAME 1e-4L /* what the digits of a table as text may move */

/* The largest of FN, Fx, dz, dx and W. */
typedef struct sizes {
    double of[NAMED];
} sizes;

/* How far the state is from what the row names, as a part of the largest values. Ways by force and by
 * displacement may end in the same state: the energy tells them apart. */
static long double distance_to_row(const fret_contact *m, const rows *w, size_t row, fret_real loss,
                                   const sizes *most) {
    fret_state now;
    fret_contact_forces(m, &now);
    const double lost = row ? w->loss[row] - w->loss[row - 1] : 0;
    const long double off[NAMED] = {(long double)now.FN - w->normal[0][row],
                                    (long double)now.Fx - w->tangential[0][row],
                                    (long double)now.dz - w->normal[1][row],
                                    (long double)now.dx - w->tangential[1][row], (long double)loss - lost};
    long double worst = 0;
    for (size_t i = 0; i < NAMED; i++)
        if (off[i] != 0)
            worst = fmaxl(worst, fabsl(off[i]) / most->of[i]);
    return worst;
}

/* Of the last, the state before, makes that behind the row: by the pair that comes nearer to what it names.
 */
static bool choose_driver(fret_contact *m[KINDS + 1], const rows *w, size_t row, const sizes *most,
                          unsigned char *driver, fret_status *st) {
    static const fret_normal_target normal[KINDS] = {FRET_TO_FORCE, FRET_TO_DEPTH};
    static const fret_tangential_target tangential[KINDS] = {FRET_TO_FX, FRET_TO_DX};
    long double least = INFINITY;
    for (unsigned char k = 0; k < KINDS; k++) {
        const fret_step step = {normal[k], tangential[k], w->normal[k][row], w->tangential[k][row]};
        *st = fret_contact_copy(m[k], m[KINDS]);
        if (st->code)
            return false;
        const fret_status taken = fret_contact_step(m[k], &step);
        if (taken.code == FRET_NO_MEMORY)
            *st = taken;
        if (st->code)
            return false;
        const long double off =
            taken.code ? INFINITY : distance_to_row(m[k], w, row, fret_contact_last_loss(m[k]), most);
        if (off < least) {
            least = off;
            *driver = k;
        }
    }
    if (!(least <= SAME))
        return false;
    fret_contact *now = m[*driver];
    m[*driver] = m[KINDS];
    m[KINDS] = now;
    return true;
}

static double largest_of(const double *v, size_t n) {
    double most = 0;
    for (size_t i = 0; i < n; i++)
        most = fmax(most, fabs(v[i]));
    return most;
}

static bool choose_drivers(shell *sh, const rows *w, size_t row, unsigned char *driver, calc_error *error) {
    const size_t n = w->data->rows;
    const sizes most = {{largest_of(w->normal[0], n), largest_of(w->tangential[0], n),
                         largest_of(w->normal[1], n), largest_of(w->tangential[1], n),
                         largest_of(w->loss, n)}};
    const fret_contact *now;
    fret_contact *m[KINDS + 1] = {NULL};
    fret_status st = {.code = FRET_OK};
    if (!scene_straight(&sh->calc.scene, &now, error))
        return false;
    for (size_t k = 0; k <= KINDS && !st.code; k++)
        st = fret_contact_make(fret_contact_normal(now), fret_contact_friction(now), FRET_EXACT, &m[k]);
    if (!st.code)
        st = fret_contact_copy(m[KINDS], now);
    bool ok = !st.code && (row == 0 || distance_to_row(m[KINDS], w, 0, 0, &most) <= SAME);
    size_t i = ok ? row : 0;
    while (ok && i < n && !shell_stop) {
        if (i % AT_ONCE == 0)
            progress_part(0.5 * (double)i / (double)n);
        ok = choose_driver(m, w, i, &most, &driver[i], &st);
        i += ok;
    }
    for (size_t k = 0; k <= KINDS; k++)
        fret_contact_free(m[k]);
    if (shell_stop)
        return calc_interrupted(error);
    return ok ||
           (calc_status(error, &st) &&
            calc_fail(error, 0, 0, "%s: FN,Fx and dz,dx do not agree in this scene (row %zu): leave one pair",
                      w->data->path, i + 1));
}

static bool read_pair(csv *data, const followed *kind, rows *w, calc_error *error) {
    const size_t k = (size_t)(kind - kinds);
    csv_values *normal = columns_take(data, kind->name[0], kind->d, error),
               *tangential = normal ? columns_take(data, kind->name[1], kind->d, error) : NULL;
    w->column[k][0] = normal;
    w->column[k][1] = tangential;
    return tangential != NULL;
}

/* What the contact reads where a rig has offsets. */
static bool take_off(shell *sh, input offset, csv_values *v, size_t n, calc_error *error) {
    long double by;
    if (!scene_get(&sh->calc.scene, offset, &by, error))
        return false;
    for (size_t i = 0; i < n; i++)
        v->v[i] -= (double)by;
    return true;
}

/* dx or drig drives at constant F_N, and F_x is compared. */
static bool read_compared(shell *sh, csv *data, rows *w, calc_error *error) {
    w->rig = columns_at_rig(sh, data);
    csv_values *dx = columns_take(data, loop_column(w->rig), DIM_LENGTH, error),
               *Fx = dx ? columns_take(data, "Fx", DIM_FORCE, error) : NULL;
    w->kind = &kinds[1];
    w->column[1][1] = dx;
    w->compared = Fx;
    if (!(csv_has(data, "dx") || w->rig) || !csv_has(data, "Fx"))
        calc_append(&sh->calc, error, " (FN,Fx or dz,dx are followed; dx,Fx or drig,Fx compared)");
    if (!Fx)
        return false;
    return sh->calc.scene.end.steps || calc_missing(error, IN_FN);
}

static bool follow_all(shell *sh, rows *w, bool both, calc_error *error) {
    unsigned char *driver = NULL;
    size_t row = 0;
    if (!sh->calc.scene.end.steps) {
        if (!follow_press(sh, w, error))
            return false;
        row = 1;
    }
    if (both && !(driver = malloc(w->data->rows)))
        return calc_no_memory(error);
    w->driver = driver;
    const bool ok = (!both || choose_drivers(sh, w, row, driver, error)) && follow_rows(sh, w, row, error);
    free(driver);
    return ok;
}

static bool read_rows(shell *sh, csv *data, rows *w, bool *both, calc_error *error) {
    const bool FN = csv_has(data, "FN"), Fx = csv_has(data, "Fx"), dz = csv_has(data, "dz"),
               dx = csv_has(data, "dx");
    /* of a pair one may have its name, and the other is the one of its dimension */
    const bool forces = FN && (Fx || !dx), places = dz && (dx || !(Fx || FN));
    const csv_values *loss = NULL;
    *both = forces && places;
    *w = (rows){.data = data, .kind = places && !forces ? &kinds[1] : &kinds[0]};
    if (*both && !csv_has(data, "W"))
        return calc_fail(error, 0, 0, "%s has FN,Fx and dz,dx, but no W: leave one pair", data->path);
    if ((!forces && !places && !read_compared(sh, data, w, error)) ||
        (forces && !read_pair(data, &kinds[0], w, error)) ||
        (places && !read_pair(data, &kinds[1], w, error)) ||
        (*both && !(loss = columns_take(data, "W", DIM_ENERGY, error))) || !csv_settle(data, error))
        return false;
    for (size_t k = 0; k < KINDS; k++) {
        w->normal[k] = w->column[k][0] ? w->column[k][0]->v : NULL;
        w->tangential[k] = w->column[k][1] ? w->column[k][1]->v : NULL;
    }
    w->loss = loss ? loss->v : NULL;
    return !w->rig || (take_off(sh, IN_D0, w->column[1][1], data->rows, error) &&
                       take_off(sh, IN_F0, w->compared, data->rows, error));
}

/* Of the rows that have been followed last. */
static bool compare_rows(shell *sh, const rows *w, double *rms, calc_error *error) {
    scene *s = &sh->calc.scene;
    const size_t count = w->data->rows, before = s->end.steps - count;
    scene_trace t;
    sight now;
    long double squares = 0;
    if (!trace_begin(&t, s, watch_points(1), true, error))
        return false;
    for (size_t i = 0; trace_next(&t, error); i++)
        if (i >= before) {
            run_sight(trace_now(&t), &now);
            const long double off = now.state.Fx - w->compared->v[i - before];
            squares += off * off;
        }
    trace_end(&t);
    *rms = (double)sqrtl(squares / (long double)count);
    return !error->raised;
}

static void report_compared(shell *sh, double rms) {
    char text[CALC_VALUE_TEXT];
    answer event;
    answer_begin(&event, &sh->set, sh->out);
    answer_event(&event, "compared");
    answer_number(&event, "rms", rms);
    answer_done(&event);
    calc_value_text(DIM_FORCE, rms, text);
    shell_note(sh, "Fx of the file is %s (rms) from Fx here", text);
}

static bool follow_file(shell *sh, csv *data, calc_error *error) {
    rows w;
    bool both, turned = false;
    scene_mark before;
    double mu, rms = 0;
    if (!read_rows(sh, data, &w, &both, error))
        return false;
    if (w.compared && columns_opposed(data, w.column[1][1], w.compared))
        return calc_fail(error, 0, 0,
                         "%s: Fx falls where dx grows: one of them has the other sign in the file",
                         data->path);
    turned = columns_turn_pull(data, w.column[0][0]);
    if (!sh->calc.scene.in.bound[IN_MU] && !scene_friction(&sh->calc.scene, &mu, error))
        return false; /* a live one may depend on the press that is to come */
    scene_save(&sh->calc.scene, &before, false);
    if (!follow_all(sh, &w, both, error) || (w.compared && !compare_rows(sh, &w, &rms, error))) {
        scene_back(&sh->calc.scene, &before);
        return false;
    }
    scene_drop(&before);
    columns_say(sh, data, turned ? TURNED_FN : "");
    if (w.compared)
        report_compared(sh, rms);
    return true;
}

bool do_follow(shell *sh, lexer *lx, said *all) {
    static const char *const names[] = {"FN", "Fx", "dx", "c", NULL};
    csv data;
    const bool ok = columns_read(lx, all, &all->list[0], &data) && follow_file(sh, &data, lx->error);
    csv_free(&data);
    if (!ok)
        return heard_place(lx->error, &all->list[0]);
    report_event(sh, "follow", names);
    return true;
}

/* ---- the ways back ----------------------------------------------------------------------------- */

bool do_reset(shell *sh, lexer *lx, said *all) {
    (void)lx;
    scene_reset(&sh->calc.scene, said_of(all, "all", 0) != NULL);
    return true;
}

bool do_undo(shell *sh, lexer *lx, said *all) {
    (void)all;
    return calc_undo(&sh->calc) || lex_fail(lx, "there is nothing to take back");
}
