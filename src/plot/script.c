/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scripts for pictures, which contain their data and can be kept and run again. Depends on script.h. */
#include "plot/script.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "text/characters.h"
#include "text/words.h"

enum { WIDTH = 900, BESIDE = 640, HEIGHT = 675, HIGHER = 840, LEVELS = 9 };

/* ---- kinds -------------------------------------------------------------------------------------- */

/* The macros that gnuplot's TikZ output calls, so that the file needs only \usepackage{tikz}, not gnuplot's
 * own style. A TeX group keeps them local. */
static const char head_tex[] =
    "% a figure for \\input; it needs \\usepackage{tikz} and \\usetikzlibrary{plotmarks}\n"
    "\\begingroup\n"
    "\\def\\gpdashlength{0.5pt}\n"
    "\\def\\gpcolor#1{\\tikzset{fret #1}}\n"
    "\\def\\gpsetlinetype#1{}\n"
    "\\def\\gpsetdashtype#1{\\tikzset{gp path/.style={#1}}}\n"
    "\\def\\gpsetlinewidth#1{\\pgfsetlinewidth{#1*0.4pt}}\n"
    "\\def\\gpsetpointsize#1{\\tikzset{gp point/.style={mark size=#1*0.4pt}}}\n"
    "\\def\\gppoint#1#2{\\path[solid] plot[only marks,gp point,#1] coordinates {#2};}\n"
    "\\def\\gp3point#1#2#3{\\path[solid] plot[only marks,gp point,#1] coordinates {#3};}\n"
    "\\def\\gpfill#1{\\path[line width=0.05pt,draw,fill,#1]}\n"
    "\\def\\gpdefrectangularnode#1#2#3{}\n"
    "\\tikzset{gnuplot/.style={line cap=round,line join=round},\n"
    "  rgb color/.code={\\definecolor{fretcolor}{rgb}{#1}\\tikzset{color=fretcolor}},\n"
    "  fret rgb color/.code={\\definecolor{fretcolor}{rgb}{#1}\\color{fretcolor}\\pgfsetcolor{fretcolor}},\n"
    "  fret color/.code={\\color{black}\\pgfsetcolor{black}},\n"
    "  gp node left/.style={anchor=mid west},gp node center/.style={anchor=mid},\n"
    "  gp node right/.style={anchor=mid east},gp path/.style={},gp point/.style={mark size=1.6pt},\n"
    "  gp dt solid/.style={solid},gp dt axes/.style={dotted},gp dt 1/.style={solid},\n"
    "  gp mark 4/.style={mark=square},gp mark 5/.style={mark=square*},gp mark 6/.style={mark=o},\n"
    "  gp mark 7/.style={mark=*},gp mark 8/.style={mark=triangle},gp mark 9/.style={mark=triangle*},\n"
    "  gp mark 11/.style={mark=triangle*,mark options={rotate=180}},gp mark 12/.style={mark=diamond},\n"
    "  gp mark 13/.style={mark=diamond*}}\n";
static const char foot_tex[] = "\\endgroup\n";
static const char head_html[] =
    "<!DOCTYPE html>\n<html><head><meta charset=\"utf-8\"><title>fret</title></head><body>\n";

static const char foot_html[] = "</body></html>\n";

/* For lengths in cm: WIDTH pixels are 12 cm of a page. */
static const plot_kind kinds[] = {
    {".png", PLOT_ENHANCED, "pngcairo size %.0f,%.0f font 'Sans,%.3g' enhanced", 1, 16, .line = 3},
    {".svg", PLOT_ENHANCED, "svg size %.0f,%.0f font 'Sans,%.3g' enhanced background rgb 'white'", 1, 19,
     .line = 3},
    {".pdf", PLOT_ENHANCED, "pdfcairo size %.4gcm,%.4gcm font 'Sans,%.3g' enhanced", 12.0 / (double)WIDTH,
     9.5, .line = 2.2},
    {".tex", PLOT_TEX, "tikz size %.4gcm,%.4gcm font ',%.3g'", 12.0 / (double)WIDTH, 10, 2, .head = head_tex,
     .foot = foot_tex},
    {".html", PLOT_ENHANCED,
     "svg size %.0f,%.0f font 'Sans,%.3g' enhanced background rgb 'white' mouse standalone", 1, 19, 3,
     .begin = "<svg", .head = head_html, .foot = foot_html},
    {".gif", PLOT_ENHANCED, "gif size %.0f,%.0f font 'Sans,%.3g' enhanced animate delay %.0f loop 0", 1, 15,
     .line = 3},
    {".gp", PLOT_ENHANCED, NULL, 1, 16, .line = 3}};

const plot_kind *plot_kind_of(const char *file, calc_error *error) {
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        if (file_ends(file, kinds[i].ending))
            return &kinds[i];
    char endings[80] = "";
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++)
        list_word(endings, sizeof endings, i + 1 == sizeof kinds / sizeof *kinds ? " or " : ", ",
                  kinds[i].ending);
    calc_fail(error, 0, 0, "cannot tell the kind of picture from '%s': use %s", file, endings);
    return NULL;
}

/* ---- looks -------------------------------------------------------------------------------------- */

/* The colours of Okabe and Ito for colour-blind readers, without their yellow, too pale for lines; each with
 * its own dashes for print in black. The eighth curve has the first look again, with marks on its line. */
static const struct {
    const char *color, *tint, *dash;
} looks[] = {{"#0072b2", "#cce3f0", "solid"},  {"#d55e00", "#f7dfcc", "(14,6)"},
             {"#009e73", "#ccece3", "(4,5)"},  {"#cc79a7", "#f5e4ed", "(14,5,3,5)"},
             {"#e69f00", "#faeccc", "(24,7)"}, {"#56b4e9", "#ddf0fb", "(14,5,3,5,3,5)"},
             {"#000000", "#d9d9d9", "(2,3)"}};
enum { LOOKS = sizeof looks / sizeof *looks };

static const int marks[] = {7, 5, 9, 13, 11, 6, 4, 8, 12};
enum { MARKS = sizeof marks / sizeof *marks };

/* Double quotes, with octal codes for all that is not harmless, and for a digit behind such a code, of which
 * gnuplot would make it a part. Single quotes are unsafe: '' stands for a quote, but a text that contains two
 * in a row would end the string, and what follows would be a command. */
void plot_quote(FILE *to, const char *text) {
    static const char harmless[] = " _{}^/:=.,;()[]<>+*-!?&~|%";
    bool coded = false;
    putc('"', to);
    for (const unsigned char *p = (const unsigned char *)text; *p; p++) {
        coded = *p < 0x80 && !strchr(harmless, *p) && !(isalnum(*p) && (!coded || *p > '7'));
        fprintf(to, coded ? "\\%03o" : "%c", *p);
    }
    putc('"', to);
}

/* ---- data --------------------------------------------------------------------------------------- */

static void write_series(FILE *to, const plot_series *s) {
    bool gap = true; /* no empty line before the first point */
    for (size_t i = 0; i < s->count; i++) {
        bool shown = isfinite(s->x[i]) && isfinite(s->y[i]) && (!s->y2 || isfinite(s->y2[i]));
        if (!shown && !gap)
            putc('\n', to);
        gap = !shown;
        if (!shown)
            continue;
        fprintf(to, s->y2 ? "%.9g %.9g %.9g\n" : "%.9g %.9g\n", s->x[i], s->y[i], s->y2 ? s->y2[i] : 0);
    }
}

size_t plot_style_of(const plot_panel *p, size_t at) {
    const plot_series *s = p->series[at];
    if (s->style >= 0)
        return (size_t)s->style;
    size_t n = 0;
    for (size_t i = 0; i < at; i++)
        n += p->series[i]->role == s->role && !p->series[i]->thin && p->series[i]->style < 0;
    return n;
}

/* Many measured points would hide a curve: they are drawn below it, and small. */
static bool is_crowd(const plot_series *s) {
    enum { FEW = 100 };
    return s->role == PLOT_MEASURED && s->count > FEW;
}

int plot_layer(const plot_series *s) {
    switch (s->role) {
    case PLOT_BAND:
        return 0;
    case PLOT_CURVE:
        return s->thin ? 1 : 3;
    case PLOT_MEASURED:
        return is_crowd(s) ? 2 : 4;
    default: /* the present point */
        return 5;
    }
}

/* Curves beyond the number of looks have marks on their lines, unless all points are marked. */
static bool is_marked(const plot_panel *p, size_t at) {
    const plot_series *s = p->series[at];
    return s->role == PLOT_CURVE && !s->thin && !p->points && plot_style_of(p, at) >= LOOKS;
}

static void write_map(FILE *to, const plot_map *m, const plot_target *t) {
    for (size_t j = 0; j < m->ny && !plot_stopped(t); j++) {
        for (size_t i = 0; i < m->nx; i++) {
            double z = m->z[j * m->nx + i];
            fprintf(to, isfinite(z) ? "%.9g %.9g %.9g\n" : "%.9g %.9g NaN\n", m->x[i], m->y[j], z);
        }
        putc('\n', to);
    }
}

/* Writes all data; incomplete if the stop flag is set, which the caller checks. */
static void write_data(FILE *to, const plot_reel *reel, const plot_target *t) {
    for (size_t n = 0; n < reel->count && !plot_stopped(t); n++)
        for (size_t i = 0; i < reel->frame[n].count; i++) {
            const plot_panel *p = reel->frame[n].panel[i];
            for (size_t j = 0; j < p->count; j++) {
                fprintf(to, "$data%zu_%zu_%zu << END\n", n, i, j);
                write_series(to, p->series[j]);
                fputs("END\n", to);
            }
            if (p->map.nx) {
                fprintf(to, "$map%zu_%zu << END\n", n, i);
                write_map(to, &p->map, t);
                fputs("END\n", to);
            }
        }
}

/* ---- a panel ------------------------------------------------------------------------------------ */

typedef struct scribe {
    FILE *to;
    const plot_kind *kind;
    double scale; /* of font, lines and marks relative to the usual size */
    double text;  /* the factor that the user gives for texts */
    double wide;  /* characters that the key of a panel has room for in a row */
    size_t frame, panel;
    size_t panels, column; /* number of panels side by side; the column of this one */
    bool has_lower, below; /* the panel has one below it; it is one below another */
    bool stacked;          /* some panel of the figure has one below it */
    const char *caption;
    double foot; /* part of the height that the caption takes */
    bool lost;   /* out of memory for a text */
} scribe;

static void quoted(scribe *s, const char *text) {
    char *shown = plot_text(text ? text : "", s->kind->form);
    plot_quote(s->to, shown ? shown : "");
    s->lost |= !shown;
    free(shown);
}

static void set_text(scribe *s, const char *what, const char *text) {
    fprintf(s->to, "set %s ", what);
    quoted(s, text);
    putc('\n', s->to);
}

static void set_log_tics(scribe *s, char name, const plot_axis *a) {
    double at[PLOT_TICS];
    const size_t n = plot_log_tics(a, at);
    fprintf(s->to, "set %ctics (", name);
    for (size_t i = 0; i < n; i++)
        fprintf(s->to, "%s%.10g", i ? "," : "", at[i] * (i ? 1 : PLOT_HAIR));
    fputs(")\n", s->to);
}

static void set_axis(scribe *s, char name, const plot_axis *a) {
    fprintf(s->to, "set %crange [%.9g:%.9g]\nset %ctics autofreq\n", name, a->flip ? a->hi : a->lo,
            a->flip ? a->lo : a->hi, name);
    if (a->log) {
        fprintf(s->to, "set logscale %c\n", name);
        if (a->hi / a->lo > 50)
            fprintf(s->to,
                    s->kind->form == PLOT_TEX ? "set format %c '$10^{%%T}$'\n" : "set format %c '10^{%%T}'\n",
                    name);
        else /* too few powers of ten to show the scale */
            set_log_tics(s, name, a);
    } else if (fmax(fabs(a->lo), fabs(a->hi)) >= 1e5 || fmax(fabs(a->lo), fabs(a->hi)) < 1e-3) {
        fprintf(s->to, "set format %c '%%h'\n", name);
    }
}

/* The number of entries in the key; *longest: columns of the longest text. */
static size_t key_entries(scribe *s, const plot_panel *p, size_t *longest) {
    size_t entries = 0;
    *longest = 0;
    for (size_t i = 0; i < p->count; i++) {
        if (!p->series[i]->title)
            continue;
        char *text = plot_text(p->series[i]->title, PLOT_UNICODE);
        size_t n = text ? text_columns(text, strlen(text)) : 0;
        s->lost |= !text;
        *longest = n > *longest ? n : *longest;
        free(text);
        entries++;
    }
    return p->key_off ? 0 : entries;
}

/* The columns of entries in a key below the frame: no more than gnuplot finds room for. */
static int key_columns(const scribe *s, size_t longest) {
    enum { SAMPLE = 5 };
    return (int)fmin(fmax(s->wide / (double)(longest + SAMPLE), 1), s->panels > 1 ? 3 : 4);
}

/* Puts the key outside the frame: at the right if entries are many and short, else below. */
static void set_key(scribe *s, const plot_panel *p) {
    size_t longest, entries = key_entries(s, p, &longest);
    if (!entries)
        fputs("unset key\n", s->to);
    else if (s->panels == 1 && longest <= 12 && entries > 3)
        fputs("set key outside right center vertical Left reverse samplen 3.5 spacing 1.15\n", s->to);
    else
        fprintf(s->to,
                "set key outside below center horizontal Left reverse samplen 3.5 spacing 1.1 height %s "
                "maxcols %d\n",
                s->kind->form == PLOT_TEX ? "2.5" : "1.2", key_columns(s, longest));
}

/* Sets the panel's part of the picture, unless gnuplot's layout of panels side by side is enough. */
static void set_place(const scribe *s) {
    const double lower = 0.36, high = 1 - s->foot, from = s->has_lower ? lower : 0, to = s->below ? lower : 1;
    if (s->caption || s->stacked)
        fprintf(s->to, "set origin %.6g,%.6g\nset size %.6g,%.6g\n", (double)s->column / (double)s->panels,
                s->foot + from * high, 1 / (double)s->panels, (to - from) * high);
}

/* Writes the lines of the caption below all panels, with the first panel. */
static void set_caption(scribe *s) {
    double line = 0, lines = 0.5;
    if (!s->caption)
        return;
    for (const char *p = s->caption; *p; p++)
        lines += *p == '\n';
    for (const char *p = s->caption, *end; !s->panel && (end = strchr(p, '\n')); p = end + 1) {
        char *text = strndup(p, (size_t)(end - p));
        s->lost |= !text;
        fputs("set label ", s->to);
        quoted(s, text);
        fprintf(s->to, " at screen 0.02,%.4g left%s\n", s->foot * (1 - (line++ + 0.5) / lines),
                s->kind->form == PLOT_TEX ? "" : " font ',10'");
        free(text);
    }
}

/* Aligns frames: the same height for panels side by side, the same width for one below another. */
static void set_margins(scribe *s, const plot_figure *f) {
    size_t rows = 0;
    bool titled = false;
    for (size_t i = 0; i < f->count; i++) {
        const plot_panel *p = f->panel[i];
        if (p->below != s->below)
            continue;
        size_t longest, entries = p->map.nx ? 0 : key_entries(s, p, &longest);
        const size_t columns = entries ? (size_t)key_columns(s, longest) : 1,
                     needed = (entries + columns - 1) / columns;
        rows = needed > rows ? needed : rows;
        titled |= p->title && *p->title;
    }
    if (s->has_lower || s->below)
        fprintf(s->to, "set lmargin at screen %.4g\nset rmargin at screen %.4g\n",
                ((double)s->column + 0.13 * s->text) / (double)s->panels,
                ((double)s->column + 0.97) / (double)s->panels);
    else
        fputs("set lmargin\nset rmargin\n", s->to);
    const double room = s->kind->form == PLOT_TEX ? 2.5 : 0.8; /* between the label of x and the key */
    if (f->count > 1)
        fprintf(s->to, "set tmargin %s\nset bmargin %.3g\n", titled ? "3" : "1.5",
                3.8 + (rows ? room + 1.2 * (double)rows : 0));
    else
        fputs("set tmargin\nset bmargin\n", s->to);
}

static void with_curve(scribe *s, const plot_panel *p, size_t at, const char *how) {
    const plot_series *c = p->series[at];
    size_t style = plot_style_of(p, at), mark = style / LOOKS;
    const double wide = p->map.nx ? 3 : 1; /* over a map, whose border would hide a thin line */
    const double line = wide * s->kind->line * s->scale;
    if (c->thin) {
        fprintf(s->to, "lines lw %.3g lc rgb '#707070' dt solid", 0.5 * line);
        return;
    }
    fprintf(s->to, "%s lw %.3g lc rgb '%s' dt %s", how, line, looks[style % LOOKS].color,
            looks[style % LOOKS].dash);
    if (strcmp(how, "lines") != 0)
        fprintf(s->to, " pt %d ps %.3g%s", marks[(p->points ? style : mark - 1) % MARKS], 1.3 * s->scale,
                p->points ? "" : " pn 8");
}

/* Writes one element of the plot command. */
static void draw_series(scribe *s, const plot_panel *p, size_t at, bool deep) {
    const plot_series *c = p->series[at];
    size_t style = plot_style_of(p, at);
    if (c->count)
        fprintf(s->to, "$data%zu_%zu_%zu using 1:2%s with ", s->frame, s->panel, at,
                deep    ? ":(0)"
                : c->y2 ? ":3"
                        : "");
    else /* an entry of the key alone */
        fputs("NaN with ", s->to);
    switch (c->role) {
    case PLOT_CURVE:
        with_curve(s, p, at, (p->points && !c->thin) || is_marked(p, at) ? "linespoints" : "lines");
        break;
    case PLOT_MEASURED:
        fprintf(s->to, "points pt %d ps %.3g lw %.3g lc rgb '%s'",
                is_crowd(c) ? 7 : marks[(style + 5) % MARKS], (is_crowd(c) ? 0.4 : 1.3) * s->scale,
                0.6 * s->kind->line * s->scale, style ? looks[style % LOOKS].color : "#000000");
        break;
    case PLOT_BAND:
        fprintf(s->to, "filledcurves %s fs solid noborder fc rgb '%s'", c->y2 ? "" : "closed",
                c->thin ? "#e4e4e4" : looks[style % LOOKS].tint);
        break;
    default: /* the present point */
        fprintf(s->to, "points pt 7 ps %.3g lc rgb '#000000'", 2 * s->scale);
        break;
    }
    if (!c->title) {
        fputs(" notitle", s->to);
        return;
    }
    fputs(" title ", s->to);
    quoted(s, c->title);
}

static void draw_all(scribe *s, const plot_panel *p, bool first, bool deep) {
    for (int l = 0; l < PLOT_LAYERS; l++)
        for (size_t i = 0; i < p->count; i++)
            if (plot_layer(p->series[i]) == l && (p->series[i]->count || p->series[i]->title)) {
                fputs(first ? "" : ", \\\n  ", s->to);
                draw_series(s, p, i, deep);
                first = false;
            }
    putc('\n', s->to);
}

/* Search for the places of contour labels: within the frame, near its middle, apart from each other. */
typedef struct spots {
    const plot_map *map;
    const plot_axis *x, *y;
    size_t count;
    double at[LEVELS][2];           /* places chosen, as parts of the frame */
    double best, here[2], value[2]; /* best score and place for the present level, and x and y there */
} spots;

/* Scores the place where a level crosses between two neighbouring points of the grid, if it does. */
static void offer(spots *s, size_t from, size_t to, double level) {
    const plot_map *m = s->map;
    const double a = m->z[from], b = m->z[to];
    if (!((a < level && level <= b) || (b < level && level <= a)))
        return;
    const double t = (level - a) / (b - a);
    const double x = m->x[from % m->nx] + t * (m->x[to % m->nx] - m->x[from % m->nx]),
                 y = m->y[from / m->nx] + t * (m->y[to / m->nx] - m->y[from / m->nx]);
    const double u = plot_part(s->x, x), v = plot_part(s->y, y), wide = 0.16, high = 0.08;
    double apart = 2;
    if (!(u > wide / 2 && u < 1 - wide / 2 && v > high / 2 && v < 1 - high / 2))
        return;
    for (size_t i = 0; i < s->count; i++)
        apart = fmin(apart, fmax(fabs(u - s->at[i][0]) / wide, fabs(v - s->at[i][1]) / high));
    const double score = apart - hypot(u - 0.5, v - 0.5);
    if (apart >= 1 && score > s->best) {
        s->best = score;
        s->here[0] = u;
        s->here[1] = v;
        s->value[0] = x;
        s->value[1] = y;
    }
}

/* Writes the labels of the contours; a contour without room gets none. They stand at values of x and y:
 * splot takes parts of the frame linearly, also along a logarithmic axis. */
static void set_values(const scribe *s, const plot_map *m, const plot_axis *x, const plot_axis *y,
                       const double *level, size_t n) {
    spots of = {.map = m, .x = x, .y = y};
    for (size_t k = 0; k < n; k++) {
        of.best = -INFINITY;
        for (size_t i = 0; i < m->nx * m->ny; i++) {
            if ((i + 1) % m->nx)
                offer(&of, i, i + 1, level[k]);
            if (i + m->nx < m->nx * m->ny)
                offer(&of, i, i + m->nx, level[k]);
        }
        if (!(of.best > -INFINITY))
            continue;
        fprintf(
            s->to,
            s->kind->form == PLOT_TEX
                ? "set label '{\\fboxsep1pt\\colorbox{white}{%.4g}}' at first %.6g,first %.6g center front\n"
                : "set label '%.4g' at first %.6g,first %.6g center front boxed\n",
            level[k], of.value[0], of.value[1]);
        memcpy(of.at[of.count++], of.here, sizeof of.here);
    }
}

/* Columns of the widest tic label of an axis, with tics `step` apart or at powers of ten. */
static int tic_columns(const plot_axis *a, double step) {
    enum { TICS = 60, POWER_OF_TEN = 5, MORE = 4 /* columns of 1x10^-5 beyond those of 1e-05 */ };
    const double first = ceil(a->lo / step);
    int widest = a->log ? POWER_OF_TEN : 1;
    for (int i = 0; i < TICS && !a->log && (first + i) * step <= a->hi; i++) {
        char text[32];
        int n = snprintf(text, sizeof text, "%g", (first + i) * step);
        n += strchr(text, 'e') ? MORE : 0;
        widest = n > widest ? n : widest;
    }
    return widest;
}

/* Contours on a light background, with their values. */
static void draw_map(scribe *s, const plot_panel *p, const plot_axis *x, const plot_axis *y) {
    double level[LEVELS], part = 1.0 / (double)s->panels, from = (double)s->column * part;
    const bool narrow = s->panels > 1 || s->kind->form == PLOT_TEX;
    const double step = plot_step((y->hi - y->lo) / 10),
                 column = s->text * (narrow ? 0.016 : 0.0127), /* of the panel */
        left = fmax(0.15 * s->text, column * (5.5 + tic_columns(y, step)));
    size_t n = plot_levels(&p->map, level, LEVELS);
    plot_axis z = {.lo = n ? level[0] : 0, .hi = n ? level[n - 1] : 0};
    z.log = z.lo > 0 && z.hi / z.lo > 50;
    const double right = (s->panels > 1 ? 0.72 : 0.77) -
                         column * fmax(0, tic_columns(&z, n > 1 ? level[1] - level[0] : 1) - 6);
    fprintf(s->to,
            "set lmargin at screen %.4g\nset rmargin at screen %.4g\nset bmargin at screen %.4g\n"
            "set tmargin at screen %.4g\nset view map\nset palette defined (0 '#ffffff', 1 '#8fc1e3')\n"
            "set colorbox\nset style textbox opaque noborder margins 0.5,0.5\nset contour base\n"
            "set cntrlabel onecolor\n"
            "set cntrparam levels discrete ",
            from + left * part, from + right * part, s->foot + 0.15 * s->text * (1 - s->foot),
            s->foot + 0.92 * (1 - s->foot));
    for (size_t i = 0; i < n; i++)
        fprintf(s->to, "%s%.9g", i ? "," : "", level[i]);
    fputs(n ? "\n" : "0\n", s->to);
    if (z.log)
        fputs(s->kind->form == PLOT_TEX ? "set logscale cb\nset format cb '$10^{%T}$'\n"
                                        : "set logscale cb\nset format cb '10^{%T}'\n",
              s->to);
    set_text(s, "cblabel offset 1.6,0", p->map.label);
    if (!y->log)
        fprintf(s->to, "set ytics %.9g\n", step);
    fputs("set ylabel offset -1.5,0\n", s->to); /* gnuplot underestimates the width of numbers */
    set_values(s, &p->map, x, y, level, n);
    fprintf(s->to, "splot $map%zu_%zu using 1:2:3 with pm3d nocontour notitle", s->frame, s->panel);
    if (n)
        fprintf(s->to, ", \\\n  '' using 1:2:3 with lines nosurface lw %.3g lc rgb '#303030' notitle",
                0.6 * s->kind->line * s->scale);
    draw_all(s, p, false, true);
}

static bool draw_panel(scribe *s, const plot_figure *f, const plot_extents *e, calc_error *error) {
    const plot_panel *p = f->panel[s->panel];
    plot_axis x, y;
    if (!plot_axes(p, e, true, &x, &y, error))
        return false;
    /* not `reset`, which would lose the panel's place in the multiplot */
    fputs("set encoding utf8\nset minussign\nunset arrow\nunset label\nunset logscale\nset format\n"
          "unset contour\nunset pm3d\nset grid layerdefault\nunset grid\nunset xzeroaxis\nunset yzeroaxis\n"
          "unset colorbox\n",
          s->to);
    if (s->kind->form != PLOT_TEX) /* the default format puts a blank before each number */
        fputs("set format '%h'\n", s->to);
    set_margins(s, f);
    set_text(s, "title", p->title);
    set_text(s, "xlabel", s->has_lower ? NULL : p->xlabel);
    set_text(s, "ylabel", p->ylabel);
    set_axis(s, 'x', &x);
    set_axis(s, 'y', &y);
    fputs("set border lw 1.2\nset ylabel offset 0,0\nset tics front\nset mxtics\nset mytics\n", s->to);
    if (s->below && !y.log)
        fprintf(s->to, "set ytics %.9g\nset mytics 1\n", plot_step((y.hi - y.lo) / 5));
    if (s->panels > 1 && (p->map.nx || s->text > 1) && !x.log) /* gnuplot's own numbers would touch */
        fprintf(s->to, "set xtics %.9g\n", plot_step((x.hi - x.lo) / 6));
    if (!p->map.nx)
        fputs("set grid back lt 1 lc rgb '#e6e6e6' lw 1\n", s->to);
    if (!p->map.nx && !x.log && !y.log)
        fputs("set xzeroaxis lt 1 lc rgb '#a0a0a0' lw 1\nset yzeroaxis lt 1 lc rgb '#a0a0a0' lw 1\n", s->to);
    set_key(s, p);
    set_place(s);
    set_caption(s);
    for (size_t i = 0; i < p->words; i++) {
        fputs("set label ", s->to);
        quoted(s, p->word[i].text);
        fprintf(s->to, " at graph %.4g,%.4g center front\n", p->word[i].at[0], p->word[i].at[1]);
    }
    if (p->map.nx) {
        draw_map(s, p, &x, &y);
    } else {
        fputs("plot ", s->to);
        draw_all(s, p, true, false);
    }
    return !s->lost || calc_no_memory(error);
}

bool plot_stopped(const plot_target *t) {
    return t->stop && *t->stop;
}

bool plot_write_picture(FILE *to, const plot_reel *reel, const plot_kind *kind, const plot_target *t,
                        calc_error *error) {
    size_t panels = plot_columns(&reel->frame[0]);
    const bool lower = panels < reel->frame[0].count;
    double w = t->width     ? t->width
               : panels > 1 ? (double)panels * (double)BESIDE
                            : (double)WIDTH,
           h = t->height ? t->height
               : lower   ? HIGHER
                         : HEIGHT;
    /* texts keep their size relative to a panel */
    double scale = fmin(w / (double)panels / (panels > 1 ? BESIDE : WIDTH), h / (double)HEIGHT);
    const double text = t->text > 0 ? t->text : 1;
    scale = fmax(scale, 0.5) * text;
    static const double line = 20; /* pixels of a line of the caption */
    double foot = t->caption ? 0.5 : 0;
    for (const char *p = t->caption; p && *p; p++)
        foot += *p == '\n';
    foot *= line * scale;
    h += foot;
    double points = kind->font * scale * (panels > 1 ? 0.9 : 1);
    fputs("# made by fret; to see it: gnuplot -p FILE\n", to);
    write_data(to, reel, t);
    if (kind->terminal) {
        fputs("set terminal ", to);
        fprintf(to, kind->terminal, w * kind->per_pixel, h * kind->per_pixel, points,
                reel->seconds > 0 ? 100 * reel->seconds : 100);
        putc('\n', to);
    }
    for (size_t n = 0; n < reel->count; n++) {
        const plot_figure *f = &reel->frame[n];
        if (plot_stopped(t))
            return calc_interrupted(error);
        if (f->count > 1)
            fprintf(to, "set multiplot layout 1,%zu\n", lower ? f->count : panels);
        for (size_t i = 0, column = 0; i < f->count; i++) {
            column += i && !f->panel[i]->below;
            scribe s = {.to = to,
                        .kind = kind,
                        .scale = scale,
                        .text = text,
                        .wide = 0.079 * (w * kind->font / ((double)panels * points) - 130), /* measured */
                        .frame = n,
                        .panel = i,
                        .panels = panels,
                        .column = column,
                        .has_lower = i + 1 < f->count && f->panel[i + 1]->below,
                        .below = f->panel[i]->below,
                        .stacked = lower,
                        .caption = t->caption,
                        .foot = foot / h};
            if (!draw_panel(&s, f, &reel->extent[i], error))
                return false;
        }
        if (f->count > 1)
            fputs("unset multiplot\n", to);
    }
    return true;
}
