/* SPDX-License-Identifier: GPL-3.0-or-later */
/* export jenkins: the contact for a dynamics code. Leaves the scene as it is. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "commands/export_command.h"
#include "language/trial.h"
#include "statement/answer.h"
#include "statement/progress.h"
#include "statement/target.h"
#include "study/jenkins.h"

typedef struct model {
    unsigned count;
    jenkins_element *element;
    jenkins_error quality;
    fret_pressed contact;
} model;

/* ---- forms ------------------------------------------------------------------------------------- */

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
    if (!hole_file(lx, part, name))
        return NULL;
    for (size_t i = 0; i < sizeof forms / sizeof *forms; i++)
        if (file_ends(name, forms[i].ending))
            return forms[i].write;
    calc_raise(lx->error, part->at, part->len,
               "cannot tell the form of a model from '%s': use .csv, .json or .h", name);
    return NULL;
}

/* ---- the command ------------------------------------------------------------------------------- */

typedef struct request {
    unsigned count;
    span name; /* of the file */
    writer *write;
    const heard *FA; /* NULL: no limit */
} request;

static bool read_request(lexer *lx, said *all, request *r) {
    const heard *count = said_of(all, "", 0), *to = said_of(all, "to", 0);
    if (!count)
        return calc_fail(lx->error, to->at, to->len, "expected how many elements before `to`: 1 to 1000");
    r->count = count->count;
    r->name = to->hole[0];
    r->write = form_of(lx, &r->name);
    r->FA = said_of(all, "FA", 0);
    return r->write && (!r->FA || r->count > 1 ||
                        calc_fail(lx->error, r->FA->hole[0].at, r->FA->hole[0].len,
                                  "up to FA one of the elements only sticks: take 2 or more"));
}

static bool make_model(trial *t, const request *r, model *m, calc_error *error) {
    double amplitude = (double)INFINITY;
    fret_loading first;
    if (!scene_contact(&t->scene, &m->contact, error))
        return false;
    if (r->FA) {
        fret_status st = fret_loading_by_force(&m->contact, (double)r->FA->v.v, &first);
        st.quantity = "FA";
        if (!calc_status(error, &st))
            return false;
        amplitude = (double)first.dx;
    }
    m->count = r->count;
    m->element = malloc(m->count * sizeof *m->element);
    if (!m->element)
        return calc_no_memory(error);
    return jenkins(&m->contact, amplitude, m->count, &shell_stop, progress_pulse, m->element, &m->quality,
                   error);
}

static bool write_model(shell *sh, lexer *lx, const request *r, const model *m) {
    target to;
    return target_file(lx, &r->name, &to) &&
           target_close(sh, lx, &to, r->write(&sh->set, m, to.to) || calc_no_memory(lx->error));
}

/* Into the file, and how good it is to the reader; what can fail without the file comes first. */
static bool give_model(shell *sh, lexer *lx, const request *r, const model *m) {
    column columns[2] = {{.name = NULL}};
    const long double si[] = {m->quality.worst, m->quality.worst / m->quality.scale};
    answer a;
    bool ok = ((column_si(&columns[0], "error of dW", DIM_ENERGY) &&
                column_si(&columns[1], "relative", DIM_NONE)) ||
               calc_no_memory(lx->error)) &&
              write_model(sh, lx, r, m);
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

bool export_jenkins(shell *sh, lexer *lx, said *all) {
    request r;
    model m = {.count = 0};
    trial *t = NULL;
    const bool ok = read_request(lx, all, &r) && (t = trial_open(&sh->calc, lx->error)) &&
                    make_model(t, &r, &m, lx->error) && give_model(sh, lx, &r, &m);
    calc_word(&sh->calc, lx->error);
    if (t)
        trial_close(t);
    free(m.element);
    return ok;
}
