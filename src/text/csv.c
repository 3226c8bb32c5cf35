/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reading tables. A field is a piece of a line; a number is what the language takes for one, or the same with
 * a decimal comma. */
#include "text/csv.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "text/unit_text.h"

enum { POINT, COMMA, MARKS };
static const char marks[MARKS] = {'.', ','};
enum { THOUSANDS = sizeof "-123.456" };

typedef struct reader {
    csv *c;
    calc_error *error;
    char separator; /* ' ': blanks and tabs */
    bool header;    /* has been read */
    size_t line;
    size_t marked[MARKS]; /* the first line with such a number; 0: none */
    unit unit[CSV_COLUMNS];
    /* the first number of each column whose mark may part thousands instead */
    struct {
        size_t line; /* 0: none */
        char text[THOUSANDS];
    } thousands[CSV_COLUMNS][MARKS];
} reader;

void csv_free(csv *c) {
    for (size_t i = 0; i < c->columns; i++) {
        free(c->column[i].v);
        free(c->column[i].trouble);
    }
    free(c->line);
    free(c->path);
    *c = (csv){.path = NULL};
}

static bool fail(const reader *r, const char *what) {
    return calc_fail(r->error, 0, 0, "%s:%zu: %s", r->c->path, r->line, what);
}

/* ---- fields ------------------------------------------------------------------------------------ */

typedef struct field {
    const char *text;
    size_t len;
} field;

static bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r';
}

static field trimmed(const char *text, size_t len) {
    while (len > 0 && is_blank(text[len - 1]))
        len--;
    while (len > 0 && is_blank(*text))
        text++, len--;
    return (field){text, len};
}

static bool parts(char separator, char c) {
    return separator == ' ' ? is_blank(c) : c == separator;
}

/* The field at *at and the place of the next; false: there is none. Quotation marks and brackets hold
 * separators. */
static bool next_field(char separator, const char *line, size_t len, size_t *at, field *out) {
    size_t i = *at;
    while (separator == ' ' && i < len && is_blank(line[i]))
        i++;
    if (i >= len + (separator != ' '))
        return false;
    const size_t begin = i;
    bool quoted = false;
    int depth = 0;
    for (; i < len; i++) {
        const char c = line[i];
        if (!quoted && depth == 0 && parts(separator, c))
            break;
        quoted = c == '"' ? !quoted : quoted;
        depth += quoted ? 0 : c == '[' || c == '(' ? 1 : (c == ']' || c == ')') && depth > 0 ? -1 : 0;
    }
    *out = trimmed(line + begin, i - begin);
    *at = i + 1;
    if (out->len >= 2 && *out->text == '"' && out->text[out->len - 1] == '"')
        *out = trimmed(out->text + 1, out->len - 2);
    return true;
}

/* ---- the header -------------------------------------------------------------------------------- */

/* What is wrong with a column, once. */
#if defined(__GNUC__)
__attribute__((format(printf, 3, 4)))
#endif
static bool
trouble(const reader *r, csv_values *column, const char *format, ...) {
    char text[CALC_ERROR_TEXT];
    va_list args;
    if (column->trouble)
        return true;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    column->trouble = malloc(strlen(text) + 1);
    if (!column->trouble)
        return calc_no_memory(r->error);
    strcpy(column->trouble, text);
    return true;
}

static bool read_unit(reader *r, csv_values *column, unit *u, const char *text, size_t len) {
    lexer lx;
    calc_error wrong;
    error_clear(&wrong);
    lex_start(&lx, text, len, &wrong);
    if (lx.kind == T_END && !wrong.raised) /* of `k []` or `k [-]`: a plain number */
        return true;
    if (len == 1 && *text == '-')
        return true;
    if (wrong.raised || !unit_of_header(&lx, u))
        return trouble(r, column, "%.200s:%zu: column %s: %.200s%.*s%s", r->c->path, r->line, column->name,
                       wrong.raised ? wrong.text : "a bad unit '", wrong.raised ? 0 : LEX_SHOWN(len), text,
                       wrong.raised ? "" : "'");
    column->d = u->d;
    column->has_unit = true;
    return true;
}

static char closing_of(char c) {
    return c == '[' ? ']' : c == '(' ? ')' : 0;
}

/* Where the unit of a title begins: at its bracket; of `p(r) [MPa]`, as tables are written, at the last. */
static size_t unit_place(field f) {
    size_t n = 0;
    for (size_t last = f.len; last > 1 && f.text[f.len - 1] == ']'; last--)
        if (f.text[last - 1] == '[')
            return last - 1;
    while (n < f.len && !strchr("[(/", f.text[n]))
        n++;
    return n;
}

static bool read_title(reader *r, field f) {
    csv *c = r->c;
    if (c->columns == CSV_COLUMNS)
        return calc_fail(r->error, 0, 0, "%s:%zu: more than %d columns", c->path, r->line, CSV_COLUMNS);
    csv_values *column = &c->column[c->columns];
    unit *u = &r->unit[c->columns++];
    *column = (csv_values){.d = DIM_NONE};
    *u = (unit){DIM_NONE, 0, 1};
    const size_t n = unit_place(f);
    const field name = trimmed(f.text, n);
    snprintf(column->name, sizeof column->name, "%.*s", (int)(name.len < CSV_NAME ? name.len : CSV_NAME - 1),
             name.text);
    for (csv_values *other = c->column; *column->name && other < column; other++)
        if (!strcmp(other->name, column->name))
            other->twice = column->twice = true;
    if (n == f.len)
        return true;
    const char closing = closing_of(f.text[n]);
    const char *end = closing ? memchr(f.text + n, closing, f.len - n) : f.text + f.len;
    if (!end)
        return fail(r, "a unit in the header is not closed");
    return read_unit(r, column, u, f.text + n + 1, (size_t)(end - f.text) - n - 1);
}

static char separator_of(const char *line, size_t len) {
    static const char kinds[] = ";\t,";
    for (const char *kind = kinds; *kind; kind++)
        if (memchr(line, *kind, len))
            return *kind;
    return ' ';
}

/* `r [mm] f [um]` parts names from their units too. */
static size_t unit_behind(const char *line, size_t len, size_t at, field *f) {
    size_t next = at;
    while (next < len && is_blank(line[next]))
        next++;
    const char closing = next < len ? closing_of(line[next]) : 0;
    const char *end = closing ? memchr(line + next, closing, len - next) : NULL;
    if (!end)
        return at;
    f->len = (size_t)(end + 1 - f->text);
    return (size_t)(end + 1 - line);
}

static bool read_header(reader *r, const char *line, size_t len) {
    size_t at = 0;
    field f;
    if (len > 4 && !memcmp(line, "sep=", 4)) /* by which spreadsheets tell themselves the separator */
        return true;
    r->header = true;
    r->separator = separator_of(line, len);
    while (next_field(r->separator, line, len, &at, &f)) {
        if (r->separator == ' ')
            at = unit_behind(line, len, at, &f);
        if (!read_title(r, f))
            return false;
    }
    while (r->c->columns > 0 && !*r->c->column[r->c->columns - 1].name) /* separators at the end */
        free(r->c->column[--r->c->columns].trouble);
    const char *first = r->c->column[0].name;
    return (r->c->columns > 0 && *first && !strchr("0123456789.+-", *first)) ||
           fail(r, "the header must name the columns with their units, such as r [mm],f [um]");
}

/* ---- rows -------------------------------------------------------------------------------------- */

/* The length of the number at the beginning of a text, which is not empty; 0: there is none. */
static size_t take_number(const char *text, size_t len, char point, const unit *u, double *out) {
    const bool minus = *text == '-', sign = minus || *text == '+', decimal = u->factor == 1;
    double v;
    const size_t n = lex_decimal(text + sign, len - sign, point, decimal ? u->exp10 : 0, &v);
    if (n == 0)
        return 0;
    v = decimal ? v : (double)((long double)v * unit_scale(u));
    *out = minus ? -v : v;
    return isfinite(v) ? n + sign : 0;
}

/* Does the mark stand where one of thousands would: `1.500`, `-12,345`, not `0.500`? */
static bool like_thousands(field f, char mark) {
    const size_t sign = *f.text == '-' || *f.text == '+';
    if (f.len < sign + 5 || f.len >= THOUSANDS || f.text[sign] == '0' || f.text[f.len - 4] != mark)
        return false;
    for (size_t i = sign; i < f.len; i++)
        if (i != f.len - 4 && (f.text[i] < '0' || f.text[i] > '9'))
            return false;
    return true;
}

/* What a number says of the marks in this file. */
static void see_marks(reader *r, size_t column, field f) {
    for (int m = 0; m < MARKS; m++) {
        if (!memchr(f.text, marks[m], f.len))
            continue;
        if (!r->marked[m])
            r->marked[m] = r->line;
        if (!r->thousands[column][m].line && like_thousands(f, marks[m])) {
            r->thousands[column][m].line = r->line;
            memcpy(r->thousands[column][m].text, f.text, f.len);
        }
    }
}

/* One mark parts thousands where the other begins decimals, and who wrote the file knows which: a number that
 * may be meant either way is not guessed at. */
static bool judge_marks(reader *r) {
    for (size_t i = 0; i < r->c->columns; i++)
        for (int m = 0; m < MARKS; m++) {
            const char *text = r->thousands[i][m].text;
            const size_t other = r->marked[m == POINT ? COMMA : POINT];
            char whole[THOUSANDS] = "";
            if (!r->thousands[i][m].line || !other)
                continue;
            const size_t before = strlen(text) - 4;
            memcpy(whole, text, before);
            memcpy(whole + before, text + before + 1, 3);
            if (!trouble(r, &r->c->column[i],
                         "%.200s:%zu: %s = %s may be %.6g or %s, since line %zu has a decimal %s: write it "
                         "without its %s, or with a %s",
                         r->c->path, r->thousands[i][m].line, r->c->column[i].name, text, atof(whole) / 1000,
                         whole, other, m == POINT ? "comma" : "point", m == POINT ? "point" : "comma",
                         m == POINT ? "comma" : "point"))
                return false;
        }
    return true;
}

/* All of a field, with a point or, where it cannot be a separator, with a comma. */
static bool read_number(reader *r, size_t column, field f, bool comma, double *out) {
    const char point = comma && !memchr(f.text, '.', f.len) ? ',' : '.';
    if (!f.len || take_number(f.text, f.len, point, &r->unit[column], out) != f.len)
        return false;
    see_marks(r, column, f);
    return true;
}

/* A number with a comment behind it. */
static bool read_commented(reader *r, size_t column, field f, bool comma, double *out) {
    const char *hash = memchr(f.text, '#', f.len);
    return hash && read_number(r, column, trimmed(f.text, (size_t)(hash - f.text)), comma, out);
}

/* A field that is a number and nothing else, as most are; else *at stays. */
static bool take_field(reader *r, size_t column, char separator, const char *line, size_t len, size_t *at,
                       double *out) {
    const size_t n = *at < len ? take_number(line + *at, len - *at, '.', &r->unit[column], out) : 0,
                 end = *at + n;
    if (n == 0 || (end < len && !parts(separator, line[end])))
        return false;
    see_marks(r, column, (field){line + *at, n});
    *at = end + 1;
    return true;
}

static bool make_room(csv *c) {
    const size_t room = c->room ? 2 * c->room : 256;
    if (c->rows < c->room)
        return true;
    size_t *line = realloc(c->line, room * sizeof *line);
    if (!line)
        return false;
    c->line = line;
    for (size_t i = 0; i < c->columns; i++) {
        double *grown = realloc(c->column[i].v, room * sizeof *grown);
        if (!grown)
            return false;
        c->column[i].v = grown;
    }
    c->room = room;
    return true;
}

static bool read_row(reader *r, const char *line, size_t len) {
    csv *c = r->c;
    char separator = r->separator;
    size_t at = 0, i = 0, blank = 0;
    field f;
    while (blank < len && (is_blank(line[blank]) || line[blank] == r->separator))
        blank++;
    if (blank == len) /* spreadsheets write empty rows as separators */
        return true;
    if (c->columns > 1 && !memchr(line, r->separator, len))
        separator = ' '; /* a header with commas over rows with blanks */
    if (!make_room(c))
        return calc_no_memory(r->error);
    for (;; i++) {
        if (i < c->columns && take_field(r, i, separator, line, len, &at, &c->column[i].v[c->rows]))
            continue;
        if (!next_field(separator, line, len, &at, &f))
            break;
        if (i >= c->columns && f.len > 0 && *f.text == '#')
            break;
        if (i >= c->columns && f.len > 0)
            return calc_fail(r->error, 0, 0, "%s:%zu: more than %zu fields, one for each name of the header",
                             c->path, r->line, c->columns);
        if (i >= c->columns)
            continue;
        const bool comma = separator != ',' || (f.text > line && f.text[-1] == '"');
        double *v = &c->column[i].v[c->rows];
        if (i + 1 == c->columns && read_commented(r, i, f, comma, v)) {
            i++;
            break;
        }
        if (!read_number(r, i, f, comma, v)) {
            *v = NAN;
            if (!trouble(r, &c->column[i], "%.200s:%zu: expected a number as %s, not '%.*s'", c->path,
                         r->line, c->column[i].name, LEX_SHOWN(f.len), f.text))
                return false;
        }
    }
    for (; i < c->columns; i++) {
        c->column[i].v[c->rows] = NAN;
        if (!trouble(r, &c->column[i], "%.200s:%zu: expected a number as %s, and the line ends", c->path,
                     r->line, c->column[i].name))
            return false;
    }
    c->line[c->rows++] = r->line;
    return true;
}

/* ---- the file ---------------------------------------------------------------------------------- */

/* The micro sign of Latin-1 is no UTF-8: it stands alone there. The new text is to be freed. */
static char *micro_signs(const char *line, size_t *len) {
    char *text = malloc(2 * *len + 1);
    size_t n = 0;
    for (size_t i = 0; text && i < *len; i++) {
        const bool alone = (unsigned char)line[i] == 0xb5 && (i == 0 || (unsigned char)line[i - 1] < 0x80);
        if (alone)
            text[n++] = '\xc2';
        text[n++] = line[i];
    }
    if (text)
        text[n] = 0;
    *len = n;
    return text;
}

static bool read_line(reader *r, const char *line, size_t len) {
    if (memchr(line, 0, len))
        return fail(r, "this is no text, or UTF-16 without its mark: save it as UTF-8");
    const field whole = trimmed(line, len);
    if (whole.len == 0 || *whole.text == '#')
        return true;
    if (r->header)
        return read_row(r, line, len);
    char *text = micro_signs(line, &len);
    bool ok = text ? read_header(r, text, len) : calc_no_memory(r->error);
    free(text);
    return ok;
}

bool csv_read(const char *path, file_stop stop, csv *c, calc_error *error) {
    file_in in;
    *c = (csv){.path = malloc(strlen(path) + 1)};
    if (!c->path)
        return calc_no_memory(error);
    strcpy(c->path, path);
    if (!file_in_open(&in, path, stop, error))
        return false;
    reader r = {.c = c, .error = error};
    bool ok = true;
    file_got got = FILE_GOT_END;
    while (ok && (got = file_in_line(&in, error)) == FILE_GOT_LINE) {
        r.line = (size_t)in.number;
        ok = read_line(&r, in.line, in.length);
    }
    file_in_close(&in);
    if (ok && got == FILE_GOT_STOP)
        ok = calc_interrupted(error);
    return ok && judge_marks(&r) && got != FILE_GOT_ERROR &&
           (c->rows > 0 || calc_fail(error, 0, 0, "%s holds no rows of numbers", path));
}

/* ---- columns ----------------------------------------------------------------------------------- */

static const csv_values *find(const csv *c, const char *name) {
    for (size_t i = 0; i < c->columns; i++)
        if (!strcmp(c->column[i].name, name))
            return &c->column[i];
    return NULL;
}

bool csv_has(const csv *c, const char *name) {
    return find(c, name) != NULL;
}

void csv_names(const csv *c, char *buf, size_t size) {
    size_t n = 0;
    *buf = 0;
    for (size_t i = 0; i < c->columns && n < size; i++)
        n += (size_t)snprintf(buf + n, size - n, "%s%s", i ? ", " : "", c->column[i].name);
}

const csv_values *csv_column(const csv *c, const char *name, calc_error *error) {
    char names[CALC_ERROR_TEXT / 2];
    const csv_values *column = find(c, name);
    csv_names(c, names, sizeof names);
    if (!column)
        calc_fail(error, 0, 0, "%.200s has no column %s: its columns are %s, by its first line", c->path,
                  name, names);
    else if (column->twice)
        calc_fail(error, 0, 0, "%.200s has two columns %s: rename one", c->path, name);
    else if (column->trouble)
        calc_fail(error, 0, 0, "%s", column->trouble);
    return column && !column->twice && !column->trouble ? column : NULL;
}
