/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A raster of terminal cells: dots, lines, signs, texts, and showing them. Depends on text/characters. */
#include "plot/cells.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "text/characters.h"

bool plot_cells_make(plot_cells *c, int cols, int rows, int across, int up) {
    *c = (plot_cells){.cols = cols, .rows = rows, .across = across, .up = up, .stride = cols};
    c->cell = calloc((size_t)cols * (size_t)rows + 1, sizeof *c->cell);
    return c->cell != NULL;
}

plot_cells plot_cells_part(const plot_cells *of, int column, int row, int cols, int rows) {
    plot_cells part = *of;
    const int right = of->cols - column, below = of->rows - row;
    part.cols = cols < right ? cols : right > 0 ? right : 0;
    part.rows = rows < below ? rows : below > 0 ? below : 0;
    part.cell = part.cols && part.rows ? of->cell + (size_t)row * (size_t)of->stride + column : of->cell;
    return part;
}

/* The cell at a place; NULL: outside. */
static plot_cell *cell_of(const plot_cells *c, int column, int row) {
    if (column < 0 || row < 0 || column >= c->cols || row >= c->rows)
        return NULL;
    return &c->cell[(size_t)row * (size_t)c->stride + (size_t)column];
}

void plot_cells_dot(const plot_cells *c, int x, int y, unsigned char ink) {
    static const unsigned char bits[4][2] = {{0x01, 0x08}, {0x02, 0x10}, {0x04, 0x20}, {0x40, 0x80}};
    plot_cell *at = x < 0 || y < 0 ? NULL : cell_of(c, x / c->across, y / c->up);
    if (!at)
        return;
    if (at->ink == c->faint && ink != c->faint)
        at->dots = 0;
    at->dots = (unsigned char)(at->dots | bits[y % c->up][x % c->across]);
    at->ink = ink;
    at->sign[0] = 0;
}

void plot_cells_sign(const plot_cells *c, int column, int row, const char *sign, unsigned char ink) {
    plot_cell *at = cell_of(c, column, row);
    const size_t n = strlen(sign);
    if (!at || n >= sizeof at->sign)
        return;
    memcpy(at->sign, sign, n + 1);
    at->ink = ink;
}

void plot_cells_text(const plot_cells *c, int column, int row, const char *text, unsigned char ink) {
    char one[CELL_TEXT] = "";
    int at = column;
    for (size_t left = strlen(text), n; left > 0; text += n, left -= n) {
        n = character_at(text, left, NULL);
        n = n ? n : 1;
        const int wide = (int)text_columns(text, n);
        size_t held = wide ? 0 : strlen(one); /* a combining character joins the one before */
        if (held + n >= sizeof one)
            continue;
        memcpy(one + held, text, n);
        one[held + n] = 0;
        if (wide) {
            column = at;
            at += wide;
        }
        if (at <= c->cols)
            plot_cells_sign(c, column, row, one, ink);
    }
}

plot_pen plot_pen_of(const plot_cells *on, const char *dash, unsigned char ink) {
    return (plot_pen){.on = on, .dash = dash, .ink = ink, .x = INT_MIN, .y = INT_MIN};
}

static void put_dot(plot_pen *p, int x, int y) {
    const plot_cells *c = p->on;
    if ((x == p->x && y == p->y) || x < 0 || y < 0 || x >= c->cols * c->across || y >= c->rows * c->up)
        return;
    p->x = x;
    p->y = y;
    if (p->dash[p->walked++ % strlen(p->dash)] != '1')
        return;
    if (p->sign)
        plot_cells_sign(c, x / c->across, y / c->up, p->sign, p->ink);
    else
        plot_cells_dot(c, x, y, p->ink);
}

/* Clips the line to the raster with a margin of a dot, t = t0..t1, then walks along it by half a dot. Along
 * an axis a division by 0 gives infinities, which clip nothing within the raster and everything beside it. */
void plot_pen_line(plot_pen *p, double x0, double y0, double x1, double y1) {
    const double from[2] = {x0, y0}, d[2] = {x1 - x0, y1 - y0},
                 most[2] = {p->on->cols * p->on->across, p->on->rows * p->on->up};
    double t0 = 0, t1 = 1;
    if (!isfinite(d[0]) || !isfinite(d[1]))
        return;
    for (int i = 0; i < 2; i++) {
        const double lo = -1 - from[i], hi = most[i] - from[i];
        t0 = fmax(t0, fmin(lo / d[i], hi / d[i]));
        t1 = fmin(t1, fmax(lo / d[i], hi / d[i]));
    }
    const double steps = ceil(2 * fmax(fabs(d[0]), fabs(d[1])) * (t1 - t0)) + 1;
    for (double k = 0; t0 <= t1 && k <= steps; k++) {
        const double t = t0 + (t1 - t0) * k / steps;
        put_dot(p, (int)floor(x0 + d[0] * t + 0.5), (int)ceil(y0 + d[1] * t - 0.5));
    }
}

unsigned char plot_cells_show(const plot_cells *c, int column, int row, char shown[CELL_TEXT]) {
    const plot_cell *at = cell_of(c, column, row);
    shown[0] = 0;
    if (!at)
        return 0;
    if (*at->sign)
        strcpy(shown, at->sign);
    else if (at->dots && c->across == 2)
        plot_braille(at->dots, shown);
    else if (at->dots)
        memcpy(shown, (char[]){" '.:"[at->dots], 0}, 2);
    return at->ink;
}

void plot_braille(unsigned char bits, char *to) {
    enum { NO_DOTS = 0x2800 };
    character_put(NO_DOTS + (unsigned)bits, to);
}
