/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pages as scripts for gnuplot's `dumb` terminal of plain characters. Depends on page.h. */
#include <stdlib.h>

#include "plot/page.h"

/* RGB of each ink: like the colours of pictures, and visible on dark and light backgrounds. */
static const int colors[] = {0,        0x0087ff, 0xff5f00, 0x00af5f, 0xd75faf,
                             0xd7af00, 0x5fd7ff, 0x878787, 0xa8a8a8};

static void set_tics(FILE *to, char name, const page_ruler *r) {
    fprintf(to, "set %crange [%.12g:%.12g]\n", name, r->axis.flip ? r->axis.hi : r->axis.lo,
            r->axis.flip ? r->axis.lo : r->axis.hi);
    if (r->axis.log)
        fprintf(to, "set logscale %c\n", name);
    fprintf(to, "set %ctics (", name);
    for (int i = 0; i < r->count; i++)
        fprintf(to, "%s'%s' %.12g", i ? "," : "", r->text[i], r->at[i] * (i || !r->axis.log ? 1 : PLOT_HAIR));
    fputs(")\n", to);
}

/* Pages side by side, which are one page of gnuplot. */
typedef struct sheet {
    FILE *to;
    int columns, rows, from; /* from: column where the present page begins */
} sheet;

/* gnuplot counts rows from below. */
static void set_label(const sheet *s, const char *text, int column, int row) {
    fputs("set label ", s->to);
    plot_quote(s->to, text);
    fprintf(s->to, " at character %d,%d left", s->from + column, s->rows - 1 - row);
}

static void set_texts(const sheet *s, const plot_page *g) {
    FILE *to = s->to;
    set_label(s, g->head, g->head_column, 0);
    fputs("\nset xlabel ", to);
    plot_quote(to, g->foot);
    fputs("\nunset key\n", to);
    for (size_t i = 0; i < g->entries && g->entry[i].row >= 0; i++) {
        const page_entry *e = &g->entry[i];
        set_label(s, e->sign, e->column, e->row);
        fprintf(to, " tc rgb %d\n", colors[e->ink]);
        set_label(s, e->text, e->text_column, e->row);
        putc('\n', to);
    }
    for (size_t i = 0; i < g->panel->words; i++) {
        int column, row;
        page_word(g, i, &column, &row);
        set_label(s, g->panel->word[i].text, column, row);
        fputs(" front\n", to);
    }
}

/* Writes the curves as labels of one character at each cell that they touch. False: out of memory. */
static bool draw(FILE *to, const plot_page *g) {
    plot_cells frame;
    if (!plot_cells_make(&frame, g->x.cells + 1, g->y.cells + 1, 1, 1))
        return false;
    const bool ok = page_trace(g, &frame);
    fputs("$cells << END\n", to);
    for (int r = 0; r < frame.rows; r++)
        for (int c = 0; c < frame.cols; c++) {
            const plot_cell *cell = &frame.cell[r * frame.stride + c];
            if (*cell->sign)
                fprintf(to, "%.12g %.12g %d %d\n", page_value(&g->x, c), page_value(&g->y, g->y.cells - r),
                        *cell->sign, colors[cell->ink]);
        }
    fputs(
        "END\nplot NaN notitle, $cells using 1:2:(sprintf('%c', $3)):4 with labels tc rgb variable notitle\n",
        to);
    free(frame.cell);
    return ok;
}

static bool write_page(const sheet *s, const plot_page *g) {
    const int left = s->from + g->left;
    fprintf(s->to,
            "reset\nset encoding utf8\nset border back\nset tics back\nset lmargin %d\nset rmargin %d\n"
            "set tmargin %d\nset bmargin %d\n",
            left, s->columns - 1 - left - g->x.cells, g->top, s->rows - g->rows + g->bottom);
    set_tics(s->to, 'x', &g->x);
    set_tics(s->to, 'y', &g->y);
    set_texts(s, g);
    return draw(s->to, g);
}

/* Writes the panels side by side, or if pages->beside is false the one panel `first`. */
static bool write_sheet(FILE *to, const plot_reel *reel, size_t n, size_t first, const plot_target *target,
                        const plot_pages *pages, calc_error *error) {
    plot_page page[PLOT_PANELS];
    size_t count = pages->beside ? reel->frame[n].count : 1, made = 0;
    sheet s = {to, (int)count * pages->columns, 0, 0};
    while (made < count && page_make(&page[made], reel->frame[n].panel[first + made],
                                     &reel->extent[first + made], target, pages, error)) {
        s.rows = page[made].rows > s.rows ? page[made].rows : s.rows;
        made++;
    }
    fprintf(to, "set terminal dumb size %d,%d noenhanced %s\nset multiplot\n", s.columns, s.rows,
            target->color ? "ansi256" : "mono");
    bool ok = made == count;
    for (size_t i = 0; i < made; i++, s.from += pages->columns) {
        ok = ok && (write_page(&s, &page[i]) || calc_no_memory(error));
        page_free(&page[i]);
    }
    fputs("unset multiplot\n", to);
    return ok;
}

bool plot_write_pages(FILE *to, const plot_reel *reel, const plot_target *target, const plot_pages *pages,
                      calc_error *error) {
    for (size_t n = 0; n < reel->count; n++) {
        if (plot_stopped(target))
            return calc_interrupted(error);
        for (size_t i = 0; i < (pages->beside ? 1 : reel->frame[n].count); i++)
            if (!write_sheet(to, reel, n, i, target, pages, error))
                return false;
    }
    return true;
}
