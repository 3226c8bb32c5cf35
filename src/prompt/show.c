/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The command show: the scene as statements, the settings and the tables as text. Changes nothing. */
#include "prompt/show.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "help/topics.h"
#include "statement/command.h"
#include "statement/output.h"
#include "statement/scripts.h"
#include "statement/setting_table.h"
#include "statement/text.h"

/* ---- the scene as statements ------------------------------------------------------------------- */

enum { VALUE_TEXT = 160 };

typedef struct writer {
    calc *c;
    FILE *to;
    bool any; /* something has been written */
} writer;

static const definition *binding(const writer *w, input in) {
    return (const definition *)w->c->scene.in.bound[in];
}

/* Bound inputs, too, are written by their value first: a definition may need the load, which needs the value.
 * Before there is a load they may have none, or only one of earlier inputs. */
static bool is_set(const writer *w, input in) {
    long double v;
    return w->c->scene.in.set[in] && (!binding(w, in) || scene_get(&w->c->scene, in, &v, error_quiet()));
}

static void write_start(writer *w, const char *words) {
    fputs(words, w->to);
    w->any = true;
}

static void write_value(writer *w, const char *name, const char *sign, value v) {
    char text[VALUE_TEXT];
    format_exact(v, text, sizeof text);
    fprintf(w->to, "%s%s%s", name, sign, text);
}

static value input_value(const writer *w, input in) {
    return (value){(long double)w->c->scene.in.v[in], quantity_dim(quantity_of_input(in), &w->c->scene)};
}

/* Writes ` NAME=VALUE` behind a command. */
static void write_argument(writer *w, const char *name, input in) {
    putc(' ', w->to);
    write_value(w, name, "=", input_value(w, in));
}

/* Writes `NAME = VALUE`, for an input that is no argument of a command written here. */
static void write_input(writer *w, input in) {
    write_start(w, "");
    write_value(w, quantity_of_input(in)->name, " = ", input_value(w, in));
    putc('\n', w->to);
}

/* Writes ` := TEXT`; line ends within a text that was continued become blanks. */
static void write_definition(writer *w, const definition *d) {
    fputs(" := ", w->to);
    for (const char *p = d->text; *p; p++)
        putc(*p == '\n' || *p == '\r' ? ' ' : *p, w->to);
    putc('\n', w->to);
}

static void write_binding(writer *w, input in) {
    if (!binding(w, in))
        return;
    write_start(w, quantity_of_input(in)->name);
    write_definition(w, binding(w, in));
}

/* `material` needs a modulus and nu (Estar alone will do), and for k also c0; the rest is set by name. */
static void write_material(writer *w) {
    const inputs *in = &w->c->scene.in;
    const bool graded = is_set(w, IN_K) && in->v[IN_K] != 0;
    static const input moduli[] = {IN_E0, IN_G0, IN_ESTAR};
    size_t m = 0;
    while (m < 2 && !is_set(w, moduli[m]))
        m++;
    const input E = moduli[m];
    const bool whole = is_set(w, E) && (is_set(w, IN_NU) || E == IN_ESTAR);
    const bool k_too = whole && graded && is_set(w, IN_C0);
    if (whole) {
        write_start(w, "material");
        write_argument(w, quantity_of_input(E)->name, E);
        if (is_set(w, IN_NU))
            write_argument(w, "nu", IN_NU);
        if (k_too)
            write_argument(w, "k", IN_K);
        if (is_set(w, IN_C0))
            write_argument(w, "c0", IN_C0);
        putc('\n', w->to);
    }
    if (!whole && is_set(w, E) && E != IN_E0)
        write_input(w, E);
    const bool alone[] = {[IN_E0] = !whole, [IN_NU] = !whole, [IN_K] = graded && !k_too, [IN_C0] = !whole};
    for (input i = IN_E0; i <= IN_C0; i++)
        if (alone[i] && is_set(w, i))
            write_input(w, i);
}

static void write_second(writer *w) {
    if (w->c->scene.in.second == SECOND_RIGID)
        write_start(w, "second rigid\n");
    if (w->c->scene.in.second != SECOND_GIVEN)
        return;
    const input E = is_set(w, IN_G0_2) ? IN_G0_2 : IN_E0_2;
    if (is_set(w, E) && is_set(w, IN_NU_2)) {
        write_start(w, "second");
        write_argument(w, E == IN_G0_2 ? "G0" : "E0", E);
        write_argument(w, "nu", IN_NU_2);
        putc('\n', w->to);
        return;
    }
    if (is_set(w, E))
        write_input(w, E);
    if (is_set(w, IN_NU_2))
        write_input(w, IN_NU_2);
}

/* Writes a file name, quoted if it must be; false if no form of it can be read back. */
static bool write_file_name(writer *w, const char *name) {
    const char *form = strchr(name, '"') ? " %s " /* as typed; the blank keeps a \ from continuing the line */
                       : strpbrk(name, " \t;#\\") ? " \"%s\""
                                                  : " %s";
    if (strpbrk(name, "\r\n"))
        return false;
    fprintf(w->to, form, name);
    return true;
}

static void write_smoothing(writer *w, const smoothing *how) {
    if (how->by)
        fputs(" smooth", w->to);
    if (how->by == SMOOTH_PIECES)
        fprintf(w->to, " %zu", how->pieces);
    if (how->by == SMOOTH_WITHIN)
        write_value(w, " ", "", (value){(long double)how->within, DIM_LENGTH});
}

static void write_radii(writer *w, const double R[2]) {
    static const char *const names[] = {" R1", " R2"};
    for (int i = 0; i < 2; i++)
        if (isinf(R[i]))
            fprintf(w->to, "%s=inf", names[i]);
        else
            write_value(w, names[i], "=", (value){(long double)R[i], DIM_LENGTH});
}

static void write_geometry(writer *w) {
    const inputs *in = &w->c->scene.in;
    const geometry *g = in->geometry;
    if (!g)
        return;
    write_start(w, "geometry ");
    fputs(g->name, w->to);
    for (input i = IN_N; i < INPUTS; i++)
        if (i == IN_RADIUS && in->radii[0] != 0)
            write_radii(w, in->radii);
        else if (in->set[i])
            write_argument(w, quantity_of_input(i)->name, i);
    for (int i = 0; i < in->sum.terms && g->kind == FRET_GAP_SUM; i++) {
        char n[VALUE_TEXT];
        format_exact((value){in->sum.power[i].n, DIM_NONE}, n, sizeof n);
        fprintf(w->to, "%s %s:", i ? "," : "", n);
        write_value(w, "", "", (value){in->sum.power[i].h, {0, 1 - in->sum.power[i].n, 0, 0}});
    }
    if (g->kind == FRET_GAP_TABLE && !write_file_name(w, in->table->name))
        fputs(" # the name of the file cannot be written in a statement", w->to);
    if (g->kind == FRET_GAP_TABLE) {
        write_smoothing(w, &in->table->smoothing);
        fprintf(w->to, "%s%s", in->table->smoothing.height ? " height" : "", in->table->smoothing.columns);
    }
    putc('\n', w->to);
}

static void write_friction(writer *w) {
    if (!is_set(w, IN_MU))
        return;
    write_start(w, "friction ");
    write_value(w, "", "", input_value(w, IN_MU));
    putc('\n', w->to);
}

static void write_rig(writer *w) {
    if (!is_set(w, IN_K_RIG))
        return;
    write_start(w, "rig");
    write_argument(w, "stiffness", IN_K_RIG);
    for (input i = IN_D0; i <= IN_F0; i++)
        if (is_set(w, i))
            write_argument(w, quantity_of_input(i)->name, i);
    putc('\n', w->to);
}

/* ---- the user's names -------------------------------------------------------------------------- */

static void write_name(writer *w, const own_name *name) {
    const definition *d = (const definition *)name->definition;
    write_start(w, name->text);
    for (unsigned i = 0; d && i < d->parameters; i++)
        fprintf(w->to, "%s%s%s", i ? ", " : "(", d->parameter[i], i + 1 == d->parameters ? ")" : "");
    if (d) {
        write_definition(w, d);
    } else {
        write_value(w, "", " = ", name->v);
        putc('\n', w->to);
    }
}

/* Does the definition of a name use another one that has not been written yet? */
static bool waits(const calc *c, size_t row, const bool written[]) {
    const definition *d = (const definition *)c->names.row[row].definition;
    for (size_t i = 0; i < c->names.count; i++)
        if (!written[i] && i != row && expr_mentions(c, &d->body, NULL, c->names.row[i].text))
            return true;
    return false;
}

/* Writes values first, then definitions, each after those that it uses: a name must be known to be read. */
static bool write_names(writer *w) {
    const own_names *n = &w->c->names;
    bool *written = calloc(n->count + 1, sizeof *written), more = true;
    if (!written)
        return false;
    for (size_t i = 0; i < n->count; i++) {
        written[i] = !n->row[i].known || !n->row[i].definition;
        if (n->row[i].known && written[i])
            write_name(w, &n->row[i]);
    }
    while (more) {
        more = false;
        for (size_t i = 0; i < n->count; i++)
            if (!written[i] && !waits(w->c, i, written)) {
                write_name(w, &n->row[i]);
                written[i] = more = true;
            }
    }
    free(written);
    return true;
}

/* ---- the load ---------------------------------------------------------------------------------- */

static void write_target(writer *w, const char *name, bool relative, double v, dim d) {
    putc(' ', w->to);
    write_value(w, name, relative ? "+=" : "=", (value){(long double)v, d});
}

static void write_cycle(writer *w, const load_item *item) {
    const load_step *step = &item->step;
    const quantity *amplitude = quantity_of_input(cycle_input((load_by)step->tangential));
    write_target(w, amplitude->name, false, step->tangential_value, amplitude->d);
    if (step->normal_value != 0 || item->extra.phase != 0) { /* a phase without FNA too */
        write_target(w, "FNA", false, step->normal_value, DIM_FORCE);
        write_target(w, "phase", false, item->extra.phase, DIM_ANGLE);
    }
    if (item->extra.times > 1)
        fprintf(w->to, " times %u", item->extra.times);
}

static void write_step(writer *w, const load_item *item) {
    static const char *const kinds[] = {[LOAD_PRESS] = "press", [LOAD_STEP] = "step", [LOAD_CYCLE] = "cycle"};
    const load_step *step = &item->step;
    write_start(w, kinds[step->kind]);
    if (step->kind == LOAD_CYCLE) {
        write_cycle(w, item);
    } else {
        if (step->normal) {
            const quantity *q = quantity_of_input(press_input((load_by)step->normal));
            write_target(w, q->name, step->relative & RELATIVE_NORMAL, step->normal_value, q->d);
        }
        if (step->tangential) {
            const quantity *q = quantity_of_step((load_by)step->tangential);
            write_target(w, q->name, step->relative & RELATIVE_TANGENTIAL, step->tangential_value, q->d);
        }
    }
    if (step->points)
        fprintf(w->to, " steps %u", step->points);
    putc('\n', w->to);
}

static void write_load(writer *w, bool whole) {
    enum { SHOWN = 20 };
    const scene *s = &w->c->scene;
    const size_t count = s->end.steps;
    if (count == 0)
        return;
    const size_t last_cycle = program_last_cycle(s->program, s->end);
    for (load_mark here = {0, 0}; here.steps < count; here.steps++) {
        const bool cycle = s->program->steps[here.steps].kind == LOAD_CYCLE;
        if (whole || count <= SHOWN || here.steps < SHOWN / 2 || here.steps >= count - SHOWN / 2) {
            const load_item item = program_item(s->program, here, last_cycle, &s->in);
            write_step(w, &item);
        } else if (here.steps == SHOWN / 2) {
            fprintf(w->to, "# ... %zu more steps, not shown\n", count - SHOWN);
        }
        here.cycles += cycle;
    }
}

/* Computes the bound inputs; one that cannot be computed keeps its last value. */
static void settle(calc *c) {
    long double unused;
    for (input i = 0; i < INPUTS; i++)
        if (c->scene.in.bound[i])
            scene_get(&c->scene, i, &unused, error_quiet());
}

bool scene_write(shell *sh, FILE *to, bool whole) {
    calc *c = &sh->calc;
    writer w = {c, to, false};
    settle(c);
    if (whole && c->scene.model != MODEL_AUTO)
        setting_show(setting_find("model"), sh, to);
    write_material(&w);
    write_second(&w);
    write_geometry(&w);
    write_friction(&w);
    write_rig(&w);
    for (input i = IN_YIELD; i <= IN_ALPHA_W; i++)
        if (is_set(&w, i))
            write_input(&w, i);
    write_load(&w, whole);
    if (is_set(&w, IN_NW))
        write_input(&w, IN_NW);
    const bool ok = write_names(&w);
    for (input i = 0; i < INPUTS; i++)
        write_binding(&w, i);
    if (!w.any)
        fputs("# nothing is set yet; try: demo, or help\n", to);
    return ok;
}

/* ---- show -------------------------------------------------------------------------------------- */

/* Shortens a long load at the prompt only: a script's output may be read back. */
static bool show_scene(shell *sh, FILE *to) {
    return scene_write(sh, to, !sh->interactive);
}

bool show_settings(shell *sh, FILE *to) {
    for (size_t i = 0; setting_row(i); i++)
        setting_show(i, sh, to);
    return true;
}

static bool show_units(shell *sh, FILE *to) {
    (void)sh;
    help_units(to);
    return true;
}

static bool show_commands(shell *sh, FILE *to) {
    const command *c;
    char usage[GRAMMAR_USAGE];
    (void)sh;
    for (size_t i = 0; (c = command_row(i)); i++) {
        grammar_usage(command_form(c), usage);
        fprintf(to, "%s\n", usage);
    }
    return true;
}

static bool show_demos(shell *sh, FILE *to) {
    (void)sh;
    for (const script *s = scripts; s->name; s++)
        fprintf(to, "%-11s %s\n", s->name, s->title);
    return true;
}

static bool show_variables(shell *sh, FILE *to) {
    writer w = {&sh->calc, to, false};
    if (!write_names(&w))
        return false;
    if (!w.any)
        fputs("# you have no names of your own yet; NAME = EXPR makes one\n", to);
    return true;
}

static const struct {
    const char *name;
    show_part *show;
} shown[] = {
    {"scene", show_scene},       {"settings", show_settings},   {"units", show_units},
    {"commands", show_commands}, {"variables", show_variables}, {"demos", show_demos},
};
enum { SHOWS = sizeof shown / sizeof *shown };

const char *show_name(size_t i) {
    return i < SHOWS ? shown[i].name : NULL;
}

bool show_text(shell *sh, show_part *part, calc_error *error) {
    text_out t;
    if (!text_begin(&t, sh, TEXT_WORDS, error))
        return false;
    const bool ok = part(sh, t.to) || calc_no_memory(error);
    return text_end(&t, ok) && ok;
}

bool do_show(shell *sh, lexer *lx, parsed *all) {
    return show_text(sh, shown[all->count ? all->list[0].choice : 0].show, lx->error); /* 0: the scene */
}
