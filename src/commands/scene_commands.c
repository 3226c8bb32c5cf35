/* SPDX-License-Identifier: GPL-3.0-or-later */
/* material, second, geometry, friction, rig, bulk, wear. Each reads all, then sets inputs or nothing. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "commands/columns.h"
#include "measured/apex.h"
#include "scene/presets.h"
#include "statement/answer.h"
#include "statement/command.h"
#include "study/smooth.h"

/* ---- gathering changes -------------------------------------------------------------------------- */

/* Changes of the inputs, gathered before any is made; `apply` makes them. */
typedef struct edit {
    bool has[INPUTS]; /* has a value in v */
    double v[INPUTS];
    counted *bound[INPUTS];   /* live definitions, borrowed; or NULL */
    input_set clear;          /* inputs to unset first */
    second_body second;       /* used if `clear` has inputs of the second body */
    const geometry *geometry; /* or NULL: it stays; with: */
    double radii[2];          /* R1 and R2; 0: not given */
    const fret_gap *sum;
    shared_table *table;
} edit;

#define OF_MATERIAL (INPUT_BIT(IN_NU) | INPUT_BIT(IN_K) | INPUT_BIT(IN_C0) | INPUT_BIT(IN_YIELD))
#define OF_SECOND (INPUT_MODULUS_2 | INPUT_BIT(IN_NU_2) | INPUT_BIT(IN_YIELD_2))

static void edit_put(edit *e, input in, long double v) {
    e->has[in] = true;
    e->v[in] = (double)v;
}

static void apply(inputs *in, void *context) {
    const edit *e = context;
    inputs_unset(in, e->clear);
    if (e->clear & OF_SECOND)
        in->second = e->second;
    if (e->geometry)
        inputs_geometry(in, e->geometry, e->sum, e->table);
    for (input i = 0; i < INPUTS; i++)
        if (e->has[i])
            inputs_put(in, i, e->v[i]);
    for (input i = 0; i < INPUTS; i++)
        if (e->bound[i]) {
            inputs_put(in, i, in->v[i]);
            inputs_bind(in, i, counted_hold(e->bound[i]));
        }
    for (int i = 0; i < 2 && e->radii[i] != 0; i++)
        in->radii[i] = e->radii[i];
}

static bool has(const edit *e, input in) {
    return e->has[in] || e->bound[in];
}

static bool has_second(const edit *e) {
    return has(e, IN_E0_2) || has(e, IN_G0_2) || has(e, IN_NU_2);
}

/* The values of a material, for the first body (0) or the second (1). */
static void put_preset(edit *e, const preset *p, int body) {
    edit_put(e, body ? IN_E0_2 : IN_E0, p->E0);
    edit_put(e, body ? IN_NU_2 : IN_NU, p->nu);
    if (p->yield > 0)
        edit_put(e, body ? IN_YIELD_2 : IN_YIELD, p->yield);
}

/* Takes all arguments of a statement that are inputs. */
static void gather(edit *e, const parsed *s) {
    for (const given_clause *h = s->list; h < s->list + s->count; h++) {
        if (!h->of->in)
            continue;
        if (h->live)
            e->bound[h->of->in - 1] = h->live;
        else
            edit_put(e, (input)(h->of->in - 1), h->v.v);
    }
}

/* ---- material, second body, friction ----------------------------------------------------------- */

bool do_material(shell *sh, lexer *lx, parsed *all) {
    edit e = {.clear = OF_MATERIAL};
    const given_clause *named = parsed_clause(all, "", 0);
    if (named)
        put_preset(&e, preset_row(named->choice), 0);
    gather(&e, all);
    if (has_second(&e)) {
        e.clear |= OF_SECOND;
        e.second = SECOND_GIVEN;
    }
    const bool modulus = has(&e, IN_E0) || has(&e, IN_G0) || has(&e, IN_ESTAR);
    if (!modulus || !(has(&e, IN_NU) || has(&e, IN_ESTAR)))
        return lex_fail(lx, modulus ? "nu is missing" : "E0 is missing") || add_usage(lx->error, all->by);
    if (e.bound[IN_K] && !has(&e, IN_C0))
        return lex_fail(lx, "c0 is missing: a k that may differ from 0 needs the depth c0 where E = E0");
    if (e.has[IN_K] && e.v[IN_K] != 0 && !has(&e, IN_C0))
        return lex_fail(lx, "c0 is missing: k = %g needs the depth c0 where E = E0", e.v[IN_K]);
    return scene_edit(&sh->calc.scene, apply, &e, lx->error);
}

/* Inputs of the first and of the second body: what `second` calls E0 is E0_2. */
static const input bodies[][2] = {{IN_E0, IN_E0_2}, {IN_G0, IN_G0_2}, {IN_NU, IN_NU_2}};
enum { OF_BODY = sizeof bodies / sizeof *bodies };

bool do_second(shell *sh, lexer *lx, parsed *all) {
    edit e = {.clear = OF_SECOND, .second = SECOND_GIVEN};
    const given_clause *named = parsed_clause(all, "", 0);
    gather(&e, all);
    if (named && named->choice < SECOND_WORDS) {
        const given_clause *more = &all->list[1];
        e.second = named->choice ? SECOND_RIGID : SECOND_SAME;
        if (e.second == SECOND_RIGID && all->count > 1)
            return calc_fail(lx->error, more->at, more->len, "a rigid body has no %s", more->of->name);
    } else if (named) {
        put_preset(&e, preset_row(named->choice - SECOND_WORDS), 1);
    }
    for (int i = 0; i < OF_BODY; i++) {
        const input own = bodies[i][0], other = bodies[i][1];
        if (e.bound[own])
            e.bound[other] = e.bound[own];
        else if (e.has[own])
            edit_put(&e, other, e.v[own]);
        e.has[own] = false;
        e.bound[own] = NULL;
    }
    return e.second != SECOND_GIVEN || has_second(&e)
               ? scene_edit(&sh->calc.scene, apply, &e, lx->error)
               : lex_fail(lx, "expected E0=... nu=..., a material, rigid or same");
}

bool do_friction(shell *sh, lexer *lx, parsed *all) {
    edit e = {.clear = 0};
    edit_put(&e, IN_MU, all->list[0].v.v);
    return scene_edit(&sh->calc.scene, apply, &e, lx->error) || given_place(lx->error, &all->list[0]);
}

/* Clears all inputs of the rig first: stiffness and offsets that are not given go. */
bool do_rig(shell *sh, lexer *lx, parsed *all) {
    edit e = {.clear = INPUT_RIG};
    const given_clause *none = parsed_clause(all, "none", 0);
    gather(&e, all);
    if (none ? all->count > 1 : !has(&e, IN_K_RIG))
        return lex_fail(lx, none ? "without a rig there are no offsets" : "stiffness is missing") ||
               add_usage(lx->error, all->by);
    return scene_edit(&sh->calc.scene, apply, &e, lx->error);
}

bool do_bulk(shell *sh, lexer *lx, parsed *all) {
    edit e = {.clear = INPUT_BIT(IN_SB)};
    gather(&e, all);
    return all->count ? scene_edit(&sh->calc.scene, apply, &e, lx->error)
                      : lex_fail(lx, "bulk of what stress?") || add_usage(lx->error, all->by);
}

/* ---- wear -------------------------------------------------------------------------------------- */

/* Archard's alpha_w = K/(mu*H) as a live definition, so that it follows mu. */
static counted *archard(shell *sh, const given_clause *K, const given_clause *H, calc_error *error) {
    char text[100];
    counted *out = NULL;
    lexer own;
    snprintf(text, sizeof text, "%.17g/(mu*%.17g Pa)", (double)K->v.v, (double)H->v.v);
    lex_start(&own, text, strlen(text), error);
    calc_bind(&sh->calc, &own, IN_ALPHA_W, &out);
    return out;
}

/* Reports the worn state after infinitely many cycles. */
static bool report_limit(shell *sh, calc_error *error) {
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
    if (inputs_any(&s->in, INPUT_BIT(IN_FN)) && inputs_any(&s->in, INPUT_BIT(IN_DXA)))
        shell_note(sh,
                   "with FN and dxA held, c grows on the way: cycles wear more than this (wear cycles N)");
    fret_wear_free(limit);
    return true;
}

/* Adds to Nw, the number of cycles so far. */
static bool add_cycles(shell *sh, edit *e, const given_clause *cycles, calc_error *error) {
    long double Nw = 0;
    if (!calc_takes(&sh->calc, IN_NW, error) || !scene_get(&sh->calc.scene, IN_NW, &Nw, error))
        return false;
    edit_put(e, IN_NW, Nw + cycles->count);
    return true;
}

bool do_wear(shell *sh, lexer *lx, parsed *all) {
    static const char *const names[] = {"Nw", "Vwear", "a", "c", "p0", NULL};
    const given_clause *cycles = parsed_clause(all, "cycles", 0), *K = parsed_clause(all, "K", 0),
                       *H = parsed_clause(all, "H", 0);
    edit e = {.clear = parsed_clause(all, "none", 0) ? INPUT_BIT(IN_ALPHA_W) | INPUT_BIT(IN_NW) : 0};
    counted *law = NULL;
    if (!all->count)
        return lex_fail(lx, "wear by what law?") || add_usage(lx->error, all->by);
    if (parsed_clause(all, "limit", 0))
        return report_limit(sh, lx->error);
    if (!K != !H)
        return lex_fail(lx, "%s is missing: wear K=1e-4 H=2 GPa", K ? "H" : "K");
    gather(&e, all);
    if ((K && !(law = archard(sh, K, H, lx->error))) || (cycles && !add_cycles(sh, &e, cycles, lx->error)))
        return false;
    e.bound[IN_ALPHA_W] = law ? law : e.bound[IN_ALPHA_W];
    const bool ok = scene_edit(&sh->calc.scene, apply, &e, lx->error);
    counted_drop(law);
    if (ok && cycles)
        report_event(sh, "wear", names);
    return ok;
}

/* ---- geometry ---------------------------------------------------------------------------------- */

/* One term n:A of a sum. */
static bool read_term(shell *sh, lexer *lx, fret_gap *sum) {
    value n, A;
    size_t at = lx->at;
    if (!expr_value(&sh->calc, lx, &n) || !value_dim(lx, "the exponent", at, lx->last - at, n, DIM_NONE))
        return false;
    if (!(n.v > 0))
        return calc_fail(lx->error, at, lx->last - at, "n = %Lg must be positive", n.v);
    if (lx->kind != T_COLON)
        return lex_fail(lx, "expected `:` between exponent and coefficient, such as 2:50 m^-1");
    lex_next(lx);
    at = lx->at;
    lx->list = true; /* a comma may follow */
    const dim d = {0, (double)(1 - n.v), 0, 0};
    const bool ok = expr_value_as(&sh->calc, lx, &d, &A);
    lx->list = false;
    if (!ok || !value_dim(lx, "the coefficient", at, lx->last - at, A, d))
        return false;
    sum->power[sum->terms++] = (fret_power){(double)n.v, (double)A.v, 1};
    return true;
}

static bool read_sum(shell *sh, const lexer *of, const span *terms, fret_gap *sum) {
    lexer own = hole_lexer(of, terms), *lx = &own;
    *sum = (fret_gap){.kind = FRET_GAP_SUM};
    do {
        if (sum->terms == FRET_GAP_TERMS)
            return lex_fail(lx, "a sum has at most %d terms", FRET_GAP_TERMS);
        if (sum->terms)
            lex_next(lx);
        if (!read_term(sh, lx, sum))
            return false;
    } while (lx->kind == T_COMMA);
    return at_end(lx);
}

/* `smooth`, `smooth PIECES`, `smooth MISFIT`. */
static bool read_smoothing(shell *sh, const lexer *of, const span *part, smoothing *how) {
    value v;
    how->by = SMOOTH_FREELY;
    if (!part->len)
        return true;
    lexer own = hole_lexer(of, part), *lx = &own;
    const size_t at = lx->at;
    if (!expr_value(&sh->calc, lx, &v) || !at_end(lx))
        return false;
    const bool within = dim_equal(v.d, DIM_LENGTH), number = dim_equal(v.d, DIM_NONE);
    if (!(within && v.v > 0) &&
        !(number && v.v >= 1 && v.v <= (long double)SMOOTH_PIECES_MOST && v.v == floorl(v.v)))
        return calc_fail(lx->error, at, lx->last - at,
                         "smooth takes a misfit (smooth 0.1 um) or a number of pieces (smooth 8)");
    how->by = within ? SMOOTH_WITHIN : SMOOTH_PIECES;
    how->pieces = within ? 0 : (size_t)v.v;
    how->within = (double)v.v;
    return true;
}

/* The columns r and f; of two lengths without these names the first is r. height: the other is z = -f. */
static bool profile_columns(csv *data, bool height, csv_values **r, csv_values **f, calc_error *error) {
    csv_values *length[2] = {NULL, NULL};
    size_t count = 0;
    for (csv_values *v = data->column; v < data->column + data->columns; v++)
        if (v->has_unit && same_dim(v->d, DIM_LENGTH) && count++ < 2)
            length[count - 1] = v;
    if (count == 2 && !csv_find(data, "r") && !csv_find(data, "f")) {
        csv_rename(data, length[0], "r");
        csv_rename(data, length[1], "f");
    }
    *r = columns_take(data, "r", DIM_LENGTH, error);
    *f = *r ? columns_take(data, "f", DIM_LENGTH, error) : NULL;
    if (!*f || !csv_settle(data, error))
        return false;
    if (height)
        columns_turn(data, *f);
    return true;
}

/* Is the gap nowhere negative? Else the bodies would overlap before they are pressed. */
static bool is_open(const csv *data, const double *f, calc_error *error) {
    char text[CALC_VALUE_TEXT];
    size_t i = 0;
    while (i < data->rows && f[i] >= 0)
        i++;
    if (i == data->rows)
        return true;
    calc_value_text(DIM_LENGTH, f[i], text);
    return calc_fail(error, 0, 0,
                     "%s:%zu: f = %s is below f(0) = 0: f is the gap and grows outward; the sign or the apex "
                     "may be the cause",
                     data->path, data->row[i].line, text);
}

/* Raises the error of a table whose radii do not start at 0 and grow, or that has a single row. */
static void fail_order(const csv *data, const double *r, calc_error *error) {
    char text[CALC_VALUE_TEXT];
    size_t i = 0;
    if (data->rows == 1) {
        calc_fail(error, 0, 0, "%s has one row: a gap needs two or more", data->path);
        return;
    }
    while (i + 1 < data->rows && (i ? r[i] > r[i - 1] : r[0] == 0))
        i++;
    calc_value_text(DIM_LENGTH, r[i], text);
    calc_fail(error, 0, 0,
              "%s:%zu: r = %s is out of order: radii must start at 0 and grow (smooth takes any order)",
              data->path, data->row[i].line, text);
}

/* Makes the gap from the columns; smoothed about the apex `top`, if how.by says so. NULL with an error. */
static struct fret_table *table_of(csv *data, smoothing how, smooth_answer *smoothed, apex *top,
                                   calc_error *error) {
    struct fret_table *gap = NULL;
    csv_values *r, *f;
    fret_status st;
    if (!profile_columns(data, how.height, &r, &f, error))
        return NULL;
    if (how.by) {
        if (!apex_find(r->v, f->v, data->rows, top, error) ||
            !smooth(r->v, f->v, data->rows, how, &shell_stop, smoothed, error))
            return NULL;
        st = fret_table_sloped(smoothed->r, smoothed->f, smoothed->slope, smoothed->pieces + 1, &shell_stop,
                               &gap);
    } else if (r->v[0] == 0 && f->v[0] != 0) {
        char text[CALC_VALUE_TEXT];
        calc_value_text(DIM_LENGTH, f->v[0], text);
        calc_fail(error, 0, 0,
                  "%s:%zu: f(0) = %s must be 0: the bodies touch at r = 0 before they are pressed (smooth "
                  "takes it off)",
                  data->path, data->row[0].line, text);
        return NULL;
    } else if (!is_open(data, f->v, error)) {
        return NULL;
    } else {
        st = fret_table_make(r->v, f->v, data->rows, &shell_stop, &gap);
        if (st.code == FRET_BAD_TABLE) {
            fail_order(data, r->v, error);
            return NULL;
        }
    }
    return calc_status(error, st) ? gap : NULL;
}

/* Whatever differs from the file is reported: here what smoothing has changed. */
static void report_misfit(shell *sh, const smooth_answer *a) {
    enum { MISFITS = 4 };
    const double v[MISFITS] = {a->rms, a->worst, a->at, a->offset};
    char text[MISFITS][CALC_VALUE_TEXT];
    answer event;
    answer_begin(&event, &sh->set, sh->out);
    answer_event(&event, "smooth");
    answer_number(&event, "pieces", (double)a->pieces);
    answer_number(&event, "rms", a->rms);
    answer_number(&event, "worst", a->worst);
    answer_number(&event, "at", a->at);
    answer_number(&event, "offset", a->offset);
    answer_done(&event);
    for (int i = 0; i < MISFITS; i++)
        format_column(&(column){.d = DIM_LENGTH}, 3, v[i], text[i], sizeof text[i]);
    shell_note(sh, "smoothed, %zu piece%s: misfit %s rms, %s at worst (r = %s); f(0) = %s is taken off",
               a->pieces, a->pieces == 1 ? "" : "s", text[0], text[1], text[2], text[3]);
}

/* Reports that a long table has been thinned to fewer pieces. */
static void report_thinning(shell *sh, size_t rows, const struct fret_table *gap) {
    const size_t pieces = fret_table_count(gap) - 1;
    const double within = fret_table_within(gap);
    answer event;
    answer_begin(&event, &sh->set, sh->out);
    answer_event(&event, "thin");
    answer_number(&event, "rows", (double)rows);
    answer_number(&event, "pieces", (double)pieces);
    answer_number(&event, "within", within);
    answer_done(&event);
    shell_note(sh, "of %zu rows %zu pieces are made, within %.0e of the largest gap", rows, pieces, within);
}

/* Reports where the apex was found, and the tilt that has been taken off. */
static void report_apex(shell *sh, const apex *top) {
    char at[CALC_VALUE_TEXT], tilt[CALC_VALUE_TEXT];
    answer event;
    answer_begin(&event, &sh->set, sh->out);
    answer_event(&event, "apex");
    answer_number(&event, "at", top->at);
    answer_number(&event, "tilt", top->tilt);
    answer_done(&event);
    calc_value_text(DIM_LENGTH, top->at, at);
    calc_value_text(DIM_NONE, top->tilt, tilt);
    shell_note(sh, "the apex is at r = %s%s%s%s: both sides are folded about it", at,
               top->tilted ? ", a tilt of " : "", top->tilted ? tilt : "",
               top->tilted ? " is taken off" : "");
}

/* Writes ` using NAME=COLUMN, ...`, for `show` to repeat. */
static bool write_using(const lexer *lx, parsed *all, char text[CHOSEN], calc_error *error) {
    const given_clause *h;
    bool fits = true;
    *text = 0;
    for (size_t i = 0; (h = parsed_clause(all, "using", i)) && fits; i++)
        fits = text_add(text, CHOSEN, "%s%.*s=%.*s", i ? ", " : " using ", (int)h->hole[0].len,
                        lx->text + h->hole[0].at, (int)h->hole[1].len, lx->text + h->hole[1].at);
    return fits || calc_fail(error, 0, 0, "the names of the columns are too long");
}

static bool read_gap_file(shell *sh, const lexer *lx, parsed *s, edit *e) {
    char name[FILE_NAME];
    const given_clause *smoothly = parsed_clause(s, "smooth", 0);
    smoothing how = {.by = SMOOTH_NOT};
    smooth_answer smoothed = {.pieces = 0};
    apex top = {.moved = false};
    csv data;
    how.height = parsed_clause(s, "height", 0) != NULL;
    hole_file(lx, &s->list[0].hole[0], name);
    if (!write_using(lx, s, how.columns, lx->error) ||
        (smoothly && !read_smoothing(sh, lx, &smoothly->hole[0], &how)))
        return false;
    bool ok = columns_read(lx, s, &s->list[0], &data);
    if (ok) {
        struct fret_table *gap = table_of(&data, how, &smoothed, &top, lx->error);
        e->table = gap ? shared_table_make(gap, name, how) : NULL;
        if (gap && !e->table)
            calc_no_memory(lx->error);
        ok = e->table && scene_edit(&sh->calc.scene, apply, e, lx->error); /* takes over the table */
    }
    if (ok)
        columns_say(sh, &data, how.height ? "f = -z" : "");
    if (ok && top.moved)
        report_apex(sh, &top);
    if (ok && how.by)
        report_misfit(sh, &smoothed);
    if (ok && fret_table_within(e->table->table) > 0)
        report_thinning(sh, data.rows, e->table->table);
    smooth_free(&smoothed);
    csv_free(&data);
    return ok || given_place(lx->error, &s->list[0]);
}

/* 1/R = 1/R1 + 1/R2; a negative radius is that of a concave body. */
static bool put_radii(lexer *lx, edit *e, const given_clause *R1, const given_clause *R2) {
    if (!R1 || !R2)
        return lex_fail(lx, "give both R1 and R2, or R");
    e->radii[0] = (double)R1->v.v;
    e->radii[1] = (double)R2->v.v;
    const long double curvature = 1 / (long double)e->radii[0] + 1 / (long double)e->radii[1];
    if (!(curvature > 0))
        return calc_fail(lx->error, R1->at, lx->last - R1->at, "1/R1 + 1/R2 must be positive");
    edit_put(e, IN_RADIUS, 1 / curvature);
    return true;
}

/* The slope of a cone from its angle to the base plane, or to the axis (half). */
static bool put_angle(lexer *lx, edit *e, const given_clause *angle, bool half) {
    if (!(angle->v.v > 0 && angle->v.v < 1.5707963267948966 /* 90 deg as a double */))
        return calc_fail(lx->error, angle->hole[0].at, angle->hole[0].len, "%s must lie between 0 and 90 deg",
                         angle->of->name);
    const long double sine = sinl(angle->v.v), cosine = cosl(angle->v.v);
    edit_put(e, IN_SLOPE, half ? cosine / sine : sine / cosine);
    return true;
}

static bool put_parameters(lexer *lx, const geometry *g, edit *e, parsed *s) {
    const given_clause *angle = parsed_clause(s, "angle", 0), *half = parsed_clause(s, "half_angle", 0),
                       *R1 = parsed_clause(s, "R1", 0), *R2 = parsed_clause(s, "R2", 0),
                       *D = parsed_clause(s, "D", 0);
    gather(e, s);
    if (D)
        edit_put(e, IN_RADIUS, D->v.v / 2);
    if ((angle && !put_angle(lx, e, angle, false)) || (half && !put_angle(lx, e, half, true)) ||
        ((R1 || R2) && !put_radii(lx, e, R1, R2)))
        return false;
    for (input in = IN_N; in < INPUTS; in++)
        if (g->required & INPUT_BIT(in) && !has(e, in))
            return lex_fail(lx, "%s is missing", quantity_of_input(in)->name) || add_usage(lx->error, s->by);
    if (geometry_takes(g, IN_A) && (has(e, IN_A) == has(e, IN_H) || has(e, IN_H) != has(e, IN_R0)))
        return lex_fail(lx, "give either A or both h and r0") || add_usage(lx->error, s->by);
    return true;
}

bool do_geometry(shell *sh, lexer *lx, parsed *all) {
    fret_gap sum;
    const geometry *g = geometry_row(all->row);
    edit e = {.geometry = g};
    e.sum = g->kind == FRET_GAP_SUM ? &sum : NULL;
    if (g->kind == FRET_GAP_TABLE)
        return read_gap_file(sh, lx, all, &e);
    return (e.sum ? read_sum(sh, lx, &all->list[0].hole[0], &sum) : put_parameters(lx, g, &e, all)) &&
           scene_edit(&sh->calc.scene, apply, &e, lx->error);
}
