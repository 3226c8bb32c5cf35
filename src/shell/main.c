/* SPDX-License-Identifier: GPL-3.0-or-later */
#include <errno.h>
#include <getopt.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "calc/file.h"
#include "shell/command.h"

#ifndef FRET_VERSION
#define FRET_VERSION "unknown"
#endif

static const char usage[] =
    "usage: fret [OPTION...] [FILE...]\n"
    "  Calculates partial-slip contact of graded elastic solids. Without FILE or -c, reads\n"
    "  standard input: with line editing at a terminal, as a script otherwise.\n\n"
    "  -f FILE             run a script (- is standard input)\n"
    "  -c STATEMENTS       run these statements\n"
    "  --replay FILE       run a transcript and compare; exit 1 where it differs\n"
    "  --tolerance X       relative tolerance of numbers in a replay\n"
    "  --format=FORMAT     text, csv or json\n"
    "  --keep-going        go on after an error\n"
    "  --quiet             no banner\n"
    "  --no-rc             do not read the start-up file\n"
    "  --color=WHEN        auto, always or never\n"
    "  --version, --help\n\n"
    "  exit status: 0 fine, 1 an error, 2 wrong usage, 130 interrupted\n";

static void on_interrupt(int signal) {
    (void)signal;
    shell_stop = 1;
}

/* Nothing half made stays behind; then the signal does what it does. */
static void on_end(int number) {
    file_emergency();
    signal(number, SIG_DFL);
    raise(number);
}

static int bad_usage(const char *what, const char *word) {
    fprintf(stderr, "fret: %s%s%s\ntry: fret --help\n", what, word ? " " : "", word ? word : "");
    return EXIT_USAGE;
}

/* The option getopt stopped at: C libraries differ in where argv stands then. */
static const char *option_word(const struct option *o, char **argv) {
    static char word[32];
    while (o->name && o->val != optopt)
        o++;
    if (!optopt)
        return argv[optind - 1];
    if (o->name)
        snprintf(word, sizeof word, "--%s", o->name);
    else
        snprintf(word, sizeof word, "-%c", optopt);
    return word;
}

/* A lost write is an error. */
static int finish(shell *sh, int status) {
    errno = 0;
    bool bad = ferror(sh->out) != 0;
    if (fflush(sh->out) || bad || fclose(sh->out)) {
        if (status == EXIT_OK) { /* else the write has been reported, or something before it */
            fprintf(stderr, "error: cannot write to standard output: %s\n", strerror(errno ? errno : EIO));
            status = EXIT_ERROR;
        }
    }
    shell_free(sh);
    return status;
}

static int run_text(shell *sh, const char *text, bool keep_going) {
    FILE *in = *text ? fmemopen((void *)(size_t)text, strlen(text), "r") : NULL;
    if (!*text)
        return EXIT_OK;
    if (!in) {
        fprintf(stderr, "error: %s\n", strerror(errno));
        return EXIT_ERROR;
    }
    int status = shell_stream(sh, in, "-c", keep_going);
    fclose(in);
    return status;
}

enum {
    OPT_REPLAY = 256,
    OPT_TOLERANCE,
    OPT_FORMAT,
    OPT_KEEP,
    OPT_QUIET,
    OPT_NO_RC,
    OPT_COLOR,
    OPT_VERSION,
    OPT_HELP
};

int main(int argc, char **argv) {
    static const struct option options[] = {{"replay", required_argument, NULL, OPT_REPLAY},
                                            {"tolerance", required_argument, NULL, OPT_TOLERANCE},
                                            {"format", required_argument, NULL, OPT_FORMAT},
                                            {"keep-going", no_argument, NULL, OPT_KEEP},
                                            {"quiet", no_argument, NULL, OPT_QUIET},
                                            {"no-rc", no_argument, NULL, OPT_NO_RC},
                                            {"color", required_argument, NULL, OPT_COLOR},
                                            {"version", no_argument, NULL, OPT_VERSION},
                                            {"help", no_argument, NULL, OPT_HELP},
                                            {NULL, 0, NULL, 0}};
    shell sh;
    bool keep_going = false, quiet = false, rc = true, ran = false;
    const char *replay = NULL, *color = "auto";
    double tolerance = 0;
    struct job {
        bool statements;
        const char *text;
    } *jobs = calloc((size_t)argc + 1, sizeof *jobs);
    size_t count = 0;
    if (!jobs) {
        fprintf(stderr, "error: out of memory\n");
        return EXIT_ERROR;
    }
    static char buffer[1 << 16];
    if (!isatty(STDOUT_FILENO)) /* musl writes the first line early: an error is forgotten by the end */
        setvbuf(stdout, buffer, _IOFBF, sizeof buffer);
    shell_init(&sh, stdout, stderr);
    int status = EXIT_OK, opt;
    opterr = 0;
    while (status == EXIT_OK && (opt = getopt_long(argc, argv, ":f:c:", options, NULL)) >= 0) {
        char *end;
        switch (opt) {
        case 'f':
        case 'c':
            jobs[count++] = (struct job){opt == 'c', optarg};
            break;
        case OPT_REPLAY:
            replay = optarg;
            break;
        case OPT_TOLERANCE:
            tolerance = strtod(optarg, &end);
            if (*end || end == optarg || !(tolerance >= 0) || !isfinite(tolerance))
                status = bad_usage("--tolerance needs a number, not", optarg);
            break;
        case OPT_FORMAT:
            if (!strcmp(optarg, "json"))
                sh.set.format = FORMAT_JSON;
            else if (!strcmp(optarg, "csv"))
                sh.set.format = FORMAT_CSV;
            else if (strcmp(optarg, "text"))
                status = bad_usage("--format is text, csv or json, not", optarg);
            break;
        case OPT_KEEP:
            keep_going = true;
            break;
        case OPT_QUIET:
            quiet = true;
            break;
        case OPT_NO_RC:
            rc = false;
            break;
        case OPT_COLOR:
            color = optarg;
            if (strcmp(color, "auto") && strcmp(color, "always") && strcmp(color, "never"))
                status = bad_usage("--color is auto, always or never, not", color);
            break;
        case OPT_VERSION:
            printf("fret %s\n", FRET_VERSION);
            ran = true;
            break;
        case OPT_HELP:
            fputs(usage, stdout);
            ran = true;
            break;
        case ':':
            status = bad_usage("an argument is missing after", option_word(options, argv));
            break;
        default:
            status = bad_usage("unknown option", option_word(options, argv));
            break;
        }
        if (ran)
            break;
    }
    for (int i = optind; i < argc && !ran && status == EXIT_OK; i++)
        jobs[count++] = (struct job){false, argv[i]};
    sh.set.color =
        !strcmp(color, "always") || (!strcmp(color, "auto") && isatty(STDERR_FILENO) && !getenv("NO_COLOR"));

    struct sigaction act = {.sa_handler = on_interrupt}; /* no SA_RESTART: a blocked read must return */
    sigaction(SIGINT, &act, NULL);
    signal(SIGPIPE, SIG_IGN);
    signal(SIGTERM, on_end);
    signal(SIGHUP, on_end);
    signal(SIGQUIT, on_end);

    if (status == EXIT_OK && !ran) {
        if (replay) {
            status = shell_replay(replay, tolerance, stdout, stderr);
        } else if (count) {
            for (size_t i = 0; i < count && !sh.quit; i++) {
                int one = jobs[i].statements           ? run_text(&sh, jobs[i].text, keep_going)
                          : !strcmp(jobs[i].text, "-") ? shell_stream(&sh, stdin, "stdin", keep_going)
                                                       : shell_file(&sh, jobs[i].text, keep_going);
                if (one != EXIT_OK)
                    status = one;
                if (one == EXIT_INTERRUPTED || (one != EXIT_OK && !keep_going))
                    break;
            }
        } else if (isatty(STDIN_FILENO)) {
            status = shell_prompt(&sh, quiet, rc);
        } else {
            status = shell_stream(&sh, stdin, "stdin", keep_going);
        }
    }
    free(jobs);
    return finish(&sh, status);
}
