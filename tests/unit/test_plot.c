/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Figures: the forms of texts, what reaches gnuplot, thinning, limits, pages, pictures. */
#define _GNU_SOURCE /* fopencookie */
#include "plot/plot.h"
#include "text/characters.h"

#include <sys/stat.h>
#include <unistd.h>

#include "plot/script.h"
#include "unit.h"

static calc_error error;

static calc_error *fresh(void) {
    error_clear(&error);
    return &error;
}

/* ---- texts -------------------------------------------------------------------------------------- */

static void check_text(const char *text, plot_form form, const char *want, int line) {
    char *got = plot_text(text, form);
    if (unit_count(got && !strcmp(got, want), __FILE__, line))
        printf("form %d of '%s': '%s', expected '%s'\n", (int)form, text, got ? got : "(null)", want);
    free(got);
}
#define TEXT(text, form, want) check_text(text, form, want, __LINE__)

/* The four forms of a label. */
static void label(const char *expression, const char *unit_text, const char *const want[4], int line) {
    char *text = plot_label(expression, unit_text);
    for (int form = PLOT_ASCII; CHECK(text) && form <= PLOT_TEX; form++)
        if (want[form])
            check_text(text, (plot_form)form, want[form], line);
    free(text);
}
#define LABEL(expression, unit_text, ...)                                                                    \
    label(expression, unit_text, (const char *const[4]){__VA_ARGS__}, __LINE__)

static void names(void) {
    LABEL("Fx/(mu*FN)", NULL, "Fx/(mu*FN)", "Fx/(μ FN)",
          "{/:Italic F}_{{/:Italic x}}/({/:Italic μ}\u2009{/:Italic F}_{N})",
          "\\relax $F_{x}/(\\mu \\,F_{\\mathrm{N}})$");
    LABEL("dx", "um", "dx [um]", "δx [µm]", "{/:Italic δ}_{{/:Italic x}} [µm]",
          "\\relax $\\delta _{x}$ [$\\mu$m]");
    LABEL("dW", "uJ", "dW [uJ]", "ΔW [µJ]", NULL, NULL);
    LABEL("p(0.1 mm)", "N/mm^2", "p(0.1 mm) [N/mm^2]", "p(0.1 mm) [N/mm²]", NULL, NULL);
    LABEL("k = -0.5", "", "k = -0.5", "k = −0.5", "{/:Italic k} = −0.5", NULL);
    LABEL("FN = 20 N, c0 = 1 um", "", "FN = 20 N, c0 = 1 um", "FN = 20 N, c0 = 1 µm", NULL, NULL);
    LABEL("x", "MPa*m^0.5", "x [MPa*m^0.5]", "x [MPa·m^0.5]", "{/:Italic x} [MPa·m^{0.5}]", NULL);
    LABEL("2*3*a^-2", "", "2*3*a^-2", "2·3 a⁻²", NULL, "\\relax $2\\cdot 3\\,a^{-2}$");
    LABEL("x*-1 + 2 * 3", "", "x*-1 + 2 * 3", "x·−1 + 2 · 3", NULL, NULL); /* not x - 1 */
    LABEL("a/b*c + a*(b/c + x*y)*b", "", "a/b*c + a*(b/c + x*y)*b", "a/b·c + a (b/c + x y) b", NULL, NULL);
    LABEL("a/(b*c)*x", "", "a/(b*c)*x", "a/(b c)·x", NULL, NULL); /* not a/(b c x) */
    LABEL("x^2^3 + x^(1/3) + x^2e1", "", "x^2^3 + x^(1/3) + x^2e1", "x^2³ + x^(1/3) + x^2e1",
          "{/:Italic x}\\^2^{3} + {/:Italic x}\\^(1/3) + {/:Italic x}\\^2e1",
          "\\relax $x\\mbox{\\textasciicircum{}}2^{3}\\ +\\ x\\mbox{\\textasciicircum{}}(1/3)\\ +\\ "
          "x\\mbox{\\textasciicircum{}}2e1$");
    LABEL("1e-6*x + 2e3", "", "1e-6*x + 2e3", "1e-6 x + 2e3", "1e-6\u2009{/:Italic x} + 2e3", NULL);
    LABEL("phase", "deg", "phase [deg]", "φ [°]", NULL, NULL);
    LABEL("force_max*x1", "", "force_max*x1", "force_max x1", "force\\_max\u2009{/:Italic x}_{1}", NULL);
    LABEL("", "um", "[um]", "[µm]", NULL, NULL);
    LABEL("dxmaximal + dWx + EE0", "", "dxmaximal + dWx + EE0", "dxmaximal + dWx + EE0", NULL, NULL);
}

/* Words, units behind numbers, numbers that break off, signs that nobody shall see. */
static void odd_names(void) {
    LABEL("sqrt(gamma(x))*loss_factor", NULL, "sqrt(gamma(x))*loss_factor", "√(Γ(x)) loss factor", NULL,
          "\\relax $\\mathrm{\\surd }(\\mathrm{\\Gamma }(x))\\,\\mathrm{loss factor}$");
    LABEL("A = 2 m^-2", "inch", "A = 2 m^-2 [inch]", "A = 2 m⁻² [in]", NULL, NULL);
    LABEL("A = 2 inch", "", "A = 2 inch", "A = 2 in", NULL, NULL);
    LABEL("A = 2 m^x + 3 m^", "", "A = 2 m^x + 3 m^", "A = 2 m^x + 3 m^", NULL, NULL);
    LABEL("A = 2 m^-", "", "A = 2 m^-", "A = 2 m^−", NULL, NULL);
    LABEL("2E+3*x + 2e+x + 1e", "", "2E+3*x + 2e+x + 1e", "2E+3 x + 2e+x + 1e", NULL, NULL);
    LABEL("a\u200bb \xff", "m\xff\u2066", "a?b ? [m??]", "a?b ? [m??]", NULL, NULL);
    TEXT("\u2029a\u2065\u061c\ufeff\u00ad\x7f\u2000\u200f\u202e\u2030\u206f\u2070", PLOT_UNICODE,
         "?a?????\u2000??\u2030?\u2070");
    TEXT("\ufff8\ufff9\ufffb\ufffc\U000dffff\U000e0001\U000e1000\xed\xa0\x80\xf4\x90\x80\x80", PLOT_UNICODE,
         "???\ufffc\U000dffff?\U000e1000???????");
}

static void plain(void) {
    TEXT("a_b^c {d} @e &f ~g \\h", PLOT_ENHANCED, "a\\_b\\^c \\{d\\} \\@e \\&f \\~g \\\\h");
    TEXT("a_b^c {d} #1 $x% &~\\", PLOT_TEX,
         "\\relax a\\_b\\textasciicircum{}c \\{d\\} \\#1 \\$x\\% \\&\\textasciitilde{}\\textbackslash{}");
    TEXT("[l]x", PLOT_TEX, "\\relax [l]x");
    TEXT("dx um mu", PLOT_UNICODE, "dx um mu"); /* words stay words */
    TEXT("µ δ é", PLOT_ASCII, "u d ?");
    TEXT("°²³µ·×ΓΔαβγδεηθκλμνπρστφω\u2009′″−√…", PLOT_ASCII,
         "deg^2^3u*xGammadalphabetagammadepsilonetathetakappalambdaunupirhosigmatauphiomega '''-sqrt...");
    TEXT("°²³µ·×ΓΔαβγδεηθκλμνπρστφω\u2009′″−√…", PLOT_TEX,
         "\\relax $^\\circ$$^2$$^3$$\\mu$$\\cdot $$\\times $$\\Gamma $$\\Delta $$\\alpha $$\\beta $$\\gamma $"
         "$\\delta $$\\varepsilon $$\\eta $$\\theta $$\\kappa $$\\lambda $$\\mu $$\\nu $$\\pi $"
         "$\\rho $$\\sigma $$\\tau $$\\varphi $$\\omega $$\\,$$'$$''$$-$$\\surd $$\\ldots $");
    /* controls, escapes, bidirectional and invisible characters, and what is no UTF-8 */
    TEXT("a\x1b[31m\nb\x7f\u202e\u200b\xc2\x85", PLOT_UNICODE, "a?[31m?b????");
    TEXT("\xff\xc0\xaf\xed\xa0\x80\xe2\x82", PLOT_ENHANCED, "????????");
    TEXT("\xf0\x9f\x98\x80", PLOT_UNICODE, "\xf0\x9f\x98\x80");
    TEXT(PLOT_END PLOT_END "a" PLOT_EXPR, PLOT_UNICODE, "a");
    TEXT("", PLOT_TEX, "");
}

static void page_sizes(void) {
    plot_panel above = {.count = 0}, lower = {.below = true};
    const plot_figure one = {1, {&above}}, two = {2, {&above, &above}}, stacked = {2, {&above, &lower}};
    plot_target t = {.columns = 20, .rows = 5};
    plot_pages p = plot_pages_for(&t, &one, true);
    CHECK(p.columns == 30 && p.rows == 8);
    t = (plot_target){.columns = 90, .rows = 30};
    p = plot_pages_for(&t, &two, true);
    CHECK(!p.beside && p.columns == 90 && p.rows == 15);
    p = plot_pages_for(&t, &two, false);
    CHECK(!p.beside && p.columns == 90 && p.rows == 30);
    t.columns = 100;
    p = plot_pages_for(&t, &two, true);
    CHECK(p.beside && p.columns == 50 && p.rows == 30);
    p = plot_pages_for(&t, &stacked, false);
    CHECK(!p.beside && p.columns == 100 && p.rows == 30);
    CHECK(plot_columns(&two) == 2 && plot_columns(&stacked) == 1);
}

/* Whatever the bytes: no control character, quote or newline leaves the quoting. */
static void quoting(void) {
    unsigned long long random = 7;
    for (int n = 0; n < 2000; n++) {
        char raw[40], *script = NULL;
        size_t room;
        for (size_t i = 0; i < sizeof raw - 1; i++) {
            static const char nasty[] = "'\"`\\@$#\n%{}()|;_^&~\001\002\00307";
            double u = unit_random(&random, 0, 1);
            raw[i] = u < 0.6 ? nasty[(size_t)unit_random(&random, 0, sizeof nasty - 1)]
                             : (char)(unsigned char)unit_random(&random, 1, 256);
        }
        raw[sizeof raw - 1] = 0;
        for (int form = PLOT_ASCII; form <= PLOT_TEX; form++) {
            char *text = plot_text(raw, (plot_form)form);
            FILE *to = open_memstream(&script, &room);
            plot_quote(to, text);
            fclose(to);
            bool ok = room >= 2 && script[0] == '"' && script[room - 1] == '"';
            for (size_t i = 1; i + 1 < room; i++) {
                ok &= !strchr("\"`'@$#", script[i]) && (unsigned char)script[i] >= 0x20;
                if (script[i] == '\\') /* an octal code, for gnuplot of any number of digits */
                    ok &= i + 3 < room - 1 && strspn(script + i + 1, "01234567") == 3;
            }
            CHECK(ok);
            free(text);
            free(script);
        }
    }
}

/* ---- figures ------------------------------------------------------------------------------------ */

static plot_figure figure(plot_role role, const char *title) {
    plot_figure f = {.count = 0};
    plot_panel *p = plot_panel_add(&f, fresh());
    CHECK(p && plot_series_add(p, role, title, fresh()));
    return f;
}

static char *text_of(plot_figure *f, plot_target target) {
    char *text = NULL;
    size_t room;
    target.out = open_memstream(&text, &room);
    if (!target.terminal)
        target.terminal = PLOT_DUMB;
    bool ok = plot_draw(f, 1, &target, NULL, fresh());
    fclose(target.out);
    if (!CHECK(ok))
        printf("%s\n", error.text);
    return text;
}

static bool write_script(plot_figure *f, const char *ending, int width, int height, FILE *to) {
    plot_extents extent[PLOT_PANELS];
    for (size_t i = 0; i < f->count; i++)
        extent[i] = plot_settle(f->panel[i]);
    const plot_kind *kind = plot_kind_of(ending, error_quiet());
    return kind && f->count &&
           plot_write_picture(to, &(plot_reel){f, 1, extent, 0}, kind,
                              &(plot_target){.width = width, .height = height}, error_quiet());
}

static char *script_of(plot_figure *f, const char *ending) {
    char *text = NULL;
    size_t room;
    FILE *to = open_memstream(&text, &room);
    CHECK(write_script(f, ending, 0, 0, to));
    fclose(to);
    return text;
}

static bool has(const char *text, const char *part) {
    return strstr(text, part) != NULL;
}

static void scripts(void) {
    plot_figure f = figure(PLOT_CURVE, "'; system('touch pwned'); # \"");
    plot_panel *p = f.panel[0];
    plot_series *s = p->series[0];
    p->title = strdup("''''; system(\"touch pwned\") `touch pwned`\nset output 'x'\n");
    p->xlabel = plot_label("`touch pwned`", "'`\"");
    plot_point(s, 0, 1);
    plot_point(s, 1, 2);
    plot_point(s, 2, NAN);
    plot_point(s, 3, INFINITY);
    plot_point(s, 4, 5);
    static const char *const endings[] = {".png", ".svg", ".pdf", ".tex", ".html", ".gif", ".gp"};
    for (size_t i = 0; i < sizeof endings / sizeof *endings; i++) {
        char *text = script_of(&f, endings[i]);
        CHECK(!has(text, "system(\"") && !has(text, "system('") && !has(text, "`") &&
              !has(text, "\nset output"));
        CHECK(has(text, "\n0 1\n1 2\n\n4 5\nEND\n")); /* a gap ends the line once */
        CHECK(has(text, "set terminal") == (i < 6));
        free(text);
    }
    CHECK(!write_script(&f, ".jpg", 0, 0, stdout));
    plot_figure_free(&f);
}

/* Curves are told apart without colour. */
static void styles(void) {
    plot_figure f = figure(PLOT_CURVE, "c0");
    plot_panel *p = f.panel[0];
    for (int i = 1; i < 12; i++) {
        char name[16];
        snprintf(name, sizeof name, "c%d", i);
        plot_series_add(p, PLOT_CURVE, name, fresh());
    }
    for (size_t i = 0; i < p->count; i++)
        for (int j = 0; j < 3; j++)
            plot_point(p->series[i], j, j);
    char *text = script_of(&f, ".gp");
    const char *look[12];
    size_t length[12];
    for (size_t i = 0; i < 12; i++) {
        char name[16];
        snprintf(name, sizeof name, " title \"c%zu\"", i);
        const char *end = strstr(text, name), *at = end;
        if (!CHECK(end != NULL) || !CHECK(!strstr(end + 1, name)))
            break;
        while (strncmp(at, "dt ", 3) != 0) /* dashes and marks */
            at--;
        look[i] = at;
        length[i] = (size_t)(end - at);
        for (size_t j = 0; j < i; j++)
            CHECK(length[i] != length[j] || strncmp(look[i], look[j], length[i]) != 0);
    }
    CHECK(has(text, "$data0_0_7 using 1:2 with linespoints") &&
          has(text, "$data0_0_6 using 1:2 with lines "));
    free(text);
    for (size_t i = p->count; i < PLOT_CURVES; i++)
        CHECK(plot_series_add(p, PLOT_CURVE, NULL, fresh()));
    CHECK(!plot_series_add(p, PLOT_CURVE, "x", fresh()) && has(error.text, "more than 64"));
    for (size_t i = 1; i < PLOT_PANELS; i++)
        CHECK(plot_panel_add(&f, fresh()));
    CHECK(!plot_panel_add(&f, fresh()) && has(error.text, "more than 6"));
    plot_figure_free(&f);
}

/* Drawn once each, from below: bands, thin curves, curves, the present point; what is empty and has no title
 * is not. */
static void layers(void) {
    static const struct {
        plot_role role;
        bool thin;
        const char *name;
    } rows[] = {{PLOT_NOW, false, "now"},
                {PLOT_CURVE, false, "curve"},
                {PLOT_CURVE, true, "thin"},
                {PLOT_BAND, false, "band"}};
    static const char *const order[] = {"band", "thin", "curve", "now"};
    plot_figure f = figure(PLOT_CURVE, NULL);
    plot_panel *p = f.panel[0];
    plot_series_add(p, PLOT_CURVE, NULL, fresh());
    for (size_t i = 0; i < 4; i++) {
        plot_series *s = plot_series_add(p, rows[i].role, rows[i].name, fresh());
        s->thin = rows[i].thin;
        plot_point(s, 0, 1);
        plot_point(s, 1, 2);
    }
    char *text = script_of(&f, ".gp");
    const char *at = strstr(text, "plot ");
    int drawn = 0;
    for (const char *with = at; with && (with = strstr(with, " with ")); with++)
        drawn++;
    CHECK(drawn == 4);
    for (size_t i = 0; i < 4 && CHECK(at != NULL); i++) {
        char title[24];
        snprintf(title, sizeof title, " title \"%s\"", order[i]);
        at = strstr(at, title);
    }
    CHECK(at != NULL);
    free(text);
    plot_figure_free(&f);
}

/* Measured points lie on the curve, as rings; a crowd of them, as dots, below it. */
static void crowds(void) {
    plot_figure f = figure(PLOT_CURVE, "curve");
    plot_panel *p = f.panel[0];
    plot_series *few = plot_series_add(p, PLOT_MEASURED, "few", fresh()),
                *many = plot_series_add(p, PLOT_MEASURED, "many", fresh());
    for (int i = 0; i <= 800; i++) {
        plot_point(p->series[0], i, i);
        plot_point(many, i, i);
        if (i % 40 == 0)
            plot_point(few, i, i);
    }
    char *text = script_of(&f, ".gp");
    const char *of_many = strstr(text, "title \"many\""), *curve = strstr(text, "title \"curve\""),
               *of_few = strstr(text, "title \"few\"");
    CHECK(of_many && curve && of_few && of_many < curve && curve < of_few);
    CHECK(has(text, "pt 7 ps 0.4") && has(text, "pt 6 ps 1.3"));
    free(text);
    text = text_of(&f, (plot_target){.columns = 60, .rows = 20});
    size_t of_curve = 0;
    for (const char *at = text; *at; at++)
        of_curve += *at == '*';
    CHECK(of_curve > 10);
    free(text);
    text = text_of(&f, (plot_target){.columns = 60, .rows = 20, .terminal = PLOT_BLOCK});
    of_curve = 0;
    for (const char *at = text; *at; at++)
        of_curve += (*at & 0xff) == 0xe2; /* begins a character of braille */
    CHECK(of_curve > 30);
    free(text);
    plot_figure_free(&f);
}

/* What scripts say of thin series, of measured ones, of bands with holes, of axes and maps of several kinds.
 */
static void looks_of(void) {
    plot_figure f = figure(PLOT_CURVE, NULL);
    plot_panel *p = f.panel[0];
    plot_series *thin = p->series[0], *measured = plot_series_add(p, PLOT_MEASURED, "one", fresh()),
                *more = plot_series_add(p, PLOT_MEASURED, "two", fresh()),
                *band = plot_series_add(p, PLOT_BAND, NULL, fresh()),
                *empty = plot_series_add(p, PLOT_CURVE, NULL, fresh());
    thin->thin = band->thin = true;
    empty->style = 3;
    for (int i = 0; i < 5; i++) {
        plot_point(thin, i, 1e6 * i);
        plot_point(measured, i, 2e6);
        plot_point(more, i, 3e6);
        plot_band(band, i, 0, i == 2 ? NAN : 1e6);
    }
    p->points = true;
    char *text = script_of(&f, ".png");
    CHECK(has(text, "lines lw 0.9 lc rgb '#707070' dt solid notitle") ||
          has(text, "lc rgb '#707070' dt solid notitle"));
    CHECK(has(text, "fc rgb '#e4e4e4'") && has(text, "\n1 0 1000000\n\n3 0 1000000\n"));
    CHECK(has(text, "lc rgb '#000000' title \"one\"") || has(text, "lc rgb '#000000' title 'one'"));
    CHECK(!has(text, "lc rgb '#000000' title \"two\"") && has(text, "two") && !has(text, "$data0_0_4 using"));
    CHECK(has(text, "set format y '%h'") && !has(text, "set format x '%h'"));
    free(text);
    for (int i = 0; i < 5; i++)
        thin->x[i] = measured->x[i] = more->x[i] = band->x[i] = 1e-5 * pow(10, i);
    p->logx = true;
    text = script_of(&f, ".tex");
    CHECK(has(text, "set format x '$10^{%T}$'") && !has(text, "set xzeroaxis lt"));
    free(text);
    p->logx = false;
    p->logy = true;
    text = script_of(&f, ".tex");
    CHECK(!has(text, "set xzeroaxis lt"));
    free(text);
    plot_figure_free(&f);
}

static void fill_map(plot_map *m, double z(double x, double y)) {
    for (size_t i = 0; i < m->nx * m->ny; i++) {
        m->x[i % m->nx] = 1.0 + (double)(i % m->nx);
        m->y[i / m->nx] = 20.0 - (double)(i / m->nx); /* downwards */
    }
    for (size_t i = 0; i < m->nx * m->ny; i++)
        m->z[i] = z(m->x[i % m->nx], m->y[i / m->nx]);
}

static double steep(double x, double y) {
    return pow(10, 0.2 * x) + y;
}

static double flat(double x, double y) {
    return 0 * x * y + 7;
}

static double plane(double x, double y) {
    return x - y;
}

static void maps(void) {
    plot_figure f = {.count = 0};
    plot_panel *p = plot_panel_add(&f, fresh());
    CHECK(plot_map_make(p, 20, 20, fresh()));
    p->map.label = strdup("z");
    p->title = strdup("a title");
    fill_map(&p->map, steep);
    char *text = script_of(&f, ".tex");
    CHECK(has(text, "set logscale cb\nset format cb '$10^{%T}$'"));
    free(text);
    p->flipx = p->flipy = true;
    text = script_of(&f, ".png");
    CHECK(has(text, "set logscale cb\nset format cb '10^{%T}'") && has(text, "set xrange [20:1]") &&
          has(text, "front boxed"));
    free(text);
    fill_map(&p->map, flat);
    text = script_of(&f, ".png");
    CHECK(has(text, "levels discrete 0\n") && !has(text, "lines nosurface"));
    free(text);
    fill_map(&p->map, plane);
    p->xlo = -10; /* beside the map there is nothing */
    p->xhi = 30;
    text = text_of(&f, (plot_target){.columns = 0, .rows = 0});
    CHECK(has(text, "contours of z") && has(text, "a title"));
    free(text);
    text = text_of(&f, (plot_target){.columns = 70, .rows = 20, .unicode = true, .terminal = PLOT_BLOCK});
    CHECK(has(text, "contours of z") && !has(text, "\u2812"));
    free(text);
    p->xlo = p->xhi = NAN;
    plot_panel *q = plot_panel_add(&f, fresh());
    plot_series *s = plot_series_add(q, PLOT_CURVE, "key", fresh());
    plot_point(s, 0, 0);
    plot_point(s, 1, 1);
    text = script_of(&f, ".svg");
    CHECK(has(text, "set xtics 5\n") && has(text, "set multiplot layout 1,2") &&
          has(text, "set tmargin 3\n"));
    free(text);
    p->logx = true;
    text = script_of(&f, ".svg");
    CHECK(!has(text, "set xtics 5\n"));
    free(text);
    plot_figure_free(&f);
}

/* ---- thinning ----------------------------------------------------------------------------------- */

static void extremes(const plot_series *s, double of[4]) {
    of[0] = of[2] = INFINITY;
    of[1] = of[3] = -INFINITY;
    for (size_t i = 0; i < s->count; i++)
        if (isfinite(s->x[i]) && isfinite(s->y[i])) {
            of[0] = fmin(of[0], s->x[i]), of[1] = fmax(of[1], s->x[i]);
            of[2] = fmin(of[2], s->y[i]), of[3] = fmax(of[3], s->y[i]);
        }
}

static void thins(void) {
    plot_figure f = figure(PLOT_CURVE, NULL);
    plot_series *s = f.panel[0]->series[0];
    double before[4], after[4];
    for (int i = 0; i < 100000; i++) /* a zigzag with one spike, one gap */
        plot_point(s, i, i == 33333 ? 7.0 : i == 77777 ? -9 : i == 50001 ? NAN : (double)(i % 2));
    extremes(s, before);
    plot_thin(s, 5000);
    extremes(s, after);
    CHECK(s->count <= 7500 && !memcmp(before, after, sizeof before));
    bool gap = false, rising = true;
    for (size_t i = 0; i < s->count; i++) {
        gap |= isnan(s->y[i]);
        rising &= i == 0 || s->x[i] > s->x[i - 1];
    }
    CHECK(gap && rising && s->x[0] == 0 && s->x[s->count - 1] == 99999);
    size_t count = s->count;
    plot_thin(s, 10000); /* few enough already */
    CHECK(s->count == count);
    for (size_t i = 0; i < 5; i++) /* a stretch that begins with a gap, another axis' gap */
        *(i % 2 ? &s->x[i] : &s->y[i]) = NAN;
    s->x[7] = -5;
    for (size_t i = 2000; i < 2200; i++) /* and one of gaps alone */
        s->y[i] = NAN;
    plot_thin(s, 3); /* less than a zigzag keeps: one stretch */
    extremes(s, after);
    CHECK(s->count <= 9 && isnan(s->y[0]) && after[0] == -5 && after[1] == 99999 && after[2] == -9 &&
          after[3] == 7);
    plot_figure_free(&f);
    f = figure(PLOT_CURVE, NULL); /* stretches that are not all as long */
    s = f.panel[0]->series[0];
    for (int i = 0; i < 1099; i++)
        plot_point(s, i, i);
    plot_thin(s, 400);
    CHECK(s->count == 200 && s->x[0] == 0 && s->x[199] == 1098);
    for (size_t i = 1; i < s->count; i++) {
        const double on = s->x[i] - s->x[i - 1];
        CHECK(i % 2 ? on == 9 || on == 10 : on == 1);
    }
    plot_figure_free(&f);
}

/* A series without end: bounded, its extremes kept, spread evenly. */
static void bounded(void) {
    plot_figure f = figure(PLOT_CURVE, NULL);
    plot_series *s = f.panel[0]->series[0];
    enum { N = 5000011 };
    bool ok = true;
    for (int i = 0; i < N && ok; i++)
        ok = plot_point(s, i, i == 1234567 ? 99 : i == 4000000 ? NAN : i == N - 2 ? -99 : sin(1e-5 * i));
    double of[4];
    extremes(s, of);
    CHECK(ok && s->count <= PLOT_KEPT && s->room == PLOT_KEPT && s->count > PLOT_KEPT / 4);
    CHECK(of[0] == 0 && of[1] == N - 1 && of[2] == -99 && of[3] == 99);
    double widest = 0;
    bool rising = true, gap = false;
    for (size_t i = 1; i < s->count; i++) {
        widest = fmax(widest, s->x[i] - s->x[i - 1]);
        rising &= s->x[i] >= s->x[i - 1];
        gap |= isnan(s->y[i]);
    }
    CHECK(rising && gap && widest < 1000);
    plot_thin(s, PLOT_WRITTEN);
    extremes(s, of);
    CHECK(of[0] == 0 && of[1] == N - 1 && of[2] == -99 && of[3] == 99);
    const double points = N, parts = PLOT_WRITTEN / 4; /* a part keeps four points */
    for (size_t i = 1; i < s->count; i++)
        CHECK(s->x[i] - s->x[i - 1] < 2.5 * points / parts); /* stretches of two such */
    plot_figure_free(&f);
}

/* A dense cloud stays one: no part of its width is left bare. */
static void clouds(void) {
    enum { PARTS = 100 };
    plot_figure f = figure(PLOT_MEASURED, NULL);
    plot_series *s = f.panel[0]->series[0];
    bool seen[PARTS] = {false};
    for (int i = 0; i < 100000; i++)
        plot_point(s, i % 10000 / 1e4, i % 7); /* ten turns */
    plot_settle(f.panel[0]);
    for (size_t i = 0; i < s->count; i++)
        seen[(int)(s->x[i] * (double)PARTS)] = true;
    for (int i = 0; i < PARTS; i++)
        CHECK(seen[i]);
    plot_figure_free(&f);
}

static void bands(void) {
    plot_figure f = figure(PLOT_BAND, NULL);
    plot_series *s = f.panel[0]->series[0];
    for (int i = 0; i < 400000; i++)
        plot_band(s, i, 1, i == 123456 ? 50 : 2);
    plot_thin(s, 100);
    double most = 0;
    for (size_t i = 0; i < s->count; i++)
        most = fmax(most, s->y2[i]);
    CHECK(most == 50 && s->count < 250);
    plot_figure_free(&f);
}

/* ---- axes --------------------------------------------------------------------------------------- */

static void axes(void) {
    plot_figure f = figure(PLOT_CURVE, NULL);
    plot_panel *p = f.panel[0];
    plot_axis x, y;
    plot_extents e = plot_settle(p);
    CHECK(!plot_axes(p, &e, true, &x, &y, fresh()) && has(error.text, "nothing to plot"));
    plot_point(p->series[0], 1, 3);
    plot_point(p->series[0], 2, 3 * (1 + 1e-14));
    e = plot_settle(p);
    CHECK(plot_axes(p, &e, true, &x, &y, fresh()));
    CHECK(x.lo == 1 && x.hi == 2);   /* a graph fills its frame */
    CHECK(y.lo < 2.8 && y.hi > 3.2); /* one value */
    plot_point(p->series[0], 1.5, -1);
    e = plot_settle(p);
    CHECK(plot_axes(p, &e, true, &x, &y, fresh()) && x.lo < 1 && x.hi > 2 && y.lo < -1 && y.hi > 3);
    p->ylo = 2;
    p->yhi = 1;
    CHECK(plot_axes(p, &e, true, &x, &y, fresh()) && y.flip && y.lo == 1 && y.hi == 2);
    p->yhi = 2;
    CHECK(!plot_axes(p, &e, true, &x, &y, fresh()) && has(error.text, "limits"));
    p->ylo = 0;
    p->logy = true;
    CHECK(!plot_axes(p, &e, true, &x, &y, fresh()) && has(error.text, "above 0"));
    p->ylo = p->yhi = NAN;
    e = plot_settle(p);
    CHECK(plot_axes(p, &e, true, &x, &y, fresh()) && y.lo > 0);
    p->xlo = 3;
    CHECK(!plot_axes(p, &e, true, &x, &y, fresh()) &&
          has(error.text, "nothing lies within the limits of the x axis"));
    p->xlo = NAN;
    p->yhi = 0; /* one limit alone */
    CHECK(!plot_axes(p, &e, true, &x, &y, fresh()) && has(error.text, "above 0"));
    p->yhi = 5;
    CHECK(plot_axes(p, &e, true, &x, &y, fresh()) && y.lo > 2.5 && y.lo < 3 && y.hi == 5);
    plot_figure_free(&f);

    f = figure(PLOT_CURVE, NULL); /* what ends at nothing is shown up to there */
    p = f.panel[0];
    plot_point(p->series[0], 1, -3);
    plot_point(p->series[0], 2, -1e-3);
    plot_point(p->series[0], 1, -2);
    e = plot_settle(p);
    CHECK(plot_axes(p, &e, true, &x, &y, fresh()) && y.hi == 0 && y.lo < -3);
    p->logy = true;
    e = plot_settle(p);
    CHECK(!plot_axes(p, &e, true, &x, &y, fresh()) &&
          has(error.text, "there is nothing above 0 to plot on a logarithmic y"));
    p->logy = false;
    plot_point(p->series[0], INFINITY, 7); /* seen nowhere */
    plot_point(p->series[0], 1, 1e-320);
    e = plot_settle(p);
    CHECK(e.y.hi < 1 && plot_axes(p, &e, true, &x, &y, fresh()));
    static const double wild[][2] = {{-1, 1e301}, {-1e301, 1}, {1e-310, 1}, {-1, -1e-310}};
    for (size_t i = 0; i < sizeof wild / sizeof *wild; i++) {
        p->ylo = wild[i][0];
        p->yhi = wild[i][1];
        CHECK(!plot_axes(p, &e, true, &x, &y, fresh()) && has(error.text, "too large or too small"));
    }
    plot_figure_free(&f);

    static const double steps[][2] = {{0.9, 1}, {1, 1},        {1.1, 2},    {3, 5},
                                      {6, 10},  {0.011, 0.02}, {1e-7, 1e-7}};
    for (size_t i = 0; i < sizeof steps / sizeof *steps; i++)
        CHECK_REL(plot_step(steps[i][0]), steps[i][1], 1e-12L);
    static const double ranges[][6] = {
        {0.3, 8, 4, 0.5, 5}, {1.1, 1.9, 4, 1.2, 1.8}, {3e-5, 7e-5, 5, 3e-5, 7e-5}, {2, 90, 5, 2, 50}};
    for (size_t i = 0; i < sizeof ranges / sizeof *ranges; i++) {
        double at[PLOT_TICS];
        const size_t n = plot_log_tics(&(plot_axis){.lo = ranges[i][0], .hi = ranges[i][1], .log = true}, at);
        CHECK(n == (size_t)ranges[i][2]);
        CHECK_REL(at[0], ranges[i][3], 1e-12L);
        CHECK_REL(at[n - 1], ranges[i][4], 1e-12L);
    }
}

static void levels(void) {
    plot_figure f = {.count = 0};
    plot_panel *p = plot_panel_add(&f, fresh());
    CHECK(!plot_map_make(p, 1, 5, fresh()) && !plot_map_make(p, 5, 501, fresh()));
    CHECK(plot_map_make(p, 10, 10, fresh()));
    double level[9];
    CHECK(plot_levels(&p->map, level, 9) == 0); /* no values */
    for (int i = 0; i < 100; i++)
        p->map.z[i] = i;
    size_t n = plot_levels(&p->map, level, 9);
    CHECK(n == 4 && level[0] == 20 && level[3] == 80);
    for (int i = 0; i < 100; i++)
        p->map.z[i] = pow(10, i / 20.0);
    n = plot_levels(&p->map, level, 9);
    CHECK(n >= 4 && n <= 9);
    for (size_t i = 1; i < n; i++)
        CHECK(level[i] > level[i - 1] && level[i] < p->map.z[99]);
    for (int i = 0; i < 100; i++)
        p->map.z[i] = pow(10, 2.6 * i / 99.0);
    static const double parts[] = {2, 5, 10, 20, 50, 100, 200};
    CHECK(plot_levels(&p->map, level, 9) == 7 && !memcmp(level, parts, sizeof parts));
    plot_figure_free(&f);
}

/* ---- cells -------------------------------------------------------------------------------------- */

static const char *shown(const plot_cells *c, int column, int row) {
    static char text[CELL_TEXT];
    plot_cells_show(c, column, row, text);
    return text;
}

static int count_dots(const plot_cells *c) {
    int n = 0;
    for (int i = 0; i < c->rows * c->stride; i++)
        for (unsigned bits = c->cell[i].dots; bits; bits &= bits - 1)
            n++;
    return n;
}

static void draw_line(const plot_cells *c, const char *dash, double x0, double y0, double x1, double y1) {
    plot_pen pen = plot_pen_of(c, dash, 1);
    plot_pen_line(&pen, x0, y0, x1, y1);
}

static void dots(void) {
    plot_cells c;
    char text[CHARACTER_BYTES];
    if (!CHECK(plot_cells_make(&c, 10, 5, 2, 4)))
        return;
    /* from corner to corner, and far beyond */
    draw_line(&c, "1", 0, 19, 19, 0);
    CHECK(count_dots(&c) >= 20 && count_dots(&c) <= 40 && *shown(&c, 9, 0) && *shown(&c, 0, 4) &&
          !*shown(&c, 0, 0) && !*shown(&c, 9, 4));
    draw_line(&c, "1", -1e14, 9, 1e14, 9);
    for (int i = 0; i < 10; i++)
        CHECK(c.cell[2 * 10 + i].dots & 0x12);
    const int before = count_dots(&c);
    draw_line(&c, "1", -5, -5, -5, 50);
    draw_line(&c, "1", 0, 21, 19, 21);
    draw_line(&c, "1", -9, 5, 5, -9);
    draw_line(&c, "1", NAN, 0, 19, 19);
    draw_line(&c, "1", 0, 0, 19, INFINITY);
    CHECK(count_dots(&c) == before);
    free(c.cell);
    if (!CHECK(plot_cells_make(&c, 8, 1, 2, 4)))
        return;
    draw_line(&c, "1100", 0, 1, 15, 1);
    CHECK(count_dots(&c) == 8 && !strcmp(shown(&c, 0, 0), "\u2812") && !*shown(&c, 1, 0));
    /* a point alone, and dashes that go on from line to line */
    plot_pen pen = plot_pen_of(&c, "10", 2);
    for (int i = 0; i < 8; i++)
        plot_pen_line(&pen, 0.5 * i, 3, 0.5 * i, 3);
    CHECK(count_dots(&c) == 11 && !strcmp(shown(&c, 0, 0), "\u2852") && !strcmp(shown(&c, 1, 0), "\u2840"));
    free(c.cell);
    plot_braille(0xff, text);
    CHECK(!strcmp(text, "\u28ff"));
    plot_braille(0x40, text);
    CHECK(!strcmp(text, "\u2840"));
}

/* What covers what. */
static void covers(void) {
    plot_cells all, c;
    char text[CELL_TEXT];
    if (!CHECK(plot_cells_make(&all, 6, 3, 1, 2)))
        return;
    all.faint = 3;
    c = plot_cells_part(&all, 1, 1, 4, 9);
    CHECK(c.cols == 4 && c.rows == 2);
    plot_cells_dot(&c, 0, 0, 3);
    CHECK(plot_cells_show(&all, 1, 1, text) == 3 && !strcmp(text, "'"));
    plot_cells_dot(&c, 0, 1, 3);
    CHECK(!strcmp(shown(&c, 0, 0), ":"));
    plot_cells_dot(&c, 0, 1, 1); /* the faint ones give way */
    CHECK(plot_cells_show(&c, 0, 0, text) == 1 && !strcmp(text, "."));
    plot_cells_sign(&c, 0, 0, "O", 2);
    CHECK(plot_cells_show(&c, 0, 0, text) == 2 && !strcmp(text, "O"));
    plot_cells_dot(&c, 0, 0, 1);
    CHECK(!strcmp(shown(&c, 0, 0), ":"));
    for (int i = -1; i <= 4; i += 5) {
        plot_cells_sign(&c, i, 0, "X", 2);
        plot_cells_dot(&c, i, 0, 2);
        plot_cells_dot(&c, 0, i, 2);
        CHECK(!*shown(&c, i, 0));
    }
    CHECK(!*shown(&all, 0, 1) && !*shown(&all, 5, 1) && !*shown(&all, 1, 0));
    /* a wide character takes two columns, or none at the end; accents go onto what they follow */
    plot_cells_text(&c, 0, 1, "e\u0301\u65e5o\u65e5", 0);
    CHECK(!strcmp(shown(&c, 0, 1), "e\u0301") && !strcmp(shown(&c, 1, 1), "\u65e5") && !*shown(&c, 2, 1) &&
          !strcmp(shown(&c, 3, 1), "o") && !*shown(&all, 5, 2));
    plot_cells_text(&c, 0, 0, "\u0301x\u0301\u0301\u0301\u0301\u0301\u0301\u0301\xff", 0);
    CHECK(!strncmp(shown(&c, 0, 0), "x\u0301", 3) && !strcmp(shown(&c, 1, 0), "\xff"));
    c = plot_cells_part(&all, 7, 0, 1, 1);
    CHECK(c.cols == 0);
    plot_cells_text(&c, 0, 0, "a", 0);
    CHECK(!*shown(&all, 0, 0));
    free(all.cell);
}

/* ---- targets ------------------------------------------------------------------------------------ */

static bool any_left(const char *dir) {
    char command[300];
    snprintf(command, sizeof command, "test -n \"$(ls -A '%s')\"", dir);
    return system(command) == 0;
}

static void pages(void) {
    plot_figure f = figure(PLOT_CURVE, "one");
    plot_panel *p = f.panel[0];
    p->xlabel = plot_label("dx", "um");
    p->ylabel = plot_label("Fx", "N");
    plot_series_add(p, PLOT_CURVE, "two", fresh());
    for (int i = 0; i <= 100; i++) {
        plot_point(p->series[0], i - 50, sin(0.1 * i));
        plot_point(p->series[1], i - 50, i > 20 && i < 40 ? NAN : cos(0.1 * i));
    }
    char *text = text_of(&f, (plot_target){.columns = 60, .rows = 20});
    CHECK(has(text, "Fx [N]") && has(text, "dx [um]") && has(text, "* one") && has(text, "o two"));
    size_t lines = 0, widest = 0;
    int last = -1, step = 0, tics = 0;
    for (char *line = text; *line; line += strcspn(line, "\n") + 1, lines++) {
        size_t n = strcspn(line, "\n");
        widest = n > widest ? n : widest;
        char *end;
        strtod(line, &end);
        end += strspn(end, " ");
        if (line[4] >= '0' && line[4] <= '9' && strchr("+|*o", *end)) { /* tics along y: evenly */
            int now = (int)lines - last;
            CHECK(tics < 2 || now == step);
            step = now;
            last = (int)lines;
            tics++;
        }
    }
    CHECK(lines <= 20 && lines >= 16 && widest <= 60 && tics >= 4);
    free(text);
    text = text_of(&f, (plot_target){.columns = 60, .rows = 20, .unicode = true, .color = true});
    CHECK(has(text, "δx [µm]") && has(text, "\033[38;5;"));
    free(text);
    /* braille: the same page, curves by dashes, with colours or without */
    text = text_of(&f, (plot_target){.columns = 60, .rows = 20, .unicode = true, .terminal = PLOT_BLOCK});
    CHECK(has(text, "\u2812\u2812\u2812\u2812 one") && has(text, "\u2812\u2812\u2802\u2800 two") &&
          !has(text, "\033"));
    free(text);
    text = text_of(
        &f, (plot_target){.columns = 60, .rows = 20, .unicode = true, .color = true, .terminal = PLOT_BLOCK});
    CHECK(has(text, "\u2812\u2812\u2812\u2812 \033[39mone") &&
          has(text, "\u2812\u2812\u2802\u2800 \033[39mtwo"));
    free(text);
    for (int i = 3; i <= 8; i++) /* the eighth has the colour of the first */
        plot_series_add(p, PLOT_CURVE, i == 8 ? "eight" : "more", fresh());
    text = text_of(
        &f, (plot_target){.columns = 90, .rows = 20, .unicode = true, .color = true, .terminal = PLOT_BLOCK});
    const char *key = strstr(text, " \033[39mone");
    CHECK(key && has(text, " \033[39meight"));
    while (key && (key = strstr(key + 1, " \033[39m"))) /* none but the first is solid */
        CHECK(memcmp(key - 12, "\u2812\u2812\u2812\u2812", 12) != 0);
    free(text);
    plot_figure_free(&f);
}

/* Pages of few rows, of numbers of all sizes, of helping lines. */
static void odd_pages(void) {
    plot_figure f = figure(PLOT_CURVE, "thin one");
    plot_panel *p = f.panel[0];
    plot_series *s = p->series[0];
    s->thin = true;
    plot_series *c = plot_series_add(p, PLOT_CURVE, "the curve", fresh());
    for (int i = -2; i <= 50; i++) {
        plot_point(s, i, i);
        plot_point(c, i, i > 40 ? i : 0.5 * i);
    }
    p->logx = p->logy = true;
    char *text =
        text_of(&f, (plot_target){.columns = 60, .rows = 20, .unicode = true, .terminal = PLOT_BLOCK});
    CHECK(has(text, "thin one") && has(text, "\n    1 ") && has(text, " 10 "));
    free(text);
    p->logx = p->logy = false;
    for (size_t i = 0; i < s->count; i++)
        c->y[i] = s->y[i] = 1e7 + 1e6 * (double)i;
    text = text_of(&f, (plot_target){.columns = 60, .rows = 20});
    CHECK(has(text, "e+07 ") && has(text, "* the curve") && has(text, ". thin one"));
    CHECK(strchr(text, '.') == strrchr(text, '.')); /* the curve covers the helping line, all of the way */
    free(text);
    for (size_t i = 0; i < s->count; i++)
        c->y[i] = s->y[i] = 1e7 + (double)i; /* numbers that the first digits do not tell apart */
    text = text_of(&f, (plot_target){.columns = 60, .rows = 20});
    CHECK(has(text, "1.000002e+07 ") && has(text, "1.000004e+07 "));
    free(text);
    for (size_t i = 0; i < s->count; i++)
        c->y[i] = s->y[i] = 1e-7 * (double)i;
    text = text_of(&f, (plot_target){.columns = 60, .rows = 20});
    CHECK(has(text, "e-06 "));
    free(text);
    p->key_off = true;
    text = text_of(&f, (plot_target){.columns = 60, .rows = 20});
    CHECK(!has(text, "the curve"));
    free(text);
    p->key_off = false;
    for (int i = 0; i < 30; i++)
        plot_point(plot_series_add(
                       p, PLOT_CURVE,
                       i % 2 ? "more" : "one more of those with long names that take all of a row", fresh()),
                   1, i);
    text = text_of(&f, (plot_target){.columns = 60, .rows = 16}); /* a picture is left, and some of the key */
    CHECK(has(text, "+---") && has(text, "the curve"));
    free(text);
    text = text_of(&f, (plot_target){.columns = 300, .rows = 12});
    CHECK(has(text, "+---"));
    free(text);
    plot_figure_free(&f);
}

static void map_pages(void) {
    plot_figure f = {.count = 0};
    plot_panel *p = plot_panel_add(&f, fresh());
    CHECK(plot_map_make(p, 20, 20, fresh()));
    for (int i = 0; i < 400; i++) {
        p->map.x[i % 20] = i % 20;
        p->map.y[i / 20] = i / 20;
        p->map.z[i] = i == 210 ? NAN : (double)(i % 20);
    }
    p->map.label = plot_label("dW", "uJ");
    char *text = text_of(&f, (plot_target){.columns = 70, .rows = 20});
    CHECK(has(text, "contours of dW [uJ]") && has(text, "1 5") && has(text, "2 10") && has(text, "3 15"));
    free(text);
    plot_figure_free(&f);
}

static void refused(const char *tmp) {
    plot_figure f = figure(PLOT_CURVE, NULL);
    plot_point(f.panel[0]->series[0], 0, 0);
    plot_point(f.panel[0]->series[0], 1, 1);
    static volatile sig_atomic_t stop = 1;
    CHECK(!plot_draw(&f, 1, &(plot_target){.file = "x.png", .stop = &stop}, NULL, fresh()));
    CHECK(!strcmp(error.text, "interrupted") && access("x.png", F_OK) != 0 && !any_left(tmp));
    CHECK(!plot_draw(&f, 1, &(plot_target){.file = "x.jpg"}, NULL, fresh()));
    CHECK(has(error.text, "use .png, .svg, .pdf, .tex, .html, .gif or .gp"));
    static const plot_target sizes[] = {{.file = "x.png", .width = 9000},
                                        {.file = "x.png", .width = -1},
                                        {.file = "x.png", .height = 9000},
                                        {.file = "x.png", .height = -1}};
    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++)
        CHECK(!plot_draw(&f, 1, &sizes[i], NULL, fresh()) && has(error.text, "at most 8000 pixels"));
    plot_figure none = {.count = 0};
    CHECK(!plot_draw(&none, 1, &(plot_target){.file = "x.png"}, NULL, fresh()) &&
          has(error.text, "there is nothing to plot"));
    CHECK(!write_script(&none, ".png", 0, 0, stdout) && !write_script(&f, ".jpg", 0, 0, stdout));
    CHECK(!plot_check("no/such/x.png", NULL, fresh()) && plot_check("x.png", NULL, fresh()));
    CHECK(access("x.png", F_OK) != 0);
    plot_figure_free(&f);
}

/* A name that gnuplot would take for a command, if it saw it. */
static void hostile_names(const char *tmp) {
    static const char *const files[] = {"|touch pwned #.png",
                                        "`touch pwned`.svg",
                                        "'; system(\"touch pwned\") #.gp",
                                        "a\nb.pdf",
                                        "\".gif",
                                        "-x.tex",
                                        "é.html"};
    plot_figure f = figure(PLOT_CURVE, "'''' ; system(\"touch pwned\") # `touch pwned`");
    f.panel[0]->title = strdup("''''; system(\"touch pwned\") # ");
    plot_point(f.panel[0]->series[0], 0, 0);
    plot_point(f.panel[0]->series[0], 1, 1);
    for (size_t i = 0; i < sizeof files / sizeof *files; i++) {
        file_report report;
        struct stat info;
        bool ok = plot_draw(&f, 1, &(plot_target){.file = files[i]}, &report, fresh());
        if (!CHECK(ok))
            printf("%s: %s\n", files[i], error.text);
        CHECK(stat(files[i], &info) == 0 && (unsigned long long)info.st_size == report.size &&
              report.size > 500);
        unlink(files[i]);
    }
    free(text_of(&f, (plot_target){.columns = 60, .rows = 20}));
    CHECK(access("pwned", F_OK) != 0 && !any_left(tmp) && !any_left("."));
    plot_figure_free(&f);
}

/* ---- animations --------------------------------------------------------------------------------- */

enum { SEVEN = 7 };

/* A line that rises from frame to frame. */
static void fill(plot_figure frame[SEVEN]) {
    for (int i = 0; i < SEVEN; i++) {
        frame[i] = figure(PLOT_CURVE, NULL);
        CHECK(plot_point(frame[i].panel[0]->series[0], 0, 0) &&
              plot_point(frame[i].panel[0]->series[0], 1, i));
    }
}

/* Images in a GIF: each has one graphic control extension. */
static size_t images(const char *file) {
    FILE *f = fopen(file, "r");
    size_t n = 0;
    unsigned last[3] = {0};
    for (int c; f && (c = getc(f)) != EOF; last[0] = last[1], last[1] = last[2], last[2] = (unsigned)c)
        n += last[0] == 0x21 && last[1] == 0xf9 && last[2] == 0x04;
    if (f)
        fclose(f);
    return n;
}

static void animates(const char *tmp) {
    plot_figure frame[SEVEN];
    fill(frame);
    CHECK(plot_draw(frame, SEVEN, &(plot_target){.file = "a.gif"}, NULL, fresh()) &&
          images("a.gif") == SEVEN);
    unlink("a.gif");
    char *text = NULL;
    size_t room;
    FILE *out = open_memstream(&text, &room);
    CHECK(plot_draw(frame, SEVEN, &(plot_target){.out = out, .columns = 50, .rows = 12, .moving = 12}, NULL,
                    fresh()));
    fclose(out);
    size_t ups = 0; /* the only letters A are of the cursor's way back up */
    for (const char *p = text; (p = strchr(p, 'A')); p++)
        ups++;
    CHECK(ups == 6 && has(text, "\033[K\n"));
    /* axes hold for all frames */
    CHECK(has(text, "\n 6 ") || has(text, "\n 6.0 ") || !strncmp(text, " 6", 2));
    free(text);
    const plot_target gif = {.file = "a.gif"};
    static volatile sig_atomic_t stop = 1;
    CHECK(!plot_draw(frame, SEVEN, &(plot_target){.file = "a.gif", .stop = &stop}, NULL, fresh()));
    CHECK(plot_panel_add(&frame[3], fresh()) && !plot_draw(frame, SEVEN, &gif, NULL, fresh()) &&
          has(error.text, "the frames differ"));
    plot_figure_free(&frame[3]);
    CHECK(!plot_draw(frame, SEVEN, &gif, NULL, fresh()) && has(error.text, "nothing to plot"));
    for (size_t n = 0; n <= PLOT_FRAMES + 1; n += PLOT_FRAMES + 1)
        CHECK(!plot_draw(frame, n, &gif, NULL, fresh()) && has(error.text, "1 to 1000 frames"));
    for (int i = 0; i < SEVEN; i++)
        plot_figure_free(&frame[i]);
    CHECK(!any_left(tmp) && !any_left("."));
}

/* Ctrl-C at the first bytes of a script: no more of it than a row of a map, or a frame. */
static volatile sig_atomic_t stop_now;

static ssize_t stop_at_once(void *cookie, const char *text, size_t size) {
    (void)text;
    *(size_t *)cookie += size;
    stop_now = 1;
    return (ssize_t)size;
}

static size_t written_after(const plot_reel *reel, const plot_pages *pages) {
    const plot_target t = {.stop = &stop_now, .columns = 60, .rows = 20};
    size_t size = 0;
    FILE *to = fopencookie(&size, "w", (cookie_io_functions_t){.write = stop_at_once});
    stop_now = 0;
    CHECK(!(pages ? plot_write_pages(to, reel, &t, pages, fresh())
                  : plot_write_picture(to, reel, plot_kind_of("a.png", &error), &t, fresh())));
    CHECK(error.stop && has(error.text, "interrupted"));
    fclose(to);
    return size;
}

static void stopped(void) {
    enum { FRAMES = 30, POINTS = 900 };
    const plot_pages pages = {.columns = 60, .rows = 20};
    plot_extents extent[PLOT_PANELS];
    plot_figure map = {.count = 0}, frame[FRAMES] = {{.count = 0}};
    plot_panel *p = plot_panel_add(&map, fresh());
    CHECK(plot_map_make(p, 200, 200, fresh()));
    fill_map(&p->map, steep);
    extent[0] = plot_settle(p);
    CHECK(written_after(&(plot_reel){&map, 1, extent, 0}, NULL) < 20000); /* all of it: 1 MB */
    for (size_t i = 0; i < FRAMES; i++) {
        p = plot_panel_add(&frame[i], fresh());
        plot_series *s = plot_series_add(p, PLOT_CURVE, NULL, fresh());
        for (size_t j = 0; j < POINTS; j++)
            CHECK(plot_point(s, (double)j, sin(1.1 * (double)j)));
        extent[0] = i ? plot_extent_join(extent[0], plot_settle(p)) : plot_settle(p);
    }
    const plot_reel reel = {frame, FRAMES, extent, 0.1};
    CHECK(written_after(&reel, NULL) < 60000);
    CHECK(written_after(&reel, &pages) < 60000);
    plot_figure_free(&map);
    for (size_t i = 0; i < FRAMES; i++)
        plot_figure_free(&frame[i]);
}

/* Pictures of a size that was asked for; what has nothing to show has no script. */
static void sizes(void) {
    plot_figure f = figure(PLOT_CURVE, NULL), none = {.count = 0};
    char text[4000] = "";
    FILE *to = tmpfile();
    if (!CHECK(to != NULL))
        return;
    plot_point(f.panel[0]->series[0], 0, 0);
    plot_point(f.panel[0]->series[0], 1, 1);
    CHECK(write_script(&f, "a.svg", 300, 200, to) && !write_script(&none, "a.svg", 0, 0, to) &&
          !write_script(&f, "a.xyz", 0, 0, to));
    rewind(to);
    text[fread(text, 1, sizeof text - 1, to)] = 0;
    CHECK(strstr(text, "size 300,200"));
    fclose(to);
    plot_figure_free(&f);
}

/* A gnuplot that hangs is stopped. */
static void late(void) {
    plot_figure f = figure(PLOT_CURVE, NULL);
    file_report report;
    const char *path = getenv("PATH");
    char *before = strdup(path ? path : "");
    FILE *fake = fopen("gnuplot", "w");
    if (!CHECK(fake && before))
        return;
    fputs("#!/bin/sh\nexec /bin/sleep 100\n", fake);
    CHECK(!fclose(fake) && !chmod("gnuplot", 0700) && !setenv("PATH", ".", 1));
    plot_point(f.panel[0]->series[0], 0, 0);
    plot_point(f.panel[0]->series[0], 1, 1);
    CHECK(!plot_draw(&f, 1, &(plot_target){.file = "late.png", .timeout = 0.2}, &report, fresh()));
    CHECK(strstr(error.text, "gnuplot gave no picture within 0.2 s and was stopped"));
    CHECK(!setenv("PATH", before, 1) && !unlink("gnuplot") && access("late.png", F_OK));
    free(before);
    plot_figure_free(&f);
}

int main(int argc, char **argv) {
    unit_start("test_plot", argc, argv);
    char dir[] = "/tmp/fret-unit-XXXXXX", tmp[40];
    if (!CHECK(mkdtemp(dir) && !chdir(dir)))
        return unit_finish();
    snprintf(tmp, sizeof tmp, "%s-tmp", dir);
    CHECK(!mkdir(tmp, 0700) && !setenv("TMPDIR", tmp, 1));
    CASE(names());
    CASE(odd_names());
    CASE(plain());
    CASE(page_sizes());
    CASE(quoting());
    CASE(scripts());
    CASE(styles());
    CASE(layers());
    CASE(thins());
    CASE(clouds());
    CASE(bounded());
    CASE(bands());
    CASE(axes());
    CASE(levels());
    CASE(dots());
    CASE(covers());
    CASE(pages());
    CASE(odd_pages());
    CASE(map_pages());
    CASE(maps());
    CASE(looks_of());
    CASE(refused(tmp));
    CASE(hostile_names(tmp));
    CASE(animates(tmp));
    CASE(stopped());
    CASE(sizes());
    CASE(late());
    CASE(crowds());
    CHECK(!chdir("/") && !rmdir(dir) && !rmdir(tmp));
    return unit_finish();
}
