/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lines by readline, with editing, history and completion. */
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

static shell *completing;     /* readline passes no context to its callbacks */
static bool in_readline;      /* a call of readline is running */
static int history_file = -1; /* open for appending; -1: no history is kept */

/* ---- signals ----------------------------------------------------------------------------------- */

/* While a line is edited readline has changed the terminal's modes: they are restored before Ctrl-Z stops the
 * program, and set again when it continues. For signals that end it file_guard_terminal does that. */
static struct job_signal {
    int number;
    struct sigaction before;
} job_signals[] = {{.number = SIGTSTP}, {.number = SIGCONT}};
enum { JOB_SIGNALS = sizeof job_signals / sizeof *job_signals };

static volatile sig_atomic_t caught;

static void on_signal(int number) {
    caught = number;
}

static void take_job_signals(void) {
    const struct sigaction act = {.sa_handler = on_signal};
    for (struct job_signal *s = job_signals; s < job_signals + JOB_SIGNALS; s++)
        if (!sigaction(s->number, NULL, &s->before) && s->before.sa_handler != SIG_IGN)
            sigaction(s->number, &act, NULL);
}

static void restore_job_signals(void) {
    for (struct job_signal *s = job_signals; s < job_signals + JOB_SIGNALS; s++)
        sigaction(s->number, &s->before, NULL);
}

/* Lets the signal act as it does without a handler; the shell may change the terminal's modes meanwhile. */
static void act_on_signal(void) {
    const int number = caught;
    caught = 0;
    rl_deprep_term_function();
    restore_job_signals();
    if (number != SIGCONT)
        raise(number);
    take_job_signals();
    rl_prep_term_function(1);
    rl_forced_update_display();
}

/* If the input ends within a bracketed paste, readline would wait for the end mark for ever: read_key returns
 * that mark first, and EOF only when readline has left the paste. */
static bool pasting;
static size_t end_sent; /* bytes of the end mark that readline has got */
static bool echoed_stop;

static int nothing_more(void) {
    static const char end[] = "\033[201~";
    if (shell_stop && !echoed_stop) { /* ^C on the screen shows that the line was dropped */
        rl_point = rl_end;            /* and the next prompt stands below all rows of the line */
        rl_redisplay();
        rl_echo_signal_char(SIGINT);
    }
    echoed_stop = true;
    return pasting ? end[end_sent++ % (sizeof end - 1)] : EOF;
}

/* The lines of a paste. Each is shown at a prompt of its own and run, as if typed; the last one is left for
 * the user to edit. */
static char *pasted;
static size_t pasted_at; /* the next line */
static size_t left_out;  /* lines of a pasted session that were dropped as answers */
static bool continues;   /* the line being typed continues the one before */

/* readline calls it when a prompt is on the screen: inserts the next pasted line. */
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
    end_sent = 0;
    const int status = rl_bracketed_paste_begin(count, key);
    pasting = false;
    if (shell_stop || !strchr(rl_line_buffer, '\n') || !(pasted = strdup(rl_line_buffer)))
        return status;
    left_out = paste_lines(pasted, continues);
    rl_replace_line("", 1);
    rl_point = 0;
    return next_pasted();
}

/* Replaces rl_getc, which reads on after a signal: Ctrl-C would act only at the next key. Signals are blocked
 * from looking at the flags until pselect(2) waits, so that none is missed in between. */
static int read_key(FILE *in) {
    const int fd = fileno(in);
    unsigned char c;
    sigset_t ours, before;
    sigemptyset(&ours);
    sigaddset(&ours, SIGINT);
    for (size_t i = 0; i < JOB_SIGNALS; i++)
        sigaddset(&ours, job_signals[i].number);
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
        if (ready <= 0) /* unreached: no other signal has a handler that returns */
            continue;
        const ssize_t n = read(fd, &c, 1);
        if (n == 1)
            return c;
        if (n == 0 || (errno != EINTR && errno != EAGAIN))
            return nothing_more();
    }
}

/* Input is UTF-8 whatever the locale. In a locale with another code readline would take the first byte of a
 * character for a Meta key, and move the cursor by bytes. It reads the locale at its start and before every
 * line, then calls this hook. If C.UTF-8 is not installed, the cursor does move by bytes. */
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

/* readline asks for the bytes that end a word; the one before our word makes it begin where we want. */
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

/* Puts a file name into quotation marks; a name that holds one stays as it is. The closing mark is missing if
 * the user typed the opening one (readline adds it) and after a directory, whose path goes on. */
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

/* The matches for readline; NULL lets it complete file names. */
static char **matches(const char *text, int start, int end) {
    (void)end;
    rl_attempted_completion_over = 1;
    if ((size_t)start != found.start)
        return NULL;
    if (found.files) {
        rl_attempted_completion_over = 0;
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
    in_readline = true;
    add_history(line);
    in_readline = false;
}

/* Reads the last lines of the history file, without NUL bytes and without lines that are too long. */
static void read_lines(int fd, const char *path, off_t size) {
    file_in in;
    bool part = size > HISTORY_READ; /* the first line read is only a part */
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

/* Opens and reads the history: readable by the user alone, and a regular file, for a pipe would block and a
 * link may lead anywhere. A file that cannot be written is read. */
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
        shell_say(sh, "other users can read %s", path);
    if (fd >= 0 && !strange)
        read_lines(fd, path, st.st_size);
    if (fd >= 0 && (strange || code)) {
        close(fd);
    } else if (fd >= 0) {
        history_file = fd;
        file_keep(fd, true);
    }
}

/* ---- prompt.h ---------------------------------------------------------------------------------- */

/* readline calls exit(3) when it is out of memory: restores the terminal. */
static void at_exit(void) {
    if (!in_readline)
        return;
    in_readline = false;
    rl_deprep_term_function();
    fflush(NULL);
    _exit(EXIT_ERROR);
}

void prompt_begin(shell *sh) {
    completing = sh;
    atexit(at_exit);
    in_readline = true;
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
    in_readline = false;
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
    echoed_stop = false;
    continues = continued;
    take_job_signals();
    in_readline = true;
    char *line = readline(text);
    const char *bracketed = rl_variable_value("enable-bracketed-paste"); /* with it readline ends the line */
    if (!line && !(bracketed && !strcmp(bracketed, "on")))
        fputc('\n', stdout);
    in_readline = false;
    restore_job_signals();
    file_unguard(guard);
    if (caught) /* came after the last key: it acts now */
        raise(caught);
    caught = 0;
    return line;
}

/* Appends by one write, so that the lines of two sessions do not mix. */
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
