/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lines on a page of text: which dots of its cells they touch.
 * Pure. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "plot/script.h"

/* A pen on its way, which puts down some of the dots that it comes over. */
typedef struct pen {
    const plot_cells *of;
    const char *dash;
    size_t length, walked; /* of the pattern; dots so far */
    size_t at;             /* the last dot */
} pen;

static void put_dot(pen *p, double cx, double cy) {
    const plot_cells *c = p->of;
    const double x = floor((cx + 0.5) * c->across), y = floor((cy + 0.5) * c->up);
    if (!(x >= 0 && x < c->columns * c->across && y >= 0 && y < c->rows * c->up))
        return;
    const size_t at = (size_t)y * (size_t)(c->columns * c->across) + (size_t)x;
    if (at == p->at)
        return;
    p->at = at;
    if (p->dash[p->walked++ % p->length] == '1')
        c->dot[at] = 1;
}

/* A stretch of a line, a step of half a dot at a time, clipped to the frame with room to spare. */
static void put_line(pen *p, const double a[2], const double b[2]) {
    const plot_cells *c = p->of;
    const int fine = c->across > c->up ? c->across : c->up, most[2] = {c->columns, c->rows};
    const double far = fine * fmax(fabs(b[0] - a[0]), fabs(b[1] - a[1]));
    double t0 = 0, t1 = 1;
    for (int i = 0; i < 2; i++) {
        const double d = b[i] - a[i], lo = -1 - a[i], hi = most[i] - a[i];
        if (d == 0)
            continue;
        t0 = fmax(t0, fmin(lo / d, hi / d));
        t1 = fmin(t1, fmax(lo / d, hi / d));
    }
    const double steps = ceil(2 * far * (t1 - t0)) + 1;
    for (double k = 0; t0 <= t1 && k <= steps; k++) {
        const double t = t0 + (t1 - t0) * k / steps;
        put_dot(p, a[0] + (b[0] - a[0]) * t, a[1] + (b[1] - a[1]) * t);
    }
}

bool plot_cells_make(plot_cells *c, int columns, int rows, bool braille) {
    *c = (plot_cells){columns, rows, braille ? 2 : 1, braille ? 4 : 1, NULL};
    c->dot = calloc((size_t)(columns * c->across), (size_t)(rows * c->up));
    return c->dot != NULL;
}

void plot_cells_draw(const plot_cells *c, const double (*point)[2], size_t count, bool joined,
                     const char *dash) {
    pen p = {.of = c, .dash = dash, .length = strlen(dash), .at = (size_t)-1};
    for (size_t i = 0; i < count; i++) {
        if (!isfinite(point[i][0]))
            continue;
        if (i > 0 && joined && isfinite(point[i - 1][0]))
            put_line(&p, point[i - 1], point[i]);
        else
            put_dot(&p, point[i][0], point[i][1]);
    }
}

bool plot_cells_has(const plot_cells *c, int column, int row) {
    for (int y = 0; y < c->up; y++)
        for (int x = 0; x < c->across; x++)
            if (c->dot[(row * c->up + y) * c->columns * c->across + column * c->across + x])
                return true;
    return false;
}

unsigned char plot_cells_braille(const plot_cells *c, int column, int row) {
    static const unsigned char bit[4][2] = {{0x40, 0x80}, {0x04, 0x20}, {0x02, 0x10}, {0x01, 0x08}};
    unsigned bits = 0;
    for (int y = 0; y < 4; y++)
        for (int x = 0; x < 2; x++)
            if (c->dot[(row * 4 + y) * c->columns * 2 + column * 2 + x])
                bits |= bit[y][x];
    return (unsigned char)bits;
}
