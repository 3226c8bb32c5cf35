/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "shell/command.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "shell/output.h"

/* ---- the table --------------------------------------------------------------------------------- */

static const command commands[] = {
    {"material", do_material, "E0=210 GPa nu=0.3 [k=0.5 c0=1 mm] | steel", "the elastic bodies",
     "Sets E(z) = E0 (z/c0)^k and Poisson's ratio of both bodies. Without k the\n"
     "material is homogeneous and c0 is not needed. Presets: steel, aluminium,\n"
     "titanium, copper, glass, alumina, rubber.\n\n"
     "    fret> material E0=210 GPa nu=0.3 k=0.5 c0=1 mm\n"
     "    fret> E(0.25 mm), eta\n"
     "    E(0.25 mm) = 105 GPa\n"
     "    eta = 2.10754\n",
     COMPLETE_QUANTITY},
    {"second", do_second, "E0=70 GPa nu=0.33 | rigid | same", "the other body, where it differs",
     "The second body shares k and c0 with the first; by default it is the same.\n"
     "Bodies that are not elastically similar couple normal and tangential contact,\n"
     "which is left out here: a warning says so.\n\n"
     "    fret> material steel; second rigid; friction 0.3\n"
     "    fret> geometry sphere R=10 mm; press FN=100 N\n"
     "    warning: the bodies are elastically dissimilar (mismatch 0.286): normal and tangential contact are "
     "coupled, and these results are an approximation\n"
     "    fret> a\n"
     "    a = 148.125 um\n",
     COMPLETE_QUANTITY},
    {"geometry", do_geometry, "SHAPE NAME=EXPR ...", "the gap between the bodies",
     NULL, /* listed from the table of geometries */
     COMPLETE_GEOMETRY},
    {"friction", do_friction, "MU", "the coefficient of friction",
     "Sets mu, Coulomb's coefficient. `mu = 0.4` does the same.\n\n"
     "    fret> friction 0.4\n"
     "    fret> mu\n"
     "    mu = 0.4\n",
     COMPLETE_NONE},
    {"press", do_press, "FN=100 N | dz=1 um | a=0.2 mm", "press the bodies together: starts a load program",
     "By force, indentation depth or contact radius. What was stepped before is\n"
     "forgotten.\n\n"
     "    fret> material steel; geometry sphere R=10 mm\n"
     "    fret> press a=0.2 mm\n"
     "    fret> FN, dz\n"
     "    FN = 123.077 N\n"
     "    dz = 4 um\n",
     COMPLETE_QUANTITY},
    {"step", do_step, "Fx=20 N | dx=0.5 um | FN=120 N | dz=1 um, += for an increment [steps 50]",
     "a straight step of the load",
     "A tangential target, a normal target, or both for a straight ramp; += adds to\n"
     "what is there now. A normal step alone holds dx. Force cannot go beyond mu*FN;\n"
     "displacement can, and then the contact slides. `steps` records points on the\n"
     "way for `history`.\n\n"
     "    fret> material steel; geometry sphere R=10 mm; friction 0.4\n"
     "    fret> press FN=100 N\n"
     "    fret> step Fx=20 N; step Fx+=-10 N\n"
     "    fret> Fx, dx, c/a\n"
     "    Fx = 10 N\n"
     "    dx = 337.819 nm\n"
     "    c/a = 0.956466\n",
     COMPLETE_QUANTITY},
    {"cycle", do_cycle, "FA=20 N | dxA=0.5 um [times 3] [steps 200] [FNA=30 N phase=90 deg]",
     "close tangential cycles",
     "Goes to +FA, then through whole cycles +FA, -FA, +FA; dW is the energy that\n"
     "the last one dissipated. With FNA the normal force swings too,\n"
     "FN + FNA sin(w t + phase) against FA sin(w t), in `steps` chords.\n\n"
     "    fret> material steel; geometry sphere R=10 mm; friction 0.4\n"
     "    fret> press FN=100 N\n"
     "    fret> cycle FA=20 N\n"
     "    fret> dW, dW/(4*FN*dxmax) in %\n"
     "    dW = 1.90646 uJ\n"
     "    dW/(4*FN*dxmax) = 0.281737 %\n",
     COMPLETE_QUANTITY},
    {"follow", do_follow, "FILE.csv", "load along a table of FN,Fx or dz,dx",
     "The header gives the columns and their units. Every row is a straight step; one\n"
     "that cannot be carried leaves the scene as before the command. Where nothing is\n"
     "pressed yet the first row presses, and must have Fx or dx = 0. The first lines\n"
     "of such a file: `FN [N],Fx [N]`, then `100,0`, `120,15`.\n\n"
     "    fret> material steel; geometry sphere R=10 mm; friction 0.4; press FN=100 N\n"
     "    fret> follow /nonexistent.csv\n"
     "    error: cannot read /nonexistent.csv: No such file or directory\n",
     COMPLETE_FILE},
    {"reset", do_reset, "[all]", "forget the load program; all: the inputs too",
     "Variables of your own are kept.\n\n"
     "    fret> material steel; geometry sphere R=10 mm; press FN=1 N\n"
     "    fret> reset\n"
     "    fret> a\n"
     "    error: there is no load yet: press first (press FN=100 N)\n",
     COMPLETE_NONE},
    {"history", do_history, "[to FILE]", "the recorded load history as a table",
     "One row for every press and step, and for the points that `steps` asked for.\n"
     "FILE.csv is written as CSV.\n\n"
     "    fret> material steel; geometry sphere R=10 mm; friction 0.4\n"
     "    fret> press FN=100 N; step Fx=20 N; step Fx=-20 N\n"
     "    fret> history\n"
     "           FN [N]         dz [m]         Fx [N]         dx [m]          W [J]\n"
     "              100    3.48291e-06              0              0              0\n"
     "              100    3.48291e-06             20    6.25995e-07    4.76614e-07\n"
     "              100    3.48291e-06            -20   -6.25995e-07    1.42984e-06\n",
     COMPLETE_FILE},
    {"table", do_table, "EXPR, ... for VAR = LO .. HI [steps N] [log] [with VAR2 = v1, v2, ...] [to FILE]",
     "a table over a range",
     "VAR is an input (k, FN, mu, ...) or a free name; the scene stays as it is.\n\n"
     "    fret> material steel; geometry sphere R=10 mm; friction 0.4; press FN=100 N\n"
     "    fret> table dW(F) in uJ, c(F)/a for F = 10 N .. 40 N steps 3\n"
     "            F [N]     dW(F) [uJ]         c(F)/a\n"
     "               10       0.188365        0.90856\n"
     "               20        1.90646       0.793701\n"
     "               30        9.01533       0.629961\n"
     "               40        54.1344              0\n",
     COMPLETE_QUANTITY},
    {"plot", do_plot,
     "loop | accuracy [FA=20 N] | EXPR, ... for VAR = LO .. HI [steps N] [log] [with VAR2 = v1, ...] [to "
     "FILE.png|svg|pdf|gp]",
     "a figure, in the terminal or to a file",
     "`plot loop` draws the hysteresis loop, F_x against delta_x; `plot accuracy` the\n"
     "table of `accuracy`, error against time. FILE.gp is the gnuplot script itself.\n"
     "`set plot 80x24` fixes the size, `set plot auto` follows the terminal.\n\n"
     "    fret> material steel; geometry sphere R=10 mm; friction 0.4\n"
     "    fret> plot loop\n"
     "    error: there is no load yet: press first (press FN=100 N)\n",
     COMPLETE_QUANTITY},
    {"explain", do_explain, "QUANTITY", "formula, source, numbers put in, model used",
     "The formula with its equation number (Mathematics 2022, 10, 3641), the inputs\n"
     "that the value depends on, and how it was computed. `conditioning`: by which\n"
     "part of itself the last binary digit of each input, of the press and of the\n"
     "last load moves the value, and the ratio of the two. Large numbers, as close\n"
     "to gross slip, mean that the value cannot be better than its inputs, whatever\n"
     "the model.\n\n"
     "    fret> material E0=210 GPa nu=0.3\n"
     "    fret> explain eta\n"
     "    eta: stiffness ratio\n"
     "        c_N/c_T  (4),(5)\n"
     "        nu = 0.3\n"
     "        model: closed form\n"
     "        eta = 1.21429\n"
     "        conditioning          last digit    moves eta by  condition number\n"
     "        nu = 0.3                 1.9e-16         4.7e-17              0.25\n"
     "        no effect: E0\n",
     COMPLETE_QUANTITY},
    {"accuracy", do_accuracy, "[FA=20 N | dxA=0.5 um] [within 3]",
     "error against time of every model, for this scene",
     "A table of the models that can answer for dW: value, relative error, time of a\n"
     "cycle without setting up. Errors refer to quadrature in extended precision; `<`\n"
     "marks one that is below what it can tell. Without an argument the amplitude is\n"
     "that of the last cycle, else of Fx now, else half of mu*FN. Where FN swings or\n"
     "has changed, the load program is run as it is and errors refer to a refined\n"
     "memory diagram. Springs with `midpoint` weights x^k h converge with order 1+k\n"
     "where k < 0. The end says what `set model auto` picks, and which springs come\n"
     "close. Larger models are left out where all would take more than 3 seconds;\n"
     "`within 20` allows more, `within 0.3` less. `plot accuracy` draws the table.\n\n"
     "    fret> material steel; geometry sphere R=10 mm; friction 0.4; press FN=100 N\n"
     "    fret> accuracy FA=50 N\n"
     "    error: FA = 50 N exceeds mu*FN = 40 N: gross slip; cycle by displacement (dxA=...) to slide\n",
     COMPLETE_QUANTITY},
    {"show", do_show, "[scene|settings|units|commands]", "what is set",
     "The scene as the commands that make it again, to the last digit; the settings,\n"
     "the units or the commands.\n\n"
     "    fret> material steel; geometry sphere R=10 mm\n"
     "    fret> show\n"
     "    material E0=210 GPa nu=0.3\n"
     "    geometry sphere R=10 mm\n",
     COMPLETE_TOPIC},
    {"set", do_set,
     "format text|csv|json, digits 6, report auto|on|off, timing on|off, plot WxH|auto, model "
     "auto|closed|memory|springs N",
     "settings",
     "One setting a statement. `set timing on` shows the time of each statement and\n"
     "the models that answered. `set model` picks one: auto takes the closed form\n"
     "where there is one, else the memory diagram; springs are an approximation.\n\n"
     "    fret> set digits 12; pi\n"
     "    pi = 3.14159265359\n",
     COMPLETE_SETTING},
    {"source", do_source, "FILE", "run a script",
     "Statements of a file, as if typed here; it stops at the first error.\n\n"
     "    fret> source /nonexistent\n"
     "    error: cannot read /nonexistent: No such file or directory\n",
     COMPLETE_FILE},
    {"demo", do_demo, "", "play a session: a steel sphere on a graded half-space",
     "Shows each statement and its answer, in a scene of its own.\n", COMPLETE_NONE},
    {"help", do_help, "[TOPIC]", "this help, or that on a command, a quantity or a topic",
     "    fret> help kappa\n"
     "    kappa: shape factor\n"
     "        (n/2) B(n/2,(k+1)/2)  (8)\n",
     COMPLETE_TOPIC},
    {"apropos", do_apropos, "WORD", "find commands and quantities by a word",
     "    fret> apropos stick\n"
     "    c           stick radius\n",
     COMPLETE_NONE},
    {"quit", do_quit, "", "leave (so does Ctrl-D)", "    fret> quit\n", COMPLETE_NONE},
    {"exit", do_quit, "", "the same as quit", "    fret> exit\n", COMPLETE_NONE},
};
enum { COMMANDS = sizeof commands / sizeof *commands };

const command *command_row(size_t i) {
    return i < COMMANDS ? &commands[i] : NULL;
}

const char *command_name(size_t i) {
    return i < COMMANDS ? commands[i].name : NULL;
}

const command *command_find(const char *name, size_t len) {
    static word_index words = {.name = command_name};
    size_t row;
    return word_find(&words, name, len, &row) ? &commands[row] : NULL;
}

/* ---- help -------------------------------------------------------------------------------------- */

static void help_overview(FILE *to) {
    fputs("fret: partial-slip contact of power-law graded elastic solids.\n\n"
          "    NAME = EXPR             set an input (k = 0.5) or a variable of your own\n"
          "    EXPR [in UNIT], ...     print values: a, c/a, dW in uJ\n\n"
          "Commands (help COMMAND tells more):\n",
          to);
    for (size_t i = 0; i < COMMANDS; i++)
        fprintf(to, "    %-10s  %s\n", commands[i].name, commands[i].summary);
    fputs("\nTopics: help quantities, help expressions, help units, help geometry.\n"
          "Begin with `demo`, or:\n"
          "    material steel; geometry sphere R=10 mm; friction 0.4\n"
          "    press FN=100 N; cycle FA=20 N; dW\n",
          to);
}

static void quantity_line(FILE *to, const quantity *q) {
    char name[64];
    snprintf(name, sizeof name, q->get || q->in >= 0 ? "%s" : "%s(%s)", q->name, q->argument);
    fprintf(to, "%-10s  %s\n", name, q->title);
}

static void help_quantities(FILE *to) {
    fputs("Inputs (NAME = EXPR sets them):\n", to);
    const quantity *q;
    for (size_t i = 0; (q = quantity_row(i)); i++)
        if (q->in >= 0)
            fputs("    ", to), quantity_line(to, q);
    fputs("Results:\n", to);
    for (size_t i = 0; (q = quantity_row(i)); i++)
        if (q->in < 0 && q->get)
            fputs("    ", to), quantity_line(to, q);
    fputs("Functions of the scene:\n", to);
    for (size_t i = 0; (q = quantity_row(i)); i++)
        if (q->call) {
            char name[64];
            snprintf(name, sizeof name, "%s(%s)", q->name, q->argument);
            fprintf(to, "    %-10s  %s\n", name, q->title);
        }
}

static void help_expressions(FILE *to) {
    fputs("+ - * / ^ ( ), -2^2 is -4. Every value has a dimension; a mismatch is an error.\n"
          "Several statements on a line: `;`. A comment: `#`. A line goes on after `\\`.\n",
          to);
    for (size_t i = 0; builtin_name(i); i++)
        fprintf(to, "    %-8s  %s\n", builtin_name(i), builtin_summary(i));
}

static void help_units(FILE *to) {
    fputs("After a number, with or without a space (210 GPa, 0.3N/mm^2), and after `in`.\n"
          "Those marked * take the prefixes n u \xc2\xb5 m k M G.\n",
          to);
    for (size_t i = 0; unit_name(i); i++)
        fprintf(to, "    %-5s%c  %s\n", unit_name(i), unit_prefixed(i) ? '*' : ' ', unit_meaning(i));
}

static void help_geometry(FILE *to) {
    const geometry *g;
    for (size_t i = 0; (g = geometry_row(i)); i++)
        fprintf(to, "    geometry %-38s  %s\n", g->usage, g->meaning);
    fputs("\n    fret> geometry cone angle=45 deg\n    fret> slope\n    slope = 1\n", to);
}

static const struct {
    const char *name;
    void (*print)(FILE *to);
} topics[] = {{"quantities", help_quantities},
              {"expressions", help_expressions},
              {"units", help_units},
              {"geometry", help_geometry}};

static const char *topic_name(size_t i) {
    size_t n = sizeof topics / sizeof *topics;
    return i < n ? topics[i].name : i < n + COMMANDS ? commands[i - n].name : quantity_name(i - n - COMMANDS);
}

bool do_help(shell *sh, lexer *lx) {
    FILE *to = sh->out;
    if (lx->kind == T_END) {
        help_overview(to);
        return true;
    }
    char word[64];
    snprintf(word, sizeof word, "%.*s", (int)(lx->len < 60 ? lx->len : 60), lx->text + lx->at);
    const command *c = command_find(word, strlen(word));
    const quantity *q = quantity_find(word, strlen(word));
    void (*topic)(FILE *) = NULL;
    for (size_t i = 0; i < sizeof topics / sizeof *topics; i++)
        if (!strcmp(topics[i].name, word))
            topic = topics[i].print;
    if (!c && !q && !topic) {
        const char *near = suggest(word, topic_name);
        return lex_fail(lx, near ? "no help on '%s': did you mean %s?" : "no help on '%s'; try: help", word,
                        near);
    }
    lex_next(lx);
    if (!at_end(lx))
        return false;
    if (c)
        fprintf(to, "%s%s%s\n  %s\n", c->name, *c->usage ? " " : "", c->usage, c->summary);
    if (c && c->help)
        fprintf(to, "\n%s", c->help);
    if (topic)
        topic(to);
    if (q) {
        fprintf(to, "%s: %s\n    %s  %s\n", q->name, q->title, q->formula, q->source);
        if (q->call)
            fprintf(to, "    as a function: %s(%s)\n", q->name, q->argument);
    }
    return true;
}

static bool contains(const char *text, const char *word) {
    size_t n = strlen(word);
    for (; *text; text++) {
        size_t i = 0;
        while (i < n && text[i] && (text[i] | 0x20) == (word[i] | 0x20))
            i++;
        if (i == n)
            return true;
    }
    return false;
}

bool do_apropos(shell *sh, lexer *lx) {
    char word[64];
    if (lx->kind == T_END)
        return lex_fail(lx, "apropos what? such as: apropos radius");
    snprintf(word, sizeof word, "%.*s", (int)(lx->len < 60 ? lx->len : 60), lx->text + lx->at);
    lex_next(lx);
    if (!at_end(lx))
        return false;
    bool found = false;
    for (size_t i = 0; i < COMMANDS; i++)
        if (contains(commands[i].name, word) || contains(commands[i].summary, word)) {
            fprintf(sh->out, "%-10s  %s\n", commands[i].name, commands[i].summary);
            found = true;
        }
    const quantity *q;
    for (size_t i = 0; (q = quantity_row(i)); i++)
        if (contains(q->name, word) || contains(q->title, word)) {
            quantity_line(sh->out, q);
            found = true;
        }
    if (!found)
        fprintf(sh->out, "nothing on '%s'\n", word);
    return true;
}

/* ---- show and set ------------------------------------------------------------------------------ */

static void show_input(shell *sh, const char *name, input in, double v) {
    const quantity *q;
    size_t i = 0;
    while ((q = quantity_row(i)) && q->in != (int)in)
        i++;
    char text[160];
    format_exact(sh, (value){v, quantity_dim(q, &sh->calc.scene)}, text, sizeof text);
    fprintf(sh->out, " %s=%s", name ? name : q->name, text);
}

static void show_step(shell *sh, const load_step *step, const cycle_extra *extra) {
    static const char *const kinds[] = {"press", "step", "cycle"};
    static const char *const normal[] = {"", "FN", "dz", "a"}, *const tangential[] = {"", "Fx", "dx"};
    char text[160];
    fputs(kinds[step->kind], sh->out);
    if (step->kind == LOAD_CYCLE) {
        bool force = step->tangential == BY_FORCE;
        format_exact(sh, (value){step->tangential_value, force ? DIM_FORCE : DIM_LENGTH}, text, sizeof text);
        fprintf(sh->out, " %s=%s", force ? "FA" : "dxA", text);
        if (step->normal_value != 0) {
            format_exact(sh, (value){step->normal_value, DIM_FORCE}, text, sizeof text);
            fprintf(sh->out, " FNA=%s phase=%.15g deg", text, extra->phase * (180 / 3.14159265358979323846));
        }
        if (extra->times > 1)
            fprintf(sh->out, " times %u", extra->times);
    } else {
        if (step->normal) {
            double v = step->kind == LOAD_PRESS && step->normal == BY_FORCE ? sh->calc.scene.in[IN_FN]
                                                                            : step->normal_value;
            format_exact(sh, (value){v, step->normal == BY_FORCE ? DIM_FORCE : DIM_LENGTH}, text,
                         sizeof text);
            fprintf(sh->out, " %s%s=%s", normal[step->normal], step->relative & 1 ? "+" : "", text);
        }
        if (step->tangential) {
            format_exact(
                sh, (value){step->tangential_value, step->tangential == BY_FORCE ? DIM_FORCE : DIM_LENGTH},
                text, sizeof text);
            fprintf(sh->out, " %s%s=%s", tangential[step->tangential], step->relative & 2 ? "+" : "", text);
        }
    }
    if (step->points)
        fprintf(sh->out, " steps %u", step->points);
    fputc('\n', sh->out);
}

static void show_scene(shell *sh) {
    const scene *s = &sh->calc.scene;
    enum { SHOWN = 20 };
    if (s->set[IN_E0] || s->set[IN_NU]) {
        fputs("material", sh->out);
        if (s->set[IN_E0])
            show_input(sh, NULL, IN_E0, s->in[IN_E0]);
        if (s->set[IN_NU])
            show_input(sh, NULL, IN_NU, s->in[IN_NU]);
        if (s->in[IN_K] != 0)
            show_input(sh, NULL, IN_K, s->in[IN_K]);
        if (s->set[IN_C0])
            show_input(sh, NULL, IN_C0, s->in[IN_C0]);
        fputc('\n', sh->out);
    }
    if (s->second == SECOND_RIGID)
        fputs("second rigid\n", sh->out);
    if (s->second == SECOND_GIVEN) {
        fputs("second", sh->out);
        if (s->set[IN_E0_2])
            show_input(sh, "E0", IN_E0_2, s->in[IN_E0_2]);
        if (s->set[IN_NU_2])
            show_input(sh, "nu", IN_NU_2, s->in[IN_NU_2]);
        fputc('\n', sh->out);
    }
    if (s->geometry) {
        fprintf(sh->out, "geometry %s", s->geometry->name);
        for (input in = IN_N; in < INPUTS; in++)
            if (s->set[in])
                show_input(sh, NULL, in, s->in[in]);
        if (s->geometry->kind == FRET_GAP_TABLE)
            fprintf(sh->out, " %s", s->table->name);
        for (int i = 0; i < s->sum.terms && s->geometry->kind == FRET_GAP_SUM; i++) {
            char n[160], text[160];
            format_exact(sh, (value){s->sum.power[i].n, DIM_NONE}, n, sizeof n);
            format_exact(sh, (value){s->sum.power[i].h, {0, 1 - s->sum.power[i].n}}, text, sizeof text);
            fprintf(sh->out, "%s %s:%s", i ? "," : "", n, text);
        }
        fputc('\n', sh->out);
    }
    if (s->set[IN_MU]) {
        char text[160];
        format_exact(sh, (value){s->in[IN_MU], DIM_NONE}, text, sizeof text);
        fprintf(sh->out, "friction %s\n", text);
    }
    size_t cycle = 0;
    for (size_t i = 0; i < s->steps; i++) {
        const cycle_extra *extra = s->program[i].kind == LOAD_CYCLE ? &s->cycles[cycle++] : NULL;
        if (i < SHOWN / 2 || i + SHOWN / 2 >= s->steps)
            show_step(sh, &s->program[i], extra);
        else if (i == SHOWN / 2)
            fprintf(sh->out, "# ... %zu more steps\n", s->steps - SHOWN);
    }
    for (size_t i = 0; i < sh->calc.variable_count; i++) {
        char text[160];
        format_exact(sh, sh->calc.variables[i].v, text, sizeof text);
        fprintf(sh->out, "%s = %s\n", sh->calc.variables[i].name, text);
    }
    if (!s->set[IN_E0] && !s->geometry && !s->set[IN_MU] && !sh->calc.variable_count)
        fputs("# nothing is set yet; try: demo, or help\n", sh->out);
}

static const char *const formats[] = {"text", "csv", "json"}, *const reports[] = {"auto", "off", "on"},
                         *const models[] = {"auto", "closed", "memory", "springs"};

static void show_settings(shell *sh) {
    fprintf(sh->out, "set format %s\nset digits %d\nset report %s\nset timing %s\n", formats[sh->set.format],
            sh->set.digits, reports[sh->set.report], sh->set.timing ? "on" : "off");
    fprintf(sh->out, "set model %s", models[sh->calc.scene.model]);
    if (sh->calc.scene.model == MODEL_SPRINGS)
        fprintf(sh->out, " %u", sh->calc.scene.springs);
    fputc('\n', sh->out);
    if (sh->set.plot_width)
        fprintf(sh->out, "set plot %dx%d\n", sh->set.plot_width, sh->set.plot_height);
    else
        fputs("set plot auto\n", sh->out);
}

bool do_show(shell *sh, lexer *lx) {
    static const char *const what[] = {"scene", "settings", "units", "commands"};
    int which = 0;
    if (lx->kind == T_NAME) {
        while (which < 4 && !lex_is(lx, what[which]))
            which++;
        if (which == 4)
            return lex_fail(lx, "show what? scene, settings, units or commands");
        lex_next(lx);
    }
    if (!at_end(lx))
        return false;
    if (which == 0)
        show_scene(sh);
    else if (which == 1)
        show_settings(sh);
    else if (which == 2)
        help_units(sh->out);
    else
        for (size_t i = 0; i < COMMANDS; i++)
            fprintf(sh->out, "%s %s\n", commands[i].name, commands[i].usage);
    return true;
}

static bool one_of(lexer *lx, const char *const *words, int count, int *out) {
    for (int i = 0; i < count; i++)
        if (lex_accept(lx, words[i])) {
            *out = i;
            return true;
        }
    char list[128] = "";
    for (int i = 0; i < count; i++)
        snprintf(list + strlen(list), sizeof list - strlen(list), "%s%s",
                 i ? (i + 1 < count ? ", " : " or ") : "", words[i]);
    return lex_fail(lx, "expected %s", list);
}

bool do_set(shell *sh, lexer *lx) {
    static const char *const names[] = {"format", "digits", "report", "timing", "plot", "model"},
                             *const onoff[] = {"off", "on"};
    settings new = sh->set;
    int name, choice = 0;
    unsigned n = 0;
    if (lx->kind == T_END) {
        show_settings(sh);
        return true;
    }
    if (!one_of(lx, names, 6, &name))
        return false;
    if (name == 0) {
        if (!one_of(lx, formats, 3, &choice))
            return false;
        new.format = (format)choice;
    } else if (name == 1) {
        if (!read_count(sh, lx, "digits", 17, &n))
            return false;
        new.digits = (int)n;
    } else if (name == 2) {
        if (!one_of(lx, reports, 3, &choice))
            return false;
        new.report = (report)choice;
    } else if (name == 3) {
        if (!one_of(lx, onoff, 2, &choice))
            return false;
        new.timing = choice;
    } else if (name == 5) {
        if (!one_of(lx, models, 4, &choice) ||
            (choice == MODEL_SPRINGS && !read_count(sh, lx, "the number of springs", 10000000, &n)) ||
            !at_end(lx))
            return false;
        scene_set_model(&sh->calc.scene, (scene_model)choice, n);
        return true;
    } else if (lex_accept(lx, "auto")) {
        new.plot_width = new.plot_height = 0;
    } else {
        /* 80x24 reads as the number 80 and the name x24 */
        int w = 0, h = 0, used = 0;
        char text[32];
        snprintf(text, sizeof text, "%.*s", (int)(lx->end - lx->at < 30 ? lx->end - lx->at : 30),
                 lx->text + lx->at);
        if (sscanf(text, "%4dx%4d%n", &w, &h, &used) != 2 || w < 20 || h < 8)
            return lex_fail(lx, "expected a size such as 80x24 (at least 20x8), or auto");
        lex_seek(lx, lx->at + (size_t)used);
        new.plot_width = w, new.plot_height = h;
    }
    if (!at_end(lx))
        return false;
    sh->set = new;
    return true;
}

/* ---- sessions ---------------------------------------------------------------------------------- */

bool do_source(shell *sh, lexer *lx) {
    char name[4000];
    enum { NESTING = 16 };
    size_t at = lx->at;
    if (!lex_filename(lx, name, sizeof name) || !at_end(lx))
        return false;
    if (sh->nesting == NESTING)
        return calc_fail(lx->error, at, 1, "scripts are nested more than %d deep", NESTING);
    FILE *in = shell_open(name);
    if (!in)
        return calc_fail(lx->error, at, strlen(name), "cannot read %s: %s", name, strerror(errno));
    sh->nesting++;
    int status = shell_stream(sh, in, name, false);
    sh->nesting--;
    fclose(in);
    return status == EXIT_OK;
}

const char demo_text[] = "# A steel sphere, R = 10 mm, on a half-space that grows stiffer with depth\n"
                         "material E0=210 GPa nu=0.3 k=0.5 c0=1 mm\n"
                         "geometry sphere R=10 mm\n"
                         "friction 0.4\n"
                         "# Pressed with 100 N: contact radius and indentation depth\n"
                         "press FN=100 N\n"
                         "a, dz\n"
                         "# Pushed sideways with half of what friction holds: rim slips, middle sticks\n"
                         "step Fx=20 N\n"
                         "c, c/a, Fx, dx\n"
                         "# A full cycle: the energy lost, in closed form and along the way\n"
                         "cycle FA=20 N\n"
                         "dW, dW(20 N)\n"
                         "# The same with a homogeneous body: everything is computed anew\n"
                         "k = 0\n"
                         "a, c, dW\n"
                         "k = 0.5\n"
                         "# Close to gross slip the loop is widest\n"
                         "cycle FA=39 N\n"
                         "dW\n"
                         "plot loop\n";

bool do_demo(shell *sh, lexer *lx) {
    if (!at_end(lx))
        return false;
    /* in a scene of its own: the user's stays as it is */
    calc kept = sh->calc;
    report old = sh->set.report;
    sh->calc = (calc){.scene.stop = kept.scene.stop};
    sh->set.report = REPORT_OFF;
    bool ok = true;
    for (const char *line = demo_text; *line && ok && !shell_stop; line += strcspn(line, "\n") + 1) {
        size_t n = strcspn(line, "\n");
        bool comment = *line == '#';
        if (sh->set.format == FORMAT_TEXT)
            fprintf(sh->out, comment ? "\n%.*s\n" : "fret> %.*s\n", (int)n, line);
        ok = comment || shell_statement(sh, line, n, lx->error);
    }
    if (!ok)
        lx->error->at = lx->error->len = 0;
    kept.scene.used |= sh->calc.scene.used;
    calc_free(&sh->calc);
    sh->calc = kept;
    sh->set.report = old;
    return ok;
}

bool do_quit(shell *sh, lexer *lx) {
    if (!at_end(lx))
        return false;
    sh->quit = true;
    return true;
}
