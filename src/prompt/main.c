/* SPDX-License-Identifier: GPL-3.0-or-later */
/* main(): options, signals and exit status; runs scripts, replays, the prompt or the full-screen mode. */
#include <errno.h>
#include <fcntl.h>
#include <getopt.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "commands/figures.h"
#include "statement/command.h"
#include "statement/output.h"
#include "statement/record.h"
#include "statement/setting_table.h"
#include "text/file.h"

static const char usage[] =
    "usage: fret [OPTION...] [FILE...]\n"
    "  Calculates partial-slip contact of graded elastic solids. Without FILE or -c, reads\n"
    "  standard input: with line editing at a terminal, as a script otherwise.\n\n"
    "  -f FILE             run a script (- is standard input)\n"
    "  -c STATEMENTS       run these statements\n"
    "  --live              the full-screen mode; FILE: a script to step through\n"
    "  --replay FILE...    run transcripts and compare; exit 1 where one differs\n"
    "  --tolerance X       relative tolerance of numbers in a replay\n"
    "  --format=FORMAT     text, csv or json\n"
    "  --part I/N          share I = 1..N of the rows of a table or a map, or of the\n"
    "                      samples of uncertainty, as csv or json: cat puts them together\n"
    "  --keep-going        go on after an error\n"
    "  --quiet             no banner\n"
    "  --no-rc             do not read the start-up file\n"
    "  --color=WHEN        auto, always or never\n"
    "  --version, --help, -h\n\n"
    "  exit status: 0 fine, 1 an error, 2 wrong usage, 130 interrupted\n";

/* ---- signals ----------------------------------------------------------------------------------- */

static void on_interrupt(int signal) {
    (void)signal;
    shell_stop = 1;
}

/* Restores the terminal and removes unfinished files; then the signal ends the program. */
static void on_end(int number) {
    file_emergency();
    signal(number, SIG_DFL);
    raise(number);
} /* unreached: it has ended us */

/* A signal that is ignored (nohup, a background job) stays so, unless the standard input is a terminal. */
static void handle(int number, void (*handler)(int)) {
    const struct sigaction act = {.sa_handler = handler}; /* no SA_RESTART: a blocked read must return */
    struct sigaction before = {.sa_handler = SIG_DFL};
    sigaction(number, NULL, &before);
    if (before.sa_handler != SIG_IGN || isatty(STDIN_FILENO))
        sigaction(number, &act, NULL);
}

static void set_signals(void) {
    handle(SIGINT, on_interrupt);
    for (int n = 1; n < FILE_SIGNALS; n++)
        if (file_signal_ends(n))
            handle(n, on_end);
    signal(SIGCHLD, SIG_DFL); /* if the parent ignored it, waitpid(2) would not work here */
    signal(SIGPIPE, SIG_IGN);
    signal(SIGXFSZ, SIG_IGN); /* a write that fails is an error like any other */
}

/* ---- options ----------------------------------------------------------------------------------- */

typedef struct job {
    const char *path, *text; /* text: the statements of -c; NULL: run the file `path` */
} job;

/* What the command line asks for. */
typedef struct wishes {
    bool replay, done;
    const char *color;
    double tolerance;
    job *jobs;
    size_t count;
} wishes;

static int keep_going, quiet, no_rc, live; /* set by getopt_long */

static int bad_usage(const char *what, const char *word) {
    fprintf(stderr, "fret: %s%s", what, word ? " " : "");
    print_safe(stderr, word ? word : "", word ? strlen(word) : 0);
    fputs("\ntry: fret --help\n", stderr);
    return EXIT_USAGE;
}

static int take_tolerance(wishes *w, const char *text) {
    char *end;
    w->tolerance = strtod(text, &end);
    if (*end || end == text || !(w->tolerance >= 0) || !isfinite(w->tolerance))
        return bad_usage("--tolerance needs a number, not", text);
    return EXIT_OK;
}

/* Shares run side by side, a process each; so each uses one core unless its script sets more. */
static int take_part(shell *sh, const char *text) {
    run_share *p = &sh->share;
    int used = 0;
    if (sscanf(text, "%9u/%9u%n", &p->number, &p->of, &used) != 2 || text[used] || strpbrk(text, "+- ") ||
        p->number < 1 || p->number > p->of)
        return bad_usage("--part is I/N, whole numbers with 1 <= I <= N, not", text);
    calc_error error = ERROR_NONE;
    FILE *nowhere = shell_nowhere(&error);
    if (!nowhere) {
        shell_error(sh, error.text);
        return EXIT_ERROR;
    }
    p->out = stdout;
    sh->out = p->number == 1 ? p->out : nowhere;
    sh->calc.cores = 1;
    return EXIT_OK;
}

static int take_color(wishes *w, const char *text) {
    static const char *const names[] = {"auto", "always", "never"};
    w->color = text;
    for (int i = 0; i < 3; i++)
        if (!strcmp(names[i], text))
            return EXIT_OK;
    return bad_usage("--color is auto, always or never, not", text);
}

enum {
    IN_ORDER = 1, /* a FILE: the leading "-" of the option string makes getopt return these in order */
    OPT_REPLAY = 256,
    OPT_LIVE,
    OPT_TOLERANCE,
    OPT_FORMAT,
    OPT_PART,
    OPT_KEEP,
    OPT_QUIET,
    OPT_NO_RC,
    OPT_COLOR,
    OPT_VERSION,
    OPT_HELP
};

static const struct option options[] = {{"replay", required_argument, NULL, OPT_REPLAY},
                                        {"live", no_argument, &live, OPT_LIVE},
                                        {"tolerance", required_argument, NULL, OPT_TOLERANCE},
                                        {"format", required_argument, NULL, OPT_FORMAT},
                                        {"part", required_argument, NULL, OPT_PART},
                                        {"keep-going", no_argument, &keep_going, OPT_KEEP},
                                        {"quiet", no_argument, &quiet, OPT_QUIET},
                                        {"no-rc", no_argument, &no_rc, OPT_NO_RC},
                                        {"color", required_argument, NULL, OPT_COLOR},
                                        {"version", no_argument, NULL, OPT_VERSION},
                                        {"help", no_argument, NULL, OPT_HELP},
                                        {NULL, 0, NULL, 0}};

/* The option that getopt refused. For a letter C libraries differ in where optind points then. */
static const char *option_word(char **argv) {
    static char word[] = "-x";
    word[1] = (char)optopt;
    return optopt && optopt < OPT_REPLAY ? word : argv[optind - 1];
}

static int take_option(int opt, wishes *w, shell *sh, char **argv) {
    switch (opt) {
    case 0: /* a switch */
        return EXIT_OK;
    case 'c':
        w->jobs[w->count++] = (job){"-c", optarg};
        return EXIT_OK;
    case IN_ORDER:
    case 'f':
    case OPT_REPLAY:
        w->replay |= opt == OPT_REPLAY;
        w->jobs[w->count++] = (job){optarg, NULL};
        return EXIT_OK;
    case OPT_TOLERANCE:
        return take_tolerance(w, optarg);
    case OPT_FORMAT:
        return setting_format(&sh->set, optarg) ? EXIT_OK
                                                : bad_usage("--format is text, csv or json, not", optarg);
    case OPT_PART:
        return take_part(sh, optarg);
    case OPT_COLOR:
        return take_color(w, optarg);
    case OPT_VERSION:
        printf("fret %s%s\n", FRET_VERSION, study_library);
        w->done = true;
        return EXIT_OK;
    case 'h':
    case OPT_HELP:
        fputs(usage, stdout);
        w->done = true;
        return EXIT_OK;
    case ':':
        return bad_usage("an argument is missing after", option_word(argv));
    default:
        return bad_usage("unknown option", option_word(argv));
    }
}

static int read_options(int argc, char **argv, wishes *w, shell *sh) {
    int status = EXIT_OK, opt;
    opterr = 0;
    while (status == EXIT_OK && !w->done && (opt = getopt_long(argc, argv, "-:f:c:h", options, NULL)) >= 0)
        status = take_option(opt, w, sh, argv);
    for (int i = optind; i < argc && !w->done && status == EXIT_OK; i++) /* behind -- */
        w->jobs[w->count++] = (job){argv[i], NULL};
    sh->keep_going = keep_going;
    const char *no = getenv("NO_COLOR");
    const bool always = !strcmp(w->color, "always"),
               may = !strcmp(w->color, "auto") && !(no && *no) && shell_escapes();
    sh->set.color = always || (may && isatty(STDERR_FILENO));
    sh->set.color_out = always || (may && isatty(STDOUT_FILENO));
    return status;
}

/* ---- jobs -------------------------------------------------------------------------------------- */

/* Runs the scripts; if none is named, the standard input. */
static int run_jobs(shell *sh, const wishes *w) {
    int status = w->count ? EXIT_OK : shell_run(sh, "-", NULL);
    for (size_t i = 0; i < w->count && !sh->quit; i++) {
        const int one = shell_run(sh, w->jobs[i].path, w->jobs[i].text);
        if (one != EXIT_OK)
            status = one;
        if (one == EXIT_INTERRUPTED || (one != EXIT_OK && !sh->keep_going))
            break;
    }
    if (status == EXIT_OK && sh->share.of && !sh->share.met) {
        shell_error(sh, "--part: there was no table, map or uncertainty whose rows could be shared");
        return EXIT_ERROR;
    }
    return status;
}

static int run_live(shell *sh, const wishes *w) {
    calc_error error = ERROR_NONE;
    if (w->count > 1 || (w->count && w->jobs[0].text))
        return bad_usage("--live takes one script", NULL);
    if (shell_live(sh, w->count ? w->jobs[0].path : NULL, &error))
        return EXIT_OK;
    shell_error(sh, error.text);
    return EXIT_ERROR;
}

/* Replays each transcript in a session of its own; one that differs does not stop the others. */
static int run_replays(shell *sh, const wishes *w) {
    int status = EXIT_OK;
    for (size_t i = 0; i < w->count; i++)
        if (w->jobs[i].text)
            return bad_usage("--replay takes transcripts, not -c", NULL);
    for (size_t i = 0; i < w->count && status != EXIT_INTERRUPTED; i++) {
        calc_error error = ERROR_NONE;
        const int one = shell_replay(sh, w->jobs[i].path, w->tolerance, &error);
        if (error.raised)
            shell_error(sh, error.text);
        if (one != EXIT_OK)
            status = one;
    }
    return status;
}

static int run_wishes(shell *sh, const wishes *w) {
    const bool scripted = w->count || !isatty(STDIN_FILENO);
    if (sh->share.of && (live || w->replay || !scripted))
        return bad_usage("--part goes with a script", NULL);
    if (live)
        return run_live(sh, w);
    if (w->replay)
        return run_replays(sh, w);
    return scripted ? run_jobs(sh, w) : shell_prompt(sh, quiet, !no_rc);
}

/* Opens closed standard streams so that using them still fails, but no later file gets their number. */
static void keep_closed(void) {
    for (int fd = 0; fd <= STDERR_FILENO; fd++)
        if (fcntl(fd, F_GETFD) < 0)
            open("/dev/null", fd == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

/* Unsets a relative HOME: what lies in the current directory may be another user's, and readline and the
 * programs started here read settings from HOME, too. */
static void check_home(void) {
    const char *home = getenv("HOME");
    if (home && *home != '/')
        unsetenv("HOME");
}

/* Flushes the output: a lost write is an error. If the reader of a pipe is gone, ends by SIGPIPE as usual. */
static int finish_output(shell *sh, int status) {
    record_end(sh, false);
    if (sh->share.out)
        sh->out = sh->share.out;
    status = status == EXIT_OK && sh->lost ? EXIT_ERROR : status;
    errno = 0;
    const bool bad = fflush(sh->out) || ferror(sh->out);
    if (bad && output_closed()) {
        shell_free(sh);
        signal(SIGPIPE, SIG_DFL);
        raise(SIGPIPE);
    }                                                    /* unreached: it has ended us */
    if ((bad || fclose(sh->out)) && status == EXIT_OK) { /* else an error has been reported before */
        fprintf(stderr, "error: cannot write to standard output: %s\n", strerror(errno ? errno : EIO));
        status = EXIT_ERROR;
    }
    shell_free(sh);
    return status;
}

int main(int argc, char **argv) {
    static shell sh;
    static char buffer[1 << 16];
    keep_closed();
    check_home();
    wishes w = {.color = "auto", .jobs = calloc((size_t)argc + 1, sizeof *w.jobs)};
    if (!w.jobs) {
        fputs("error: out of memory\n", stderr);
        return EXIT_ERROR;
    }
    if (!isatty(STDOUT_FILENO)) /* musl would write the first line at once, and forget its error by the end */
        setvbuf(stdout, buffer, _IOFBF, sizeof buffer);
    command_use(commands, holes);
    shell_init(&sh, stdout, stderr);
    int status = read_options(argc, argv, &w, &sh);
    set_signals();
    if (status == EXIT_OK && !w.done)
        status = run_wishes(&sh, &w);
    free(w.jobs);
    return finish_output(&sh, status);
}
