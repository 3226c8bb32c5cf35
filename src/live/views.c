/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The one table of views, and all drawing. Changes nothing of the state but the place of the hysteresis loop,
 * which the mouse needs, and that the screen is torn no more. */
#define _XOPEN_SOURCE 700
#define NCURSES_WIDECHAR 1
#include <curses.h>
#include <limits.h>
#include <math.h>
#include <string.h>

#include "live/state.h"
#include "live/terminal.h"
#include "text/characters.h"
#include "text/typeset.h"

/* ---- text -------------------------------------------------------------------------------------- */

/* Wraps a text, draws its rows from number `from` on as far as `at` has room, and returns how many it has. */
static int put_words(const char *text, ink of, rect at, int from) {
    int row = 0;
    for (const char *p = text; *p; p += *p == '\n') {
        size_t left = strcspn(p, "\n");
        do {
            const char *here = p;
            const size_t n = text_break(&p, &left, (size_t)at.cols);
            if (row >= from)
                put_text(at, row - from, of, "%.*s", (int)n, here);
            row++;
        } while (left > 0);
    }
    return row;
}

static int rows_of(const char *text, int most) {
    const int rows = put_words(text, INK_NONE, (rect){0, 0, 0, COLS}, 0);
    return rows < most ? rows : most;
}

/* ---- scales, the same for all scenes on the screen --------------------------------------------- */

typedef struct scales {
    double a, bound, dx, Fx, energy, lost;
} scales;

/* A round number a little above v: scales must not change at every key. */
static double roomy(double v) {
    static const double steps[] = {1, 1.5, 2, 3, 4, 5, 6, 8, 10};
    if (!(v > 0))
        return 1;
    const double ten = pow(10, floor(log10(v * 1.02)));
    size_t i = 0;
    while (i + 1 < sizeof steps / sizeof *steps && steps[i] * ten < v * 1.02)
        i++;
    return steps[i] * ten;
}

static scales scales_of(const live *l) {
    scales most = {0, 0, 0, 0, 0, 0};
    for (size_t i = 0; i < live_sides(l); i++) {
        const side *s = &l->side[i];
        if (*s->trouble)
            continue;
        const extent curve = playback_curve(&s->playback)->most;
        most.a = fmax(most.a, fmax(curve.a, s->now.a));
        most.bound = fmax(most.bound, fmax(curve.bound, s->now.bound));
        most.dx = fmax(most.dx, fmax(curve.dx, s->now.bound));
        most.Fx = fmax(most.Fx, fmax(curve.Fx, s->now.slip));
        most.energy = fmax(most.energy, curve.energy);
        for (int j = 0; j <= SHOT_SAMPLES && s->loses; j++)
            most.lost = fmax(most.lost, s->lost[j]);
    }
    return (scales){roomy(most.a),  roomy(most.bound),  roomy(most.dx),
                    roomy(most.Fx), roomy(most.energy), roomy(most.lost)};
}

/* ---- panes ------------------------------------------------------------------------------------- */

/* What a view draws, and on what. */
typedef struct pane {
    const side *side;
    const shot *shot; /* the state of the side that is shown */
    const scales *most;
    plot_cells cells;
    int wide, high; /* in dots */
    int digits;     /* of numbers */
} pane;

static void put_label(const pane *p, int column, int row, ink of, const char *text) {
    plot_cells_text(&p->cells, column, row, text, (unsigned char)of);
}

/* Writes the largest value of an axis: in the first row at the left, in others at the right. */
static void put_scale(const pane *p, int row, const char *name, double v, dim d) {
    char number[40], text[48];
    live_amount(v, d, number, sizeof number);
    const int n = snprintf(text, sizeof text, "%s%s", name, number);
    put_label(p, row ? p->cells.cols - n : 0, row, INK_FRAME, text);
}

static plot_pen pen_of(const pane *p, const char *dash, ink of) {
    return plot_pen_of(&p->cells, dash, (unsigned char)of);
}

static void draw_dotted(const pane *p, ink of, double x0, double y0, double x1, double y1) {
    plot_pen pen = pen_of(p, "1000", of);
    plot_pen_line(&pen, x0, y0, x1, y1);
}

/* ---- the views --------------------------------------------------------------------------------- */

typedef struct zone {
    ink of;
    const char *name, *sign, *dots;
    int every; /* one place in `every` gets a dot, so that zones differ without colours */
} zone;

static const zone stick = {INK_STICK, "stick", "#", "\u28ff", 1}, slip = {INK_SLIP, "slip", ".", "\u2801", 4},
                  earlier = {INK_MEMORY, "earlier", "+", "\u28a5", 2};

static const zone *zone_at(const shot *s, double r) {
    if (r > s->a)
        return NULL;
    if (r > s->c)
        return &slip;
    size_t i = 0;
    while (i + 1 < s->rings && s->ring[i].radius < r)
        i++;
    return fabs(s->ring[i].sigma) > 0.5 ? &earlier : &stick;
}

/* Dots on the edge of a ring are left out, so that neighbouring rings can be told apart. */
static bool on_edge(const shot *s, double r, double width) {
    for (size_t i = 0; i < s->rings; i++)
        if (fabs(s->ring[i].radius - r) < width && s->ring[i].radius < s->c * (1 - 1e-9))
            return true;
    return false;
}

/* Draws one zone of the disc; dot: the size of a dot [m]. */
static void put_zone(const pane *p, int high, const zone *z, double dot) {
    const int mx = p->wide / 2, my = high / 2;
    for (int y = 0; y < high; y++)
        for (int x = 0; x < p->wide; x++) {
            const double r = hypot(x - mx + 0.5, y - my + 0.5) * dot;
            if (zone_at(p->shot, r) != z || on_edge(p->shot, r, 0.5 * dot))
                continue;
            if (!typeset_unicode())
                put_label(p, x, y / p->cells.up, z->of, z->sign);
            else if ((x + 2 * (y % 2) * (z->every / 4) + (y % 2) * (z->every == 2)) % z->every == 0 &&
                     (z->every < 4 || y % 2 == 0))
                plot_cells_dot(&p->cells, x, y, (unsigned char)z->of);
        }
}

static void draw_disc(const pane *p) {
    const zone *const zones[] = {&stick, &slip, &earlier}, *const upwards[] = {&earlier, &stick, &slip};
    const int below = p->cells.rows - 1, high = below * p->cells.up;
    const double dot = p->most->a / (fmin(p->wide, high) / 2.0 - 0.5);
    int column = 1;
    for (size_t i = 0; i < 3; i++)
        put_zone(p, high, upwards[i], dot);
    for (size_t i = 0; i < 3; i++) {
        put_label(p, column, below, zones[i]->of, typeset_unicode() ? zones[i]->dots : zones[i]->sign);
        put_label(p, column + 2, below, zones[i]->of, zones[i]->name);
        column += (int)strlen(zones[i]->name) + 4;
    }
}

static void draw_springs(const pane *p) {
    const shot *s = p->shot;
    const int below = p->cells.rows - 1;
    const double mx = (p->wide - 1) / 2.0, my = (below * p->cells.up - 1) / 2.0, kx = mx / p->most->a,
                 ky = my / p->most->bound;
    draw_dotted(p, INK_FRAME, 0, my, p->wide - 1, my);
    for (int sign = -1; sign <= 1; sign += 2) {
        const double step = sign * kx * s->a / (double)SHOT_SAMPLES;
        plot_pen above = pen_of(p, "10", INK_BOUND), under = above, u = pen_of(p, "1", INK_STICK);
        for (int i = 0; i < SHOT_SAMPLES; i++) {
            const double x0 = mx + step * i, x1 = x0 + step;
            plot_pen_line(&above, x0, my - ky * s->B[i], x1, my - ky * s->B[i + 1]);
            plot_pen_line(&under, x0, my + ky * s->B[i], x1, my + ky * s->B[i + 1]);
        }
        for (int i = 0; i < SHOT_SAMPLES; i++) {
            const double x0 = mx + step * i, x1 = x0 + step;
            u.ink = s->a * (i + 0.5) / (double)SHOT_SAMPLES > s->c ? INK_SLIP : INK_STICK;
            plot_pen_line(&u, x0, my - ky * s->u[i], x1, my - ky * s->u[i + 1]);
        }
    }
    put_scale(p, 0, "", p->most->bound, DIM_LENGTH);
    /* which springs slip, along the bottom */
    for (int col = 0; col < p->cells.cols; col++) {
        const double r = fabs((col + 0.5) * p->wide / p->cells.cols - mx) / kx;
        if (r <= s->a)
            put_label(p, col, below, r > s->c ? INK_SLIP : INK_STICK, r > s->c ? "~" : "=");
    }
    put_scale(p, below - 1, "", p->most->a, DIM_LENGTH);
}

static void draw_loop(const pane *p) {
    const shot *s = p->shot;
    const double mx = (p->wide - 1) / 2.0, my = (p->high - 1) / 2.0, kx = mx / p->most->dx,
                 ky = my / p->most->Fx;
    draw_dotted(p, INK_FRAME, 0, my, p->wide - 1, my);
    draw_dotted(p, INK_FRAME, mx, 0, mx, p->high - 1);
    draw_dotted(p, INK_BOUND, 0, my - ky * s->slip, p->wide - 1, my - ky * s->slip);
    draw_dotted(p, INK_BOUND, 0, my + ky * s->slip, p->wide - 1, my + ky * s->slip);
    plot_pen path = pen_of(p, "1", INK_CURVE);
    const track *t = playback_curve(&p->side->playback);
    for (size_t i = 0; i < t->count; i++) {
        const track_point *from = &t->point[i], *to = from + 1;
        const bool last = i + 1 == t->count; /* from there to the present point */
        plot_pen_line(&path, mx + kx * from->dx, my - ky * from->Fx, mx + kx * (last ? s->dx : to->dx),
                      my - ky * (last ? s->Fx : to->Fx));
    }
    put_label(p, (int)lround(mx + kx * s->dx) / p->cells.across, (int)lround(my - ky * s->Fx) / p->cells.up,
              INK_POINT, "O");
    put_scale(p, 0, "Fx ", p->most->Fx, DIM_FORCE);
    put_scale(p, p->cells.rows - 1, "dx ", p->most->dx, DIM_LENGTH);
}

static void draw_energies(const pane *p) {
    const track *t = playback_curve(&p->side->playback);
    const double begin = t->point[0].time, end = fmax(t->point[t->count - 1].time, begin + 1);
    const double kx = (p->wide - 1) / (end - begin), bottom = p->high - 1, ky = bottom / p->most->energy;
    plot_pen W = pen_of(p, "1", INK_SLIP), U = pen_of(p, "10", INK_OTHER);
    for (size_t i = 0; i + 1 < t->count; i++) {
        const track_point *from = &t->point[i], *to = from + 1;
        const double x0 = kx * (from->time - begin), x1 = kx * (to->time - begin);
        plot_pen_line(&W, x0, bottom - ky * from->W, x1, bottom - ky * to->W);
        plot_pen_line(&U, x0, bottom - ky * from->U, x1, bottom - ky * to->U);
    }
    put_scale(p, 0, "", p->most->energy, DIM_ENERGY);
}

/* The energy that friction dissipates in a cycle, per area, over r. */
static void draw_lost(const pane *p) {
    const side *s = p->side;
    char text[40] = "of a cycle at constant FN";
    const double step = (p->wide - 1) * s->now.a / p->most->a / (double)SHOT_SAMPLES, bottom = p->high - 1,
                 ky = bottom / p->most->lost;
    plot_pen lost = pen_of(p, "1", INK_SLIP);
    for (int i = 0; i < SHOT_SAMPLES && s->loses; i++)
        plot_pen_line(&lost, step * i, bottom - ky * s->lost[i], step * (i + 1),
                      bottom - ky * s->lost[i + 1]);
    if (s->loses)
        snprintf(text, sizeof text, "%.3g J/m^2", p->most->lost);
    put_label(p, 0, 0, INK_FRAME, text);
    put_scale(p, p->cells.rows - 1, "r ", p->most->a, DIM_LENGTH);
}

static void draw_numbers(const pane *p) {
    const shot *s = p->shot;
    const int columns = p->cells.cols < 30 ? 1 : 2, rows = (SHOT_VALUES + columns - 1) / columns,
              wide = (p->cells.cols - 1) / columns;
    for (int i = 0; i < SHOT_VALUES; i++) {
        char number[48] = "-";
        const int column = 1 + i / rows * wide;
        for (int digits = p->digits; s->known[i] && digits > 0; digits--) { /* as many as there is room for */
            char in[32];
            const long double scale = unit_choose(s->d[i], s->value[i], digits, in, sizeof in);
            if (snprintf(number, sizeof number, "%.*g %s", digits, (double)(s->value[i] / scale), in) <
                wide - 4)
                break;
        }
        put_label(p, column, i % rows, INK_CURVE, shot_names[i]);
        put_label(p, column + 4, i % rows, INK_NONE, number);
    }
}

/* ---- the table --------------------------------------------------------------------------------- */

typedef struct view {
    const char *title;
    void (*draw)(const pane *p);
    bool right;     /* in the right column; narrow screens have one column */
    int share;      /* weight when the height of the column is divided; 0: the view takes `rows` */
    int rows;       /* of the view, if it has no share */
    int worth_rows; /* rows of the screen that it takes to show the view */
} view;

static const view views[] = {
    {"contact", draw_disc, false, 5, 0, 0},
    {"springs: u1D(x) between +-B", draw_springs, true, 4, 0, 0},
    {"loop: Fx over dx", draw_loop, true, 6, 0, 0},
    {"energy: W, U (dotted)", draw_energies, false, 4, 0, 40},
    {"lost in a cycle: dWdA(r)", draw_lost, true, 3, 0, 40},
    {"", draw_numbers, false, 0, (SHOT_VALUES + 1) / 2, 0},
};
enum { VIEWS = sizeof views / sizeof *views };

/* Is the view shown in the left or right column, or, if narrow, in the only one? */
static bool is_shown(const view *v, rect all, bool narrow, bool right) {
    const int rows = v->worth_rows ? v->worth_rows : narrow && v->draw == draw_disc ? 30 : 0;
    return all.rows + 3 >= rows && (narrow || v->right == right);
}

/* Writes the title of a view and of its scene; if there is no room for it, only up to its colon. */
static void put_title(const char *of, const char *title, rect at) {
    char text[LIVE_TEXT + 80];
    const int n = snprintf(text, sizeof text, "-- %s%s%s", of, *of ? ": " : "", title);
    if ((int)text_columns(text, (size_t)n) > at.cols)
        text[(size_t)n - strlen(title) + strcspn(title, ":")] = 0;
    put_text(at, 0, INK_FRAME, "%s", text);
}

static void draw_view(live *l, const view *v, const side *s, const scales *sc, rect at) {
    pane p = {.side = s, .shot = l->playing ? &s->played : &s->now, .most = sc, .digits = *l->host->digits};
    if (p.shot->digits && p.shot->digits < p.digits)
        p.digits = p.shot->digits;
    if (!canvas_make(&p.cells, at))
        return;
    p.wide = at.cols * p.cells.across;
    p.high = at.rows * p.cells.up;
    v->draw(&p);
    canvas_show(&p.cells, at);
    if (v->draw == draw_loop && s == side_first(l)) {
        l->loop = at;
        l->loop_dx = sc->dx;
    }
}

/* Draws the views of a column; those with a share divide the rows that the others leave. */
static void draw_column(live *l, const side *s, const scales *sc, rect all, rect column, bool narrow,
                        bool right) {
    int shares = 0, room = column.rows;
    for (size_t i = 0; i < VIEWS; i++) {
        const view *v = &views[i];
        if (is_shown(v, all, narrow, right)) {
            shares += v->share;
            room -= v->rows;
        }
    }
    if (room < 0) /* the last rows of the last view do without */
        room = 0;
    rect at = column;
    for (size_t i = 0; i < VIEWS; i++) {
        const view *v = &views[i];
        if (!is_shown(v, all, narrow, right))
            continue;
        const int left = column.top + column.rows - at.top;
        at.rows = v->share ? room * v->share / shares : v->rows < left ? v->rows : left;
        shares -= v->share;
        room -= v->share ? at.rows : 0;
        if (*v->title)
            put_title(s->title, v->title, at);
        const int title = *v->title != 0;
        draw_view(l, v, s, sc, (rect){at.top + title, at.left, at.rows - title, at.cols});
        at.top += at.rows;
    }
}

static void draw_side(live *l, const side *s, const scales *sc, rect all) {
    const bool narrow = all.cols < 60;
    const int left = narrow ? all.cols : all.cols * 2 / 5 > 34 ? all.cols * 2 / 5 : 34;
    if (*s->trouble) {
        char text[2 * LIVE_TEXT + 4];
        snprintf(text, sizeof text, "%s%s%s", s->title, *s->title ? ": " : "", s->trouble);
        put_words(text, l->host->calc->scene.end.steps ? INK_ERROR : INK_FRAME,
                  (rect){all.top + 1, all.left, all.rows - 1, all.cols}, 0);
        return;
    }
    rect column = {all.top, all.left, all.rows, left - 1};
    draw_column(l, s, sc, all, column, narrow, false);
    if (!narrow)
        draw_column(l, s, sc, all, (rect){all.top, all.left + left, all.rows, all.cols - left}, narrow, true);
}

/* ---- lines around the views -------------------------------------------------------------------- */

/* Writes the inputs, the most important first, as many as fit; two dots if some are left out. */
static void put_inputs_line(const live *l, rect at) {
    static const input shown[] = {IN_K, IN_MU, IN_C0, IN_RADIUS, IN_SLOPE, IN_N};
    const scene *s = &l->host->calc->scene;
    char text[LIVE_LINE], one[60], amount_of[40];
    int n = snprintf(text, sizeof text, "%s", s->in.geometry ? s->in.geometry->name : "");
    for (size_t i = 0; i < sizeof shown / sizeof *shown; i++) {
        const quantity *q = quantity_of_input(shown[i]);
        if (!s->in.set[shown[i]] || (shown[i] == IN_C0 && s->in.v[IN_K] == 0))
            continue; /* c0 says nothing of a body without grading */
        live_amount(s->in.v[shown[i]], quantity_dim(q, s), amount_of, sizeof amount_of);
        const int more = snprintf(one, sizeof one, "  %s %s", q->name, amount_of);
        if (n + more > at.cols) {
            text_add(text, sizeof text, "%s", n + 3 <= at.cols ? " .." : "");
            break;
        }
        text_add(text, sizeof text, "%s", one);
        n += more;
    }
    put_text(at, 0, INK_NONE, "%s", text);
}

static void draw_head(const live *l, rect at) {
    char FA[40], FNA[40], swing[120] = "", right[200];
    live_amount(l->FA, DIM_FORCE, FA, sizeof FA);
    live_amount(l->FNA, DIM_FORCE, FNA, sizeof FNA);
    if (l->FNA > 0)
        snprintf(swing, sizeof swing, " FNA %s %g deg", FNA, l->phase);
    snprintf(right, sizeof right, "%scycle FA %s%s %g/s %s", l->playing ? "> " : "", FA, swing, l->speed,
             l->by_displacement ? "[dx dz]" : "[Fx FN]");
    int w = (int)strlen(right);
    w = w < at.cols ? w : at.cols;
    put_text((rect){at.top, at.cols - w, 1, w}, 0, INK_CURVE, "%s", right);
    put_inputs_line(l, (rect){at.top, at.left, 1, at.cols - w - 2});
}

enum { NOTE_ROWS = 4 };
#define STATUS_ROWS (LINES >= 16 ? LINES / 8 : 1)

static int note_rows(const live *l) {
    return *l->note && !l->page ? rows_of(l->note, NOTE_ROWS) : 1;
}

/* The status takes the rows that it needs, but one below a page and while a line is typed. */
static int status_rows(const live *l) {
    const int rows = l->page || l->typing ? 1 : rows_of(l->status, STATUS_ROWS);
    return rows > 1 ? rows : 1;
}

/* Writes the line being typed, scrolled so that the cursor is on the screen. */
static void put_line(const live *l, rect at, int row) {
    char before[LIVE_LINE], shown[4 * LIVE_LINE];
    const int prompt = (int)strlen(l->prompt), width = at.cols - prompt - 1;
    snprintf(before, sizeof before, "%.*s", (int)l->cursor, l->line);
    characters_shown(before, shown, sizeof shown);
    const int column = (int)text_columns(shown, strlen(shown)), skip = column > width ? column - width : 0;
    characters_shown(l->line, shown, sizeof shown);
    const char *from = shown;
    while ((int)text_columns(shown, (size_t)(from - shown)) < skip)
        from += character_at(from, strlen(from), NULL);
    put_text(at, row, INK_NONE, "%s%s", l->prompt, from);
    move(at.top + row, at.left + prompt + column - skip);
}

static void draw_foot(const live *l, rect at) {
    const int rows = status_rows(l), last = at.rows - rows;
    if (l->page)
        put_text(at, 0, INK_FRAME, "space: more of it  up: before  any other key: back");
    else if (*l->note)
        put_words(l->note, INK_CURVE, (rect){at.top, at.left, last, at.cols}, 0);
    else
        put_text(at, 0, INK_FRAME,
                 "q quit  ? keys  arrows push and press  space plays  u undo  r reset  : statement");
    if (l->typing)
        put_line(l, at, last);
    else
        put_words(l->status, l->bad ? INK_ERROR : INK_NONE, (rect){at.top + last, at.left, rows, at.cols}, 0);
    curs_set(l->typing);
}

bool status_holds(const char *text) {
    return rows_of(text, LINES) <= STATUS_ROWS;
}

int page_rows(const char *page) {
    return rows_of(page, INT_MAX);
}

/* Draws the page in place of the views, from the row it has been scrolled to. */
static void draw_page(const live *l, rect all) {
    const int rows = page_rows(l->page);
    put_words(l->page, INK_NONE, all, l->page_from < rows ? l->page_from : rows - 1);
}

static void draw_all(live *l) {
    const int foot = note_rows(l) + status_rows(l);
    rect all = {1, 0, LINES - 1 - foot, COLS};
    erase();
    l->loop = (rect){0, 0, 0, 0};
    if (LINES < 10 || COLS < 40) {
        put_text((rect){0, 0, LINES, COLS}, 0, INK_ERROR, "the screen is too small: 40 x 10");
        return;
    }
    draw_head(l, (rect){0, 0, 1, COLS});
    if (l->page) {
        draw_page(l, all);
    } else {
        const scales sc = scales_of(l);
        const int sides = (int)live_sides(l);
        for (int i = 0; i < sides; i++)
            draw_side(l, &l->side[i], &sc,
                      (rect){all.top, COLS * i / sides, all.rows, COLS / sides - (sides > 1 ? 1 : 0)});
    }
    draw_foot(l, (rect){LINES - foot, 0, foot, COLS});
}

void live_draw(live *l) {
    draw_all(l);
    terminal_show(l->torn);
    l->torn = false;
}
