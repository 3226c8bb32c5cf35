/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Draws pages on cells, panels side by side, and prints them with colours. Depends on page.h. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "plot/page.h"
#include "text/characters.h"

/* ---- drawing ------------------------------------------------------------------------------------ */

static void draw_y_tics(const plot_page *g, const plot_cells *page) {
    const int right = g->left + g->x.cells;
    for (int i = 0; i < g->y.count; i++) {
        const int row = g->top + g->y.cells - (int)lround(page_cell(&g->y, g->y.at[i]));
        plot_cells_text(page, g->left - 1 - (int)strlen(g->y.text[i]), row, g->y.text[i], 0);
        plot_cells_text(page, g->left + 1, row, "-+", 0);
        plot_cells_text(page, right - 2, row, "+-", 0);
    }
}

static void draw_x_tics(const plot_page *g, const plot_cells *page) {
    const int bottom = g->top + g->y.cells;
    for (int i = 0; i < g->x.count; i++) {
        const int column = g->left + (int)lround(page_cell(&g->x, g->x.at[i]));
        plot_cells_text(page, column - (int)strlen(g->x.text[i]) / 2, bottom + 1, g->x.text[i], 0);
        plot_cells_sign(page, column, g->top + 1, "+", 0);
        plot_cells_sign(page, column, bottom - 1, "+", 0);
    }
}

static void draw_border(const plot_page *g, const plot_cells *page) {
    const int right = g->left + g->x.cells, bottom = g->top + g->y.cells;
    for (int row = g->top; row <= bottom; row++)
        for (int column = g->left; column <= right; column++) {
            const bool side = column == g->left || column == right, end = row == g->top || row == bottom;
            if (side || end)
                plot_cells_sign(page, column, row, side && end ? "+" : side ? "|" : "-", 0);
        }
}

static void draw_texts(const plot_page *g, const plot_cells *page) {
    const int wide = (int)text_columns(g->foot, strlen(g->foot));
    plot_cells_text(page, g->head_column, 0, g->head, 0);
    plot_cells_text(page, g->left + g->x.cells / 2 - wide / 2, g->top + g->y.cells + 2, g->foot, 0);
    for (size_t i = 0; i < g->entries; i++) {
        const page_entry *e = &g->entry[i];
        plot_cells_text(page, e->column, e->row, e->sign, e->ink);
        plot_cells_text(page, e->text_column, e->row, e->text, 0);
    }
}

/* False: out of memory. */
static bool draw_page(const plot_page *g, const plot_cells *page) {
    const plot_cells frame = plot_cells_part(page, g->left, g->top, g->x.cells + 1, g->y.cells + 1);
    draw_y_tics(g, page);
    draw_x_tics(g, page);
    draw_border(g, page);
    draw_texts(g, page);
    const bool ok = page_trace(g, &frame);
    for (size_t i = 0; i < g->panel->words; i++) {
        int column, row;
        page_word(g, i, &column, &row);
        plot_cells_text(page, column, row, g->panel->word[i].text, 0);
    }
    return ok;
}

/* ---- printing ----------------------------------------------------------------------------------- */

/* Sets the colour of an ink from the palette of 256: like in pictures, for dark and light backgrounds. */
static void print_ink(FILE *out, unsigned char ink) {
    static const unsigned char palette[] = {0, 33, 202, 35, 169, 178, 81, 102, 248};
    if (ink)
        fprintf(out, "\033[38;5;%dm", palette[ink]);
    else
        fputs("\033[39m", out);
}

static void print_row(FILE *out, const plot_cells *sheet, int row, bool color, const char *end) {
    int blanks = 0; /* printed only if something follows them */
    unsigned char holds = 0;
    char text[CELL_TEXT];
    for (int column = 0; column < sheet->cols; column++) {
        const unsigned char ink = plot_cells_show(sheet, column, row, text);
        if (!*text || !strcmp(text, " ")) {
            blanks++;
            continue;
        }
        fprintf(out, "%*s", blanks, "");
        blanks = 0;
        if (color && ink != holds)
            print_ink(out, holds = ink);
        fputs(text, out);
        column += text_columns(text, strlen(text)) > 1;
    }
    if (holds)
        print_ink(out, 0);
    fputs(end, out);
}

/* ---- frames ------------------------------------------------------------------------------------- */

/* Draws `count` panels from `first` on; returns the rows used, 0 with the error. */
static int draw_panels(const plot_cells *sheet, const plot_reel *reel, size_t n, size_t first, size_t count,
                       const plot_target *target, const plot_pages *pages, calc_error *error) {
    plot_page g;
    int rows = 0;
    for (size_t i = 0; i < count; i++) {
        const plot_cells page =
            plot_cells_part(sheet, (int)i * pages->columns, 0, pages->columns, pages->rows);
        if (!page_make(&g, reel->frame[n].panel[first + i], &reel->extent[first + i], target, pages, error))
            return 0;
        const bool drawn = draw_page(&g, &page);
        rows = g.rows > rows ? g.rows : rows;
        page_free(&g);
        if (!drawn) {
            calc_no_memory(error);
            return 0;
        }
    }
    return rows;
}

size_t plot_print_frame(const plot_reel *reel, size_t n, const plot_target *target, const plot_pages *pages,
                        const char *end, calc_error *error) {
    const size_t panels = reel->frame[n].count, abreast = pages->beside ? panels : 1;
    size_t lines = 0;
    for (size_t i = 0; i < panels; i += abreast) {
        plot_cells sheet;
        if (!plot_cells_make(&sheet, (int)abreast * pages->columns, pages->rows, 2, 4)) {
            calc_no_memory(error);
            return 0;
        }
        sheet.faint = PAGE_GRAY;
        const int rows = draw_panels(&sheet, reel, n, i, abreast, target, pages, error);
        for (int row = 0; row < rows; row++)
            print_row(target->out, &sheet, row, target->color, end);
        free(sheet.cell);
        if (!rows)
            return 0;
        lines += (size_t)rows;
    }
    return lines;
}
