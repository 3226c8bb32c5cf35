/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The one table of keys: what they do, and what `?` tells about them. Each change of the scene is a
 * statement. */
#define _XOPEN_SOURCE 700
#define NCURSES_WIDECHAR 1
#include <curses.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "live/state.h"
#include "live/terminal.h"
#include "text/characters.h"
#include "text/file.h"

/* ---- pushing and pressing ---------------------------------------------------------------------- */

static const shot *now(const live *l) {
    return &side_first(l)->now;
}

/* The value of a number in the table, if positive; else `otherwise`. */
static double number(const live *l, const char *name, double otherwise) {
    for (size_t i = 0; i < SHOT_VALUES; i++)
        if (!strcmp(shot_names[i], name) && now(l)->known[i] && now(l)->value[i] > 0)
            return (double)now(l)->value[i];
    return otherwise;
}

static const double parts = 25;

/* Steps by about whole/parts, times factor. */
static void step_by(live *l, const char *name, double whole, double factor) {
    char by[40];
    if (!(whole > 0)) {
        live_tell(l, true, "nothing is pressed: r presses again");
        return;
    }
    live_amount(live_nice(whole / parts) * factor, l->by_displacement ? DIM_LENGTH : DIM_FORCE, by,
                sizeof by);
    live_statement(l, "step %s+=%s", name, by);
}

static void push(live *l, double factor) {
    step_by(l, l->by_displacement ? "dx" : "Fx", l->by_displacement ? now(l)->bound : now(l)->slip, factor);
}

static void press(live *l, double factor) {
    const char *name = l->by_displacement ? "dz" : "FN";
    step_by(l, name, number(l, name, 0), factor);
}

static void drive(live *l) {
    l->by_displacement = !l->by_displacement;
    live_tell(l, false, "arrows change %s",
              l->by_displacement ? "the displacements dx and dz" : "the forces Fx and FN");
}

/* ---- the bodies -------------------------------------------------------------------------------- */

static double input_now(const live *l, input in) {
    return l->host->calc->scene.in.v[in];
}

static void grade(live *l, double by) {
    const double k = round(100 * (input_now(l, IN_K) + by)) / 100;
    char depth[40] = "";
    if (!l->host->calc->scene.in.set[IN_C0]) /* a depth about the contact radius, where the grading matters */
        live_amount(live_nice(number(l, "a", 1e-3)), DIM_LENGTH, depth, sizeof depth);
    live_statement(l, "k = %g%s%s", k, *depth ? ", c0 = " : "", depth);
}

static void deepen(live *l, double by) {
    char depth[40];
    const double c0 =
        l->host->calc->scene.in.set[IN_C0] ? input_now(l, IN_C0) * by : live_nice(number(l, "a", 1e-3));
    live_amount(c0, DIM_LENGTH, depth, sizeof depth);
    live_statement(l, "c0 = %s", depth);
}

static void rub(live *l, double by) {
    live_statement(l, "mu = %g", round(100 * (input_now(l, IN_MU) + by)) / 100);
}

static void next_shape(live *l) {
    static const char *const shapes[] = {"sphere R=10 mm", "cone slope=0.02", "power n=4 h=2 um r0=0.2 mm",
                                         "flat-rounded b=0.1 mm R=10 mm"};
    enum { SHAPES = sizeof shapes / sizeof *shapes };
    const geometry *g = l->host->calc->scene.in.geometry;
    size_t i = 0;
    while (g && i < SHAPES && strncmp(shapes[i], g->name, strlen(g->name)))
        i++;
    live_statement(l, "geometry %s", shapes[g ? (i + 1) % SHAPES : 0]);
}

/* ---- the cycle --------------------------------------------------------------------------------- */

static void play_key(live *l) {
    if (!script_ends(l)) {
        script_on(l);
    } else if (!l->playing) {
        live_play(l);
    } else if (!l->stops_at_end) {
        l->stops_at_end = true;
        live_tell(l, false, "the last cycle: space again shows its end");
    } else {
        live_play_end(l);
    }
}

static void wider(live *l, double sign) {
    const double by = live_nice(now(l)->slip > 0 ? now(l)->slip / parts : 1) * sign, FA = l->FA + by;
    l->FA = FA > 0.5 * fabs(by) ? FA : l->FA;
}

static void hurry(live *l, double by) {
    l->speed = fmin(fmax(l->speed * by, 0.0625), 8);
}

static void swing(live *l) {
    const double FN = number(l, "FN", 0);
    l->FNA = l->FNA > 0.35 * FN ? 0 : l->FNA + 0.1 * FN;
    live_tell(l, false, l->FNA > 0 ? "the cycle swings FN too" : "the cycle holds FN");
}

static void phase(live *l) {
    l->phase = l->phase >= 345 ? 0 : l->phase + 15;
    live_tell(l, false, "phase of FN against Fx: %g deg", l->phase);
}

/* ---- the session ------------------------------------------------------------------------------- */

static void undo_last(live *l) {
    live_statement(l, "undo");
}

/* Presses again, which drops all steps after the first press. */
static void reset(live *l) {
    const scene *s = &l->host->calc->scene;
    if (!s->end.steps) {
        live_begin(l);
        return;
    }
    const input in = press_input((load_by)s->program->steps[0].normal);
    const quantity *q = quantity_of_input(in);
    char unit_text[40];
    dim_unit(q->d, unit_text, sizeof unit_text);
    live_statement(l, "press %s=%.17g %s", q->name, s->in.v[in], unit_text);
}

static void ask_line(live *l, const char *prompt, const char *text,
                     void (*entered)(live *l, const char *line)) {
    l->typing = true;
    l->prompt = prompt;
    snprintf(l->line, sizeof l->line, "%s", text);
    l->cursor = strlen(l->line);
    l->kept_at = l->kept_count;
    l->entered = entered;
}

static void keep_line(live *l, const char *line) {
    char *copy = strdup(line);
    if (!copy)
        return;
    if (l->kept_count == KEPT_LINES) {
        free(l->kept[0]);
        memmove(l->kept, l->kept + 1, (KEPT_LINES - 1) * sizeof *l->kept);
        l->kept_count--;
    }
    l->kept[l->kept_count++] = copy;
}

static void statement_entered(live *l, const char *line) {
    if (!line[strspn(line, " \t")])
        return;
    keep_line(l, line);
    live_statement(l, "%s", line);
}

static void statement(live *l) {
    ask_line(l, ":", "", statement_entered);
}

static void save_entered(live *l, const char *line) {
    if (live_statement(l, "save \"%s\"", line))
        live_tell(l, false, "wrote %.400s", line);
}

static void save(live *l) {
    ask_line(l, "save the scene as: ", "live.fret", save_entered);
}

/* The clause that compares both scenes in a plot statement, values exact to the last digit. */
static void comparison_text(const live *l, char *text, size_t size) {
    snprintf(text, size, " with %s =", l->compared.by.text);
    for (size_t i = 0; i < COMPARED; i++) {
        char in[32];
        const long double scale = unit_choose(l->compared.by.d, l->compared.with[i], 17, in, sizeof in);
        text_add(text, size, "%s %.17Lg %s", i ? "," : "", l->compared.with[i] / scale, in);
    }
}

static void picture_entered(live *l, const char *line) {
    const bool pushed = l->host->calc->scene.end.steps > 1;
    char with[LIVE_TEXT] = "";
    if (l->compared.on)
        comparison_text(l, with, sizeof with);
    if (pushed ? live_statement(l, "plot springs%s | loop%s | traction%s to \"%s\"", with, with, with, line)
               : live_statement(l, "plot springs%s | pressure%s to \"%s\"", with, with, line))
        live_tell(l, false, "wrote %.400s", line);
}

static void picture(live *l) {
    ask_line(l, "save the picture as: ", "live.png", picture_entered);
}

static void leave(live *l) {
    l->leave = true;
}

static void back(live *l) {
    if (l->script.count)
        script_back(l);
    else
        undo_last(l);
}

/* ---- the mouse --------------------------------------------------------------------------------- */

static void pull_to(live *l, int column) {
    char to[40];
    const double x = (2.0 * (column - l->loop.left) + 1 - l->loop.cols) / (l->loop.cols - 1) * l->loop_dx;
    live_amount(x, DIM_LENGTH, to, sizeof to);
    if (fabs(x - now(l)->dx) > 0.6 * l->loop_dx / l->loop.cols)
        live_statement(l, "step dx=%s", to);
}

/* Dragging in the loop steps dx to the mouse. Curses may hand over several events at once, in any order. */
static void mouse(live *l) {
    MEVENT e;
    bool released = false;
    int to = -1;
    while (getmouse(&e) == OK) {
        const bool inside = e.x >= l->loop.left && e.x < l->loop.left + l->loop.cols && e.y >= l->loop.top &&
                            e.y < l->loop.top + l->loop.rows;
        if (e.bstate & BUTTON1_PRESSED)
            l->dragging = inside && !l->page && !l->typing;
        released = released || (e.bstate & BUTTON1_RELEASED);
        if (to < 0 || e.bstate & (BUTTON1_PRESSED | BUTTON1_RELEASED))
            to = e.x;
    }
    if (l->dragging && to >= 0)
        pull_to(l, to);
    l->dragging = l->dragging && !released;
}

/* ---- the table --------------------------------------------------------------------------------- */

static void help(live *l);

typedef struct key_row {
    int key, other;          /* other: a second key for the same; 0: none */
    const char *keys, *does; /* for help; NULL: the row before covers it */
    void (*act)(live *l);
    void (*change)(live *l, double by); /* called with `by` in place of act */
    double by;
} key_row;

static const key_row keys[] = {
    {KEY_RIGHT, 'l', "right, left", "push tangentially; with shift, or as l h and L H: finely",
     .change = push, .by = 1},
    {KEY_LEFT, 'h', .change = push, .by = -1},
    {KEY_SRIGHT, 'L', .change = push, .by = 0.1},
    {KEY_SLEFT, 'H', .change = push, .by = -0.1},
    {KEY_UP, 'i', "up, down", "press more, less; with shift, or as i j and I J: finely", .change = press,
     .by = 1},
    {KEY_DOWN, 'j', .change = press, .by = -1},
    {KEY_SR, 'I', .change = press, .by = 0.1},
    {KEY_SF, 'J', .change = press, .by = -0.1},
    {'f', 0, "f", "arrows by force, or by displacement", .act = drive},
    {'k', 0, "k, K", "grading k up, down", .change = grade, .by = 0.05},
    {'K', 0, .change = grade, .by = -0.05},
    {'c', 0, "c, C", "its depth c0 up, down", .change = deepen, .by = 1.25},
    {'C', 0, .change = deepen, .by = 0.8},
    {'m', 0, "m, M", "friction mu up, down", .change = rub, .by = 0.02},
    {'M', 0, .change = rub, .by = -0.02},
    {'g', 0, "g", "the next shape", .act = next_shape},
    {' ', 0, "space", "a cycle plays; again: the last one, its end; script: next line", .act = play_key},
    {'+', '=', "+, -", "amplitude FA of the cycle", .change = wider, .by = 1},
    {'-', 0, .change = wider, .by = -1},
    {']', 0, "], [", "speed of the cycle", .change = hurry, .by = 2},
    {'[', 0, .change = hurry, .by = 0.5},
    {'n', 0, "n", "FN swings too, by 10, .. 40 %; then not", .act = swing},
    {'a', 0, "a", "phase of FN against Fx, 15 deg more", .act = phase},
    {'u', 0, "u", "undo", .act = undo_last},
    {'b', 0, "b", "back: a line of the script, else undo", .act = back},
    {'r', 0, "r", "back to the press: nothing pushed", .act = reset},
    {':', 0, ":", "any statement; Tab completes; compare k = -0.5, 0.5", .act = statement},
    {'s', 0, "s", "save the scene as a script", .act = save},
    {'p', 0, "p", "springs, loop and traction as a picture", .act = picture},
    {'?', KEY_F(1), "?", "this help", .act = help},
    {'q', KEY_STOP, "q, Ctrl-C", "leave; Ctrl-Z stops, fg goes on", .act = leave},
};
enum { KEYS = sizeof keys / sizeof *keys };

void live_keys(FILE *to) {
    for (size_t i = 0; i < KEYS; i++)
        if (keys[i].keys)
            fprintf(to, "    %-12s %s\n", keys[i].keys, keys[i].does);
}

static void help(live *l) {
    file_text page;
    bool ok = file_text_open(&page);
    if (ok) {
        live_keys(page.to);
        fputs("\nThe mouse drags the point of the loop. All of it is statements: `history`,\n"
              "`save` and `undo` know them.\n",
              page.to);
        ok = file_text_close(&page);
    }
    if (!ok) {
        live_tell(l, true, "out of memory");
        return;
    }
    free(l->page);
    l->page = page.text;
    l->page_from = 0;
}

/* ---- a page, a line being typed ---------------------------------------------------------------- */

static void page_key(live *l, int key) {
    const bool next = key == ' ' || key == KEY_DOWN || key == KEY_NPAGE,
               before = key == KEY_UP || key == KEY_PPAGE;
    const int rows = LINES > 4 ? LINES - 3 : 1;
    if (next && l->page_from + rows < page_rows(l->page)) {
        l->page_from += rows;
    } else if (before) {
        l->page_from = l->page_from > rows ? l->page_from - rows : 0;
    } else {
        free(l->page);
        l->page = NULL;
    }
}

static void recall(live *l, bool older) {
    if (older ? l->kept_at == 0 : l->kept_at >= l->kept_count)
        return;
    l->kept_at += older ? (size_t)-1 : 1;
    snprintf(l->line, sizeof l->line, "%s", l->kept_at < l->kept_count ? l->kept[l->kept_at] : "");
    l->cursor = strlen(l->line);
}

static void enter(live *l) {
    char line[LIVE_LINE];
    memcpy(line, l->line, sizeof line);
    l->typing = false;
    l->entered(l, line);
}

static void insert(live *l, int key) {
    const size_t n = strlen(l->line);
    if (key < ' ' || key > 0xff || key == 0x7f || n + 1 >= sizeof l->line)
        return;
    memmove(l->line + l->cursor + 1, l->line + l->cursor, n - l->cursor + 1);
    l->line[l->cursor++] = (char)key;
}

/* The place after the character at the cursor. */
static size_t next(const live *l) {
    const size_t left = strlen(l->line) - l->cursor, n = character_at(l->line + l->cursor, left, NULL);
    return l->cursor + (n || !left ? n : 1);
}

static void erase_one(live *l) {
    const size_t at = character_before(l->line, l->cursor);
    memmove(l->line + at, l->line + l->cursor, strlen(l->line) - l->cursor + 1);
    l->cursor = at;
}

static void typing_key(live *l, int key) {
    enum { CTRL_A = 1, CTRL_E = 5, CTRL_U = 21, ESCAPE = 27, DELETE = 0x7f };
    if (key == '\r' || key == '\n' || key == KEY_ENTER) {
        enter(l);
    } else if (key == ESCAPE || key == KEY_STOP) {
        l->typing = false;
    } else if (key == '\t') {
        l->host->complete(l->host->self, l->line, sizeof l->line, &l->cursor);
    } else if (key == KEY_BACKSPACE || key == DELETE || key == '\b') {
        erase_one(l);
    } else if (key == KEY_LEFT) {
        l->cursor = character_before(l->line, l->cursor);
    } else if (key == KEY_RIGHT) {
        l->cursor = next(l);
    } else if (key == KEY_UP || key == KEY_DOWN) {
        recall(l, key == KEY_UP);
    } else if (key == CTRL_U) {
        l->line[l->cursor = 0] = 0;
    } else if (key == CTRL_A || key == KEY_HOME) {
        l->cursor = 0;
    } else if (key == CTRL_E || key == KEY_END) {
        l->cursor = strlen(l->line);
    } else {
        insert(l, key);
    }
}

/* Repeats of a held key act on the state that is shown, which is not refreshed for each: a slow scene is
 * computed once for all of them. */
void live_key(live *l, int key) {
    if (key != l->last_key)
        live_refresh(l);
    l->last_key = key;
    l->changed = true;
    if (key == KEY_AGAIN)
        return;
    if (key == KEY_MOUSE) {
        mouse(l);
    } else if (l->typing) {
        typing_key(l, key);
    } else if (l->page) {
        page_key(l, key);
    } else {
        for (size_t i = 0; i < KEYS; i++)
            if (keys[i].key == key || (keys[i].other && keys[i].other == key)) {
                if (keys[i].change)
                    keys[i].change(l, keys[i].by);
                else
                    keys[i].act(l);
                return;
            }
        live_tell(l, false, "? lists the keys");
    }
}
