/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Targets for libFuzzer, chosen by FRET_FUZZ: what reads bytes that others made. It keeps to files of a
 * folder of its own, and starts no program: the Makefile turns these calls of the program's to those here. */
#include <ctype.h>
#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <signal.h>
#include <spawn.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/types.h>
#include <unistd.h>

#include "library.h"
#include "prompt/show.h"
#include "statement/command.h"
#include "statement/output.h"
#include "statement/setting_table.h"
#include "statement/shell.h"
#include "text/lines.h"

/* ---- what the program may do ------------------------------------------------------------------- */

int fuzz_open(const char *path, int flags, ...);
FILE *fuzz_fopen(const char *path, const char *mode);
int fuzz_posix_spawnp(pid_t *pid, const char *file, const posix_spawn_file_actions_t *actions,
                      const posix_spawnattr_t *attributes, char *const argv[], char *const envp[]);
int fuzz_system(const char *line);
FILE *fuzz_popen(const char *line, const char *mode);
pid_t fuzz_fork(void);
char *fuzz_mkdtemp(char *pattern);

static char folder[] = "/tmp/fret-fuzz-XXXXXX";

/* In the folder; what a target has put there is for reading only. */
static bool may(const char *path, bool write) {
    const size_t n = strlen(folder);
    const char *name = strncmp(path, folder, n) == 0 && path[n] == '/' ? path + n + 1 : path;
    return *name && !strchr(name, '/') && !(write && !strncmp(name, "given", 5));
}

int fuzz_open(const char *path, int flags, ...) {
    va_list args;
    va_start(args, flags);
    const mode_t mode = flags & O_CREAT ? (mode_t)va_arg(args, int) : 0;
    va_end(args);
    if (!may(path, (flags & O_ACCMODE) != O_RDONLY))
        return errno = EACCES, -1;
    return open(path, flags, mode);
}

FILE *fuzz_fopen(const char *path, const char *mode) {
    if (!strcmp(path, "/dev/null") || may(path, *mode != 'r'))
        return fopen(path, mode);
    errno = EACCES;
    return NULL;
}

int fuzz_posix_spawnp(pid_t *pid, const char *file, const posix_spawn_file_actions_t *actions,
                      const posix_spawnattr_t *attributes, char *const argv[], char *const envp[]) {
    (void)pid, (void)file, (void)actions, (void)attributes, (void)argv, (void)envp;
    return ENOENT;
}

int fuzz_system(const char *line) {
    (void)line;
    return -1;
}

FILE *fuzz_popen(const char *line, const char *mode) {
    (void)line, (void)mode;
    errno = ENOENT;
    return NULL;
}

pid_t fuzz_fork(void) {
    errno = EAGAIN;
    return -1;
}

char *fuzz_mkdtemp(char *pattern) {
    (void)pattern;
    errno = EACCES;
    return NULL;
}

/* ---- what must hold ---------------------------------------------------------------------------- */

static void fail(const char *what, const char *one, const char *other) {
    fprintf(stderr, "fuzz: %s\n--- before\n%s--- after\n%s", what, one ? one : "", other ? other : "");
    abort();
}

/* One JSON object, strictly. */
static bool json_value(const char **p, const char *end, int depth);

static void blanks(const char **p, const char *end) {
    while (*p < end && strchr(" \t\r", **p) && **p)
        ++*p;
}

static bool json_string(const char **p, const char *end) {
    if (*p == end || *(*p)++ != '"')
        return false;
    while (*p < end && **p != '"') {
        const unsigned char c = (unsigned char)*(*p)++;
        if (c < 0x20)
            return false;
        if (c != '\\')
            continue;
        if (*p == end)
            return false;
        const char e = *(*p)++;
        for (int i = 0; e == 'u' && i < 4; i++)
            if (*p == end || !isxdigit((unsigned char)*(*p)++))
                return false;
        if (!strchr("\"\\/bfnrtu", e))
            return false;
    }
    return *p < end && *(*p)++ == '"';
}

static bool json_number(const char **p, const char *end) {
    const char *start = *p;
    if (*p < end && **p == '-')
        ++*p;
    const char *digits = *p;
    while (*p < end && isdigit((unsigned char)**p))
        ++*p;
    if (*p == digits || (*digits == '0' && *p > digits + 1))
        return false;
    if (*p < end && **p == '.') {
        const char *more = ++*p;
        while (*p < end && isdigit((unsigned char)**p))
            ++*p;
        if (*p == more)
            return false;
    }
    if (*p < end && (**p == 'e' || **p == 'E')) {
        ++*p;
        if (*p < end && (**p == '+' || **p == '-'))
            ++*p;
        const char *more = *p;
        while (*p < end && isdigit((unsigned char)**p))
            ++*p;
        if (*p == more)
            return false;
    }
    return *p > start;
}

static bool json_list(const char **p, const char *end, char close, int depth) {
    ++*p;
    blanks(p, end);
    if (*p < end && **p == close)
        return ++*p, true;
    for (;;) {
        if (close == '}') {
            blanks(p, end);
            if (!json_string(p, end))
                return false;
            blanks(p, end);
            if (*p == end || *(*p)++ != ':')
                return false;
        }
        if (!json_value(p, end, depth + 1))
            return false;
        if (*p == end)
            return false;
        const char c = *(*p)++;
        if (c == close)
            return true;
        if (c != ',')
            return false;
    }
}

static bool json_value(const char **p, const char *end, int depth) {
    static const char *const words[] = {"true", "false", "null"};
    bool ok = false;
    blanks(p, end);
    if (*p == end || depth > 20)
        return false;
    if (**p == '{' || **p == '[')
        ok = json_list(p, end, **p == '{' ? '}' : ']', depth);
    else if (**p == '"')
        ok = json_string(p, end);
    else
        for (int i = 0; i < 3 && !ok; i++)
            if ((size_t)(end - *p) >= strlen(words[i]) && !memcmp(*p, words[i], strlen(words[i])))
                ok = true, *p += strlen(words[i]);
    ok = ok || json_number(p, end);
    blanks(p, end);
    return ok;
}

static bool is_utf8(const char *s, size_t n) {
    for (size_t i = 0; i < n;) {
        const unsigned char c = (unsigned char)s[i++];
        int more = c < 0x80 ? 0 : c >> 5 == 6 ? 1 : c >> 4 == 14 ? 2 : c >> 3 == 30 ? 3 : -1;
        for (; more > 0 && i < n && (s[i] & 0xc0) == 0x80; more--)
            i++;
        if (more)
            return false;
    }
    return true;
}

static void check_json(const char *text, size_t n) {
    for (size_t i = 0, length; i < n; i += length + 1) {
        const char *end = memchr(text + i, '\n', n - i), *p = text + i;
        length = end ? (size_t)(end - p) : n - i;
        const bool ok = end && *p == '{' && json_value(&p, end, 0) && p == end && is_utf8(text + i, length);
        if (!ok)
            fail("a line that is no JSON object", text + i, "\n");
    }
}

/* ---- sessions ---------------------------------------------------------------------------------- */

static FILE *nowhere;

/* The timer stands for the user's Ctrl-C: what takes longer is interrupted, and must then come to its end.
 * What runs for LONGEST seconds after it, or without it, hangs. libFuzzer's own -timeout would need the same
 * timer. */
enum { LONGEST = 30 };
static volatile sig_atomic_t interruptible;

static void interrupt(int signal) {
    static const char hangs[] = "fuzz: does not come to its end\n";
    (void)signal;
    if (!interruptible || shell_stop) {
        (void)!write(STDERR_FILENO, hangs, sizeof hangs - 1);
        abort();
    }
    shell_stop = 1;
}

/* Interrupts after us microseconds; with 0 not at all. */
static void patience(long us) {
    const struct itimerval t = {.it_value = {.tv_sec = us ? us / 1000000 : LONGEST, .tv_usec = us % 1000000},
                                .it_interval = {.tv_sec = LONGEST}};
    interruptible = true; /* the timer before may still interrupt */
    setitimer(ITIMER_REAL, &t, NULL);
    interruptible = us > 0;
}

static void write_file(const char *name, const uint8_t *data, size_t size) {
    FILE *f = fopen(name, "wb");
    if (!f || (size && fwrite(data, 1, size, f) != size) || fclose(f))
        abort();
}

/* The folder as it is at the beginning. */
static void prepare(void) {
    static const char gap[] = "r [mm],f [um]\n0,0\n0.1,0.5\n0.2,2\n0.4,8\n0.8,32\n1.6,128\n",
                      loads[] = "FN [N],Fx [N]\n100,0\n120,15\n90,-10\n100,20\n",
                      data[] = "force [N],depth [um]\n10,0.75\n50,2.2\n100,3.5\n",
                      script[] = "x = 3\nstep Fx+=0.5 N\n";
    DIR *d = opendir(".");
    for (struct dirent *e; d && (e = readdir(d));)
        if (strncmp(e->d_name, "given", 5) && strcmp(e->d_name, ".") && strcmp(e->d_name, ".."))
            unlink(e->d_name);
    if (d)
        closedir(d);
    static bool made;
    if (made)
        return;
    made = true;
    write_file("given.csv", (const uint8_t *)gap, sizeof gap - 1);
    write_file("given-loads.csv", (const uint8_t *)loads, sizeof loads - 1);
    write_file("given-data.csv", (const uint8_t *)data, sizeof data - 1);
    write_file("given.fret", (const uint8_t *)script, sizeof script - 1);
}

static char *scene_text(shell *sh) {
    char *text = NULL;
    size_t n;
    FILE *to = open_memstream(&text, &n);
    if (!to || !scene_write(sh, to, true) || fclose(to))
        abort();
    return text;
}

static bool starts(const char *text, size_t n, const char *word) {
    while (n && isspace((unsigned char)*text))
        text++, n--;
    return n >= strlen(word) && !memcmp(text, word, strlen(word));
}

static bool run_statement(shell *sh, const char *text, size_t n) {
    calc_error error;
    error_clear(&error);
    patience(50000);
    const bool ok = shell_statement(sh, text, n, &error);
    patience(0);
    shell_stop = 0;
    if (ok ? error.raised : !error.raised && !starts(text, n, "source"))
        fail("an error without its word, or the other way round", text, error.text);
    if (!ok)
        calc_word(&sh->calc, &error);
    return ok;
}

/* Statements one by one: what is refused changes nothing. */
static void run_statements(shell *sh, const char *text, size_t size) {
    for (size_t line = 0, n; line < size && !sh->quit; line += n + 1) {
        const char *end = memchr(text + line, '\n', size - line);
        n = end ? (size_t)(end - (text + line)) : size - line;
        for (size_t i = 0, stop; i <= n && !sh->quit; i = stop + 1) {
            stop = shell_statement_end(text + line, i, n);
            const char *one = text + line + i;
            char *before = scene_text(sh);
            if (!run_statement(sh, one, stop - i) && !starts(one, stop - i, "source") &&
                !starts(one, stop - i, "live")) {
                char *after = scene_text(sh);
                if (strcmp(before, after))
                    fail("what was refused has changed the scene", before, after);
                free(after);
            }
            free(before);
            if (stop < n && text[line + stop] == '#')
                break;
        }
    }
}

/* What is saved makes the same scene again. */
static void check_saved(shell *sh) {
    char *saved = scene_text(sh);
    if (!strstr(saved, "# the name of the file")) {
        shell again;
        shell_init(&again, nowhere, nowhere);
        patience(1000000);
        const int status = shell_run(&again, "saved", saved);
        patience(0);
        if (!shell_stop) {
            char *text = scene_text(&again);
            if (status != EXIT_OK || strcmp(text, saved))
                fail("what is saved does not make the scene again", saved, text);
            free(text);
        }
        shell_stop = 0;
        shell_free(&again);
    }
    free(saved);
}

static void statements(const char *text, size_t size) {
    shell sh;
    shell_init(&sh, nowhere, nowhere);
    run_statements(&sh, text, size);
    check_saved(&sh);
    shell_free(&sh);
}

/* The same under --format=json, as a script that goes on after errors. */
static void json(const char *text, size_t size) {
    shell sh;
    char *copy = strndup(text, size), *out = NULL;
    size_t n;
    FILE *to = open_memstream(&out, &n);
    if (!to || !copy)
        abort();
    for (char *p = copy; (p = strstr(p, "format")); p++) /* no way out of JSON */
        *p = 'g';
    shell_init(&sh, to, nowhere);
    sh.set.format = FORMAT_JSON;
    sh.keep_going = true;
    patience(50000);
    shell_run(&sh, "given", copy);
    patience(0);
    shell_stop = 0;
    shell_free(&sh);
    fclose(to);
    check_json(out, n);
    free(out);
    free(copy);
}

#define SCENE "material E0=210 GPa nu=0.3 k=0.2 c0=1 mm; geometry sphere R=10 mm; friction 0.4\n"

/* A session with a file of the given bytes. */
static void with_file(const char *name, const char *text, size_t size, const char *first, const char *then) {
    shell sh;
    write_file(name, (const uint8_t *)text, size);
    shell_init(&sh, nowhere, nowhere);
    run_statements(&sh, first, strlen(first));
    run_statements(&sh, then, strlen(then));
    check_saved(&sh);
    shell_free(&sh);
}

static void gap(const char *text, size_t size) {
    with_file("given-gap.csv", text, size, SCENE "press FN=10 N\nstep Fx=1 N",
              "geometry file given-gap.csv\nk = 0\nf(0.1 mm), g(0.1 mm), a, dz, FN\npress a=0.1 mm\nstep "
              "dx=0.1 um\n"
              "cycle dxA=0.2 um\nW, dW, c\np(0.05 mm), uz(0.2 mm)\nk = -0.5\na\ngeometry file given-gap.csv "
              "smooth\na, c, dW\ngeometry file given-gap.csv smooth 3 height using r=1, f=2\ngeometry file "
              "given-gap.csv using r=2 mm, f=1 um\na\nshow");
}

static void follow(const char *text, size_t size) {
    with_file("given-follow.csv", text, size, SCENE,
              "follow given-follow.csv\nFN, Fx, dz, dx, W, U, c\nhistory\nreset\npress FN=100 N\nfollow "
              "given-follow.csv\n"
              "FN, Fx, W, dW\nk = 0");
}

/* Columns of a table, as names and as measured points. */
static void columns(const char *text, size_t size) {
    with_file("given-table.csv", text, size, SCENE "press FN=100 N",
              "fit E0 for depth = dz(force) to given-table.csv\nfit mu along given-table.csv\n"
              "loop given-table.csv\nloop given-table.csv using dx=1 um, Fx=2 N\nfollow given-table.csv\n"
              "fit mu along given-table.csv using dx=2 um, Fx=\"3\" N, FN=1 N\nset format json\nloop "
              "given-table.csv\n"
              "plot dz(x) for x = 1 N .. 100 N steps 3 over given-table.csv to a.gp");
}

static void replay(const char *text, size_t size) {
    calc_error error;
    write_file("given-replay.txt", (const uint8_t *)text, size);
    for (int format = 0; format < 2; format++) {
        char *out = NULL;
        size_t n;
        FILE *to = open_memstream(&out, &n);
        if (!to)
            abort();
        shell sh;
        error_clear(&error);
        shell_init(&sh, to, nowhere);
        sh.set.format = format ? FORMAT_JSON : FORMAT_TEXT;
        patience(100000);
        const int status = shell_replay(&sh, "given-replay.txt", 1e-12, &error);
        patience(0);
        shell_free(&sh);
        fclose(to);
        if (!shell_stop && status != EXIT_OK && status != EXIT_ERROR)
            fail("a replay ends with another status", out, "");
        if (format && !shell_stop)
            check_json(out, n);
        shell_stop = 0;
        free(out);
    }
}

/* The functions of the library themselves. */
static void library(const char *text, size_t size) {
    (void)size;
    patience(50000);
    library_calls(text, &shell_stop);
    patience(0);
    shell_stop = 0;
}

/* ---- targets ----------------------------------------------------------------------------------- */

static const struct target {
    const char *name;
    void (*run)(const char *text, size_t size);
} targets[] = {{"statements", statements}, {"json", json},     {"gap", gap},        {"follow", follow},
               {"table", columns},         {"replay", replay}, {"library", library}};

static const struct target *chosen;

static void leave(void) {
    if (chdir(folder)) /* not where it was started: all files go */
        return;
    prepare();
    static const char *const given[] = {"given.csv",       "given-loads.csv", "given-data.csv",
                                        "given.fret",      "given-gap.csv",   "given-follow.csv",
                                        "given-table.csv", "given-replay.txt"};
    for (size_t i = 0; i < sizeof given / sizeof *given; i++)
        unlink(given[i]);
    rmdir(folder);
}

int LLVMFuzzerInitialize(int *argc, char ***argv);
int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

int LLVMFuzzerInitialize(int *argc, char ***argv) {
    const char *name = getenv("FRET_FUZZ");
    (void)argc, (void)argv;
    for (size_t i = 0; name && i < sizeof targets / sizeof *targets; i++)
        if (!strcmp(name, targets[i].name))
            chosen = &targets[i];
    command_use(commands, holes);
    nowhere = fopen("/dev/null", "w");
    if (!chosen || !nowhere || !mkdtemp(folder)) {
        fprintf(stderr, "FRET_FUZZ must be statements, json, gap, follow, table, replay or library\n");
        exit(2);
    }
    setenv("HOME", folder, 1);
    setenv("TMPDIR", folder, 1);
    signal(SIGALRM, interrupt);
    atexit(leave);
    return 0;
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
    static int here = -1;
    if (here < 0)
        here = open(".", O_RDONLY | O_DIRECTORY);
    char *text = malloc(size + 1);
    if (!text || chdir(folder))
        abort();
    memcpy(text, data, size);
    text[size] = 0;
    patience(0);
    prepare();
    chosen->run(text, size);
    setitimer(ITIMER_REAL, &(const struct itimerval){0}, NULL);
    free(text);
    return fchdir(here); /* the corpus is named from there */
}
