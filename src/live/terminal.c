/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The terminal by curses. On signals that end the program, the guards of text/file.h restore it; signals that
 * stop it or change the screen's size only set flags, on which terminal_key acts, when nothing is drawn. */
#define _XOPEN_SOURCE 700
#define NCURSES_WIDECHAR 1
#define NCURSES_NOMACROS 1
#include "live/terminal.h"

#include <curses.h>
#include <errno.h>
#include <locale.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/select.h>
#include <term.h>
#include <time.h>
#include <unistd.h>

#include "live/canvas.h"
#include "text/clock.h"
#include "text/file.h"

static const char mouse_on[] = "\033[?1002h", mouse_off[] = "\033[?1002l\033[?1006l\033[?1000l";

static struct {
    SCREEN *screen;
    FILE *nowhere; /* /dev/null in place of the terminal */
    int guard;
    bool mouse;
    double free_at;     /* after a write that took long: the time until which nothing is drawn */
    char farewell[256]; /* sent to restore the terminal at a signal that ends the program */
    int deaf;           /* how often in a row waiting for a key has failed */
} own = {.guard = -1};

/* ---- signals ----------------------------------------------------------------------------------- */

static volatile sig_atomic_t stopped, resized;

static void on_stop(int number) {
    (void)number;
    stopped = 1;
}

static void on_resize(int number) {
    (void)number;
    resized = 1;
}

static void on_crash(int number);

static struct taken {
    int number;
    void (*handler)(int number);
    struct sigaction before;
} taken[] = {{.number = SIGTSTP, .handler = on_stop},
             {.number = SIGCONT, .handler = on_resize},
             {.number = SIGWINCH, .handler = on_resize},
             {.number = SIGSEGV, .handler = on_crash},
             {.number = SIGBUS, .handler = on_crash},
             {.number = SIGFPE, .handler = on_crash},
             {.number = SIGILL, .handler = on_crash},
             {.number = SIGABRT, .handler = on_crash},
             {.number = 0}};

/* At a crash: restores the terminal, then lets the signal act as before. */
static void on_crash(int number) {
    file_emergency();
    for (struct taken *t = taken; t->number; t++)
        if (t->number == number)
            sigaction(number, &t->before, NULL);
    raise(number);
} /* unreached: it has ended us */

static void take_signals(void) {
    stopped = resized = 0;
    for (struct taken *t = taken; t->number; t++) {
        const struct sigaction act = {.sa_handler = t->handler};
        sigaction(t->number, &act, &t->before);
    }
}

static void give_signals_back(void) {
    for (struct taken *t = taken; t->number; t++)
        sigaction(t->number, &t->before, NULL);
}

/* ---- taking over ------------------------------------------------------------------------------- */

/* Appends a string of the terminal's description, without padding such as $<5>. */
static void append_capability(char *to, size_t size, const char *name) {
    const char *s = tigetstr(name);
    size_t n = strlen(to);
    for (; s && s != (const char *)-1 && *s && n + 1 < size; s++) {
        if (s[0] == '$' && s[1] == '<' && strchr(s, '>'))
            s = strchr(s, '>');
        else
            to[n++] = *s;
    }
    to[n] = 0;
}

static void send(const char *text) {
    const ssize_t sent = write(STDOUT_FILENO, text, strlen(text));
    (void)sent; /* only the mouse is lost if it fails */
}

static void set_colors(void) {
    static const short basic[INKS] = {
        [INK_FRAME] = COLOR_WHITE,  [INK_BOUND] = COLOR_YELLOW, [INK_MEMORY] = COLOR_MAGENTA,
        [INK_STICK] = COLOR_GREEN,  [INK_SLIP] = COLOR_RED,     [INK_CURVE] = COLOR_CYAN,
        [INK_OTHER] = COLOR_YELLOW, [INK_POINT] = COLOR_WHITE,  [INK_ERROR] = COLOR_RED};
    static const short many[INKS] = {
        [INK_FRAME] = 250, [INK_BOUND] = 179, [INK_MEMORY] = 133, [INK_STICK] = 71, [INK_SLIP] = 203,
        [INK_CURVE] = 80,  [INK_OTHER] = 179, [INK_POINT] = 231,  [INK_ERROR] = 203};
    if (!has_colors())
        return;
    start_color();
    use_default_colors();
    for (short i = INK_FRAME; i < INKS && i < COLOR_PAIRS; i++)
        init_pair(i, COLORS >= 256 ? many[i] : basic[i], -1);
}

/* Arrow keys as sent by terminals that ignore the keypad mode. */
static const struct {
    const char *sent;
    int key;
} arrows[] = {{"\033[A", KEY_UP}, {"\033[B", KEY_DOWN}, {"\033[C", KEY_RIGHT}, {"\033[D", KEY_LEFT}};

static bool open_seen(calc_error *error) {
    struct termios modes;
    if (!isatty(STDOUT_FILENO) || tcgetattr(STDIN_FILENO, &modes))
        return calc_fail(error, 0, 0, "the full-screen mode needs a terminal");
    own.screen = newterm(NULL, stdout, stdin);
    if (!own.screen || !tigetstr("cup")) {
        const char *name = getenv("TERM");
        return calc_fail(error, 0, 0,
                         own.screen
                             ? "this terminal cannot move its cursor, as the full-screen mode needs (TERM=%s)"
                             : "the full-screen mode does not know this terminal (TERM=%s); most are of "
                               "the kind of xterm, try: TERM=xterm-256color fret --live",
                         name ? name : "");
    }
    own.farewell[0] = 0;
    const char *reports = tigetstr("kmous");
    own.mouse = reports && reports != (const char *)-1;
    if (own.mouse)
        strcpy(own.farewell, mouse_off);
    append_capability(own.farewell, sizeof own.farewell, "sgr0");
    append_capability(own.farewell, sizeof own.farewell, "rmkx");
    append_capability(own.farewell, sizeof own.farewell, "cnorm");
    append_capability(own.farewell, sizeof own.farewell, "rmcup");
    own.guard = file_guard_terminal(&modes, own.farewell);
    if (cbreak() == ERR)
        return calc_fail(error, 0, 0, "the full-screen mode cannot have each key of this terminal");
    noecho();
    nonl();
    keypad(stdscr, TRUE);
    nodelay(stdscr, TRUE);
    set_escdelay(50);
    for (size_t i = 0; i < sizeof arrows / sizeof *arrows; i++)
        define_key(arrows[i].sent, arrows[i].key);
    if (own.mouse) {
        mousemask(BUTTON1_PRESSED | BUTTON1_RELEASED | REPORT_MOUSE_POSITION, NULL);
        mouseinterval(0);
        send(mouse_on);
    }
    return true;
}

static bool open_unseen(calc_error *error) {
    char name[] = "xterm-256color";
    own.nowhere = fopen("/dev/null", "r+");
    own.screen = own.nowhere ? newterm(name, own.nowhere, own.nowhere) : NULL;
    return own.screen || calc_fail(error, 0, 0, "no screen can be had to play the script on");
}

bool terminal_open(bool unseen, calc_error *error) {
    setlocale(LC_CTYPE, "");
    take_signals();
    if (!(unseen ? open_unseen(error) : open_seen(error))) {
        terminal_close();
        return false;
    }
    curs_set(0);
    set_colors();
    return true;
}

void terminal_close(void) {
    if (own.screen) {
        if (own.mouse) {
            mousemask(0, NULL);
            send(mouse_off);
        }
        if (endwin() == ERR) /* the modes would be left without echo */
            reset_shell_mode();
        delscreen(own.screen);
    }
    if (own.nowhere)
        fclose(own.nowhere);
    own.nowhere = NULL;
    own.screen = NULL;
    own.mouse = false;
    file_unguard(own.guard);
    own.guard = -1;
    give_signals_back();
    setlocale(LC_CTYPE, "C");
}

/* ---- slow lines -------------------------------------------------------------------------------- */

void terminal_show(bool again) {
    static const double LONG = 0.05; /* [s] */
    if (again)
        clearok(curscr, TRUE);
    const double begin = clock_wall();
    refresh();
    const double took = clock_wall() - begin;
    own.free_at = took > LONG ? begin + 2 * took : 0;
}

int terminal_busy(void) {
    int waiting = 0;
    const double left = own.free_at - clock_wall();
    if (left > 0)
        return 1 + (int)(1000 * fmin(left, 60));
    ioctl(STDOUT_FILENO, TIOCOUTQ, &waiting);
    return waiting > 0 ? 1 + waiting / 16 : 0; /* unreached: output waits on serial lines only */
}

/* ---- keys -------------------------------------------------------------------------------------- */

/* Stops the program, as Ctrl-Z does elsewhere; returns when it is continued. */
static void stop_here(void) {
    struct sigaction act = {.sa_handler = SIG_DFL}, ours;
    if (own.mouse)
        send(mouse_off);
    endwin();
    sigaction(SIGTSTP, &act, &ours);
    raise(SIGTSTP);
    sigaction(SIGTSTP, &ours, NULL);
    stopped = 0;
    resized = 1;
}

static void take_size(void) {
    struct winsize size;
    resized = 0;
    if (isendwin())
        refresh();
    else
        reset_prog_mode(); /* the shell may have changed the modes */
    if (!ioctl(STDOUT_FILENO, TIOCGWINSZ, &size))
        resizeterm(size.ws_row, size.ws_col); /* which refuses a size of 0 */
    clearok(curscr, TRUE);
    curs_set(0);
    if (own.mouse)
        send(mouse_on);
}

int terminal_key(int milliseconds, volatile sig_atomic_t *stop) {
    enum { DEAF = 20 };
    int key = getch(); /* curses may have bytes in its buffer, which pselect does not see */
    if (key != ERR)
        return key == KEY_RESIZE ? KEY_AGAIN : key;
    sigset_t ours, before;
    sigemptyset(&ours);
    sigaddset(&ours, SIGINT);
    for (struct taken *t = taken; t->handler != on_crash; t++)
        sigaddset(&ours, t->number);
    sigprocmask(SIG_BLOCK, &ours, &before); /* none may come between looking at the flags and waiting */
    fd_set in;
    FD_ZERO(&in);
    FD_SET(STDIN_FILENO, &in);
    const struct timespec time = {milliseconds / 1000, milliseconds % 1000 * 1000000L};
    const int ready =
        *stop || stopped || resized ? 0 : pselect(STDIN_FILENO + 1, &in, NULL, NULL, &time, &before);
    own.deaf = ready < 0 && errno != EINTR ? own.deaf + 1 : 0;
    sigprocmask(SIG_SETMASK, &before, NULL);
    if (stopped)
        stop_here();
    if (resized) {
        take_size();
        return KEY_AGAIN;
    }
    if (*stop) {
        *stop = 0;
        return KEY_STOP;
    }
    if (own.deaf > DEAF) { /* standard input is broken: no key will come */
        own.deaf = 0;
        return KEY_STOP;
    }
    key = ready > 0 ? getch() : ERR;
    if (ready > 0 && key == ERR && !isatty(STDIN_FILENO))
        return KEY_STOP; /* the terminal is gone */
    return key == ERR ? KEY_NONE : key;
}
