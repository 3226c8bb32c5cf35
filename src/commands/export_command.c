/* SPDX-License-Identifier: GPL-3.0-or-later */
/* export: the contact for a dynamics code, as parallel Jenkins elements, as the stiffnesses of its first
 * harmonic, or as the branches of its loop. Does not change the scene. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "commands/range.h"
#include "commands/tables.h"
#include "language/trial.h"
#include "scene/functions.h"
#include "statement/command.h"
#include "statement/progress.h"
#include "study/jenkins.h"

typedef struct export_table {
    si_table t;
    size_t rows, total; /* written so far, and in all */
    const volatile sig_atomic_t *stop;
    calc_error *error;
} export_table;

static bool put_row(export_table *t, const long double *si) {
    answer_row(&t->t.a, si);
    progress_part((double)++t->rows / (double)t->total);
    return !calc_stopped(t->stop, t->error);
}

/* Writes the table of `to FILE` with columns of these names, ended by NULL; `write` writes the rows. */
static bool write_table(shell *sh, lexer *lx, parsed *all, const char *const *names, size_t rows,
                        bool (*write)(export_table *t, void *context), void *context) {
    export_table t = {.total = rows, .stop = sh->calc.scene.stop, .error = lx->error};
    if (!table_open(sh, lx, all, &t.t))
        return false;
    for (; *names; names++) {
        const quantity *q = quantity_find(*names, strlen(*names));
        table_column(&t.t, *names, q ? q->d : DIM_NONE);
    }
    const bool ok = table_begin(sh, &t.t, "export", lx->error) && write(&t, context);
    calc_word(&sh->calc, lx->error);
    return table_close(sh, lx, &t.t, ok);
}

static size_t steps_of(parsed *all, size_t usual) {
    const given_clause *steps = parsed_clause(all, "steps", 0);
    return steps ? steps->count : usual;
}

/* ---- harmonic ---------------------------------------------------------------------------------- */

typedef struct amplitudes {
    scene *scene;
    sweep_range ends;
    size_t steps;
    bool log;
} amplitudes;

static bool read_amplitudes(shell *sh, const lexer *lx, parsed *all, amplitudes *out) {
    const knob dxA = {.is_input = true, .in = IN_DXA, .d = DIM_LENGTH, .text = "dxA"};
    const span *name = &parsed_clause(all, "for", 0)->hole[0], *ends = name + 1;
    *out = (amplitudes){sh->calc.now, {.lo = 0}, steps_of(all, 50), parsed_clause(all, "log", 0)};
    if (name->len != strlen(dxA.text) || strncmp(lx->text + name->at, dxA.text, name->len) != 0)
        return calc_fail(lx->error, name->at, name->len,
                         "K' and K'' are functions of dxA: for dxA = LO .. HI");
    if (!range_read_interval(sh, lx, ends, &dxA, NULL, &out->ends))
        return false;
    return (out->log ? out->ends.lo > 0 && out->ends.hi > 0 : out->ends.lo >= 0 && out->ends.hi >= 0) ||
           calc_fail(lx->error, ends->at, ends->len,
                     out->log ? "a logarithmic sweep needs positive ends"
                              : "an amplitude cannot be negative");
}

static bool write_harmonic(export_table *t, void *context) {
    const amplitudes *by = context;
    for (size_t i = 0; i < t->total; i++) {
        const long double part = (long double)i / (long double)by->steps;
        long double row[3] = {(double)points_place(by->ends.lo, by->ends.hi, by->log, part)};
        const value d = {row[0], DIM_LENGTH};
        if (!call_Kp(by->scene, d, &row[1], t->error) || !call_Kpp(by->scene, d, &row[2], t->error) ||
            !put_row(t, row))
            return false;
    }
    return true;
}

static bool export_harmonic(shell *sh, lexer *lx, parsed *all) {
    static const char *const names[] = {"dxA", "Kp", "Kpp", NULL};
    amplitudes by;
    return read_amplitudes(sh, lx, all, &by) &&
           write_table(sh, lx, all, names, by.steps + 1, write_harmonic, &by);
}

/* ---- loop -------------------------------------------------------------------------------------- */

/* The last period goes from one peak to the other and back; both branches have the turning point. */
static bool write_loop(export_table *t, void *context) {
    trial_along *a = context;
    const size_t turn = t->total / 2 - 1;
    for (size_t i = 0; trial_along_next(a, t->error); i++) {
        run_view now;
        run_view_now(a->trace.run, a->trace.levels, &now);
        for (int branch = i > turn ? 2 : 1; branch <= (i < turn ? 1 : 2); branch++)
            if (!put_row(t, (const long double[]){branch, now.state.dx, now.state.Fx, now.state.FN}))
                return false;
    }
    return !t->error->raised;
}

static bool export_loop(shell *sh, lexer *lx, parsed *all) {
    static const char *const names[] = {"branch", "dx", "Fx", "FN", NULL};
    const size_t steps = steps_of(all, 100);
    const scene *s = &sh->calc.scene;
    trial_along a;
    if (program_last_cycle(s->program, s->end) == NO_CYCLE)
        return calc_fail(lx->error, 0, 0, "no cycle has been run yet: cycle first (cycle FA=20 N)");
    trial *t = trial_open(&sh->calc, lx->error);
    bool ok = t && trial_along_begin(&a, t, ALONG_CYCLE, s->end, 2 * steps, false, lx->error);
    if (ok) {
        ok = write_table(sh, lx, all, names, 2 * (steps + 1), write_loop, &a);
        trial_along_end(&a);
    }
    calc_word(&sh->calc, lx->error);
    trial_close(t);
    return ok;
}

/* ---- jenkins: forms ---------------------------------------------------------------------------- */

typedef struct model {
    unsigned count;
    jenkins_element *element;
    jenkins_error quality;
    fret_pressed contact;
} model;

static bool write_csv(const settings *set, const model *m, FILE *to) {
    answer a;
    column columns[2] = {{.name = NULL}};
    const bool ok = column_si(&columns[0], "k", DIM_STIFFNESS) && column_si(&columns[1], "slip", DIM_FORCE);
    fprintf(to, "# parallel Jenkins elements of a contact at F_N = %.17g N, mu = %.17g\n",
            (double)m->contact.press.F, m->contact.mu);
    fprintf(to, "# worst error of the energy per cycle, up to the amplitude %.17g m: %.17g J\n",
            m->quality.most, m->quality.worst);
    answer_begin_as(&a, set, to, FORMAT_CSV);
    if (ok)
        answer_columns(&a, "export", columns, 2);
    for (unsigned i = 0; ok && i < m->count; i++)
        answer_row(&a, (const long double[]){m->element[i].k, m->element[i].s});
    columns_free(columns, 2);
    return answer_end(&a, ok) && ok;
}

static bool write_json(const settings *set, const model *m, FILE *to) {
    answer a;
    answer_begin_as(&a, set, to, FORMAT_JSON);
    answer_message(&a, "model", "jenkins");
    answer_number(&a, "FN", (double)m->contact.press.F);
    answer_number(&a, "mu", m->contact.mu);
    answer_number(&a, "error", m->quality.worst);
    answer_number(&a, "amplitude", m->quality.most);
    answer_items(&a, "elements");
    for (unsigned i = 0; i < m->count; i++) {
        answer_item(&a);
        answer_number(&a, "k", m->element[i].k);
        answer_number(&a, "slip", m->element[i].s);
        answer_up(&a);
    }
    answer_up(&a);
    answer_done(&a);
    return answer_end(&a, true);
}

static bool write_header(const settings *set, const model *m, FILE *to) {
    (void)set;
    fprintf(
        to,
        "/* Parallel Jenkins elements, each a spring k [N/m] in line with a slider of the force slip [N], of "
        "a\n"
        " * contact at F_N = %.9g N, mu = %.9g. Worst error of the energy per cycle, up to the amplitude\n"
        " * %.9g m: %.3g J. One step of the displacement d, with a force f[i] an element, all 0 at first:\n"
        " *     f[i] += k * (d_new - d_old), then f[i] = -slip or slip where it is beyond; F_x is their sum. "
        "*/\n",
        (double)m->contact.press.F, m->contact.mu, m->quality.most, m->quality.worst);
    fprintf(to, "#ifndef JENKINS_ELEMENTS\n#define JENKINS_ELEMENTS %u\n", m->count);
    fputs("static const struct { double k, slip; } jenkins_element[JENKINS_ELEMENTS] = {\n", to);
    for (unsigned i = 0; i < m->count; i++)
        fprintf(to, "    {%.17g, %.17g},\n", m->element[i].k, m->element[i].s);
    fputs("};\n#endif\n", to);
    return true;
}

/* False: out of memory. */
typedef bool writer(const settings *set, const model *m, FILE *to);
static const struct {
    const char *ending;
    writer *write;
} forms[] = {{".csv", write_csv}, {".json", write_json}, {".h", write_header}};

static writer *form_of(const lexer *lx, const span *part) {
    char name[FILE_NAME];
    hole_file(lx, part, name);
    for (size_t i = 0; i < sizeof forms / sizeof *forms; i++)
        if (file_ends(name, forms[i].ending))
            return forms[i].write;
    calc_raise(lx->error, part->at, part->len,
               "cannot tell the form of a model from '%s': use .csv, .json or .h", name);
    return NULL;
}

/* ---- jenkins ----------------------------------------------------------------------------------- */

/* Makes the elements for amplitudes up to FA, or for all amplitudes if it is NULL. */
static bool make_model(trial *t, const given_clause *FA, model *m, calc_error *error) {
    double amplitude = (double)INFINITY;
    fret_loading first;
    if (!scene_contact(&t->scene, &m->contact, error))
        return false;
    if (FA) {
        fret_status st = fret_loading_by_force(&m->contact, (double)FA->v.v, &first);
        st.quantity = "FA";
        if (!calc_status(error, st))
            return false;
        amplitude = (double)first.dx;
    }
    m->element = malloc(m->count * sizeof *m->element);
    if (!m->element)
        return calc_no_memory(error);
    return jenkins(&m->contact, amplitude, m->count, &shell_stop, progress_pulse, m->element, &m->quality,
                   error);
}

/* Writes the file, then answers with the errors; what can fail without the file comes first. */
static bool write_model(shell *sh, lexer *lx, const span *name, writer *write, const model *m) {
    target to;
    column columns[2] = {{.name = NULL}};
    const long double si[] = {m->quality.worst, m->quality.worst / m->quality.scale};
    answer a;
    bool ok = ((column_si(&columns[0], "error of dW", DIM_ENERGY) &&
                column_si(&columns[1], "relative", DIM_NONE)) ||
               calc_no_memory(lx->error)) &&
              target_file(lx, name, &to) &&
              target_close(sh, lx, &to, write(&sh->set, m, to.to) || calc_no_memory(lx->error));
    if (ok) {
        answer_begin(&a, &sh->set, sh->out);
        for (int i = 0; i < 2; i++)
            answer_value(&a, &columns[i], si[i]);
        answer_event(&a, "export");
        answer_string(&a, "model", "jenkins");
        answer_number(&a, "elements", m->count);
        answer_done(&a);
        ok = answer_end(&a, true) || calc_no_memory(lx->error);
    }
    columns_free(columns, 2);
    return ok;
}

static bool export_jenkins(shell *sh, lexer *lx, parsed *all) {
    const given_clause *count = parsed_clause(all, "", 0), *to = parsed_clause(all, "to", 0),
                       *FA = parsed_clause(all, "FA", 0);
    const span *name = &to->hole[0];
    if (!count)
        return calc_fail(lx->error, to->at, to->len,
                         "expected the number of elements before `to`: 1 to 1000");
    writer *write = form_of(lx, name);
    if (!write)
        return false;
    if (FA && count->count < 2)
        return calc_fail(lx->error, FA->hole[0].at, FA->hole[0].len,
                         "one of the elements is the spring of what sticks up to FA: take 2 or more");
    model m = {.count = count->count};
    trial *t = trial_open(&sh->calc, lx->error);
    const bool ok = t && make_model(t, FA, &m, lx->error) && write_model(sh, lx, name, write, &m);
    calc_word(&sh->calc, lx->error);
    trial_close(t);
    free(m.element);
    return ok;
}

/* ---- the command ------------------------------------------------------------------------------- */

static const struct {
    const char *name;
    const char *takes; /* grammar behind the name, see grammar.h */
    const char *summary;
    bool (*write)(shell *sh, lexer *lx, parsed *all);
} exported[] = {
    {"jenkins", "N:1000 to FILE.csv|json|h [FA=20 N]", "parallel springs in line with sliders",
     export_jenkins},
    {"harmonic", "to FILE.csv|json for NAME = LO .. HI [steps N:1000000] [log]",
     "K'(dxA) and K''(dxA), stiffness and loss stiffness of the first harmonic", export_harmonic},
    {"loop", "to FILE.csv|json [steps N:1000000]", "both branches of the last cycle, so many steps each",
     export_loop},
};
enum { EXPORTED = sizeof exported / sizeof *exported };

const char *export_name(size_t i) {
    return i < EXPORTED ? exported[i].name : NULL;
}

const grammar *export_form(size_t i) {
    return i < EXPORTED ? grammar_made("export", exported[i].name, exported[i].takes, exported[i].summary)
                        : NULL;
}

bool do_export(shell *sh, lexer *lx, parsed *all) {
    return exported[all->row].write(sh, lx, all);
}
