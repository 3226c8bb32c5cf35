/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Reading tables: decodes the file, finds the table and its header, and converts the fields of a column to
 * numbers on request. Depends on this room. */
#include "text/csv.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "text/characters.h"
#include "text/encoding.h"
#include "text/field.h"
#include "text/unit.h"

static const unit plain_unit = {{0, 0, 0, 0}, 0, 1};
static const char separators[] = ";\t, "; /* ' ': blanks and tabs */

void csv_free(csv *c) {
    for (size_t i = 0; i < c->columns; i++) {
        free(c->column[i].v);
        free(c->column[i].trouble);
    }
    free(c->row);
    free(c->text);
    free(c->path);
    file_in_close(&c->in);
    *c = (csv){.path = NULL};
}

/* ---- the text ---------------------------------------------------------------------------------- */

/* A line as `to FILE.json` writes it, {"event":"table","columns":{"F":"N","c(F)":"m"}} or
 * {"F":20,"c(F)":0.1}, as one of CSV, "F [N]","c(F) [m]" or 20,0.1. */
static void put_members(FILE *to, const char *line) {
    static const char columns[] = "\"columns\":{", colon[] = "\":";
    const char *head = strstr(line, columns), *name = head ? head + sizeof columns - 1 : line + 1, *value;
    for (; *name == '"' && (value = strstr(name, colon)); name = value + (*value == ',')) {
        const char *end = value;
        value += sizeof colon - 1;
        const int len = (int)strcspn(value, ",}");
        if (head)
            fprintf(to, "%.*s [%.*s]\"", (int)(end - name), name, len > 2 ? len - 2 : 0, value + 1);
        else
            fprintf(to, "%.*s", len, value);
        value += len;
        fputs(*value == ',' ? "," : "", to);
    }
}

/* Reads the file into c->text as UTF-8. A file with line ends CR arrives as one line and is split here. */
static bool read_text(csv *c, size_t *len, calc_error *error) {
    file_in *in = &c->in;
    file_text all;
    file_got got = FILE_GOT_END;
    bool ok = true, json = false;
    if (!file_in_open(in, c->path, c->stop, error))
        return false;
    if (!file_text_open(&all))
        return calc_no_memory(error);
    while (ok && (got = file_in_line(in, error)) == FILE_GOT_LINE) {
        json = json || (in->number == 1 && !strncmp(in->line, "{\"event\":", 9));
        if (json)
            put_members(all.to, in->line);
        else
            fwrite(in->line, 1, in->length, all.to);
        putc('\n', all.to);
        ok = !memchr(in->line, 0, in->length) ||
             calc_fail(error, 0, 0, "%s:%llu: this is no text, or UTF-16 without its mark: save it as UTF-8",
                       c->path, in->number);
    }
    const bool single = in->read == 1;
    if (!file_text_close(&all))
        return calc_no_memory(error);
    c->text = all.text;
    *len = all.size;
    for (char *end = c->text; single && ok && (end = strchr(end, '\r'));)
        *end = '\n';
    if (ok && got == FILE_GOT_STOP)
        return calc_interrupted(error);
    return ok && got != FILE_GOT_ERROR && encoding_to_utf8(&c->text, len, &c->encoding, c->path, error);
}

/* ---- the table --------------------------------------------------------------------------------- */

/* A line that is not empty. Bit i of a set stands for field i, the last bit for all further fields. `marked`:
 * words like numbers with thousands separators, an error if their column is loaded. */
typedef struct table_line {
    csv_row at;
    bool comment;
    unsigned fields;
    unsigned long long numbers, words, marked, labels; /* labels: words that begin with two letters */
} table_line;

typedef struct finder {
    csv *c;
    calc_error *error;
    table_line *list;
    size_t count;
    unsigned long long usual; /* the fields that are numbers in a typical row */
    char title[CSV_COLUMNS][CSV_NAME];
} finder;

#define NO_LINE ((size_t)-1)

static const char *text_of(const finder *t, const table_line *l) {
    return t->c->text + l->at.at;
}

static unsigned count_bits(unsigned long long bits) {
    unsigned n = 0;
    for (; bits; bits &= bits - 1)
        n++;
    return n;
}

static bool is_letter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (unsigned char)c >= 0x80;
}

static void scan_line(const char *text, char separator, table_line *l) {
    size_t at = 0;
    cell c = {.ends = false};
    l->fields = 0;
    l->numbers = l->words = l->marked = l->labels = 0;
    while (!c.ends && cell_next(separator, text, l->at.len, &at, &plain_unit, &c) && c.is != COMMENT) {
        const unsigned long long bit = 1ULL << (l->fields < CSV_COLUMNS ? l->fields : CSV_COLUMNS - 1);
        l->numbers |= c.is == NUMBER ? bit : 0;
        l->words |= c.is == WORD ? bit : 0;
        l->marked |= c.is == WORD && field_has_thousands(c.f) ? bit : 0;
        l->labels |=
            c.is == WORD && c.f.len > 1 && is_letter(c.f.text[0]) && is_letter(c.f.text[1]) ? bit : 0;
        l->fields++;
    }
}

/* Is there more than blanks and the separators that spreadsheets write in empty rows? */
static bool has_content(const char *text, size_t len) {
    for (size_t i = 0; i < len; i++)
        if (!field_is_blank(text[i]) && text[i] != ';' && text[i] != ',')
            return true;
    return false;
}

/* Does it begin with `#`, and not with a spreadsheet's error such as #N/A? */
static bool is_comment(field f) {
    size_t n = 0;
    while (n < f.len && !strchr("; \t,", f.text[n]))
        n++;
    return f.len > 0 && *f.text == '#' && !field_is_missing((field){f.text, n});
}

/* Lists the lines that are not empty, but for `sep=;`, by which spreadsheets name the separator. */
static bool list_lines(finder *t, size_t len) {
    const char *text = t->c->text;
    size_t lines = 1;
    for (const char *end = text; (end = strchr(end, '\n')); end++)
        lines++;
    t->list = malloc(lines * sizeof *t->list);
    t->c->row = malloc(lines * sizeof *t->c->row);
    if (!t->list || !t->c->row)
        return calc_no_memory(t->error);
    for (size_t at = 0, number = 1, n; at < len && !*t->c->stop; at += n + 1, number++) {
        n = strcspn(text + at, "\n");
        if (has_content(text + at, n) && (n != 5 || memcmp(text + at, "sep=", 4)))
            t->list[t->count++] =
                (table_line){.at = {number, at, n}, .comment = is_comment(field_trimmed(text + at, n))};
    }
    return true;
}

/* The separator that separates the most numbers and leaves the fewest words, judged by at most TRIED
 * lines. Numbers with thousands separators count only for `;` and tab, which cannot be such separators. */
static char choose_separator(const finder *t) {
    enum { TRIED = 1000 };
    char best = ' ';
    long most = 0;
    for (long least = 2; least > 0 && most == 0; least--) /* lines with two numbers; if there are none, one */
        for (const char *kind = separators; *kind; kind++) {
            long score = 0;
            for (size_t i = 0; i < t->count; i += 1 + t->count / TRIED) {
                table_line l = t->list[i];
                if (l.comment)
                    continue;
                scan_line(text_of(t, &l), *kind, &l);
                const unsigned long long marked = strchr(";\t", *kind) ? l.marked : 0;
                const long numbers = count_bits(l.numbers | marked);
                score += numbers >= least ? 4 * numbers - (long)count_bits(l.words & ~marked) : 0;
            }
            if (score > most) {
                most = score;
                best = *kind;
            }
        }
    return best;
}

/* Sets t->usual: the most frequent set of numeric fields, each line weighted by the square of its numbers. */
static void find_usual(finder *t) {
    enum { KINDS = 64 };
    struct {
        unsigned long long numbers;
        size_t weight;
    } kind[KINDS] = {{0, 0}};
    size_t kinds = 0, most = 0;
    for (size_t i = 0; i < t->count && !*t->c->stop; i++) {
        table_line *l = &t->list[i];
        if (l->comment)
            continue;
        scan_line(text_of(t, l), t->c->separator, l);
        const size_t numbers = count_bits(l->numbers);
        size_t k = 0;
        while (k < kinds && kind[k].numbers != l->numbers)
            k++;
        if (numbers == 0 || k == KINDS)
            continue;
        kinds += k == kinds;
        kind[k].numbers = l->numbers;
        kind[k].weight += numbers * numbers;
    }
    for (size_t k = 0; k < kinds; k++)
        if (kind[k].weight > most) {
            most = kind[k].weight;
            t->usual = kind[k].numbers;
        }
}

/* Are the usual numeric fields of the line numbers or missing, with one number at least? */
static bool is_row(const finder *t, const table_line *l) {
    return !l->comment && (l->numbers | l->marked) & t->usual && !(l->words & ~l->marked & t->usual);
}

/* ---- the header -------------------------------------------------------------------------------- */

static bool parse_unit(const char *text, size_t len, unit *u, calc_error *wrong) {
    lexer lx;
    error_clear(wrong);
    lex_start(&lx, text, len, wrong);
    return lx.kind != T_END && !wrong->raised && unit_of_header(&lx, u);
}

/* The unit of a plain number, `k []` or `k [-]`. */
static bool no_unit(const char *text, size_t len) {
    const field f = field_trimmed(text, len);
    return f.len == 0 || (f.len == 1 && *f.text == '-');
}

static char closing_of(char c) {
    return c == '[' ? ']' : c == '(' ? ')' : 0;
}

/* Between blanks, `r [mm] f [um]` are two titles: extends f by the bracket behind it, unless f is a unit
 * itself
 * (`[mm] [um]`, `- [um]`). Returns where the next field begins. */
static size_t unit_behind(const char *line, size_t len, size_t at, field *f) {
    size_t next = at;
    while (next < len && field_is_blank(line[next]))
        next++;
    const bool alone = no_unit(f->text, f->len) || closing_of(*f->text);
    const char closing = next < len && !alone ? closing_of(line[next]) : 0;
    const char *end = closing ? memchr(line + next, closing, len - next) : NULL;
    if (!end)
        return at;
    f->len = (size_t)(end + 1 - f->text);
    return (size_t)(end + 1 - line);
}

/* The line without comment signs and without the `ITEM: ATOMS` that LAMMPS writes before the names. */
static field heading(const char *text, size_t len) {
    static const char item[] = "ITEM: ";
    field f = field_trimmed(text, len);
    while (f.len > 0 && strchr("#%!", *f.text))
        f = field_trimmed(f.text + 1, f.len - 1);
    if (f.len > sizeof item && !memcmp(f.text, item, sizeof item - 1)) {
        size_t n = sizeof item - 1;
        while (n < f.len && !field_is_blank(f.text[n]))
            n++;
        f = field_trimmed(f.text + n, f.len - n);
    }
    return *text == '\t' || *text == ';' || *text == ',' ? (field){text, len} : f; /* an empty first field */
}

/* Reads the titles of a line into t->title. Returns their count up to the last that is not empty; 0: half of
 * them or more are numbers, or there are more than CSV_COLUMNS. */
static size_t read_titles(finder *t, char separator, const char *text, size_t len) {
    const field head = heading(text, len);
    size_t at = 0, count = 0, named = 0, numbers = 0;
    double v;
    field f;
    while (field_next(separator, head.text, head.len, &at, &f) && !is_comment(f)) {
        if (separator == ' ')
            at = unit_behind(head.text, head.len, at, &f);
        if (f.len > 0 && count >= CSV_COLUMNS)
            return 0;
        numbers += field_is_number(f, true, &plain_unit, &v);
        if (count < CSV_COLUMNS)
            snprintf(t->title[count], CSV_NAME, "%.*s", (int)(f.len < CSV_NAME ? f.len : CSV_NAME - 1),
                     f.text);
        count++;
        named = f.len > 0 ? count : named;
    }
    return 2 * numbers < named ? named : 0;
}

/* Reads titles and returns their count: by the separator of the rows or, if that gives too few, by one that
 * gives as many titles as a row has fields. With `exact`, any other count is 0. */
static size_t names_in(finder *t, const table_line *l, unsigned fields, bool exact) {
    const char *text = text_of(t, l), own = t->c->separator;
    size_t named = read_titles(t, own, text, l->at.len);
    const bool other =
        own == ' ' ? named != fields : named < count_bits(t->usual); /* too few, or `r , f` over `1 2` */
    for (const char *kind = separators; *kind && named != fields && other; kind++)
        named = read_titles(t, *kind, text, l->at.len);
    if (named != fields)
        named = exact ? 0 : read_titles(t, own, text, l->at.len);
    return named < 2 && count_bits(t->usual) > 1 && !memchr(text, '[', l->at.len) ? 0 : named;
}

/* Are half of the titles or more units alone? */
static bool are_units(const finder *t, size_t named) {
    size_t units = 0, all = 0;
    for (size_t i = 0; i < named; i++) {
        const char *s = t->title[i];
        const size_t len = strlen(s), bare = len > 2 && closing_of(*s) == s[len - 1] && closing_of(*s);
        unit u;
        all += len > 0;
        units += len > 0 && (no_unit(s, len) || parse_unit(s + bare, len - 2 * bare, &u, error_quiet()));
    }
    return units > 0 && 2 * units >= all;
}

static bool have_units(const finder *t, size_t named) {
    for (size_t i = 0; i < named; i++)
        if (strpbrk(t->title[i], "[("))
            return true;
    return false;
}

/* The index of the header above line i, or NO_LINE. A line that is no comment decides; a comment is a header
 * if it has as many titles as line i has fields, and one with units goes before one without. */
static size_t header_above(finder *t, size_t i) {
    const unsigned fields = t->list[i].fields;
    size_t candidate = NO_LINE; /* the lowest comment with titles, but without units */
    while (i-- > 0) {
        const table_line *l = &t->list[i];
        if (!l->comment)
            return names_in(t, l, fields, false) ? i : candidate;
        const size_t named = names_in(t, l, fields, true);
        if (named && have_units(t, named))
            return i;
        candidate = named && candidate == NO_LINE ? i : candidate;
    }
    return candidate;
}

static bool same_line(const finder *t, const table_line *a, const table_line *b) {
    return a->at.len == b->at.len && !memcmp(text_of(t, a), text_of(t, b), a->at.len);
}

/* Records the first error of a column. False: out of memory. */
LIKE_PRINTF(3, 4)
static bool trouble(csv_values *column, calc_error *error, const char *format, ...) {
    char text[CALC_ERROR_TEXT];
    va_list args;
    if (column->trouble)
        return true;
    va_start(args, format);
    vsnprintf(text, sizeof text, format, args);
    va_end(args);
    column->trouble = strdup(text);
    return column->trouble || calc_no_memory(error);
}

/* Splits a title into name and unit, which stands in the last brackets or behind the last of the other marks.
 * If a text in brackets or behind a slash is not a unit, that is the column's trouble. */
static bool read_title(const finder *t, csv_values *column) {
    static const char *const before[] = {"[", "(", "/", " in ", "_"};
    enum { SURE = 3 }; /* the first three announce a unit for sure */
    const char *title = column->title, *path = t->c->path;
    size_t name = strlen(title);
    calc_error wrong;
    for (size_t k = 0; k < sizeof before / sizeof *before; k++) {
        const char *at = NULL, *closing = k == 0 ? "]" : k == 1 ? ")" : "";
        for (const char *next = title; (next = strstr(next, before[k])); next++)
            at = next;
        if (!at || (k >= SURE && at == title))
            continue;
        const char *text = at + strlen(before[k]),
                   *end = *closing ? strstr(text, closing) : text + strlen(text);
        if (!end)
            return calc_fail(t->error, 0, 0, "%s:%zu: a unit in the header is not closed", path,
                             t->c->header.line);
        const size_t len = (size_t)(end - text);
        const bool known = parse_unit(text, len, &column->u, &wrong);
        if (!known && k >= SURE)
            continue;
        name = (size_t)(at - title);
        if (known || no_unit(text, len)) {
            column->d = column->u.d;
            column->has_unit = known;
            free(column->trouble);
            column->trouble = NULL;
            break;
        }
        if (!trouble(column, t->error, "%.200s:%zu: column %.*s: %.200s%.*s%s", path, t->c->header.line,
                     (int)field_trimmed(title, name).len, title, wrong.raised ? wrong.text : "a bad unit '",
                     wrong.raised ? 0 : LEX_SHOWN(len), text, wrong.raised ? "" : "'"))
            return false;
    }
    const field own = field_trimmed(title, name);
    snprintf(column->own, sizeof column->own, "%.*s", (int)own.len, own.text);
    memcpy(column->name, column->own, sizeof column->name);
    return true;
}

/* Makes the columns from the header at line i; if that holds units, from it and the line of names above. */
static bool read_header(finder *t, size_t i, unsigned fields) {
    csv *c = t->c;
    char unit_of[CSV_COLUMNS][CSV_NAME] = {""};
    size_t named = names_in(t, &t->list[i], fields, false), above = i;
    if (are_units(t, named)) {
        const size_t units = named;
        memcpy(unit_of, t->title, sizeof unit_of);
        while (above-- > 0 && t->list[above].comment)
            continue;
        named = above == NO_LINE ? 0 : names_in(t, &t->list[above], fields, false);
        if (named < units) { /* no names above: names that look like units */
            memset(unit_of, 0, sizeof unit_of);
            named = names_in(t, &t->list[above = i], fields, false);
        }
    }
    c->header = t->list[above].at;
    c->plain = true;
    while (above-- > 0)
        c->plain = c->plain && t->list[above].comment;
    for (size_t k = 0; k < named; k++) {
        csv_values *column = &c->column[c->columns++];
        const char *u = unit_of[k];
        const size_t len = strlen(u), bare = len > 2 && closing_of(*u) == u[len - 1];
        *column = (csv_values){.u = plain_unit};
        if (len > 0)
            snprintf(column->title, sizeof column->title, "%.60s [%.*s]", t->title[k], (int)(len - 2 * bare),
                     u + bare);
        else
            memcpy(column->title, t->title[k], sizeof column->title);
        if (!read_title(t, column))
            return false;
        for (csv_values *other = c->column; *column->name && other < column; other++)
            if (!strcmp(other->name, column->name))
                other->twice = column->twice = true;
    }
    return true;
}

/* ---- rows -------------------------------------------------------------------------------------- */

/* The first row of the first table with a header and longer than all before it, else of the first table. */
static size_t find_begin(finder *t, size_t *header) {
    size_t first = NO_LINE, before = 0;
    *header = NO_LINE;
    for (size_t i = 0; i < t->count;) {
        if (!is_row(t, &t->list[i]) || (t->list[i].numbers & t->usual) != t->usual) {
            i++;
            continue;
        }
        size_t begin = i, end = i;
        while (begin > 0 && is_row(t, &t->list[begin - 1]) &&
               (t->list[begin - 1].fields > 1 || t->list[i].fields == 1))
            begin--; /* rows with missing values belong to the table */
        while (end < t->count && (t->list[end].comment || is_row(t, &t->list[end])))
            end++;
        const size_t named = header_above(t, begin);
        if (named != NO_LINE && end - begin > before) {
            *header = named;
            return begin;
        }
        first = first == NO_LINE ? begin : first;
        before += end - begin;
        i = end;
    }
    return first;
}

/* Is the line a header with units? Then another table begins. */
static bool begins_another(finder *t, const table_line *l) {
    const size_t named = l->numbers ? 0 : names_in(t, l, (unsigned)t->c->columns, false);
    return named >= count_bits(t->usual) && have_units(t, named);
}

static bool add_row(finder *t, const table_line *l) {
    csv *c = t->c;
    if (c->header.line && c->columns < CSV_COLUMNS && l->numbers >> c->columns)
        return calc_fail(t->error, 0, 0, "%s:%zu: more than %zu fields, one for each name of the header",
                         c->path, l->at.line, c->columns);
    if (l->fields > CSV_COLUMNS)
        return calc_fail(t->error, 0, 0, "%s:%zu: more than %d columns", c->path, l->at.line, CSV_COLUMNS);
    while (!c->header.line && c->columns < l->fields)
        c->column[c->columns++] = (csv_values){.u = plain_unit};
    c->row[c->rows++] = l->at;
    return true;
}

static bool read_rows(finder *t, size_t begin, size_t header) {
    csv *c = t->c;
    for (size_t i = begin; i < t->count; i++) {
        const table_line *l = &t->list[i];
        if (l->comment)
            continue;
        const unsigned long long first = t->usual & (~t->usual + 1);
        if (!(l->words & ~l->marked & t->usual) ||
            (l->numbers & t->usual && !(l->labels & first))) { /* but not `Mean;0.3;5` */
            if (!add_row(t, l))
                return false;
            continue;
        }
        if (header != NO_LINE && same_line(t, l, &t->list[header]))
            continue;
        c->first_word = c->words++ ? c->first_word : l->at.line;
        if (header != NO_LINE && begins_another(t, l))
            break;
    }
    return true;
}

/* ---- decimal marks ----------------------------------------------------------------------------- */

enum { POINT, COMMA };
static const struct {
    char is;
    const char *name;
} marks[CSV_MARKS] = {{'.', "point"}, {',', "comma"}};

static field number_of(const cell *c) {
    const char *hash = memchr(c->f.text, '#', c->f.len);
    return field_trimmed(c->f.text, hash ? (size_t)(hash - c->f.text) : c->f.len);
}

/* Does the mark stand where a thousands separator would: `1.500`, `-12,345`, but not `0.500`? */
static bool like_thousands(field f, char mark) {
    const size_t sign = *f.text == '-' || *f.text == '+';
    if (f.len < sign + 5 || f.len > sign + 7 || f.text[sign] == '0' || f.text[f.len - 4] != mark)
        return false;
    for (size_t i = sign; i < f.len; i++)
        if (i != f.len - 4 && (f.text[i] < '0' || f.text[i] > '9'))
            return false;
    return true;
}

/* If the file has decimal points and commas: records trouble if this number's mark may separate thousands. */
static bool doubt(const csv *c, const csv_row *row, csv_values *column, const cell *v, calc_error *error) {
    const field f = number_of(v);
    const int behind = 3, before = (int)f.len - behind - 1, mark = memchr(f.text, ',', f.len) ? COMMA : POINT;
    const char *own = marks[mark].name, *other = marks[!mark].name;
    char whole[CSV_NAME];
    if (!like_thousands(f, marks[mark].is))
        return true;
    snprintf(whole, sizeof whole, "%.*s%.*s", before, f.text, behind, f.text + before + 1);
    return trouble(column, error,
                   "%.200s:%zu: %.60s = %.*s may be %.6g or %s, since line %zu has a decimal %s: write it "
                   "without its %s, or with a %s",
                   c->path, row->line, column->name, (int)f.len, f.text, atof(whole) / 1000, whole,
                   c->marked[!mark], other, own, other);
}

/* Fills c->marked, unless the file cannot hold both marks within numbers: then none is ambiguous. */
static void find_marks(csv *c) {
    if (c->separator != ',' ? !strchr(c->text, ',') || !strchr(c->text, '.') : !strchr(c->text, '"'))
        return;
    for (const csv_row *row = c->row; row < c->row + c->rows && !*c->stop; row++) {
        const char *text = c->text + row->at;
        size_t at = 0;
        cell v;
        for (size_t i = 0; i < c->columns && cell_next(c->separator, text, row->len, &at, &plain_unit, &v);
             i++)
            for (int k = 0; k < CSV_MARKS && v.is == NUMBER; k++) {
                const field f = number_of(&v);
                if (!c->marked[k] && memchr(f.text, marks[k].is, f.len))
                    c->marked[k] = row->line;
            }
    }
}

/* ---- the file ---------------------------------------------------------------------------------- */

static bool find_table(finder *t, size_t len) {
    csv *c = t->c;
    size_t header;
    if (!list_lines(t, len))
        return false;
    c->separator = choose_separator(t);
    find_usual(t);
    if (calc_stopped(c->stop, t->error))
        return false;
    const size_t begin = t->usual ? find_begin(t, &header) : NO_LINE;
    const bool ok =
        begin == NO_LINE ||
        ((header == NO_LINE || read_header(t, header, t->list[begin].fields)) && read_rows(t, begin, header));
    for (size_t i = 0; i < c->columns; i++)
        c->column[i].numbers = t->usual >> i & 1;
    if (ok)
        find_marks(c);
    return ok && (c->rows > 0 || calc_fail(t->error, 0, 0, "%s holds no rows of numbers", c->path));
}

bool csv_read(const char *path, file_stop stop, csv *c, calc_error *error) {
    size_t len;
    *c = (csv){.path = strdup(path), .stop = stop};
    finder *t = calloc(1, sizeof *t);
    if (!c->path || !t) {
        free(t);
        return calc_no_memory(error);
    }
    *t = (finder){.c = c, .error = error};
    const bool ok = read_text(c, &len, error) && find_table(t, len);
    free(t->list);
    free(t);
    return ok;
}

/* ---- columns ----------------------------------------------------------------------------------- */

csv_values *csv_find(csv *c, const char *name) {
    for (csv_values *v = c->column; v < c->column + c->columns && *name; v++)
        if (!strcmp(v->name, name))
            return v;
    csv_values *v = csv_in_header(c, name);
    return v && !v->given ? v : NULL;
}

csv_values *csv_in_header(csv *c, const char *name) {
    for (csv_values *v = c->column; v < c->column + c->columns && *name; v++)
        if (!strcmp(v->own, name))
            return v;
    for (csv_values *v = c->column; v < c->column + c->columns && *name; v++)
        if (!strcmp(v->title, name))
            return v;
    return NULL;
}

void csv_rename(csv *c, csv_values *column, const char *name) {
    for (csv_values *v = c->column; v < c->column + c->columns; v++)
        if (v != column && !strcmp(v->name, name))
            *v->name = 0;
    column->given = column->given || strcmp(column->name, name) != 0;
    column->twice = false;
    snprintf(column->name, sizeof column->name, "%s", name);
}

void csv_names(const csv *c, char *buf, size_t size) {
    *buf = 0;
    for (size_t i = 0; i < c->columns; i++) {
        if (*c->column[i].own)
            list_word(buf, size, ", ", c->column[i].own);
        else
            text_add(buf, size, "%s%zu", i ? ", " : "", i + 1);
    }
}

void csv_layout(const csv *c, char *buf, size_t size) {
    char names[CALC_ERROR_TEXT / 3];
    const field head = field_trimmed(c->text + c->header.at, c->header.len);
    csv_names(c, names, sizeof names);
    if (c->header.line)
        snprintf(buf, size, "its columns are %s, by line %zu, \"%.*s\"", names, c->header.line,
                 (int)text_fit(head.text, head.len, 60), head.text);
    else
        snprintf(buf, size, "it has no line of names above its rows");
}

const csv_values *csv_column(csv *c, const char *name, calc_error *error) {
    csv_values *column = csv_find(c, name);
    char layout[CALC_ERROR_TEXT / 2];
    if (!column) {
        csv_layout(c, layout, sizeof layout);
        calc_fail(error, 0, 0, "%.100s has no column %.60s: %s; say which it is: using %.60s=%s", c->path,
                  name, layout, name, c->header.line ? "COLUMN" : "NUMBER UNIT");
    } else if (column->twice) {
        calc_fail(error, 0, 0,
                  "%.200s has two columns %.60s: rename one, or say which by its number: using %.60s=%zu",
                  c->path, name, name, (size_t)(column - c->column) + 1);
    }
    return column && !column->twice && csv_load(c, column, error) ? column : NULL;
}

/* Reads the cell of a row in a column; false: the line ends before it. */
static bool cell_at(const csv *c, const csv_row *row, size_t column, cell *out) {
    size_t at = 0;
    for (size_t i = 0; i < column; i++)
        if (!cell_next(c->separator, c->text + row->at, row->len, &at, &plain_unit, out) ||
            out->is == COMMENT)
            return false;
    return cell_next(c->separator, c->text + row->at, row->len, &at, &c->column[column].u, out) &&
           out->is != COMMENT;
}

bool csv_load(csv *c, csv_values *column, calc_error *error) {
    const size_t k = (size_t)(column - c->column);
    double *v = column->v || column->trouble ? NULL : malloc(c->rows * sizeof *v);
    bool ok = v || column->v || column->trouble || calc_no_memory(error);
    for (size_t i = 0; i < c->rows && v && ok && !column->trouble; i++) {
        const csv_row *row = &c->row[i];
        cell f = {.v = NAN};
        if (!cell_at(c, row, k, &f))
            ok = trouble(column, error, "%.200s:%zu: expected a number as %.60s, and the line ends", c->path,
                         row->line, column->name);
        else if (f.is == WORD || (f.ends && k + 1 < c->columns))
            ok = trouble(column, error, "%.200s:%zu: expected a number as %.60s, not '%.*s'", c->path,
                         row->line, column->name, LEX_SHOWN(f.f.len), f.f.text);
        else if (f.is == NUMBER && c->marked[POINT] && c->marked[COMMA])
            ok = doubt(c, row, column, &f, error);
        v[i] = f.v;
        ok = ok && !calc_stopped(c->stop, error);
    }
    if (ok && column->trouble)
        ok = calc_fail(error, 0, 0, "%s", column->trouble);
    if (ok && v)
        column->v = v;
    else
        free(v);
    return ok;
}

bool csv_settle(csv *c, calc_error *error) {
    size_t kept = 0;
    for (size_t i = 0; i < c->rows; i++) {
        bool whole = true;
        for (size_t k = 0; k < c->columns; k++)
            whole = whole && !(c->column[k].v && isnan(c->column[k].v[i]));
        for (size_t k = 0; k < c->columns && whole; k++)
            if (c->column[k].v)
                c->column[k].v[kept] = c->column[k].v[i];
        c->row[kept] = c->row[i];
        kept += whole;
    }
    c->without += c->rows - kept;
    c->rows = kept;
    return kept > 0 ||
           calc_fail(error, 0, 0, "%s has no row with a value in each column that is asked for", c->path);
}
