/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads figures and draws their curves by sweeps into a panel. */
#include "commands/panel.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "commands/figures.h"
#include "commands/map.h"
#include "statement/progress.h"

enum {
    PLOTTED = 8,  /* the most expressions of a panel */
    EVENLY = 100, /* points of a curve before the sweep refines it */
    MOVING = 300, /* the same in a frame of an animation */
    ALONG = 1000  /* points of a curve along a load */
};

/* State of a panel while its sweep runs. */
typedef struct panel_job {
    shell *sh;
    plot_panel *p;
    looks *looks;
    const figure *figure; /* or NULL */
    const sweep *s;
    motion *m;
    size_t index;     /* of the panel in the figure */
    size_t count;     /* expressions that are drawn (ordinates) */
    size_t abscissas; /* expressions behind them that are abscissas; 0: the range is the abscissa */
    size_t abscissa_of[PLOTTED]; /* index of the abscissa of each ordinate */
    const column *columns;
    const char *statement;
    calc_error *error;
    bool lost;                                   /* out of memory for a point */
    bool moved;                                  /* the statement's range is that of the animation */
    size_t per_curve;                            /* series for each value of `with` */
    bool slips[PLOT_CURVES], begun[PLOT_CURVES]; /* of series of role s: the last point slips; there is one */
    double last[PLOTTED][2];                     /* that point */
    found found;
    file_rows *measured;  /* draw residuals: the file's values less the expressions; or NULL */
    comparison residuals; /* of these */
    size_t rows;          /* of the file so far */
} panel_job;

/* The letter of figure.roles for expression i; but bands of several curves would cover each other. */
static char role_of(const panel_job *job, size_t i) {
    const char role = job->figure && job->figure->roles ? job->figure->roles[i] : 'c';
    return role == 'b' && job->s->curves ? 't' : role;
}

static bool is_main(const panel_job *job, size_t i) {
    return role_of(job, i) == 'c' || role_of(job, i) == 's';
}

static size_t main_count(const panel_job *job) {
    size_t n = 0;
    for (size_t i = 0; i < job->count; i++)
        n += is_main(job, i);
    return n;
}

/* ---- curves ------------------------------------------------------------------------------------ */

/* The value of `with` for a curve: as typed if that says more than its number (c0 = 2*a0). */
static void value_text(const panel_job *job, size_t curve, char *text, size_t size) {
    const sweep *s = job->s;
    const char *written = job->statement + s->value_at[curve];
    const size_t len = s->value_len[curve];
    if (isalpha((unsigned char)*written) || memchr(written, '*', len))
        snprintf(text, size, "%.*s", (int)len, written);
    else
        format_value(&job->sh->set, (value){s->value[curve], s->with.d}, text, size);
}

enum { TITLE = 520 };

/* The title of a series: "k = 0.5", the expression, or both, as needed to tell it from others, then `part`
 * ("stick"; may be NULL). NULL: it needs none. */
static const char *title_of(const panel_job *job, size_t curve, size_t i, const char *part,
                            char title[TITLE]) {
    char number[160], name[TITLE / 2];
    const column *c = &job->columns[i];
    const bool several = main_count(job) > 1, own = is_main(job, i) && (several || job->s->curves);
    if (!own && !part)
        return NULL;
    if (job->s->curves)
        value_text(job, curve, number, sizeof number);
    if (job->abscissas > 1)
        snprintf(name, sizeof name, PLOT_EXPR "%.110s" PLOT_END " against " PLOT_EXPR "%.110s" PLOT_END,
                 c->name, job->columns[job->count + job->abscissa_of[i]].name);
    else
        snprintf(name, sizeof name, PLOT_EXPR "%.220s" PLOT_END, c->name);
    if (!own)
        *title = 0;
    else if (several && job->s->curves)
        snprintf(title, TITLE, "%s, " PLOT_EXPR "%s = %s" PLOT_END, name, job->s->with.text, number);
    else if (job->s->curves)
        snprintf(title, TITLE, PLOT_EXPR "%s = %s" PLOT_END, job->s->with.text, number);
    else
        snprintf(title, TITLE, "%s", name);
    if (part)
        list_word(title, TITLE, ", ", part);
    return title;
}

static plot_series *add_series(panel_job *job, plot_role role, const char *title, bool thin) {
    plot_series *s = plot_series_add(job->p, role, title, job->error);
    if (s)
        s->thin = thin;
    return s;
}

/* Adds the series of a value of `with`: for each expression, both edges of a band, stick and slip. */
static bool add_curve(panel_job *job, size_t curve) {
    for (size_t i = 0; i < job->count; i++) {
        const char role = role_of(job, i);
        char title[TITLE];
        if (role == 's') {
            plot_series *stick = add_series(job, PLOT_CURVE, title_of(job, curve, i, "stick", title), false),
                        *slip =
                            stick ? add_series(job, PLOT_CURVE, title_of(job, curve, i, "slip", title), false)
                                  : NULL;
            if (!slip)
                return false;
            stick->style = (int)(2 * curve);
            slip->style = (int)(2 * curve + 1);
        } else if (!add_series(job,
                               role == 'b'     ? PLOT_BAND
                               : job->measured ? PLOT_MEASURED
                                               : PLOT_CURVE,
                               title_of(job, curve, i, NULL, title), role != 'c')) {
            return false;
        }
        i += role == 'b';
    }
    if (curve == 0)
        job->per_curve = job->p->count;
    return true;
}

static void add_point(panel_job *job, plot_series *s, double x, double y) {
    job->lost = !plot_point(s, x, y) || job->lost;
}

/* Adds a point to the stick or slip series (j, j + 1). A new one begins with the last point of the other. */
static void add_stick_slip(panel_job *job, size_t j, size_t i, double x, const long double *values) {
    plot_series *const *s = job->p->series + j;
    const double u = (double)values[i], bound = fabs((double)values[i + 1]);
    if (!(bound > 1e-12 * fabs(u))) { /* out of contact */
        add_point(job, s[0], x, NAN);
        add_point(job, s[1], x, NAN);
        job->begun[j] = false;
        return;
    }
    const bool slips = fabs(u) >= bound * (1 - 1e-9);
    if (job->begun[j] && slips != job->slips[j]) {
        add_point(job, s[slips], x, NAN);
        add_point(job, s[slips], job->last[i][0], job->last[i][1]);
    }
    job->slips[j] = slips;
    job->begun[j] = true;
    job->last[i][0] = x;
    job->last[i][1] = u;
    add_point(job, s[slips], x, u);
}

/* Is it after the time of this frame? */
static bool is_later(const panel_job *job, const sweep *s, long double time) {
    return job->m && job->m->trial && s->along && time > (long double)job->m->until + 1e-9L;
}

/* The residuals of a row: the file's value less those of the expressions. */
static bool subtract(panel_job *job, const long double *values, long double *left) {
    const axis_of axis = {.name = job->columns[0].name, .d = job->found.d[0]};
    comparison *c = &job->residuals;
    if (!c->with)
        c->with = rows_compared(job->measured, &axis, true, job->error);
    if (!c->with)
        return job->error->raised ? false
                                  : calc_fail(job->error, 0, 0, "%.200s has no column to compare with %s",
                                              job->measured->data.path, axis.name);
    for (size_t i = 0; i < job->count; i++)
        left[i] = columns_differ(c, job->rows % job->measured->data.rows, values[i]);
    job->rows++;
    return true;
}

static bool give_point(void *context, const sweep *s, size_t curve, long double x,
                       const long double *values) {
    panel_job *job = context;
    const size_t at = curve * job->per_curve;
    long double left[PLOTTED];
    progress_pulse();
    if (job->measured && !subtract(job, values, left))
        return false;
    values = job->measured ? left : values;
    if (at >= job->p->count && !add_curve(job, curve))
        return false;
    if (is_later(job, s, x))
        return true;
    for (size_t i = 0, j = at; i < job->count; i++, j++) {
        const char role = role_of(job, i);
        plot_series *to = job->p->series[j];
        const double abscissa = (double)(job->abscissas ? values[job->count + job->abscissa_of[i]] : x);
        if (role == 'b')
            job->lost = !plot_band(to, abscissa, (double)values[i], (double)values[i + 1]) || job->lost;
        else if (role == 's')
            add_stick_slip(job, j, i, abscissa, values);
        else
            add_point(job, to, abscissa, (double)values[i]);
        i += role == 'b';
        j += role == 's';
    }
    return !job->lost || calc_no_memory(job->error);
}

/* In a frame along a load, marks the last point of every main curve. */
static bool mark_now(panel_job *job) {
    const size_t series = job->p->count;
    if (!job->m || !job->m->trial || !job->s->along)
        return true;
    plot_series *now = add_series(job, PLOT_NOW, NULL, false);
    for (size_t i = 0; now && i < series; i++) {
        const plot_series *s = job->p->series[i];
        if (s->role == PLOT_CURVE && !s->thin && s->count)
            add_point(job, now, s->x[s->count - 1], s->y[s->count - 1]);
    }
    return now && (!job->lost || calc_no_memory(job->error));
}

/* Draws vertical lines at the lengths of figure.marks, if the figure is one curve over a place. */
static bool mark_places(panel_job *job) {
    plot_panel *p = job->p;
    const char *marks = job->figure && job->figure->marks ? job->figure->marks : "";
    const axis_extent y = looks_extent(p, false);
    for (; *marks && !job->s->along && !job->s->curves && !job->s->at; marks++) {
        const quantity *q = quantity_find(marks, 1);
        long double at = 0;
        if (!quantity_get(q, job->sh->calc.now, &at, error_quiet()) || !(at > 0))
            continue;
        plot_series *s = add_series(job, PLOT_CURVE, NULL, true);
        if (!s)
            return false;
        add_point(job, s, (double)at, fmin(y.lo, 0));
        add_point(job, s, (double)at, y.hi);
        p->word[p->words++].text = q->name;
    }
    return !job->lost || calc_no_memory(job->error);
}

/* Places the names beside these lines, which are the last series and are in the unit of the axis by now. */
static void name_marks(plot_panel *p) {
    const axis_extent e = looks_extent(p, true);
    const double lo = isfinite(p->xlo) ? p->xlo : e.lo, hi = isfinite(p->xhi) ? p->xhi : e.hi;
    for (size_t i = 0; i < p->words; i++) {
        const double x = p->series[p->count - p->words + i]->x[0];
        const double part = p->logx ? log(x / lo) / log(hi / lo) : (x - lo) / (hi - lo);
        p->word[i].at[0] = 0.02 + (p->flipx ? 1 - part : part);
        p->word[i].at[1] = 0.95;
    }
}

/* ---- axes -------------------------------------------------------------------------------------- */

/* Notes that points are left out on a logarithmic axis. */
static void note_logarithms(shell *sh, const plot_panel *p) {
    if ((p->logx && looks_extent(p, true).lo <= 0) || (p->logy && looks_extent(p, false).lo <= 0))
        shell_note(sh, "a logarithmic axis leaves out what is not above 0");
}

/* The name of an axis: the expressions that share it, each once; empty if they do not fit. */
static void shared_name(const panel_job *job, size_t first, size_t end, char *name, size_t size) {
    *name = 0;
    for (size_t i = first; i < end; i++) {
        size_t before = first;
        while (before < i && strcmp(job->columns[before].name, job->columns[i].name))
            before++;
        if (before < i || (i < job->count && !is_main(job, i)))
            continue;
        if (strlen(name) + strlen(job->columns[i].name) + 3 > size) {
            *name = 0;
            return;
        }
        list_word(name, size, ", ", job->columns[i].name);
    }
}

/* The name of the ordinate, and a title with the rms, if there is none. */
static bool name_residuals(panel_job *job, dim d, char name[TITLE]) {
    const comparison *c = &job->residuals;
    char rms[NUMBER_TEXT + COLUMN_UNIT], title[200];
    snprintf(name, TITLE, "file %s - %.300s", c->with->name, job->columns[0].name);
    format_value(&job->sh->set, (value){columns_rms(c), d}, rms, sizeof rms);
    snprintf(title, sizeof title, "rms = %s over %zu row%s", rms, c->rows, c->rows == 1 ? "" : "s");
    job->p->title = job->p->title ? job->p->title : strdup(title);
    return job->p->title || calc_no_memory(job->error);
}

/* *known: the first of these expressions whose dimension is known (one without any value has none), which is
 * that of the axis. False with an error: two dimensions differ. */
static bool share_axis(const panel_job *job, const found *f, size_t first, size_t end, size_t *known) {
    const column *c = job->columns;
    while (first + 1 < end && !f->known[first])
        first++;
    *known = first;
    for (size_t i = first + 1; i < end; i++)
        if (f->known[i] && !dim_equal(f->d[i], f->d[first]))
            return calc_fail(job->error, job->sh->list[i].at, job->sh->list[i].len,
                             "%s and %s cannot share an axis", c[first].name, c[i].name);
    return true;
}

static bool finish_axes(panel_job *job, lexer *lx, const found *f) {
    const sweep *s = job->s;
    char name[40], x_names[40], residuals[TITLE];
    const size_t count = job->count, all = count + job->abscissas;
    const column *c = job->columns, *x = job->abscissas ? &c[count] : NULL;
    size_t first, across;
    if (!share_axis(job, f, 0, count, &first) || !share_axis(job, f, count, all, &across))
        return false;
    shared_name(job, 0, count, name, sizeof name);
    shared_name(job, count, all, x_names, sizeof x_names);
    axis_unit own[2] = {{.scale = 0}, {.scale = 0}}, *kept = job->m ? job->m->unit[job->index] : own;
    const axis_of ax = {.name = !x                   ? s->var.text
                                : job->abscissas > 1 ? x_names
                                                     : x->name,
                        .d = x ? f->d[across] : s->var.d,
                        .like = x,
                        .unit = &kept[1]};
    axis_of ay = {
        .name = main_count(job) > 1 ? name : c[0].name, .d = f->d[first], .like = &c[0], .unit = &kept[0]};
    job->p->logx = job->p->logx || s->log;
    if (!job->p->title && job->figure)
        job->p->title = strdup(job->figure->title);
    if (!job->p->title && job->figure)
        return calc_no_memory(lx->error);
    if (!(job->measured ? name_residuals(job, ay.d, residuals)
                        : looks_lay_over(lx, job->looks, job->p, &ax, &ay)))
        return false;
    ay.name = job->measured ? residuals : ay.name;
    return looks_axis(lx, job->looks, job->p, true, &ax) && looks_axis(lx, job->looks, job->p, false, &ay);
}

/* ---- animations --------------------------------------------------------------------------------- */

/* Does the sweep set inputs or a load? Then it starts from the user's scene, not from that of a frame. */
static bool is_still(const sweep *s) {
    return s->along || s->var.is_input || (s->at && s->at->names > 1) || (s->curves && s->with.is_input);
}

/* Does the which-th range of an animated figure go over an input? Then its values are the frames. */
static bool is_moving(const panel_job *job, const lexer *lx, parsed *all, size_t which) {
    const given_clause *by = job->m ? parsed_clause(all, "for", which) : NULL;
    const lexer name = by ? hole_lexer(lx, &by->hole[0]) : *lx;
    const quantity *q = by ? quantity_find(name.text + name.at, name.len) : NULL;
    return q && quantity_is_input(q);
}

/* Makes the range of an input that of the animation; an error if another figure follows something else. */
static bool move_by(panel_job *job, lexer *lx, parsed *all, size_t which) {
    const given_clause *by = parsed_clause(all, "for", which);
    motion *m = job->m;
    range r;
    job->moved = true;
    if (m->trial)
        return true;
    if (!range_read_name(job->sh, lx, all, which, true, &r) || !range_options(job->sh, lx, all, which, &r, 0))
        return false;
    if (m->found && (m->over.sweep.along || m->over.sweep.var.in != r.sweep.var.in))
        return calc_fail(lx->error, by->at, by->len,
                         "all figures of an animation need the same load or the same input");
    m->found = true;
    m->over = r;
    return true;
}

/* Makes a load that of the animation; an error if another figure follows another load. */
static bool follow_load(motion *m, const range *r) {
    const lexer *own = &r->own, *other = m ? &m->over.own : NULL;
    if (!m || m->trial || !r->sweep.along)
        return true;
    if (!m->found)
        m->over = *r;
    const size_t len = own->end - own->at;
    const bool same =
        !m->found || !m->over.sweep.along ||
        (other->end - other->at == len && !memcmp(other->text + other->at, own->text + own->at, len));
    m->found = true;
    return same || calc_fail(own->error, own->at, len, "all figures of an animation need the same load");
}

/* ---- sweeps ------------------------------------------------------------------------------------ */

static bool run_sweep(panel_job *job, sweep_job *sweeping, const sweep *s) {
    calc *c = &job->sh->calc;
    scene *before = c->now;
    const bool still = job->m && job->m->trial && is_still(s);
    if (s->along && s->what == ALONG_PROGRAM && c->scene.end.steps == 1)
        return calc_fail(job->error, 0, 0, "there is no loop yet: use step or cycle first");
    if (still)
        c->now = job->m->trial->outer;
    const bool ok = sweep_run(s, sweeping);
    c->now = before;
    return ok && mark_now(job);
}

static bool no_second_range(panel_job *job, lexer *lx, parsed *all) {
    const given_clause *second = parsed_clause(all, "for", 1);
    if (is_moving(job, lx, all, 1))
        return move_by(job, lx, all, 1);
    return !second || calc_fail(lx->error, second->at, second->len,
                                "two ranges make a map: plot map EXPR for A = ... for B = ...");
}

/* Runs the sweep, and makes its curves and axes. */
static bool make_curves(panel_job *job, lexer *lx, sweep *s) {
    const size_t count = job->count + job->abscissas;
    job->s = s;
    s->turns = true;
    if (s->at) {
        job->p->points = true;
    } else {
        s->refine = !s->along && !s->steps;
        s->steps = s->steps ? s->steps : s->along ? ALONG : job->m ? MOVING : EVENLY;
    }
    sweep_job sweeping = range_job(job->sh, job->columns, count, &job->found, give_point, job, job->error);
    if (!run_sweep(job, &sweeping, s) || !mark_places(job) || !finish_axes(job, lx, &job->found))
        return false;
    name_marks(job->p);
    if (!job->m || !job->m->trial) {
        note_missing(job->sh, &sweeping);
        note_logarithms(job->sh, job->p);
    }
    return true;
}

/* The clauses of a statement, or of a row of the table of figures, and a lexer over its text. */
typedef struct written {
    lexer lx;
    parsed *all;
} written;

static const given_clause *range_of(parsed *all) {
    const given_clause *by = parsed_clause(all, "for", 0), *along = parsed_clause(all, "along", 0);
    return by ? by : along ? along : parsed_clause(all, "at", 0);
}

/* For `residuals`: replaces the range of the curve by the rows of the file. */
static bool take_residuals(panel_job *job, const lexer *lx, range *r, file_rows *from) {
    const looks *l = job->looks;
    if (!l->residuals)
        return true;
    if (l->files != 1 || r->sweep.along || r->sweep.at || job->abscissas)
        return calc_fail(lx->error, l->over[0]->hole[0].at, l->over[0]->hole[0].len,
                         "residuals are of EXPR, ... for NAME = LO .. HI over one FILE.csv");
    job->measured = from;
    return rows_over(lx, l->all, l->over[0], &r->sweep, from);
}

/* Reads EXPR, ... [against EXPR], ...: the ordinates, then the abscissas, kept at PLOTTED and on at first. */
static bool read_curves(panel_job *job, const written *of, column columns[2 * PLOTTED]) {
    shell *sh = job->sh;
    const given_clause *h = &of->all->list[0];
    lexer own = hole_lexer(&of->lx, &h->hole[0]);
    size_t drawn = 0;
    bool ok = read_expressions(sh, &own, columns, PLOTTED, &job->count);
    while (ok && at_end(&own) && (h = parsed_clause(of->all, "against", job->abscissas))) {
        const size_t i = PLOTTED + job->abscissas;
        if (drawn == job->count)
            return calc_fail(own.error, h->at, h->len, "expected EXPR before against");
        while (drawn < job->count)
            job->abscissa_of[drawn++] = job->abscissas;
        job->abscissas++;
        own = hole_lexer(&of->lx, &h->hole[0]);
        ok = read_expression(sh, &own, i, &columns[i]);
        if (ok && own.kind == T_COMMA) {
            lex_next(&own);
            ok = read_expressions(sh, &own, columns, PLOTTED, &job->count);
        }
    }
    if (!ok || own.error->raised)
        return false;
    if (job->abscissas && drawn < job->count)
        return calc_fail(own.error, sh->list[drawn].at, sh->list[drawn].len, "expected %s against EXPR",
                         columns[drawn].name);
    for (size_t i = job->count, from = PLOTTED; i < job->count + job->abscissas; i++, from++) {
        const expr e = sh->list[i];
        const column c = columns[i];
        sh->list[i] = sh->list[from];
        sh->list[from] = e;
        columns[i] = columns[from];
        columns[from] = c;
    }
    job->p->airy = job->p->airy || job->abscissas;
    return true;
}

/* Draws curves. of: has the expressions, and the range, unless the user's statement (lx, all) has one. */
static bool draw_sweep(panel_job *job, lexer *lx, parsed *all, written *of) {
    shell *sh = job->sh;
    column columns[2 * PLOTTED] = {{.name = NULL}};
    written own = {*lx, all}, *over = range_of(of->all) ? of : &own;
    range r;
    file_rows at;
    job->columns = columns;
    bool ok = rows_open(sh, &over->lx, over->all, &at) && read_curves(job, of, columns);
    if (!ok && at.given)
        columns_missed(sh, lx, &at.data);
    else if (ok && at.given)
        ok = range_read_rows(sh, &over->lx, over->all, &at, job->count + job->abscissas, &r);
    else
        ok = ok && (job->moved || no_second_range(job, lx, all)) &&
             range_read(sh, &over->lx, over->all, 0, &r) &&
             ((job->moved && job->figure) || range_options(sh, lx, all, 0, &r, 0));
    ok = ok && take_residuals(job, lx, &r, &at) && follow_load(job->m, &r) && make_curves(job, lx, &r.sweep);
    if (!ok && job->measured)
        given_place(lx->error, job->looks->over[0]);
    if (ok && at.given && !(job->m && job->m->trial))
        rows_say(sh, &at);
    rows_close(&at);
    columns_free(columns, 2 * PLOTTED);
    return ok;
}

/* ---- named figures ----------------------------------------------------------------------------- */

static const char *statement_of(const shell *sh, const figure *f, parsed *all) {
    return f->when && f->when(&sh->calc.now->in, parsed_clause(all, "with", 0)) ? f->instead : f->statement;
}

/* `along LOAD` behind a figure over a place (`pressure`): the load of the animation; an error in a plot. */
static bool take_load(panel_job *job, const lexer *lx, const given_clause *along, const char *place,
                      size_t len) {
    const char *name = job->figure->name;
    range r;
    if (!job->m)
        return calc_fail(lx->error, along->at, along->len,
                         "%s goes over %.*s, not along a load: animate %s along ... shows it move", name,
                         (int)len, place, name);
    return range_read_along(job->sh, lx, &along->hole[0], &r) && follow_load(job->m, &r);
}

/* Draws the statement of the row. A range in the user's statement replaces the row's and the looks behind
 * that; but if the row has a `for`, the animation just follows a load, or the range of an input. */
static bool draw_row(panel_job *job, lexer *lx, parsed *all, written *row) {
    const given_clause *over = range_of(row->all), *along = parsed_clause(all, "along", 0);
    const span *place = &over->hole[0];
    if (row->all->shows_names && along && !parsed_clause(all, "for", 0)) {
        if (!take_load(job, lx, along, row->lx.text + place->at, place->len))
            return false;
    } else if (row->all->shows_names && is_moving(job, lx, all, 0)) {
        if (!move_by(job, lx, all, 0))
            return false;
    } else if (range_of(all)) {
        parsed_drop(job->sh, row->all);
        row->all->count = (unsigned)(over - row->all->list);
    }
    return looks_read(job->sh, &row->lx, row->all, job->p, job->looks) &&
           looks_read(job->sh, lx, all, job->p, job->looks) && draw_sweep(job, lx, all, row);
}

static bool draw_named(panel_job *job, lexer *lx, parsed *all) {
    const char *statement = statement_of(job->sh, job->figure, all);
    calc_error mine = ERROR_NONE;
    parsed own;
    written row = {.all = &own};
    job->error = &mine;
    lex_start(&row.lx, statement, strlen(statement), &mine);
    bool ok = parsed_read(job->sh, &row.lx, all->by, &own);
    if (ok) {
        ok = draw_row(job, lx, all, &row);
        parsed_drop(job->sh, &own);
    }
    if (mine.raised) { /* its place is one in the row's text */
        *lx->error = mine;
        lx->error->at = lx->error->len = 0;
    }
    return ok;
}

/* ---- figures ----------------------------------------------------------------------------------- */

/* Is the first word the name of a figure, not part of an expression, nor a value's name before a range? */
static bool is_named(const shell *sh, const figure *f, parsed *all) {
    const size_t len = strlen(f->name);
    size_t own;
    if (!all->count || all->list[0].hole[0].len != len || parsed_clause(all, "against", 0))
        return false;
    return !range_of(all) ||
           !(quantity_find(f->name, len) || names_find(&sh->calc.names, f->name, len, &own));
}

bool panel_read(shell *sh, lexer *lx, const grammar *row, panel *out) {
    const figure *f = lx->kind == T_NAME ? figure_find(lx->text + lx->at, lx->len) : NULL;
    out->at = lx->at;
    const bool ok = parsed_read_some(sh, lx, row, &out->parsed);
    out->figure = ok && f && (f->build || is_named(sh, f, &out->parsed)) ? f : NULL;
    if (!ok)
        parsed_drop(sh, &out->parsed);
    parsed_hide_names(sh, &out->parsed); /* other panels must not know its names */
    return ok;
}

bool panel_is_whole(panel *p) {
    return p->figure || range_of(&p->parsed);
}

bool panel_is_map(const lexer *lx, const panel *p) {
    if (p->figure)
        return false;
    const lexer first = hole_lexer(lx, &p->parsed.list[0].hole[0]);
    return map_at(&first);
}

bool panel_list(shell *sh, lexer *lx, panel *as) {
    const bool ok = parsed_show_names(sh, lx, &as->parsed) && table_map(sh, lx, &as->parsed);
    parsed_hide_names(sh, &as->parsed);
    return ok;
}

static bool draw_panel(shell *sh, lexer *lx, panel *as, plot_figure *f, motion *m) {
    const size_t index = f->count;
    plot_panel *p = plot_panel_add(f, lx->error);
    if (!p)
        return calc_place(lx->error, as->at, 1);
    looks l = {.files = 0};
    panel_job job = {.sh = sh,
                     .p = p,
                     .looks = &l,
                     .figure = as->figure,
                     .m = m,
                     .index = index,
                     .statement = lx->text,
                     .error = lx->error};
    if (as->figure && !as->figure->build)
        return draw_named(&job, lx, &as->parsed);
    if (!looks_read(sh, lx, &as->parsed, p, &l))
        return false;
    if (as->figure) {
        if (!as->figure->build(sh, lx, &as->parsed, p, &l) || !as->figure->below)
            return !lx->error->raised;
        p = plot_panel_add(f, lx->error);
        if (!p)
            return calc_place(lx->error, as->at, 1);
        p->below = true;
        return as->figure->below(sh, lx, &as->parsed, p, &l);
    }
    lexer first = hole_lexer(lx, &as->parsed.list[0].hole[0]);
    size_t own;
    if (lex_is(&first, "map") && lex_peek(&first) == T_END && !names_find(&sh->calc.names, "map", 3, &own))
        return lex_fail(&first, "expected map EXPR for A = LO .. HI for B = LO .. HI");
    return map_at(&first) ? map_draw(sh, lx, &as->parsed, p, &l)
                          : draw_sweep(&job, lx, &as->parsed, &(written){*lx, &as->parsed});
}

bool panel_draw(shell *sh, lexer *lx, panel *as, plot_figure *f, motion *m) {
    const bool ok = parsed_show_names(sh, lx, &as->parsed) && draw_panel(sh, lx, as, f, m);
    parsed_hide_names(sh, &as->parsed);
    return ok;
}
