/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lines as users type, paste and read them. Depends on text/characters. */
#include "text/lines.h"

#include <stdio.h>
#include <string.h>

#include "text/characters.h"

const char *strip_prompt(const char *line, size_t *len) {
    static const char *const prompts[] = {"fret>", "....>"};
    enum { PROMPT = 5 };
    size_t i = 0;
    while (i < *len && (line[i] == ' ' || line[i] == '\t'))
        i++;
    if (i == *len || (line[i] != 'f' && line[i] != '.'))
        return line;
    for (size_t p = 0; p < sizeof prompts / sizeof *prompts; p++) {
        if (*len - i < PROMPT || memcmp(line + i, prompts[p], PROMPT))
            continue;
        size_t end = i + PROMPT; /* a terminal may have cut the blank off a bare prompt */
        if (end < *len && line[end] != ' ' && line[end] != '\r')
            continue;
        end += end < *len;
        *len -= end;
        return line + end;
    }
    return line;
}

bool begins_with_prompt(const char *line, size_t len) {
    return strip_prompt(line, &len) != line;
}

void help_wrapped(FILE *to, const char *label, const char *text, size_t indent) {
    enum { WIDTH = 79 };
    size_t before = strlen(label);
    fputs(label, to);
    for (size_t left = strlen(text); left > 0; before = indent) {
        const char *row = text;
        const size_t n = text_break(&text, &left, WIDTH - before);
        fwrite(row, 1, n, to);
        if (left)
            fprintf(to, "\n%*s", (int)indent, "");
    }
    putc('\n', to);
}

/* Does the `#` at i belong to a word, as in a#b.csv? */
static bool within_word(const char *text, size_t i, size_t len) {
    static const char ends[] = " \t\r\n;\"#"; /* strchr finds the NUL too */
    return i > 0 && i + 1 < len && !strchr(ends, text[i - 1]) && !strchr(ends, text[i + 1]);
}

size_t shell_statement_end(const char *text, size_t i, size_t len) {
    static const bool special[256] = {['"'] = true, ['\n'] = true, [';'] = true, ['#'] = true};
    bool quoted = false;
    for (; i < len; i++) {
        const char c = text[i];
        if (!special[(unsigned char)c])
            continue;
        if (c == '"')
            quoted = !quoted;
        else if (c == '\n')
            quoted = false;
        else if (!quoted && (c != '#' || !within_word(text, i, len)))
            break;
    }
    return i;
}

size_t shell_mark(const char *line, size_t len) {
    size_t n = len, end;
    while (n > 0 && line[n - 1] == '\r')
        n--;
    if (n == 0 || line[n - 1] != '\\')
        return len;
    end = shell_statement_end(line, 0, n);
    while (end < n && line[end] == ';')
        end = shell_statement_end(line, end + 1, n);
    return end == n ? n - 1 : len; /* a `\` within a comment is no mark */
}

size_t paste_lines(char *text, bool continued) {
    size_t dropped = 0, n;
    bool transcript = false;
    for (char *line = text; *line; line += n + (line[n] == '\n')) {
        n = strcspn(line, "\n");
        transcript = transcript || (begins_with_prompt(line, n) && strchr(text, '\n'));
    }
    char *to = text, *next = text;
    for (bool more = true; more;) {
        const char *line = next;
        size_t left = n = strcspn(line, "\n");
        more = line[n] && line[n + 1];
        next += n + 1;
        const char *typed = strip_prompt(line, &left);
        if (typed == line && transcript && !continued) {
            dropped += left > 0;
            continue;
        }
        continued = shell_mark(typed, left) < left;
        memmove(to, typed, left);
        to += left;
        *to++ = '\n';
    }
    to[-1] = 0;
    return dropped;
}
