/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A transcript is a test: lines after `fret> ` are run, what follows each must come out again. */
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "shell/shell.h"

static const char prompt[] = "fret> ";

static bool starts_number(const char *s) {
    return (*s >= '0' && *s <= '9') || (*s == '.' && s[1] >= '0' && s[1] <= '9');
}

/* One unit in the last printed place of the number at s. */
static double last_place(const char *s, const char *end) {
    int places = 0;
    bool point = false;
    const char *e = end;
    for (const char *p = s; p < end; p++) {
        if (*p == 'e' || *p == 'E') {
            e = p;
            break;
        }
        places += point;
        point = point || *p == '.';
    }
    return pow(10, (e < end ? strtod(e + 1, NULL) : 0) - places);
}

/* Equal, but for numbers that agree to the digits wanted, or within the tolerance. */
static bool same(const char *want, const char *got, double tolerance) {
    while (*want && *got) {
        if (starts_number(want) && starts_number(got)) {
            char *we, *ge;
            double w = strtod(want, &we), g = strtod(got, &ge);
            if (fabs(w - g) > fmax(0.500001 * last_place(want, we), tolerance * fabs(w)))
                return false;
            want = we;
            got = ge;
        } else if (*want++ != *got++) {
            return false;
        }
    }
    return *want == *got;
}

/* The next line of a text, without its end; NULL at the end. */
static char *next_line(char **text) {
    char *line = *text;
    if (!line || !*line)
        return NULL;
    char *end = strchr(line, '\n');
    *text = end ? end + 1 : line + strlen(line);
    if (end)
        *end = 0;
    for (size_t n = strlen(line); n && (line[n - 1] == ' ' || line[n - 1] == '\r'); n--)
        line[n - 1] = 0;
    return line;
}

/* Compares line by line; trailing empty lines do not count. */
static bool compare(char *want, char *got, double tolerance) {
    for (;;) {
        char *w = next_line(&want), *g = next_line(&got);
        while (!g && w && !*w)
            w = next_line(&want);
        while (!w && g && !*g)
            g = next_line(&got);
        if (!w && !g)
            return true;
        if (!w || !g || !same(w, g, tolerance))
            return false;
    }
}

static void show(FILE *out, char mark, const char *text) {
    while (*text) {
        size_t n = strcspn(text, "\n");
        fprintf(out, "%c %.*s\n", mark, (int)n, text);
        text += n + (text[n] == '\n');
    }
}

typedef struct text {
    char *p;
    size_t len;
} text;

static bool append(text *t, const char *line, size_t n) {
    char *grown = realloc(t->p, t->len + n + 1);
    if (!grown)
        return false;
    memcpy(grown + t->len, line, n);
    t->p = grown;
    t->len += n;
    grown[t->len] = 0;
    return true;
}

typedef struct replay {
    FILE *out, *err;
    double tolerance;
    const char *path;
    size_t passed, failed;
} replay;

static bool check(replay *r, shell *sh, const char *statement, size_t line, const text *want) {
    char *got = NULL;
    size_t got_len = 0;
    FILE *to = open_memstream(&got, &got_len);
    if (!to)
        return false;
    sh->out = sh->err = to;
    source from = {NULL, false};
    sh->quit = false;
    shell_line(sh, &from, statement, strlen(statement), line);
    if (fclose(to)) {
        free(got);
        return false;
    }
    char *w = strdup(want->p ? want->p : ""), *g = strdup(got);
    bool ok = w && g && compare(w, g, r->tolerance);
    free(w);
    free(g);
    if (ok) {
        r->passed++;
    } else {
        r->failed++;
        fprintf(r->out, "%s:%zu: %s%s\n", r->path, line, prompt, statement);
        show(r->out, '-', want->p ? want->p : "");
        show(r->out, '+', got);
    }
    free(got);
    return true;
}

int shell_replay(const char *path, double tolerance, FILE *out, FILE *err) {
    FILE *in = strcmp(path, "-") ? shell_open(path) : stdin;
    if (!in) {
        fprintf(err, "error: cannot read %s: %s\n", path, strerror(errno));
        return EXIT_ERROR;
    }
    replay r = {out, err, tolerance, path, 0, 0};
    shell sh;
    shell_init(&sh, out, err);
    char *buf = NULL, *statement = NULL;
    size_t room = 0, line = 0, at = 0;
    text want = {NULL, 0};
    bool ok = true;
    ssize_t n;
    while (ok && (n = getline(&buf, &room, in)) >= 0 && !shell_stop) {
        line++;
        if (strncmp(buf, prompt, sizeof prompt - 1)) {
            ok = !statement || append(&want, buf, (size_t)n);
            continue;
        }
        if (statement)
            ok = check(&r, &sh, statement, at, &want);
        free(statement);
        buf[strcspn(buf, "\r\n")] = 0;
        statement = strdup(buf + sizeof prompt - 1);
        ok = ok && statement;
        at = line;
        want.len = 0;
        if (want.p)
            want.p[0] = 0;
    }
    if (ok && statement)
        ok = check(&r, &sh, statement, at, &want);
    if (!ok)
        fprintf(err, "error: out of memory\n");
    if (ok && r.passed + r.failed == 0) {
        fprintf(err, "error: %s holds no lines that begin with `%s`\n", path, prompt);
        ok = false;
    }
    if (ok)
        fprintf(out, "%s: %zu passed, %zu failed\n", path, r.passed, r.failed);
    sh.out = out, sh.err = err;
    shell_free(&sh);
    free(buf);
    free(statement);
    free(want.p);
    if (in != stdin)
        fclose(in);
    return shell_stop ? EXIT_INTERRUPTED : ok && !r.failed ? EXIT_OK : EXIT_ERROR;
}
