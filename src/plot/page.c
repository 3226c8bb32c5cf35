/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lays out a panel as a page of text: texts, frame and key, with every tic on its own row; and traces the
 * cells that curves touch, with the sign and dashes of each curve. Depends on script.h and text/characters.
 */
#include "plot/page.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "text/characters.h"

enum { LEAST_ROWS = 8, STACKED_ROWS = 6 };

plot_pages plot_pages_for(const plot_target *t, const plot_figure *f, bool one_screen) {
    int w = t->columns ? t->columns : 79, h = t->rows ? t->rows : 24, n = (int)f->count;
    bool beside = n == 1 || (w / n >= 50 && plot_columns(f) == f->count);
    plot_pages p = {beside ? w / n : w, beside || !one_screen ? h : h / n, beside, t->terminal == PLOT_BLOCK};
    p.columns = p.columns < 30 ? 30 : p.columns;
    const int least = beside || !one_screen ? LEAST_ROWS : STACKED_ROWS;
    p.rows = p.rows < least ? least : p.rows;
    return p;
}

/* ---- tics --------------------------------------------------------------------------------------- */

double page_cell(const page_ruler *r, double v) {
    const plot_axis *a = &r->axis;
    const double t = plot_part(a, v);
    return (a->flip ? 1 - t : t) * r->cells;
}

double page_value(const page_ruler *r, double cell) {
    const plot_axis *a = &r->axis;
    double t = a->flip ? 1 - cell / r->cells : cell / r->cells;
    return a->log ? a->lo * pow(a->hi / a->lo, t) : a->lo + (a->hi - a->lo) * t;
}

static void tic(page_ruler *r, double v, const char *format, int digits) {
    r->at[r->count] = v;
    snprintf(r->text[r->count], PAGE_TIC, format, digits, v + 0.0);
    size_t n = strlen(r->text[r->count++]);
    r->width = n > r->width ? n : r->width;
}

/* Tics at multiples of a step, all with the same number of digits. */
static void linear_tics(page_ruler *r, double step) {
    const plot_axis *a = &r->axis;
    double most = fmax(fabs(a->lo), fabs(a->hi));
    bool plain = most < 1e6 && most >= 1e-4;
    int digits =
        plain ? (int)fmax(0, -floor(log10(step) + 1e-9)) : (int)fmax(3, ceil(log10(most / step)) + 1);
    for (double k = ceil(a->lo / step - 1e-6); k <= a->hi / step + 1e-6; k++)
        tic(r, k == 0 ? 0 : k * step, plain ? "%.*f" : "%.*g", digits);
}

static void log_tics(page_ruler *r, int most) {
    const plot_axis *a = &r->axis;
    int first = (int)ceil(log10(a->lo) - 1e-9), last = (int)floor(log10(a->hi) + 1e-9);
    if (last - first < 1) {
        double at[PLOT_TICS];
        const size_t n = plot_log_tics(a, at);
        for (size_t i = 0; i < n; i++)
            tic(r, at[i], "%.*g", 6);
        return;
    }
    int skip = (last - first) / (most > 1 ? most : 1) + 1;
    for (int e = first; e <= last; e += skip)
        tic(r, pow(10, e), "%.*g", 6);
}

/* Chooses tics at least `gap` cells apart. Unless a limit is fixed, both move out to tics, and the ruler gets
 * shorter so that every step is the same whole number of cells. */
static void make_ruler(page_ruler *r, const plot_axis *axis, int cells, int gap) {
    *r = (page_ruler){.axis = *axis, .cells = cells};
    plot_axis *a = &r->axis;
    const int most = cells / gap < PAGE_TICS - 2 ? cells / gap : PAGE_TICS - 2;
    if (a->log) {
        log_tics(r, most);
        return;
    }
    if (a->fixed_lo || a->fixed_hi) {
        linear_tics(r, plot_step(fmax((a->hi - a->lo) * gap / cells, (a->hi - a->lo) / (PAGE_TICS - 2))));
        return;
    }
    double best = -1, width = a->hi - a->lo;
    /* steps wider than the range only where all others would put the tics too close */
    for (double step = plot_step(width / cells); step <= (best < 0 ? 10 : 1.0001) * width;
         step = plot_step(1.5 * step)) {
        double lo = floor(axis->lo / step + 1e-6), hi = ceil(axis->hi / step - 1e-6);
        int n = (int)(hi - lo), each = cells / n;
        if (each < gap || n > PAGE_TICS - 1)
            continue;
        /* the part of the cells that shows points, reduced if there are few tics */
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

/* ---- curves ------------------------------------------------------------------------------------- */

static const char *const chars = "*o+x#%@&=$0123456789abcdefghijklmnpqrstuvwyzABCDEFGHIJKLMNOPQRSTUVWXYZ";

static bool is_line(const plot_series *s) {
    return s->role == PLOT_CURVE || s->role == PLOT_BAND;
}

static bool is_helping(const plot_series *s) {
    return s->thin || s->role == PLOT_BAND;
}

/* The dash pattern of a line in braille: helping lines are dotted; curves differ by dashes too, for prints
 * without colour and for curves of the same colour. */
static const char *dash_of(const plot_page *g, size_t at) {
    static const char *const dashes[] = {"1", "11111000", "1000", "11111001000", "1110", "1100", "10"};
    if (!g->braille)
        return "1";
    if (is_helping(g->panel->series[at]))
        return "10";
    const size_t style = plot_style_of(g->panel, at), round = style / PAGE_COLORS;
    return dashes[(style + round) % (sizeof dashes / sizeof *dashes)];
}

/* The sign of a series in the key, a piece of its line or its character, and its ink. */
static void sign_of(const plot_page *g, size_t at, char sign[PAGE_SIGN], unsigned char *ink) {
    const plot_panel *p = g->panel;
    const plot_series *s = p->series[at];
    const size_t place = plot_style_of(p, at);
    *ink = s->role == PLOT_NOW || is_helping(s) ? PAGE_GRAY : (unsigned char)(1 + place % PAGE_COLORS);
    if (g->braille && is_line(s)) {
        const char *dash = dash_of(g, at);
        const size_t n = strlen(dash);
        for (size_t i = 0; i < 8; i += 2, sign += 3)
            plot_braille(
                (unsigned char)((dash[i % n] == '1' ? 0x02 : 0) | (dash[(i + 1) % n] == '1' ? 0x10 : 0)),
                sign);
        return;
    }
    const char c = s->role == PLOT_NOW        ? '@'
                   : s->role == PLOT_MEASURED ? 'O'
                   : is_helping(s)            ? '.'
                                              : chars[place % strlen(chars)];
    snprintf(sign, PAGE_SIGN, "%c", c);
}

static void sign_of_level(size_t k, char sign[PAGE_SIGN], unsigned char *ink) {
    memcpy(sign, (char[]){(char)('1' + k), 0}, 2);
    *ink = (unsigned char)(1 + k % PAGE_COLORS);
}

void page_word(const plot_page *g, size_t i, int *column, int *row) {
    const double *at = g->panel->word[i].at;
    *column = g->left + (int)lround(at[0] * g->x.cells) - (int)strlen(g->panel->word[i].text) / 2;
    *row = g->top + g->y.cells - (int)lround(at[1] * g->y.cells);
}

/* at[]: column and row of a point in the frame, row 0 at the top; NaN: not on the page. */
static void locate(const plot_page *g, double x, double y, double at[2]) {
    at[0] = at[1] = NAN;
    if (!isfinite(x) || !isfinite(y) || (g->x.axis.log && x <= 0) || (g->y.axis.log && y <= 0))
        return;
    const double cx = page_cell(&g->x, x), cy = page_cell(&g->y, y);
    if (fabs(cx) < 1e15 && fabs(cy) < 1e15) {
        at[0] = cx;
        at[1] = g->y.cells - cy;
    }
}

static void trace_line(const plot_page *g, size_t at, const double *y, const plot_cells *frame,
                       const char *sign, unsigned char ink) {
    const plot_series *s = g->panel->series[at];
    plot_pen pen = plot_pen_of(frame, dash_of(g, at), ink);
    pen.sign = g->braille ? NULL : sign;
    double from[2] = {NAN, NAN}, to[2];
    for (size_t i = 0; i < s->count; i++) {
        locate(g, s->x[i], y[i], to);
        to[0] = (to[0] + 0.5) * frame->across - 0.5;
        to[1] = (to[1] + 0.5) * frame->up - 0.5;
        const double *start = isfinite(from[0]) ? from : to;
        plot_pen_line(&pen, start[0], start[1], to[0], to[1]);
        memcpy(from, to, sizeof to);
    }
}

static void trace_points(const plot_page *g, const plot_series *s, const plot_cells *frame, const char *sign,
                         unsigned char ink) {
    double at[2];
    for (size_t i = 0; i < s->count; i++) {
        locate(g, s->x[i], s->y[i], at);
        if (fabs(at[0]) < g->columns && fabs(at[1]) < g->rows)
            plot_cells_sign(frame, (int)floor(at[0] + 0.5), (int)ceil(at[1] - 0.5), sign, ink);
    }
}

/* The index i with v between list[i] and list[i+1]; the list is monotonic and contains v. */
static size_t find(const double *list, double v) {
    size_t i = 0;
    while (!((list[i] <= v && v <= list[i + 1]) || (list[i] >= v && v >= list[i + 1])))
        i++;
    return i;
}

/* v clamped to the range of a monotonic list. */
static double within(const double *list, size_t n, double v) {
    const double first = list[0] + 1e-9 * (list[1] - list[0]), last = list[n - 1];
    return fmin(fmax(v, fmin(first, last)), fmax(first, last));
}

/* How many levels lie below z at a cell; -1: no value. */
static int band_at(const plot_page *g, int c, int r) {
    const plot_map *m = &g->panel->map;
    const double x = within(m->x, m->nx, page_value(&g->x, c)), y = within(m->y, m->ny, page_value(&g->y, r));
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

/* Draws the contour of level k where a cell has at most k levels below it and its neighbour more. */
static bool trace_map(const plot_page *g, const plot_cells *frame) {
    char sign[PAGE_SIGN];
    unsigned char ink;
    const int w = g->x.cells + 1, h = g->y.cells + 1;
    int *band = malloc((size_t)w * (size_t)h * sizeof *band);
    if (!band)
        return false;
    for (int r = 0; r < h; r++)
        for (int c = 0; c < w; c++)
            band[r * w + c] = band_at(g, c, r);
    for (int k = 0; k < (int)g->levels; k++) {
        sign_of_level((size_t)k, sign, &ink);
        for (int r = 0; r < h; r++)
            for (int c = 0; c < w; c++) {
                int here = band[r * w + c], east = c + 1 < w ? band[r * w + c + 1] : here,
                    north = r + 1 < h ? band[(r + 1) * w + c] : here;
                if (here < 0 || east < 0 || north < 0)
                    continue;
                if ((here <= k) != (east <= k) || (here <= k) != (north <= k))
                    plot_cells_sign(frame, c, h - 1 - r, sign, ink);
            }
    }
    free(band);
    return true;
}

static void trace_series(const plot_page *g, size_t at, const plot_cells *frame) {
    const plot_series *s = g->panel->series[at];
    char sign[PAGE_SIGN];
    unsigned char ink;
    sign_of(g, at, sign, &ink);
    if (!is_line(s)) {
        trace_points(g, s, frame, sign, ink);
    } else if (s->role != PLOT_BAND || s->y2) {
        trace_line(g, at, s->y, frame, sign, ink);
        if (s->y2)
            trace_line(g, at, s->y2, frame, sign, ink);
    }
}

bool page_trace(const plot_page *g, const plot_cells *frame) {
    if (g->levels && !trace_map(g, frame))
        return false;
    for (int layer = 0; layer < PLOT_LAYERS; layer++)
        for (size_t i = 0; i < g->panel->count; i++)
            if (plot_layer(g->panel->series[i]) == layer)
                trace_series(g, i, frame);
    return true;
}

/* ---- texts -------------------------------------------------------------------------------------- */

static int columns_of(const char *text) {
    return (int)text_columns(text, strlen(text));
}

static char *shown(const plot_page *g, const char *text) {
    return plot_text(text ? text : "", g->form);
}

/* Makes the line above the frame, from the labels of y and z and the title, and the label of x below. */
static bool take_texts(plot_page *g) {
    const plot_panel *p = g->panel;
    char *title = shown(g, p->title), *y = shown(g, p->ylabel), *z = shown(g, p->map.nx ? p->map.label : "");
    g->foot = shown(g, p->xlabel);
    if (title && y && z) {
        const size_t room = strlen(title) + strlen(y) + strlen(z) + 20;
        g->head = malloc(room);
        if (g->head)
            snprintf(g->head, room, "%s%s%s%s%s", y, *z ? "   contours of " : "", z,
                     *title && (*y || *z) ? "   " : "", title);
        g->head_column = columns_of(y) + 2 < g->left ? g->left - columns_of(y) - 1 : 1;
    }
    free(title);
    free(y);
    free(z);
    return g->head && g->foot;
}

/* ---- the key ------------------------------------------------------------------------------------ */

/* Is the entry a second line of the one before: a series of the same style without points? */
static bool goes_on(const plot_panel *p, size_t i) {
    const plot_series *s = p->series[i];
    return i && !s->count && s->style >= 0 && s->style == p->series[i - 1]->style;
}

static bool take_key(plot_page *g) {
    const plot_panel *p = g->panel;
    bool ok = true;
    for (size_t i = 0; i < p->count && !p->key_off; i++)
        if (p->series[i]->title) {
            page_entry *e = &g->entry[g->entries++];
            sign_of(g, i, e->sign, &e->ink);
            if (goes_on(p, i))
                memcpy(e->sign, " ", 2);
            e->text = shown(g, p->series[i]->title);
            ok &= e->text != NULL;
        }
    for (size_t k = 0; k < g->levels; k++) {
        page_entry *e = &g->entry[g->entries++];
        sign_of_level(k, e->sign, &e->ink);
        e->text = malloc(PAGE_TIC);
        ok &= e->text != NULL;
        if (e->text)
            snprintf(e->text, PAGE_TIC, "%.4g", g->level[k]);
    }
    return ok;
}

static int sign_columns(const plot_page *g) {
    int most = 1;
    for (size_t i = 0; i < g->entries; i++)
        most = columns_of(g->entry[i].sign) > most ? columns_of(g->entry[i].sign) : most;
    return most;
}

/* Places the entries from `row` on; returns the rows they take. Entries below the page are hidden. */
static int place_entries(plot_page *g, int row) {
    const int sign = sign_columns(g), first = row;
    int column = g->key_right ? g->left + g->x.cells + 3 : 2;
    for (size_t i = 0; i < g->entries; i++) {
        page_entry *e = &g->entry[i];
        const int w = columns_of(e->text) + sign + 4;
        if (i > 0 && (g->key_right || column + w - 2 > g->columns)) {
            row++;
            column = g->key_right ? column : 2;
        }
        e->column = column;
        e->text_column = column + sign + 1;
        e->row = row < g->rows ? row : -1;
        column += g->key_right ? 0 : w;
    }
    return g->entries ? row - first + 1 : 0;
}

/* Decides where the key is, and its room. */
static void place_key(plot_page *g) {
    int longest = 0;
    for (size_t i = 0; i < g->entries; i++) {
        const int c = columns_of(g->entry[i].text);
        longest = c > longest ? c : longest;
    }
    const int sign = sign_columns(g), most = (g->rows - 4) / 2; /* leaves room for the frame */
    g->key_right = g->entries && longest + sign + 3 <= g->columns / 4 && (int)g->entries <= g->rows - 4;
    g->key_rows = g->key_right ? 0 : place_entries(g, 0);
    g->key_rows = g->key_rows < most ? g->key_rows : most;
    g->right = g->key_right ? longest + sign + 5 : 3;
}

/* ---- the page ----------------------------------------------------------------------------------- */

/* The frame takes the room that key and tics leave. */
static void place_frame(plot_page *g, const plot_axis *x, const plot_axis *y) {
    place_key(g);
    g->top = 1;
    g->bottom = 2 + g->key_rows;
    const int height = g->rows - 1 - g->top - g->bottom;
    make_ruler(&g->y, y, height, 2);
    g->left = (int)g->y.width + 2;
    const int width = g->columns - 1 - g->left - g->right;
    for (size_t gap = 6;; gap = g->x.width + 2) { /* until all numbers have blanks between them */
        make_ruler(&g->x, x, width < 10 ? 10 : width, (int)gap);
        if (g->x.width + 2 <= gap)
            break;
    }
    /* unused cells stay below and at the right */
    g->rows -= height - g->y.cells;
    place_entries(g, g->key_right ? g->top : g->rows - g->key_rows);
}

bool page_make(plot_page *g, const plot_panel *panel, const plot_extents *extent, const plot_target *target,
               const plot_pages *pages, calc_error *error) {
    plot_axis x, y;
    *g = (plot_page){.panel = panel,
                     .form = target->unicode ? PLOT_UNICODE : PLOT_ASCII,
                     .braille = pages->braille,
                     .columns = pages->columns,
                     .rows = panel->below ? (pages->rows + LEAST_ROWS) / 2 : pages->rows};
    if (!plot_axes(panel, extent, false, &x, &y, error))
        return false;
    g->levels = panel->map.nx ? plot_levels(&panel->map, g->level, PAGE_LEVELS) : 0;
    bool ok = take_key(g);
    if (ok) {
        place_frame(g, &x, &y);
        ok = take_texts(g);
    }
    if (!ok) {
        page_free(g);
        calc_no_memory(error);
    }
    return ok;
}

void page_free(plot_page *g) {
    for (size_t i = 0; i < g->entries; i++)
        free(g->entry[i].text);
    free(g->head);
    free(g->foot);
}
