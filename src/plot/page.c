/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Scripts for text: a page of gnuplot's terminal for each panel. The terminal draws frame, tics and texts;
 * where the lines run is reckoned here, cell by cell, so that every curve has its own character and every tic
 * its own row. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "plot/script.h"

enum { TICS = 24, TIC = 24, LEVELS = 9 };

plot_pages plot_pages_for(const plot_target *t, size_t panels, bool one_screen) {
    int w = t->columns ? t->columns : 79, h = t->rows ? t->rows : 24, n = (int)panels;
    bool beside = n == 1 || w / n >= 50;
    plot_pages p = {beside ? w / n : w, beside || !one_screen ? h : h / n, beside, t->terminal == PLOT_BLOCK};
    p.columns = p.columns < 30 ? 30 : p.columns;
    p.rows = p.rows < 8 ? 8 : p.rows;
    return p;
}

/* ---- tics --------------------------------------------------------------------------------------- */

/* An axis over the cells 0 .. cells of the page, with its tics. */
typedef struct ruler {
    plot_axis axis;
    int cells, count;
    size_t width; /* of the widest tic text */
    double at[TICS];
    char text[TICS][TIC];
} ruler;

static double cell_of(const ruler *r, double v) {
    const plot_axis *a = &r->axis;
    double t = a->log ? log(v / a->lo) / log(a->hi / a->lo) : (v - a->lo) / (a->hi - a->lo);
    return (a->flip ? 1 - t : t) * r->cells;
}

static double at_cell(const ruler *r, double cell) {
    const plot_axis *a = &r->axis;
    double t = a->flip ? 1 - cell / r->cells : cell / r->cells;
    return a->log ? a->lo * pow(a->hi / a->lo, t) : a->lo + (a->hi - a->lo) * t;
}

static void tic(ruler *r, double v, const char *format, int digits) {
    r->at[r->count] = v;
    snprintf(r->text[r->count], TIC, format, digits, v + 0.0);
    size_t n = strlen(r->text[r->count++]);
    r->width = n > r->width ? n : r->width;
}

/* Tics at multiples of a step, all with the same digits. */
static void linear_tics(ruler *r, double step) {
    const plot_axis *a = &r->axis;
    double most = fmax(fabs(a->lo), fabs(a->hi));
    bool plain = most < 1e6 && most >= 1e-4;
    int digits =
        plain ? (int)fmax(0, -floor(log10(step) + 1e-9)) : (int)fmax(3, ceil(log10(most / step)) + 1);
    for (double k = ceil(a->lo / step - 1e-6); k <= a->hi / step + 1e-6; k++)
        tic(r, k == 0 ? 0 : k * step, plain ? "%.*f" : "%.*g", digits);
}

static void log_tics(ruler *r, int most) {
    const plot_axis *a = &r->axis;
    int first = (int)ceil(log10(a->lo) - 1e-9), last = (int)floor(log10(a->hi) + 1e-9);
    if (last - first < 1) { /* within a decade or two: 1, 2, 5 */
        static const double steps[] = {1, 2, 5};
        for (int e = first - 1; e <= last; e++)
            for (int i = 0; i < 3; i++) {
                double v = steps[i] * pow(10, e);
                if (v >= a->lo * (1 - 1e-9) && v <= a->hi * (1 + 1e-9))
                    tic(r, v, "%.*g", 6);
            }
        return;
    }
    int skip = (last - first) / (most > 1 ? most : 1) + 1;
    for (int e = first; e <= last; e += skip)
        tic(r, pow(10, e), "%.*g", 6);
}

/* Chooses tics at least `gap` cells apart. Limits that are not fixed move out to tics, and the cells that are
 * over are given up, so that every step is as many cells as the next. */
static void make_ruler(ruler *r, const plot_axis *axis, int cells, int gap) {
    *r = (ruler){.axis = *axis, .cells = cells};
    plot_axis *a = &r->axis;
    const int most = cells / gap < TICS - 2 ? cells / gap : TICS - 2;
    if (a->log) {
        log_tics(r, most);
        return;
    }
    if (a->fixed_lo || a->fixed_hi) {
        linear_tics(r, plot_step(fmax((a->hi - a->lo) * gap / cells, (a->hi - a->lo) / (TICS - 2))));
        return;
    }
    double best = -1, width = a->hi - a->lo;
    for (double step = plot_step(width / cells); step <= 1.0001 * width; step = plot_step(1.5 * step)) {
        double lo = floor(axis->lo / step + 1e-6), hi = ceil(axis->hi / step - 1e-6);
        int n = (int)(hi - lo), each = cells / n;
        if (each < gap || n > TICS - 1)
            continue;
        /* how much of the page shows points; too few tics are as bad as lost room */
        double score = width / (n * step) * ((double)(n * each) / cells) * (n < 3 ? 0.6 : n < 5 ? 0.95 : 1);
        if (score > best) {
            best = score;
            a->lo = lo * step;
            a->hi = hi * step;
            r->cells = n * each;
            r->count = 0;
            r->width = 0;
            linear_tics(r, step);
        }
    }
}

/* ---- cells -------------------------------------------------------------------------------------- */

enum { SIGN = 16 };

/* What a cell of braille shows. */
typedef struct ink {
    unsigned char bits;
    bool helping;
    const char *color;
} ink;

typedef struct page {
    FILE *to;
    const plot_target *target;
    const plot_panel *panel;
    plot_form form;
    ruler x, y;
    size_t frame, index;
    int columns, rows, left, right, top, bottom;
    bool key_right;
    int key_rows;
    bool braille;
    ink *ink; /* of braille: the cells of the frame */
    double level[LEVELS];
    size_t levels;
} page;

static const char *const chars = "*o+x#%@&=$0123456789abcdefghijklmnpqrstuvwyzABCDEFGHIJKLMNOPQRSTUVWXYZ";

/* As those of the pictures, on grounds both dark and light. */
static const char *const colors[] = {"#0087ff", "#ff5f00", "#00af5f", "#d75faf",
                                     "#d7af00", "#5fd7ff", "#878787"};

static const char gray[] = "#a8a8a8";

/* The colours of ink, the uppermost last; NULL after them. */
static const char *ink_color(size_t n) {
    enum { COLORS = sizeof colors / sizeof *colors };
    return n == 0 ? gray : n <= COLORS ? colors[n - 1] : NULL;
}

static bool is_line(const plot_series *s) {
    return s->role == PLOT_CURVE || s->role == PLOT_BAND;
}

static bool is_helping(const plot_series *s) {
    return s->thin || s->role == PLOT_BAND;
}

/* Which dots along a line of braille are put down: helping lines are dotted; dashes tell curves apart in a
 * copy without colours, and others of the same colour. */
static const char *dash_of(const page *g, size_t at) {
    static const char *const dashes[] = {"1", "11111000", "1000", "11111001000", "1110", "1100", "10"};
    if (!g->braille)
        return "1";
    if (is_helping(g->panel->series[at]))
        return "10";
    const size_t style = plot_style_of(g->panel, at), round = style / (sizeof colors / sizeof *colors);
    return dashes[(style + round) % (sizeof dashes / sizeof *dashes)];
}

/* In the key: a stretch of the line, or its character. */
static void sign_of(const page *g, size_t at, char sign[SIGN], const char **color) {
    const plot_panel *p = g->panel;
    const plot_series *s = p->series[at];
    const size_t place = plot_style_of(p, at);
    *color = s->role == PLOT_NOW || is_helping(s) ? gray : colors[place % (sizeof colors / sizeof *colors)];
    if (g->braille && is_line(s)) {
        const char *dash = dash_of(g, at);
        const size_t n = strlen(dash);
        size_t used = 0;
        for (size_t i = 0; i < 8; i += 2, used += 3)
            plot_braille(
                (unsigned char)((dash[i % n] == '1' ? 0x02 : 0) | (dash[(i + 1) % n] == '1' ? 0x10 : 0)),
                sign + used);
        return;
    }
    const char c = s->role == PLOT_NOW        ? '@'
                   : s->role == PLOT_MEASURED ? 'O'
                   : is_helping(s)            ? '.'
                                              : chars[place % strlen(chars)];
    snprintf(sign, SIGN, "%c", c);
}

/* In dots; false where there is no point. */
static bool locate(const page *g, const plot_cells *cells, double x, double y, double at[2]) {
    at[0] = at[1] = NAN;
    if (!isfinite(x) || !isfinite(y) || (g->x.axis.log && x <= 0) || (g->y.axis.log && y <= 0))
        return false;
    const double cx = cell_of(&g->x, x), cy = cell_of(&g->y, y);
    if (!(fabs(cx) < 1e15 && fabs(cy) < 1e15))
        return false;
    at[0] = (cx + 0.5) * cells->across - 0.5;
    at[1] = (g->y.cells - cy + 0.5) * cells->up - 0.5;
    return true;
}

/* The cells that a series touches. */
static bool trace(const page *g, size_t at, plot_cells *cells) {
    const plot_series *s = g->panel->series[at];
    const bool braille = g->braille && is_line(s);
    if (!plot_cells_make(cells, g->x.cells + 1, g->y.cells + 1, braille ? 2 : 1, braille ? 4 : 1))
        return false;
    for (int edge = 0; edge < 1 + (s->y2 != NULL); edge++) {
        const double *y = edge ? s->y2 : s->y;
        plot_pen pen = plot_pen_of(cells, dash_of(g, at), 0);
        double from[2] = {NAN, NAN}, to[2];
        for (size_t i = 0; i < s->count; i++) {
            const bool on = locate(g, cells, s->x[i], y[i], to) && is_line(s) && isfinite(from[0]);
            plot_pen_line(&pen, on ? from[0] : to[0], on ? from[1] : to[1], to[0], to[1]);
            memcpy(from, to, sizeof to);
        }
    }
    return true;
}

/* Row 0 is the lowest. */
static const plot_cell *traced(const plot_cells *cells, int column, int row) {
    return &cells->cell[(cells->rows - 1 - row) * cells->stride + column];
}

static void write_cells(const page *g, const plot_cells *cells) {
    for (int r = 0; r < cells->rows; r++)
        for (int c = 0; c < cells->cols; c++)
            if (traced(cells, c, r)->dots)
                fprintf(g->to, "%.12g %.12g\n", at_cell(&g->x, c), at_cell(&g->y, r));
}

/* A cell of braille shows all the lines through it in the colour of the uppermost; helping lines give way. */
static void ink_cells(page *g, size_t at, const plot_cells *cells) {
    char sign[SIGN];
    const char *color;
    sign_of(g, at, sign, &color);
    const bool helping = is_helping(g->panel->series[at]);
    for (int r = 0; r < cells->rows; r++)
        for (int c = 0; c < cells->cols; c++) {
            const unsigned char bits = traced(cells, c, r)->dots;
            ink *i = &g->ink[r * cells->cols + c];
            if (!bits)
                continue;
            i->bits = i->helping && !helping ? bits : (unsigned char)(i->bits | bits);
            i->helping = helping;
            i->color = color;
        }
}

static bool write_series_cells(page *g, size_t at) {
    plot_cells cells;
    if (!trace(g, at, &cells))
        return false;
    if (g->braille && is_line(g->panel->series[at])) {
        ink_cells(g, at, &cells);
    } else {
        fprintf(g->to, "$data%zu_%zu_%zu << END\n", g->frame, g->index, at);
        write_cells(g, &cells);
        fputs("END\n", g->to);
    }
    free(cells.cell);
    return true;
}

/* The characters of one colour. */
static void write_ink(const page *g, size_t n) {
    const int columns = g->x.cells + 1;
    char braille[4];
    fprintf(g->to, "$ink%zu_%zu_%zu << END\n", g->frame, g->index, n);
    for (int r = 0; r <= g->y.cells; r++)
        for (int c = 0; c < columns; c++) {
            const ink *i = &g->ink[r * columns + c];
            if (!i->bits || i->color != ink_color(n))
                continue;
            plot_braille(i->bits, braille);
            fprintf(g->to, "%.12g %.12g %s\n", at_cell(&g->x, c), at_cell(&g->y, r), braille);
        }
    fputs("END\n", g->to);
}

/* The index i with list[i] <= v <= list[i+1], rising or falling: v lies within. */
static size_t find(const double *list, double v) {
    size_t i = 0;
    while (!((list[i] <= v && v <= list[i + 1]) || (list[i] >= v && v >= list[i + 1])))
        i++;
    return i;
}

/* The nearest value of a list, rising or falling. */
static double within(const double *list, size_t n, double v) {
    const double first = list[0] + 1e-9 * (list[1] - list[0]), last = list[n - 1];
    return fmin(fmax(v, fmin(first, last)), fmax(first, last));
}

/* How many levels lie below z at a cell; -1: no value. */
static int band_at(const page *g, int c, int r) {
    const plot_map *m = &g->panel->map;
    const double x = within(m->x, m->nx, at_cell(&g->x, c)), y = within(m->y, m->ny, at_cell(&g->y, r));
    size_t i = find(m->x, x), j = find(m->y, y);
    double u = (x - m->x[i]) / (m->x[i + 1] - m->x[i]), v = (y - m->y[j]) / (m->y[j + 1] - m->y[j]);
    const double *z = m->z + j * m->nx + i;
    double at = (1 - v) * ((1 - u) * z[0] + u * z[1]) + v * ((1 - u) * z[m->nx] + u * z[m->nx + 1]);
    int below = 0;
    if (!isfinite(at))
        return -1;
    for (size_t k = 0; k < g->levels; k++)
        below += g->level[k] < at;
    return below;
}

/* The contour of level k lies between cells with k levels below and more. */
static bool write_map_cells(const page *g) {
    size_t room = (size_t)(g->x.cells + 1) * (size_t)(g->y.cells + 1);
    int *band = malloc(room * sizeof *band);
    if (!band)
        return false;
    int w = g->x.cells + 1, h = g->y.cells + 1;
    for (int r = 0; r < h; r++)
        for (int c = 0; c < w; c++)
            band[r * w + c] = band_at(g, c, r);
    for (int k = 0; k < (int)g->levels; k++) {
        fprintf(g->to, "$level%zu_%zu_%d << END\n", g->frame, g->index, k);
        for (int r = 0; r < h; r++)
            for (int c = 0; c < w; c++) {
                int here = band[r * w + c], east = c + 1 < w ? band[r * w + c + 1] : here,
                    north = r + 1 < h ? band[(r + 1) * w + c] : here;
                if (here < 0 || east < 0 || north < 0)
                    continue;
                if ((here <= k) != (east <= k) || (here <= k) != (north <= k))
                    fprintf(g->to, "%.12g %.12g\n", at_cell(&g->x, c), at_cell(&g->y, r));
            }
        fputs("END\n", g->to);
    }
    free(band);
    return true;
}

/* ---- texts -------------------------------------------------------------------------------------- */

static char *shown(const page *g, const char *text) {
    return plot_text(text ? text : "", g->form);
}

/* The label of y stands level, in the line of the title. */
static bool set_texts(const page *g) {
    const plot_panel *p = g->panel;
    char *title = shown(g, p->title), *x = shown(g, p->xlabel), *y = shown(g, p->ylabel),
         *z = shown(g, p->map.nx ? p->map.label : "");
    bool ok = title && x && y && z;
    if (ok) {
        size_t room = strlen(title) + strlen(y) + strlen(z) + 20;
        char *line = malloc(room);
        ok = line != NULL;
        if (ok) {
            snprintf(line, room, "%s%s%s%s%s", y, *z ? "   contours of " : "", z,
                     *title && (*y || *z) ? "   " : "", title);
            fputs("set label ", g->to);
            plot_quote(g->to, line);
            fprintf(g->to, " at character %d,%d left\nset xlabel ",
                    plot_columns(y) + 2 < (size_t)g->left ? g->left - (int)plot_columns(y) - 1 : 1,
                    g->rows - 1);
            plot_quote(g->to, x);
            putc('\n', g->to);
            free(line);
        }
    }
    free(title);
    free(x);
    free(y);
    free(z);
    return ok;
}

static void set_tics(const page *g, char name, const ruler *r) {
    fprintf(g->to, "set %crange [%.12g:%.12g]\n", name, r->axis.flip ? r->axis.hi : r->axis.lo,
            r->axis.flip ? r->axis.lo : r->axis.hi);
    if (r->axis.log)
        fprintf(g->to, "set logscale %c\n", name);
    fprintf(g->to, "set %ctics (", name);
    for (int i = 0; i < r->count; i++)
        fprintf(g->to, "%s'%s' %.12g", i ? "," : "", r->text[i], r->at[i]);
    fputs(")\n", g->to);
}

/* An entry of the key, 0 .. ; NULL after the last. */
typedef struct entry {
    char sign[SIGN];
    const char *color;
    char *text; /* to be freed */
} entry;

static size_t key_of(const page *g, entry key[PLOT_CURVES + LEVELS]) {
    const plot_panel *p = g->panel;
    size_t n = 0;
    for (size_t i = 0; i < p->count && !p->key_off; i++)
        if (p->series[i]->title) {
            sign_of(g, i, key[n].sign, &key[n].color);
            key[n++].text = shown(g, p->series[i]->title);
        }
    for (size_t k = 0; k < g->levels; k++) {
        key[n].text = malloc(TIC);
        if (key[n].text)
            snprintf(key[n].text, TIC, "%.4g", g->level[k]);
        key[n].sign[0] = (char)('1' + k);
        key[n].sign[1] = 0;
        key[n++].color = colors[k % 7];
    }
    return n;
}

static size_t sign_columns(const entry *key, size_t n) {
    size_t most = 1;
    for (size_t i = 0; i < n; i++)
        most = plot_columns(key[i].sign) > most ? plot_columns(key[i].sign) : most;
    return most;
}

static void place_key(page *g, const entry *key, size_t n) {
    size_t longest = 0;
    for (size_t i = 0; i < n; i++) {
        size_t c = plot_columns(key[i].text);
        longest = c > longest ? c : longest;
    }
    const size_t sign = sign_columns(key, n);
    g->key_right = n && longest + sign + 3 <= (size_t)g->columns / 4 && n <= (size_t)g->rows - 4;
    g->key_rows = 0;
    g->right = g->key_right ? (int)(longest + sign) + 5 : 3;
    size_t at = 0;
    for (size_t i = 0; i < n && !g->key_right; i++) { /* rows of entries below */
        size_t w = plot_columns(key[i].text) + sign + 4;
        if (!g->key_rows || at + w > (size_t)g->columns) {
            g->key_rows++;
            at = 0;
        }
        at += w;
    }
    /* a key of half the page would leave no picture */
    if (g->key_rows > (g->rows - 4) / 2)
        g->key_rows = (g->rows - 4) / 2;
}

static void set_key(const page *g, const entry *key, size_t n) {
    int column = g->key_right ? g->left + g->x.cells + 3 : 2,
        row = g->key_right ? g->rows - 1 - g->top : g->key_rows - 1;
    const int sign = (int)sign_columns(key, n);
    fputs("unset key\n", g->to);
    for (size_t i = 0; i < n && row >= 0; i++) {
        int w = (int)plot_columns(key[i].text) + sign + 4;
        if (!g->key_right && column > 2 && column + w - 2 > g->columns) {
            column = 2;
            if (--row < 0)
                break;
        }
        fprintf(g->to, "set label '%s' at character %d,%d left tc rgb '%s'\nset label ", key[i].sign, column,
                row, key[i].color);
        plot_quote(g->to, key[i].text);
        fprintf(g->to, " at character %d,%d left\n", column + sign + 1, row);
        if (g->key_right)
            row--;
        else
            column += w;
    }
}

static size_t in_order(const plot_panel *p, size_t at[PLOT_CURVES]) {
    size_t n = 0;
    for (int l = 0; l < PLOT_LAYERS; l++)
        for (size_t i = 0; i < p->count; i++)
            if (plot_layer(p->series[i]) == l)
                at[n++] = i;
    return n;
}

/* Lines of braille are ink, crowds lie below it, and all else above. */
static void draw_series(const page *g, const size_t *order, size_t count, bool crowds) {
    for (size_t i = 0; i < count; i++) {
        char sign[SIGN];
        const char *color;
        const plot_series *s = g->panel->series[order[i]];
        if (g->braille && (is_line(s) || plot_is_crowd(s) != crowds))
            continue;
        sign_of(g, order[i], sign, &color);
        fprintf(g->to, ", \\\n  $data%zu_%zu_%zu with points pt '%s' lc rgb '%s'", g->frame, g->index,
                order[i], sign, color);
    }
}

static void draw(const page *g, const size_t *order, size_t count) {
    fputs("plot NaN notitle", g->to);
    for (size_t k = 0; k < g->levels; k++)
        fprintf(g->to, ", \\\n  $level%zu_%zu_%zu with points pt '%zu' lc rgb '%s'", g->frame, g->index, k,
                k + 1, colors[k % 7]);
    if (g->braille)
        draw_series(g, order, count, true);
    for (size_t n = 0; g->braille && ink_color(n); n++)
        fprintf(g->to, ", \\\n  $ink%zu_%zu_%zu using 1:2:3 with labels tc rgb '%s' notitle", g->frame,
                g->index, n, ink_color(n));
    draw_series(g, order, count, false);
    putc('\n', g->to);
}

/* All cells of the series, in the script. */
static bool write_all_cells(page *g, const size_t *order, size_t count) {
    const size_t cells = (size_t)(g->x.cells + 1) * (size_t)(g->y.cells + 1);
    g->ink = g->braille ? calloc(cells, sizeof *g->ink) : NULL;
    bool ok = g->ink || !g->braille;
    for (size_t i = 0; i < count && ok; i++)
        ok = write_series_cells(g, order[i]);
    for (size_t n = 0; g->braille && ok && ink_color(n); n++)
        write_ink(g, n);
    free(g->ink);
    return ok;
}

/* Margins in characters: texts first, then the frame takes what is left. */
static void place_frame(page *g, const plot_axis *x, const plot_axis *y, const entry *key, size_t n) {
    place_key(g, key, n);
    g->top = 1;
    g->bottom = 2 + g->key_rows;
    int height = g->rows - 1 - g->top - g->bottom;
    make_ruler(&g->y, y, height < 3 ? 3 : height, 2);
    g->left = (int)g->y.width + 2;
    int width = g->columns - 1 - g->left - g->right;
    for (size_t gap = 6;; gap = g->x.width + 2) { /* numbers side by side, with blanks between */
        make_ruler(&g->x, x, width < 10 ? 10 : width, (int)gap);
        if (g->x.width + 2 <= gap)
            break;
    }
    /* what is over goes below and to the right */
    g->rows -= height > g->y.cells ? height - g->y.cells : 0;
    fprintf(g->to,
            "set terminal dumb size %d,%d noenhanced %s\nset lmargin %d\nset rmargin %d\nset tmargin %d\nset "
            "bmargin %d\n",
            g->columns, g->rows, g->target->color ? "ansi256" : "mono", g->left,
            g->columns - 1 - g->left - g->x.cells, g->top, g->bottom);
    set_tics(g, 'x', &g->x);
    set_tics(g, 'y', &g->y);
    set_key(g, key, n);
}

/* False: out of memory. */
static bool lay_out(page *g, const plot_axis *x, const plot_axis *y) {
    entry key[PLOT_CURVES + LEVELS];
    const plot_map *m = &g->panel->map;
    bool ok = true;
    g->levels = m->nx ? plot_levels(m, g->level, LEVELS) : 0;
    const size_t n = key_of(g, key);
    for (size_t i = 0; i < n; i++)
        ok &= key[i].text != NULL;
    if (ok)
        place_frame(g, x, y, key, n);
    for (size_t i = 0; i < n; i++)
        free(key[i].text);
    return ok;
}

static bool write_page(page *g, const plot_extents *e, calc_error *error) {
    size_t order[PLOT_CURVES];
    const size_t count = in_order(g->panel, order);
    plot_axis x, y;
    if (!plot_axes(g->panel, e, false, &x, &y, error))
        return false;
    fputs("reset\nset encoding utf8\nset border back\nset tics back\n", g->to);
    bool ok = lay_out(g, &x, &y) && set_texts(g);
    ok = ok && write_all_cells(g, order, count);
    if (ok && g->levels)
        ok = write_map_cells(g);
    if (!ok)
        return calc_no_memory(error);
    draw(g, order, count);
    return true;
}

bool plot_write_pages(FILE *to, const plot_reel *reel, const plot_target *target, const plot_pages *pages,
                      calc_error *error) {
    for (size_t n = 0; n < reel->count; n++) {
        if (plot_stopped(target))
            return calc_interrupted(error);
        for (size_t i = 0; i < reel->frame[n].count; i++) {
            page g = {.to = to,
                      .target = target,
                      .panel = reel->frame[n].panel[i],
                      .form = target->unicode ? PLOT_UNICODE : PLOT_ASCII,
                      .frame = n,
                      .index = i,
                      .columns = pages->columns,
                      .rows = pages->rows,
                      .braille = pages->braille && !reel->frame[n].panel[i]->map.nx};
            if (!write_page(&g, &reel->extent[i], error))
                return false;
        }
    }
    return true;
}
