/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Writes pages of HTML to the stream given. */
#include "statement/handout.h"

#include <stdlib.h>
#include <string.h>

#include "text/characters.h"

/* The element of each part. Successive parts of the same kind share one element, unless `separate`. */
static const struct {
    const char *begin, *end;
    bool separate;
} parts[] = {
    [PAGE_GAP] = {"", "", true},
    [PAGE_TITLE] = {"<h1>", "</h1>\n", true},
    [PAGE_WORDS] = {"<p>", "</p>\n", false},
    [PAGE_STATEMENT] = {"<pre class=\"statement\">", "</pre>\n", false},
    [PAGE_ANSWER] = {"<pre>", "</pre>\n", false},
    [PAGE_QUESTION] = {"<p class=\"question\">", "</p>\n", true},
    [PAGE_CHOICE] = {"<p class=\"choice\">", "</p>\n", true},
    [PAGE_ROOM] = {"<div class=\"room\">", "</div>\n", true},
    [PAGE_SOLUTION] = {"<li>", "</li>\n", true},
    [PAGE_FIGURE] = {"<figure>", "</figure>\n", true},
};

static const char head[] =
    "<!DOCTYPE html>\n"
    "<html xmlns=\"http://www.w3.org/1999/xhtml\" lang=\"en\"><head><meta charset=\"utf-8\"/>\n"
    "<meta name=\"viewport\" content=\"width=device-width\"/>\n"
    "<style>\n"
    "body { max-width: 42em; margin: 2em auto; padding: 0 1em; font: 11pt/1.45 Georgia, serif; "
    "color: #000; background: #fff; counter-reset: question; }\n"
    "h1, h2 { font: bold 1.4em/1.25 Helvetica, Arial, sans-serif; }\n"
    "h2 { font-size: 1.15em; }\n"
    "pre { font: 0.8em/1.35 monospace; white-space: pre-wrap; margin: 0.3em 0 0.3em 1.5em; }\n"
    ".statement { font-weight: bold; margin: 0.8em 0 0.3em; break-after: avoid; }\n"
    ".question, .choice { margin-left: 1.5em; }\n"
    ".question { font-weight: bold; counter-increment: question; break-after: avoid; }\n"
    ".question::before { content: counter(question) \". \"; margin-left: -1.5em; display: inline-block; "
    "width: 1.5em; }\n"
    ".choice { margin-top: 0.2em; margin-bottom: 0.2em; break-before: avoid; }\n"
    ".choice::before { content: \"\\2610\\00a0\"; }\n"
    ".room { height: 3.2em; margin-left: 1.5em; border-bottom: 1px dotted #777; break-inside: avoid; "
    "break-before: avoid; }\n"
    "figure { margin: 1em 0; break-inside: avoid; }\n"
    "figure svg { width: 100%; max-width: 36em; height: auto; display: block; margin: auto; }\n"
    ".solutions { break-before: page; }\n"
    "@media print { body { margin: 0 auto; font-size: 10pt; } figure { margin: 0.5em 0; } "
    "figure svg { max-width: 30em; } }\n"
    "@page { margin: 18mm; }\n"
    "</style>\n"
    "<title>";

/* Writes text as XML: & < > as references; characters that do not print are escaped. */
static void put_text(FILE *to, const char *text, size_t len) {
    char shown[CHARACTER_SHOWN];
    for (size_t i = 0, n; i < len; i += n) {
        n = 1;
        if (text[i] == '&' || text[i] == '<' || text[i] == '>') {
            fprintf(to, "&#%d;", text[i]);
        } else if (text[i] == '\n') {
            putc('\n', to);
        } else {
            n = character_shown(text + i, len - i, shown);
            fputs(shown, to);
        }
    }
}

/* Writes an SVG picture. Its ids, and references to them, get a prefix that makes them unique on the page. */
static void put_figure(handout *p, const char *text, size_t len) {
    static const char *const naming[] = {" id=\"", " id='", "href=\"#", "href='#", "url(#", "url('#"};
    bool tag = false;
    p->figures++;
    for (size_t i = 0; i < len; i++) {
        tag = text[i] == '<' || (tag && text[i] != '>');
        putc(text[i], p->to);
        for (size_t j = 0; tag && j < sizeof naming / sizeof *naming; j++) {
            const size_t n = strlen(naming[j]);
            if (i + 1 >= n && !memcmp(text + i + 1 - n, naming[j], n))
                fprintf(p->to, "fig%u-", p->figures);
        }
    }
}

void handout_begin(handout *p, FILE *to, const char *title) {
    p->to = to;
    fputs(head, to);
    put_text(to, title, strlen(title));
    fputs("</title></head><body>\n", to);
}

static void close_part(handout *p, page_part next) {
    fputs(parts[p->open].end, p->to);
    if (p->open == PAGE_WORDS && p->last == '?' && next != PAGE_QUESTION) { /* a question within a remark */
        fputs(parts[PAGE_ROOM].begin, p->to);
        fputs(parts[PAGE_ROOM].end, p->to);
    }
    p->open = PAGE_GAP;
}

void handout_put(handout *p, page_part part, const char *text, size_t len) {
    if (part == PAGE_SOLUTION) {
        if (!p->solutions.to && !p->lost)
            p->lost = !file_text_open(&p->solutions);
        if (p->lost)
            return;
        fputs(parts[part].begin, p->solutions.to);
        put_text(p->solutions.to, text, len);
        fputs(parts[part].end, p->solutions.to);
        return;
    }
    size_t end = len;
    while (end > 0 && (text[end - 1] == '\n' || text[end - 1] == ' '))
        end--;
    if (part == PAGE_ANSWER && p->open != PAGE_ANSWER && !end)
        return;
    if (part != p->open || parts[part].separate) {
        close_part(p, part);
        fputs(parts[part].begin, p->to);
    }
    if (part == PAGE_FIGURE)
        put_figure(p, text, len);
    else
        put_text(p->to, text, len);
    p->open = part;
    p->last = end ? text[end - 1] : p->last;
    fflush(p->to);
}

bool handout_end(handout *p) {
    FILE *to = p->to;
    if (to)
        handout_put(p, PAGE_GAP, "", 0);
    p->to = NULL;
    const bool ok = !p->lost && (!p->solutions.to || file_text_close(&p->solutions));
    if (to && ok && p->solutions.size)
        fprintf(to, "<div class=\"solutions\"><h2>Answers</h2>\n<ol>\n%s</ol></div>\n", p->solutions.text);
    if (ok)
        free(p->solutions.text);
    p->solutions.text = NULL;
    if (to)
        fputs("</body></html>\n", to);
    if (to)
        fflush(to);
    return ok;
}
