/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Pages as scripts for gnuplot's terminal of plain characters, which draws frame, tics and texts, and puts a
 * character where curves are. */
#include <stdlib.h>

#include "plot/page.h"

/* Of inks. As the colours of pictures, on grounds both dark and light. */
static const char *const colors[] = {"",        "#0087ff", "#ff5f00", "#00af5f", "#d75faf",
                                     "#d7af00", "#5fd7ff", "#878787", "#a8a8a8"};

static void set_tics(FILE *to, char name, const page_ruler *r) {
    fprintf(to, "set %crange [%.12g:%.12g]\n", name, r->axis.flip ? r->axis.hi : r->axis.lo,
            r->axis.flip ? r->axis.lo : r->axis.hi);
    if (r->axis.log)
        fprintf(to, "set logscale %c\n", name);
    fprintf(to, "set %ctics (", name);
    for (int i = 0; i < r->count; i++)
        fprintf(to, "%s'%s' %.12g", i ? "," : "", r->text[i], r->at[i]);
    fputs(")\n", to);
}

/* gnuplot counts rows from below. */
static void set_label(FILE *to, const plot_page *g, const char *text, int column, int row) {
    fputs("set label ", to);
    plot_quote(to, text);
    fprintf(to, " at character %d,%d left", column, g->rows - 1 - row);
}

static void set_texts(FILE *to, const plot_page *g) {
    set_label(to, g, g->head, g->head_column, 0);
    fputs("\nset xlabel ", to);
    plot_quote(to, g->foot);
    fputs("\nunset key\n", to);
    for (size_t i = 0; i < g->entries && g->entry[i].row >= 0; i++) {
        const page_entry *e = &g->entry[i];
        set_label(to, g, e->sign, e->column, e->row);
        fprintf(to, " tc rgb '%s'\n", colors[e->ink]);
        set_label(to, g, e->text, e->text_column, e->row);
        putc('\n', to);
    }
    for (size_t i = 0; i < g->panel->words; i++) {
        int column, row;
        page_word(g, i, &column, &row);
        set_label(to, g, g->panel->word[i].text, column, row);
        fputs(" front\n", to);
    }
}

/* The cells of a layer that nothing covers. */
static void write_layer(FILE *to, const plot_page *g, const plot_cells *frame, size_t layer) {
    fprintf(to, "$layer%zu << END\n", layer);
    for (int r = 0; r < frame->rows; r++)
        for (int c = 0; c < frame->cols; c++)
            if (frame->cell[r * frame->stride + c].ink == layer + 1)
                fprintf(to, "%.12g %.12g\n", page_value(&g->x, c), page_value(&g->y, g->y.cells - r));
    fputs("END\n", to);
}

static bool draw(FILE *to, const plot_page *g) {
    plot_cells frame;
    if (!plot_cells_make(&frame, g->x.cells + 1, g->y.cells + 1, 1, 1))
        return false;
    const bool ok = page_trace(g, &frame, true);
    for (size_t i = 0; ok && i < page_layers(g); i++)
        write_layer(to, g, &frame, i);
    free(frame.cell);
    fputs("plot NaN notitle", to);
    for (size_t i = 0; i < page_layers(g); i++) {
        char sign[PAGE_SIGN];
        unsigned char ink;
        page_layer(g, i, sign, &ink);
        fprintf(to, ", \\\n  $layer%zu with points pt '%s' lc rgb '%s'", i, sign, colors[ink]);
    }
    putc('\n', to);
    return ok;
}

/* False: out of memory. */
static bool write_page(FILE *to, const plot_page *g, bool color) {
    fputs("reset\nset encoding utf8\nset border back\nset tics back\n", to);
    fprintf(to,
            "set terminal dumb size %d,%d noenhanced %s\nset lmargin %d\nset rmargin %d\nset tmargin %d\nset "
            "bmargin %d\n",
            g->columns, g->rows, color ? "ansi256" : "mono", g->left, g->columns - 1 - g->left - g->x.cells,
            g->top, g->bottom);
    set_tics(to, 'x', &g->x);
    set_tics(to, 'y', &g->y);
    set_texts(to, g);
    return draw(to, g);
}

bool plot_write_pages(FILE *to, const plot_reel *reel, const plot_target *target, const plot_pages *pages,
                      calc_error *error) {
    for (size_t n = 0; n < reel->count; n++) {
        if (plot_stopped(target))
            return calc_interrupted(error);
        for (size_t i = 0; i < reel->frame[n].count; i++) {
            plot_page g;
            if (!page_make(&g, reel->frame[n].panel[i], &reel->extent[i], target, pages, error))
                return false;
            const bool ok = write_page(to, &g, target->color);
            page_free(&g);
            if (!ok)
                return calc_no_memory(error);
        }
    }
    return true;
}
