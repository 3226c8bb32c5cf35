/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lines by readline: editing, history, completion. */
#include <errno.h>
#include <fcntl.h>
#include <langinfo.h>
#include <locale.h>
#include <stdlib.h>
#include <string.h>
#include <sys/select.h>
#include <sys/stat.h>
#include <termios.h>
#include <unistd.h>

#include <readline/history.h>
#include <readline/readline.h>

#include "help/complete.h"
#include "prompt/prompt.h"
#include "text/lines.h"

/* readline's callbacks carry no context */
static shell *completing;
static bool at_work;          /* readline is */
static int history_file = -1; /* open for appending; -1: none is kept */

/* ---- signals ----------------------------------------------------------------------------------- */

/* While a line is edited the terminal is not as the user left it: it is put right before the program is
 * stopped, and taken again when it goes on. What ends the program finds the terminal in the list of
 * text/file.h. */
static struct stop {
    int number;
    struct sigaction before;
} stops[] = {{.number = SIGTSTP}, {.number = SIGCONT}};
enum { STOPS = sizeof stops / sizeof *stops };

static volatile sig_atomic_t caught;

static void on_signal(int number) {
    caught = number;
}

static void take_stops(void) {
    const struct sigaction act = {.sa_handler = on_signal};
    for (struct stop *s = stops; s < stops + STOPS; s++)
        if (!sigaction(s->number, NULL, &s->before) && s->before.sa_handler != SIG_IGN)
            sigaction(s->number, &act, NULL);
}

static void give_stops_back(void) {
    for (struct stop *s = stops; s < stops + STOPS; s++)
        sigaction(s->number, &s->before, NULL);
}

/* Lets the signal do what it would have done; whoever stopped us may have changed the terminal. */
static void act_on_signal(void) {
    const int number = caught;
    caught = 0;
    rl_deprep_term_function();
    give_stops_back();
    if (number != SIGCONT)
        raise(number);
    take_stops();
    rl_prep_term_function(1);
    rl_forced_update_display();
}

/* Where a paste is cut off readline does not end its text: read_key sends the end of a paste first, and
 * only then EOF. */
static bool pasting;
static size_t ending; /* bytes of the end that it has got */
static bool told_stop;

static int nothing_more(void) {
    static const char end[] = "\033[201~";
    if (shell_stop && !told_stop) { /* a copy of the terminal tells that the line was dropped */
        rl_point = rl_end;          /* the next prompt is to stand below all of its rows */
        rl_redisplay();
        rl_echo_signal_char(SIGINT);
    }
    told_stop = true;
    return pasting ? end[ending++ % (sizeof end - 1)] : EOF;
}

/* Lines of a paste that are still to come, each at a prompt of its own, so that the screen holds a session as
 * if it had been typed; the last is left to be edited. */
static char *pasted;
static size_t pasted_at, left_out; /* answers of a pasted session */
static bool goes_on;               /* the line being typed, with the one before */

static int next_pasted(void) {
    if (!pasted)
        return 0;
    char *line = pasted + pasted_at;
    const size_t n = strcspn(line, "\n");
    const bool more = line[n];
    line[n] = 0;
    pasted_at += n + 1;
    rl_insert_text(line);
    rl_redisplay();
    if (more)
        rl_stuff_char('\r'); /* as if Enter were pressed */
    else
        prompt_drop();
    return 0;
}

void prompt_drop(void) {
    free(pasted);
    pasted = NULL;
    pasted_at = 0;
}

static int paste(int count, int key) {
    pasting = true;
    ending = 0;
    const int status = rl_bracketed_paste_begin(count, key);
    pasting = false;
    if (shell_stop || !strchr(rl_line_buffer, '\n') || !(pasted = strdup(rl_line_buffer)))
        return status;
    left_out = paste_lines(pasted, goes_on);
    rl_replace_line("", 1);
    rl_point = 0;
    return next_pasted();
}

/* readline's own getc restarts after a signal: Ctrl-C would not be seen before the next key. Signals are let
 * through while it waits and nowhere else, so that none comes between looking and waiting. */
static int read_key(FILE *in) {
    const int fd = fileno(in);
    unsigned char c;
    sigset_t ours, before;
    sigemptyset(&ours);
    sigaddset(&ours, SIGINT);
    for (size_t i = 0; i < STOPS; i++)
        sigaddset(&ours, stops[i].number);
    for (;;) {
        fd_set set;
        FD_ZERO(&set);
        FD_SET(fd, &set);
        sigprocmask(SIG_BLOCK, &ours, &before);
        const int ready = shell_stop || caught ? 0 : pselect(fd + 1, &set, NULL, NULL, NULL, &before);
        const bool failed = ready < 0 && errno != EINTR;
        sigprocmask(SIG_SETMASK, &before, NULL);
        if (shell_stop || failed)
            return nothing_more();
        if (caught) {
            act_on_signal();
            continue;
        }
        if (ready <= 0) /* unreached: a signal that is none of these */
            continue;
        const ssize_t n = read(fd, &c, 1);
        if (n == 1)
            return c;
        if (n == 0 || (errno != EINTR && errno != EAGAIN))
            return nothing_more();
    }
}

/* What is typed is UTF-8 whatever the locale says. Where that has another code, readline takes the first byte
 * of a character for a Meta key, and moves by bytes: it asks for the locale when it begins and again before
 * every line, and calls this behind it. Where C.UTF-8 is not installed the cursor moves by bytes all the
 * same. */
static int take_utf8(void) {
    rl_variable_bind("convert-meta", "off");
    rl_variable_bind("input-meta", "on");
    rl_variable_bind("output-meta", "on");
    if (strcmp(nl_langinfo(CODESET), "UTF-8") != 0)
        setlocale(LC_CTYPE, "C.UTF-8");
    return 0;
}

/* ---- completion -------------------------------------------------------------------------------- */

static candidates found;

/* Tells readline where the word begins, by the one byte before it. */
static char *word_breaks(void) {
    static char breaks[2];
    candidates_free(&found);
    complete(completing, rl_line_buffer, (size_t)rl_point, &found);
    breaks[0] = '\001';
    if (found.start > 0)
        breaks[0] = rl_line_buffer[found.start - 1];
    return breaks;
}

static char *next_match(const char *text, int state) {
    static size_t next;
    (void)text;
    if (!state)
        next = 0;
    return next < found.count ? strdup(found.word[next++]) : NULL;
}

/* Puts a name into quotation marks. The last mark is left to readline where the first was typed, and left out
 * after a directory, which goes on. A name that holds a mark stays as it is. */
static char *quote_name(char *name, int how_many, char *typed) {
    struct stat st = {.st_mode = 0};
    const size_t room = strlen(name) + 3;
    char *quoted = strchr(name, '"') ? NULL : malloc(room), *path = file_expand(name);
    const bool ends = how_many == SINGLE_MATCH && !*typed && path && !stat(path, &st) && !S_ISDIR(st.st_mode);
    free(path);
    if (!quoted)
        return strdup(name);
    snprintf(quoted, room, "\"%s%s", name, ends ? "\"" : "");
    return quoted;
}

static char **matches(const char *text, int start, int end) {
    (void)end;
    rl_attempted_completion_over = 1;
    if ((size_t)start != found.start)
        return NULL;
    if (found.files) {
        rl_attempted_completion_over = 0; /* readline knows file names */
        return NULL;
    }
    if (found.count == 1) {
        const char *word = found.word[0];
        rl_completion_suppress_append = strchr("=(", word[strlen(word) - 1]) != NULL;
    }
    return rl_completion_matches(text, next_match);
}

/* ---- history ----------------------------------------------------------------------------------- */

enum { HISTORY_READ = 16 << 20, HISTORY_LINES = 10000, HISTORY_LINE = 1 << 16 };

static void remember(const char *line) {
    at_work = true;
    add_history(line);
    at_work = false;
}

/* The latest lines of the file, without bytes 0 and without lines that are too long to be kept. */
static void read_lines(int fd, const char *path, off_t size) {
    file_in in;
    bool part = size > HISTORY_READ; /* of a line comes first */
    if (part)
        lseek(fd, size - HISTORY_READ, SEEK_SET);
    if (!file_in_take(&in, fd, path, NULL, error_quiet()))
        return;
    for (; file_in_line(&in, error_quiet()) == FILE_GOT_LINE; part = false) {
        size_t n = 0;
        for (size_t i = 0; i < in.length; i++)
            if (in.line[i])
                in.line[n++] = in.line[i];
        in.line[n] = 0;
        if (!part && n > 0 && n <= HISTORY_LINE)
            remember(in.line);
    }
    file_in_close(&in);
}

/* For the user alone, and a plain file: a pipe would block, and a link may lead anywhere. One that cannot be
 * written is read. */
static void open_history(shell *sh) {
    enum { FLAGS = O_APPEND | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC | O_NOCTTY };
    char path[FILE_PATH];
    struct stat st = {.st_mode = 0};
    const size_t known = file_own_path(path, "XDG_STATE_HOME", ".local/state", "history");
    if (!known)
        return;
    for (char *slash = path + known; (slash = strchr(slash, '/')); *slash++ = '/') {
        *slash = 0;
        mkdir(path, 0700);
    }
    int fd = open(path, O_RDWR | O_CREAT | FLAGS, 0600);
    const int code = fd < 0 ? errno : 0;
    if (code == EACCES || code == EPERM || code == EROFS)
        fd = open(path, O_RDONLY | FLAGS);
    const bool strange = fd < 0 ? code == ELOOP : (fstat(fd, &st), !S_ISREG(st.st_mode));
    if (strange)
        shell_say(sh, "no history is kept: %s is no plain file", path);
    else if (code)
        shell_say(sh, "no history is kept: cannot write %s: %s", path, strerror(code));
    else if ((st.st_mode & 077) != 0 && st.st_nlink == 1 && fchmod(fd, 0600) != 0)
        shell_say(sh, "others can read %s", path);
    if (fd >= 0 && !strange)
        read_lines(fd, path, st.st_size);
    if (fd >= 0 && (strange || code)) {
        close(fd);
    } else if (fd >= 0) {
        history_file = fd;
        file_keep(fd, true);
    }
}

/* ---- what the session calls -------------------------------------------------------------------- */

/* readline ends the program where it finds no memory; the terminal must not stay as it had it. */
static void at_exit(void) {
    if (!at_work)
        return;
    at_work = false;
    rl_deprep_term_function();
    fflush(NULL);
    _exit(EXIT_ERROR);
}

void prompt_begin(shell *sh) {
    completing = sh;
    atexit(at_exit);
    at_work = true;
    rl_readline_name = "fret"; /* `$if fret` in inputrc */
    rl_getc_function = read_key;
    rl_startup_hook = take_utf8;
    rl_pre_input_hook = next_pasted;
    rl_bind_keyseq_in_map("\\e[200~", paste, emacs_standard_keymap);
    rl_bind_keyseq_in_map("\\e[200~", paste, vi_insertion_keymap);
    rl_attempted_completion_function = matches;
    rl_completion_word_break_hook = word_breaks;
    rl_completer_quote_characters = "\"";
    rl_filename_quote_characters = " \t\n;#";
    rl_filename_quoting_function = quote_name;
    rl_catch_signals = 0;
    using_history();
    stifle_history(HISTORY_LINES);
    at_work = false;
    open_history(sh);
}

char *prompt_line(const char *text, bool continued) {
    struct termios modes;
    if (left_out > 0 && !continued) {
        shell_say(completing, PASTED "%zu line%s without a prompt taken for answers", left_out,
                  left_out == 1 ? "" : "s");
        left_out = 0;
    }
    tcgetattr(STDIN_FILENO, &modes);
    const int guard = file_guard_terminal(&modes, shell_escapes() ? "\033[?2004l\r" : "");
    told_stop = false;
    goes_on = continued;
    take_stops();
    at_work = true;
    char *line = readline(text);
    const char *bracketed = rl_variable_value("enable-bracketed-paste"); /* it ends the line itself then */
    if (!line && !(bracketed && !strcmp(bracketed, "on")))
        fputc('\n', stdout);
    if (shell_stop) /* clears what the editor holds of the line */
        rl_callback_sigcleanup();
    at_work = false;
    give_stops_back();
    file_unguard(guard);
    if (caught) /* came when the line was done: it acts now */
        raise(caught);
    caught = 0;
    return line;
}

/* One write at the end of the file: two sessions do not mix. */
void prompt_keep(const char *line) {
    const size_t n = strlen(line);
    char *copy = n <= HISTORY_LINE ? malloc(n + 2) : NULL;
    if (!copy)
        return;
    for (size_t i = 0; i < n; i++)
        copy[i] = line[i] == '\n' ? ' ' : line[i];
    copy[n] = 0;
    remember(copy);
    copy[n] = '\n';
    if (history_file >= 0 && write(history_file, copy, n + 1) < 0) { /* full, or gone */
        shell_say(completing, "no history is kept any more: %s", strerror(errno));
        file_keep(history_file, false);
        close(history_file);
        history_file = -1;
    }
    free(copy);
}
