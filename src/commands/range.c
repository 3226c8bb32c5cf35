/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reads ranges, and files whose rows are one. Changes nothing in the session but which names are known. */
#include "commands/range.h"

#include <math.h>
#include <string.h>

const char *load_name(size_t i) {
    static const char *const names[] = {"program", "cycle", "step"};
    return i < sizeof names / sizeof *names ? names[i] : NULL;
}

const char *range_line(size_t i) {
    return i ? NULL
             : "[for NAME = LO .. HI]* [along LOAD] [at FILE] [steps N:100000000]* [log]* [with NAME = "
               "VALUES]";
}

/* ---- for NAME = LO .. HI ----------------------------------------------------------------------- */

/* The common dimension of the ends of a range, or of the values of a list. A bare 0 has any dimension. */
typedef struct bounds {
    dim d;
    bool known;     /* a value with a dimension has been read (a bare 0 has none); not used for inputs */
    value v;        /* the first such value */
    size_t at, len; /* its place */
} bounds;

static bool is_plain(dim d) {
    return dim_equal(d, DIM_NONE) && d.rad == 0;
}

static bool read_bound(calc *c, lexer *lx, const knob *var, bounds *b, long double *out) {
    value v;
    const size_t at = lx->at;
    if (var->is_input)
        b->d = quantity_dim(quantity_of_input(var->in), c->now);
    if (!expr_value_as(c, lx, var->is_input || (b->known && !is_plain(b->d)) ? &b->d : NULL, &v))
        return false;
    const size_t len = lx->last - at;
    *out = v.v;
    if (var->is_input)
        return value_dim(lx, var->text, at, len, v, b->d);
    if (b->known && is_plain(b->d) && !is_plain(v.d))
        return value_dim(lx, var->text, b->at, b->len, b->v, v.d); /* 1 .. 3 mm */
    else if (!b->known)
        *b = (bounds){v.d, v.v != 0 || !is_plain(v.d), v, at, len};
    return value_dim(lx, var->text, at, len, v, b->d);
}

static bool read_other_end(calc *c, lexer *lx, const knob *var, const char *word, bounds *b,
                           sweep_range *out) {
    if (word ? !lex_is(lx, word) : lx->kind != T_RANGE)
        return word ? lex_fail(lx, "expected %s and the other end of the range", word)
                    : lex_fail(lx, "expected .. between the two ends of the sweep");
    lex_next(lx);
    const bool ok = read_bound(c, lx, var, b, &out->hi);
    out->d = b->d;
    return ok;
}

bool range_read_interval(shell *sh, const lexer *lx, const span *part, const knob *var, const char *word,
                         sweep_range *out) {
    bounds b = {.known = false};
    lexer own = hole_lexer(lx, part);
    return read_bound(&sh->calc, &own, var, &b, &out->lo) &&
           read_other_end(&sh->calc, &own, var, word, &b, out) && at_end(&own);
}

/* Reads LO .. HI, or a list v1, v2, ... */
static bool read_interval_or_list(calc *c, lexer *lx, const knob *var, sweep_range *out) {
    bounds b = {.known = false};
    lexer comma = *lx; /* at the first comma, if there is one */
    lx->list = true;
    for (out->listed = 0; out->listed == 0 || lx->kind == T_COMMA;) {
        if (out->listed == SWEEP_LISTED)
            return lex_fail(lx, "more than %d values", SWEEP_LISTED);
        if (out->listed == 1)
            comma = *lx;
        if (out->listed)
            lex_next(lx);
        if (!read_bound(c, lx, var, &b, &out->list[out->listed++]))
            return false;
    }
    lx->list = false;
    out->d = b.d;
    out->lo = out->list[0];
    if (out->listed > 1 && lx->kind != T_RANGE)
        return true;
    if (out->listed > 1) /* 1,5 .. 3: a decimal comma is an error */
        return lex_one_value(&comma) && read_other_end(c, &comma, var, NULL, &b, out);
    out->listed = 0;
    return read_other_end(c, lx, var, NULL, &b, out);
}

/* Evaluates the range in the scene of a curve: its ends may depend on the name of `with`. */
static bool evaluate_range(const sweep *s, sweep_range *out, calc_error *error) {
    const range *r = s->context;
    lexer lx = r->own;
    lx.error = error;
    if (s->at) {
        out->d = s->var.d;
        return true;
    }
    if (!s->along)
        return read_interval_or_list(&r->sh->calc, &lx, &s->var, out) &&
               (!s->log || (out->lo > 0 && out->hi > 0) ||
                calc_fail(error, r->own.at, r->own.end - r->own.at,
                          "a logarithmic sweep needs positive ends"));
    return s->what != ALONG_LOAD || read_load(r->sh, &lx, &out->step, &out->extra, out->bound);
}

static void start_range(shell *sh, const lexer *lx, const span *part, range *out) {
    *out = (range){.sweep = {.range = evaluate_range}, .sh = sh, .own = hole_lexer(lx, part)};
    out->sweep.context = out;
}

bool range_read_along(shell *sh, const lexer *lx, const span *part, range *out) {
    sweep *s = &out->sweep;
    sweep_range load = {.lo = 0};
    start_range(sh, lx, part, out);
    lexer own = out->own;
    s->along = true;
    s->var = (knob){.text = "time"};
    s->what = ALONG_LOAD;
    if (lex_accept(&own, "program")) {
        s->what = ALONG_PROGRAM;
    } else if (lex_is(&own, "cycle") &&
               own.at + own.len == own.end) { /* `cycle` alone: the last period; `cycle FA=..` is a load */
        s->what = ALONG_CYCLE;
        lex_next(&own);
    }
    if (s->what != ALONG_LOAD)
        return at_end(&own);
    const bool ok = read_load(sh, &own, &load.step, &load.extra, load.bound) && at_end(&own);
    if (ok && load.step.kind == LOAD_CYCLE && inputs_any(&sh->calc.scene.in, INPUT_BIT(IN_NW)))
        shell_note(sh, "the cycle runs on the unworn gap: Nw counts cycles like the last one");
    for (input in = 0; in < INPUTS; in++)
        counted_drop(load.bound[in]);
    return ok;
}

bool range_read_values(shell *sh, const lexer *lx, const span *values, sweep *s) {
    lexer own = hole_lexer(lx, values);
    bounds b = {.known = false};
    do {
        if (s->curves == SWEEP_VALUES)
            return lex_fail(&own, "more than %d values", SWEEP_VALUES);
        if (s->curves)
            lex_next(&own);
        s->value_at[s->curves] = own.at;
        own.list = true;
        const bool ok = read_bound(&sh->calc, &own, &s->with, &b, &s->value[s->curves]);
        own.list = false;
        if (!ok)
            return false;
        s->with.d = b.d;
        s->value_len[s->curves] = own.last - s->value_at[s->curves];
        s->curves++;
    } while (own.kind == T_COMMA);
    return at_end(&own);
}

/* Does the name occur in the text other than at byte `here`? */
static bool occurs_elsewhere(const char *text, size_t here, const char *name) {
    const size_t len = strlen(name);
    for (const char *p = text; (p = strstr(p, name)); p += len)
        if (p != text + here && !lex_in_name(p[len]) && (p == text || !lex_in_name(p[-1])))
            return true;
    return false;
}

static bool read_with(shell *sh, const lexer *lx, const parsed *all, const given_clause *h, sweep *s) {
    lexer name = hole_lexer(lx, &h->hole[0]);
    if (!knob_read(&sh->calc, &name, &s->with))
        return false;
    const bool fresh =
        !s->with.is_input && (sh->calc.names.row[s->with.name].lent || s->with.name >= all->names);
    if (fresh &&
        !occurs_elsewhere(lx->text, h->hole[0].at, s->with.text)) /* no definition can use a new name */
        snprintf(sh->calc.note, sizeof sh->calc.note, "nothing here depends on %s", s->with.text);
    if (!s->along && !knob_apart(&s->var, &s->with, h->hole[0].at, h->hole[0].len, lx->error))
        return false;
    return range_read_values(sh, lx, &h->hole[1], s);
}

bool range_options(shell *sh, lexer *lx, const parsed *all, size_t which, range *out, size_t steps) {
    sweep *s = &out->sweep;
    size_t ranges = 0;
    bool given = false;
    s->steps = out->listed ? s->steps : steps;
    for (const given_clause *h = all->list; h < all->list + all->count; h++) {
        const char *word = h->of->name;
        ranges += !strcmp(word, "for");
        if ((ranges ? ranges - 1 : 0) != which)
            continue;
        if (out->listed && (!strcmp(word, "steps") || (!strcmp(word, "log") && !h->of->holes)))
            return calc_fail(lx->error, h->at, h->len,
                             "%s goes with for NAME = LO .. HI, not with a list of values", word);
        if (!strcmp(word, "steps")) {
            if (given)
                return calc_fail(lx->error, h->at, h->len, "steps is given twice");
            s->steps = h->count;
            s->refine = false;
            given = true;
        } else if (!strcmp(word, "log") && !h->of->holes) { /* `log x` is a look of the axes */
            if (s->along)
                return calc_fail(lx->error, h->at, h->len,
                                 "log goes with for NAME = LO .. HI, or as log x or log y");
            s->log = true;
        } else if (!strcmp(word, "with") && !read_with(sh, lx, all, h, s)) {
            return false;
        }
    }
    return true;
}

bool range_read_name(shell *sh, lexer *lx, parsed *all, size_t which, bool takes, range *out) {
    sweep *s = &out->sweep;
    sweep_range ends = {.lo = 0};
    const given_clause *by = parsed_clause(all, "for", which);
    start_range(sh, lx, &by->hole[1], out);
    lexer name = hole_lexer(lx, &by->hole[0]), own = out->own;
    if (!(takes ? knob_read : knob_name)(&sh->calc, &name, &s->var) ||
        !read_interval_or_list(&sh->calc, &own, &s->var, &ends) || !at_end(&own))
        return false;
    s->var.d = ends.d;
    out->listed = ends.listed > 0;
    s->steps = out->listed ? ends.listed - 1 : 0;
    return true;
}

bool range_read(shell *sh, lexer *lx, parsed *all, size_t which, range *out) {
    const given_clause *along = parsed_clause(all, "along", 0), *by = parsed_clause(all, "for", which);
    if (along && by) {
        const given_clause *later = by->at > along->at ? by : along;
        return calc_fail(lx->error, later->at, later->len,
                         "a range goes for NAME = LO .. HI, or along a load");
    }
    if (along)
        return range_read_along(sh, lx, &along->hole[0], out);
    if (!by)
        return lex_fail(lx, "expected for NAME = LO .. HI");
    return range_read_name(sh, lx, all, which, true, out);
}

sweep_job range_job(shell *sh, const column *columns, size_t count, found *f, sweep_row *row, void *context,
                    calc_error *error) {
    for (size_t i = 0; i < count; i++) {
        f->d[i] = columns[i].d;
        f->known[i] = columns[i].chosen;
        f->units[i] = columns[i].chosen ? columns[i].unit : NULL;
    }
    return (sweep_job){.c = &sh->calc,
                       .expressions = sh->list,
                       .count = count,
                       .d = f->d,
                       .known = f->known,
                       .units = f->units,
                       .row = row,
                       .context = context,
                       .error = error};
}

void note_missing(shell *sh, const sweep_job *job) {
    if (job->missing.raised)
        shell_note(sh, "some values are missing: %s (%s)", job->missing.text, job->where);
}

/* ---- the rows of a file --------------------------------------------------------------------------- */

bool rows_open(shell *sh, const lexer *lx, parsed *all, file_rows *out) {
    const given_clause *at = parsed_clause(all, "at", 0);
    out->given = at != NULL;
    out->data = (csv){.path = NULL};
    if (!columns_placed(all, lx->error) || !at)
        return !lx->error->raised;
    return (columns_read(lx, all, at, &out->data) &&
            columns_show_names(sh, &out->data, all, &out->names, lx->error)) ||
           given_place(lx->error, at);
}

void rows_close(file_rows *r) {
    if (r->given)
        csv_free(&r->data);
    r->given = false;
}

/* Notes which names are the scene's and not columns; an expression that is such a name alone is compared. */
static void note_hidden(shell *sh, csv *data, const expr *e) {
    size_t i = 0;
    for (const quantity *of; e->count > 1 && (of = columns_hidden(sh, data, e, &i));)
        shell_note(sh, "%s is the scene's here, not the column of %.200s: using NAME=%s names that", of->name,
                   data->path, of->name);
}

/* The sweep over the rows sets inputs, and names that the first `count` expressions mention. */
static bool rows_range(shell *sh, const lexer *lx, parsed *all, file_rows *r, size_t count, sweep *out) {
    static const char *const others[] = {"for", "along", "steps", "log"};
    for (const given_clause *h = all->list; h < all->list + all->count; h++)
        for (size_t i = 0; i < sizeof others / sizeof *others; i++)
            if (!strcmp(h->of->name, others[i]) && !(i == 3 && h->of->holes)) /* `log x` is a look */
                return calc_fail(lx->error, h->at, h->len,
                                 "the rows of the file are the range: %s does not go with at FILE",
                                 others[i]);
    const span *file = &parsed_clause(all, "at", 0)->hole[0];
    if (!columns_load(sh, &r->data, count, &r->names, lx->error))
        return calc_place(lx->error, file->at, file->len);
    if (r->names.count > SWEEP_NAMES)
        return calc_fail(lx->error, file->at, file->len,
                         "more than %d columns are inputs or names that are used", SWEEP_NAMES);
    if (!r->names.count) {
        char columns[CALC_ERROR_TEXT / 2];
        csv_names(&r->data, columns, sizeof columns);
        return calc_fail(lx->error, file->at, file->len,
                         "no column of %.100s is used: they are %s; using NAME=COLUMN names one",
                         r->data.path, columns);
    }
    for (size_t k = 0; k < count; k++)
        note_hidden(sh, &r->data, &sh->list[k]);
    r->at = (sweep_rows){r->names.count, r->names.column};
    out->at = &r->at;
    out->var = r->at.names == 1 ? r->at.column[0].name : (knob){.text = "row"};
    out->steps = r->data.rows - 1;
    return true;
}

bool range_read_rows(shell *sh, lexer *lx, parsed *all, file_rows *from, size_t count, range *out) {
    const given_clause *at = parsed_clause(all, "at", 0);
    start_range(sh, lx, &at->hole[0], out);
    if (!rows_range(sh, lx, all, from, count, &out->sweep))
        return false;
    for (const given_clause *h = all->list; h < all->list + all->count; h++)
        if (!strcmp(h->of->name, "with") && !read_with(sh, lx, all, h, &out->sweep))
            return false;
    for (size_t i = 0; out->sweep.curves && i < from->at.names; i++)
        if (!knob_apart(&from->at.column[i].name, &out->sweep.with, at->hole[0].at, at->hole[0].len,
                        lx->error))
            return false;
    return true;
}

bool rows_over(const lexer *lx, const parsed *all, const given_clause *file, sweep *over, file_rows *out) {
    const axis_of axis = {.name = over->var.text, .d = over->var.d};
    out->given = true;
    if (!columns_read(lx, all, file, &out->data))
        return false;
    const csv_values *x = looks_column(&out->data, &axis, true, lx->error);
    if (!x && !lx->error->raised)
        calc_fail(lx->error, 0, 0, "%.200s has no column for %s, or more than one", out->data.path,
                  axis.name);
    if (!x || !csv_settle(&out->data, lx->error))
        return given_place(lx->error, file);
    out->names.column[0] = (column_knob){over->var, x->v};
    out->names.turned = false;
    out->at = (sweep_rows){1, out->names.column};
    over->at = &out->at;
    over->steps = out->data.rows - 1;
    return true;
}

void rows_say(shell *sh, const file_rows *r) {
    columns_say(sh, &r->data, r->names.turned ? TURNED_FN : "");
}

const csv_values *rows_compared(file_rows *r, const axis_of *expression, bool alone, calc_error *error) {
    const csv_values *with = looks_column(&r->data, expression, alone, error);
    for (size_t j = 0; with && j < r->at.names; j++)
        if (with->v == r->at.column[j].v)
            return NULL;
    return with;
}
