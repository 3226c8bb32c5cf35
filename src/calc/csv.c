/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reading tables, line by line. */
#include "calc/csv.h"

#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "calc/unit_text.h"

void csv_free(csv *c) {
    free(c->column[0]);
    free(c->column[1]);
    *c = (csv){0};
}

static bool is_break(char ch) {
    return ch == ',' || ch == ';' || ch == '\t' || ch == ' ' || ch == '\r' || ch == '\n';
}

/* `r [mm]`, `r (mm)`, `r/mm` and plain `k`. */
static bool read_header(char *line, csv *c, long double scale[2], const char *path, size_t number,
                        calc_error *error) {
    char *p = line;
    for (int i = 0; i < 2; i++) {
        p += strspn(p, " \t,;\"");
        size_t n = strcspn(p, " \t,;[(/\r\n\"");
        if (!n || n >= CSV_NAME)
            return calc_fail(
                error, 0, 0,
                "%s:%zu: the header must name two columns with their units, such as r [mm],f [um]", path,
                number);
        memcpy(c->name[i], p, n);
        c->name[i][n] = 0;
        p += n;
        p += strspn(p, " \t");
        c->d[i] = DIM_NONE;
        scale[i] = 1;
        if (*p == '[' || *p == '(' || *p == '/') {
            char *begin = p + 1;
            size_t len = strcspn(begin, *p == '[' ? "]" : *p == '(' ? ")" : " \t,;\r\n\"");
            unit u;
            lexer lx;
            calc_error mine = {0};
            lex_start(&lx, begin, len, &mine);
            if (mine.raised || !unit_parse(&lx, &u) || lx.kind != T_END)
                return calc_fail(error, 0, 0, "%s:%zu: %s in the header", path, number,
                                 mine.raised ? mine.text : "a bad unit");
            c->d[i] = u.d;
            scale[i] = unit_scale(&u);
            p = begin + len;
            if (*p == ']' || *p == ')')
                p++;
        }
    }
    p += strspn(p, " \t\r\n,;\"");
    return !*p || calc_fail(error, 0, 0, "%s:%zu: more than two columns", path, number);
}

static bool add_row(csv *c, size_t *room, const double row[2]) {
    if (c->count == *room) {
        size_t more = *room ? 2 * *room : 256;
        for (int i = 0; i < 2; i++) {
            double *grown = realloc(c->column[i], more * sizeof *grown);
            if (!grown)
                return false;
            c->column[i] = grown;
        }
        *room = more;
    }
    c->column[0][c->count] = row[0];
    c->column[1][c->count++] = row[1];
    return true;
}

bool csv_read(const char *path, csv *c, calc_error *error) {
    *c = (csv){0};
    FILE *in = fopen(path, "r");
    if (!in)
        return calc_fail(error, 0, 0, "cannot read %s: %s", path, strerror(errno));
    char *line = NULL;
    size_t size = 0, room = 0, number = 0;
    long double scale[2] = {1, 1};
    bool header = false, ok = true;
    while (ok && getline(&line, &size, in) >= 0) {
        char *p = line + strspn(line, " \t\r\n");
        number++;
        if (!*p || *p == '#')
            continue;
        if (!header) {
            header = true;
            ok = read_header(p, c, scale, path, number, error);
            continue;
        }
        double row[2] = {0, 0};
        for (int i = 0; i < 2 && ok; i++) {
            char *end;
            while (is_break(*p))
                p++;
            double v = strtod(p, &end);
            /* strtod knows nan, inf and hexadecimal; a table of lengths and forces does not */
            ok = end > p && (is_break(*end) || !*end) && isfinite(v) &&
                 strcspn(p, "xXnN") >= (size_t)(end - p);
            row[i] = (double)(v * scale[i]);
            p = end;
        }
        p += strspn(p, " \t\r\n,;");
        if (!ok || *p)
            ok = calc_fail(error, 0, 0, "%s:%zu: expected two numbers", path, number);
        else if (!add_row(c, &room, row))
            ok = calc_fail(error, 0, 0, "out of memory");
    }
    if (ok && ferror(in))
        ok = calc_fail(error, 0, 0, "cannot read %s: %s", path, strerror(errno));
    if (ok && c->count == 0)
        ok = calc_fail(error, 0, 0, "%s holds no rows of numbers", path);
    free(line);
    fclose(in);
    if (!ok)
        csv_free(c);
    return ok;
}
