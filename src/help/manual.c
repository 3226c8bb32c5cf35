/* SPDX-License-Identifier: GPL-3.0-or-later */
/* fret(1), fret(5) and completion for bash. Writes to the stream that it is given. */
#include "help/manual.h"

#include <ctype.h>
#include <stdlib.h>
#include <string.h>

#include "help/help.h"
#include "help/topics.h"
#include "statement/command.h"

/* ---- text for troff ---------------------------------------------------------------------------- */

/* One line, which begins with no sign of a request; what troff takes for other signs is escaped. */
static void put_line(FILE *to, const char *text, size_t n) {
    for (size_t i = 0; i < n; i++)
        if (text[i] == '\\')
            fputs("\\e", to);
        else if (text[i] == '-')
            fputs("\\-", to);
        else if (text[i] == '~')
            fputs("\\(ti", to);
        else if (text[i] == '^')
            fputs("\\(ha", to);
        else if (text[i] == '`')
            fputs("\\(ga", to);
        else if (text[i] == '\'')
            fputs("\\(aq", to);
        else
            putc(text[i], to);
    putc('\n', to);
}

/* Help as it is shown: what is indented stays as it is, the rest is filled. */
static void put_help(FILE *to, const char *text) {
    bool verbatim = false;
    while (*text) {
        const size_t n = strcspn(text, "\n");
        const bool indented = n > 0 && *text == ' ';
        if (indented && !verbatim)
            fputs(".PP\n.nf\n", to);
        else if (!indented && n > 0 && verbatim)
            fputs(".fi\n.PP\n", to);
        else if (n == 0 && !verbatim && text[n + 1] && text[n + 1] != ' ')
            fputs(".PP\n", to);
        if (n > 0) {
            verbatim = indented;
            put_line(to, text, n);
        }
        text += n + (text[n] == '\n');
    }
    if (verbatim)
        fputs(".fi\n", to);
}

/* False: out of memory. */
static bool put_printed(FILE *to, void (*print)(FILE *to)) {
    file_text page;
    if (!file_text_open(&page))
        return false;
    print(page.to);
    if (!file_text_close(&page))
        return false;
    put_help(to, page.text);
    free(page.text);
    return true;
}

static bool put_topic(FILE *to, const char *name) {
    bool ok = true;
    const topic *t;
    for (size_t i = 0; (t = topic_row(i)); i++)
        if (!strcmp(t->name, name)) {
            if (t->text)
                put_help(to, t->text);
            if (t->print)
                ok = put_printed(to, t->print);
            put_help(to, t->example);
        }
    return ok;
}

/* ---- pages ------------------------------------------------------------------------------------- */

static void put_commands(FILE *to) {
    const command *c;
    const hole_row *h;
    char usage[GRAMMAR_USAGE];
    for (size_t i = 0; (c = command_row(i)); i++) {
        grammar_usage(command_form(c), usage);
        fputs(".TP\n.B ", to);
        put_line(to, usage, strlen(usage));
        fprintf(to, "%c%s.\n", toupper((unsigned char)c->summary[0]), c->summary + 1);
    }
    for (size_t i = 0; (h = hole_at(i)); i++)
        if (h->kind == HOLE_CLAUSES) {
            grammar_clauses(h, usage);
            fprintf(to, ".TP\n.B %s\n", h->name);
            put_line(to, usage, strlen(usage));
        }
}

/* `  -f FILE  what it does` of the usage, and lines that go on with what it does. */
static void put_options(FILE *to, const char *usage) {
    enum { TEXT = 22 };
    for (const char *line = usage; *line; line += strcspn(line, "\n") + (strchr(line, '\n') != NULL)) {
        const size_t n = strcspn(line, "\n"), begin = strspn(line, " ");
        size_t end = begin;
        while (line[begin] == '-' && end < n && strncmp(line + end, "  ", 2) != 0)
            end++;
        if (end > begin) {
            fputs(".TP\n.B ", to);
            put_line(to, line + begin, end - begin);
        }
        if (end < n && (end > begin || begin == TEXT))
            put_line(to, line + TEXT, n - TEXT);
    }
}

static bool page_1(FILE *to, const char *usage, const char *version) {
    fprintf(to, ".TH FRET 1 \"\" \"fret %s\" \"User Commands\"\n", version);
    fputs(".SH NAME\nfret \\- partial\\-slip contact of graded elastic solids\n"
          ".SH SYNOPSIS\n.B fret\n[\\fIOPTION\\fR...] [\\fIFILE\\fR...]\n"
          ".SH DESCRIPTION\nAn interactive calculator for fretting contact: two elastic bodies, whose "
          "modulus may grow "
          "or fall with depth as a power law, are pressed together and pushed sideways. Without\n.I "
          "FILE\nor\n.B \\-c\n"
          "it reads standard input: with line editing at a terminal, as a script otherwise.\n.PP\n",
          to);
    put_topic(to, "theory");
    fputs(".SH OPTIONS\n", to);
    put_options(to, usage);
    fputs(".SH COMMANDS\n.B help\n.I NAME\ntells more, with an example.\n", to);
    put_commands(to);
    static const char *const sections[][2] = {
        {"EXPRESSIONS", "expressions"}, {"QUANTITIES", "quantities"}, {"UNITS", "units"},
        {"THE PROMPT", "prompt"},       {"SCRIPTS", "scripts"},       {"LIMITS", "limits"}};
    bool ok = true;
    for (size_t i = 0; i < sizeof sections / sizeof *sections; i++) {
        fprintf(to, ".SH %s\n", sections[i][0]);
        ok = put_topic(to, sections[i][1]) && ok;
    }
    fputs(".SH SETTINGS\n", to);
    ok = put_printed(to, help_settings) && ok;
    fputs(".SH EXIT STATUS\n0 fine, 1 an error, 2 wrong usage, 130 interrupted.\n"
          ".SH ENVIRONMENT\n.TP\n.B PAGER\nshows text that the terminal is too low for\n.TP\n"
          ".BR NO_COLOR \", \" XDG_CONFIG_HOME \", \" XDG_STATE_HOME \", \" HOME\nas usual\n"
          ".SH SEE ALSO\n.BR fret (5),\n.BR libfret (3)\n",
          to);
    return ok;
}

static void page_5(FILE *to, const char *version) {
    fprintf(to, ".TH FRET 5 \"\" \"fret %s\" \"File Formats\"\n", version);
    fputs(".SH NAME\nfret \\- files that fret reads and writes\n.SH DESCRIPTION\n", to);
    put_topic(to, "files");
    fputs(".SH SCRIPTS AND TRANSCRIPTS\n", to);
    put_topic(to, "scripts");
    fputs(".SH SEE ALSO\n.BR fret (1)\n", to);
}

/* ---- bash -------------------------------------------------------------------------------------- */

/* The long options of the usage; with values: `--format=json`. */
static void put_long_options(FILE *to, const char *usage) {
    for (const char *p = strstr(usage, "--"); p; p = strstr(p, "--")) {
        const size_t n = strcspn(p, " =,\n");
        const char *end = strchr(p, '\n'), *after = p + n;
        if (*after != '=') {
            fprintf(to, " %.*s", (int)n, p);
            p += n;
            continue;
        }
        for (const char *word = after + strcspn(after, " "); word < end; word += strcspn(word, " \n")) {
            word += strspn(word, " ");
            const size_t length = strspn(word, "abcdefghijklmnopqrstuvwxyz");
            if (length > 2) /* not `or` */
                fprintf(to, " %.*s=%.*s", (int)n, p, (int)length, word);
        }
        p = end;
    }
}

static void completion_bash(FILE *to, const char *usage) {
    fputs("# bash completion for fret: options, and files\n"
          "_fret() {\n"
          "    local line=${COMP_LINE:0:COMP_POINT}\n"
          "    local word=${line##*[[:space:]]} prefix\n"
          "    prefix=${word%\"${COMP_WORDS[COMP_CWORD]}\"}\n"
          "    case $word in\n"
          "    -*)\n"
          "        local all='-f -c",
          to);
    put_long_options(to, usage);
    fputs("'\n"
          "        mapfile -t COMPREPLY < <(compgen -W \"$all\" -- \"$word\")\n"
          "        [[ ${COMP_WORDS[COMP_CWORD]} == = ]] && prefix=$word\n"
          "        COMPREPLY=(\"${COMPREPLY[@]#\"$prefix\"}\")\n"
          "        ;;\n"
          "    *)\n"
          "        mapfile -t COMPREPLY < <(compgen -f -- \"${COMP_WORDS[COMP_CWORD]}\")\n"
          "        compopt -o filenames 2>/dev/null\n"
          "        ;;\n"
          "    esac\n"
          "}\n"
          "complete -F _fret fret\n",
          to);
}

int manual_write(FILE *to, const char *what, const char *usage, const char *version) {
    if (!strcmp(what, "1"))
        return page_1(to, usage, version) ? EXIT_OK : EXIT_ERROR;
    if (!strcmp(what, "5"))
        page_5(to, version);
    else if (!strcmp(what, "bash"))
        completion_bash(to, usage);
    else
        return EXIT_USAGE;
    return EXIT_OK;
}
