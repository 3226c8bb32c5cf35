/* SPDX-License-Identifier: GPL-3.0-or-later */
#include "plot/plot.h"

#include <errno.h>
#include <fcntl.h>
#include <math.h>
#include <spawn.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

extern char **environ;

/* Beyond this gnuplot's PNG takes minutes; thinning keeps every extreme. */
enum { THIN = 4000 };

bool plot_point(plot_series *s, double x, double y) {
    if (s->count == s->room) {
        size_t room = s->room ? 2 * s->room : 256;
        double *gx = realloc(s->x, room * sizeof *gx);
        if (gx)
            s->x = gx;
        double *gy = realloc(s->y, room * sizeof *gy);
        if (gy)
            s->y = gy;
        if (!gx || !gy)
            return false;
        s->room = room;
    }
    s->x[s->count] = x;
    s->y[s->count++] = y;
    return true;
}

bool plot_title(plot_series *s, const char *title) {
    free(s->title);
    s->title = malloc(strlen(title) + 1);
    return s->title && strcpy(s->title, title);
}

void plot_free(plot_figure *f) {
    for (size_t i = 0; i < f->count; i++) {
        free(f->series[i].title);
        free(f->series[i].x);
        free(f->series[i].y);
    }
    *f = (plot_figure){.count = 0};
}

static bool fail(char *error, size_t size, const char *format, ...) {
    va_list args;
    va_start(args, format);
    vsnprintf(error, size, format, args);
    va_end(args);
    return false;
}

static void quoted(FILE *to, const char *text) {
    fputc('\'', to);
    for (; *text; text++)
        if (*text == '\'')
            fputs("''", to);
        else if ((unsigned char)*text >= 0x20)
            fputc(*text, to);
    fputc('\'', to);
}

/* Each bucket of points gives its first, lowest, highest and last, in their order. */
static void write_points(FILE *to, const plot_series *s) {
    size_t buckets = THIN / 4, each = s->count <= THIN ? 1 : (s->count + buckets - 1) / buckets;
    for (size_t i = 0; i < s->count; i += each) {
        size_t end = i + each < s->count ? i + each : s->count, pick[4] = {i, i, i, end - 1};
        for (size_t j = i; j < end; j++) {
            if (s->y[j] < s->y[pick[1]])
                pick[1] = j;
            if (s->y[j] > s->y[pick[2]])
                pick[2] = j;
        }
        if (pick[1] > pick[2]) {
            size_t swap = pick[1];
            pick[1] = pick[2];
            pick[2] = swap;
        }
        for (int p = 0; p < 4; p++)
            if (p == 0 || pick[p] != pick[p - 1])
                fprintf(to, "%.9g %.9g\n", s->x[pick[p]], s->y[pick[p]]);
    }
}

/* The script holds its data: it can be kept, edited and run again. */
static void write_script(FILE *to, const plot_figure *f, const char *terminal, const char *output) {
    static const char *const colors[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                         "#e69f00", "#56b4e9", "#000000"};
    fprintf(to, "# made by fret; run with gnuplot\n");
    for (size_t i = 0; i < f->count; i++) {
        fprintf(to, "$data%zu << END\n", i);
        write_points(to, &f->series[i]);
        fprintf(to, "END\n");
    }
    if (terminal)
        fprintf(to, "set terminal %s\n", terminal);
    if (output) {
        fprintf(to, "set output ");
        quoted(to, output);
        fputc('\n', to);
    }
    bool dumb = terminal && !strncmp(terminal, "dumb", 4);
    char title[3 * PLOT_LABEL];
    /* dumb terminals have no room for an upright label: it goes into the title */
    snprintf(title, sizeof title, dumb ? "%s: %s" : "%s", f->title, f->ylabel);
    fprintf(to, "set title ");
    quoted(to, dumb && strstr(f->ylabel, f->title) ? f->ylabel : title);
    fprintf(to, " noenhanced\nset xlabel ");
    quoted(to, f->xlabel);
    fprintf(to, " noenhanced\nset ylabel ");
    quoted(to, dumb ? "" : f->ylabel);
    fprintf(to, " noenhanced\nset grid\nset xzeroaxis\n%s%s", f->logx ? "set logscale x\n" : "",
            f->logy ? "set logscale y\nset format '%.0e'\n" : "");
    bool keys = f->count > 1;
    const char *key = !keys     ? "off"
                      : !dumb   ? "outside right noenhanced"
                      : f->logy ? "bottom right noenhanced"
                                : "top left noenhanced";
    fprintf(to, "set key %s\n", key);
    if (dumb)
        fprintf(to, "unset grid\n");
    for (size_t i = 0; i < f->count; i++) {
        fprintf(to, "%s $data%zu using 1:2 with %s lw 2 lc rgb '%s' title ", i ? "," : "plot", i,
                f->points ? dumb ? "linespoints" : "linespoints pt 7 ps 1.2" : "lines",
                colors[i % (sizeof colors / sizeof *colors)]);
        quoted(to, f->series[i].title ? f->series[i].title : "");
        fprintf(to, i + 1 < f->count ? " \\\n" : "\n");
    }
    if (output)
        fprintf(to, "unset output\n");
}

static double seconds(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static bool is_flat(const plot_figure *f) {
    for (size_t i = 0; i < f->count; i++)
        if (f->series[i].count)
            return false;
    return true;
}

/* Runs gnuplot on the script in dir; its output in dir/out and dir/err. */
static bool run(const char *dir, const plot_target *target, char *error, size_t size) {
    char script[300], out[300], err[300];
    snprintf(script, sizeof script, "%s/plot.gp", dir);
    snprintf(out, sizeof out, "%s/out", dir);
    snprintf(err, sizeof err, "%s/err", dir);
    posix_spawn_file_actions_t actions;
    posix_spawnattr_t attributes;
    posix_spawn_file_actions_init(&actions);
    posix_spawnattr_init(&attributes);
    posix_spawn_file_actions_addopen(&actions, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_addopen(&actions, 1, out, O_WRONLY | O_CREAT | O_TRUNC, 0600);
    posix_spawn_file_actions_addopen(&actions, 2, err, O_WRONLY | O_CREAT | O_TRUNC, 0600);
    /* a group of its own: Ctrl-C reaches fret alone, which then ends it whole */
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    posix_spawnattr_setpgroup(&attributes, 0);
    char *argv[] = {"gnuplot", "-d", script, NULL};
    pid_t pid;
    int rc = posix_spawnp(&pid, "gnuplot", &actions, &attributes, argv, environ);
    posix_spawn_file_actions_destroy(&actions);
    posix_spawnattr_destroy(&attributes);
    if (rc)
        return fail(error, size,
                    rc == ENOENT
                        ? "plots need gnuplot, which is not installed (Debian: apt-get install gnuplot-nox)"
                        : "cannot run gnuplot: %s",
                    strerror(rc));
    double limit = seconds() + target->timeout;
    int status = 0;
    for (;;) {
        pid_t done = waitpid(pid, &status, WNOHANG);
        if (done == pid)
            break;
        bool stopped = target->stop && *target->stop, late = seconds() > limit;
        if (stopped || late || (done < 0 && errno != EINTR)) {
            kill(-pid, SIGKILL);
            waitpid(pid, &status, 0);
            return stopped ? fail(error, size, "interrupted")
                           : fail(error, size, "gnuplot gave no picture within %g s and was stopped",
                                  target->timeout);
        }
        nanosleep(&(struct timespec){0, 1000000}, NULL);
    }
    if (WIFEXITED(status) && WEXITSTATUS(status) == 0)
        return true;
    if (WIFEXITED(status) && WEXITSTATUS(status) == 127)
        return fail(error, size,
                    "plots need gnuplot, which is not installed (Debian: apt-get install gnuplot-nox)");
    char line[200] = "", last[200] = "";
    FILE *f = fopen(err, "r");
    while (f && fgets(line, sizeof line, f))
        if (line[0] != '\n' && line[0] != '^' && !strstr(line, "plot.gp\", line"))
            snprintf(last, sizeof last, "%s", line);
        else if (strstr(line, "plot.gp\", line"))
            snprintf(last, sizeof last, "%s", strstr(line, ", line") + 2);
    if (f)
        fclose(f);
    last[strcspn(last, "\n")] = 0;
    return fail(error, size, "gnuplot failed: %s", *last ? last : "no message");
}

static void clear(const char *dir) {
    static const char *const names[] = {"plot.gp", "out", "err"};
    char path[300];
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        snprintf(path, sizeof path, "%s/%s", dir, names[i]);
        unlink(path);
    }
    rmdir(dir);
}

static bool close_checked(FILE *f) {
    bool bad = ferror(f) != 0;
    return fclose(f) == 0 && !bad;
}

static bool copy_out(const char *dir, const plot_target *target, char *error, size_t size) {
    char path[300], buf[4096];
    snprintf(path, sizeof path, "%s/out", dir);
    FILE *f = fopen(path, "r");
    if (!f)
        return fail(error, size, "gnuplot drew nothing");
    size_t n;
    bool leading = true;
    while (fgets(buf, sizeof buf, f)) {
        n = strlen(buf);
        /* dumb begins with a form feed and an empty line, and pads with blanks */
        while (n && (buf[n - 1] == '\n' || buf[n - 1] == ' ' || buf[n - 1] == '\f'))
            n--;
        if (leading && n == 0)
            continue;
        leading = false;
        fwrite(buf[0] == '\f' ? buf + 1 : buf, 1, buf[0] == '\f' ? n - 1 : n, target->out);
        fputc('\n', target->out);
    }
    fclose(f);
    return true;
}

static bool draw_in(const char *dir, plot_figure *f, const plot_target *target, const char *terminal,
                    const char *partial, char *error, size_t size) {
    char path[300];
    snprintf(path, sizeof path, "%s/plot.gp", dir);
    FILE *script = fopen(path, "w");
    if (!script)
        return fail(error, size, "cannot write %s: %s", path, strerror(errno));
    write_script(script, f, terminal, partial);
    if (!close_checked(script))
        return fail(error, size, "cannot write %s: %s", path, strerror(errno));
    if (!run(dir, target, error, size))
        return false;
    return partial || copy_out(dir, target, error, size);
}

/* The terminal of gnuplot that draws to the target; empty for a script. */
static bool choose_terminal(const plot_target *target, char *terminal, size_t room, char *error,
                            size_t size) {
    const char *dot = target->file ? strrchr(target->file, '.') : NULL;
    int w = target->width, h = target->height;
    terminal[0] = 0;
    if (!target->file)
        snprintf(terminal, room, "dumb size %d,%d noenhanced", w, h);
    else if (dot && !strcmp(dot, ".png"))
        snprintf(terminal, room, "pngcairo size %d,%d font 'Sans,11'", w ? w : 900, h ? h : 675);
    else if (dot && !strcmp(dot, ".svg"))
        snprintf(terminal, room, "svg size %d,%d font 'Sans,11' background rgb 'white'", w ? w : 900,
                 h ? h : 675);
    else if (dot && !strcmp(dot, ".pdf"))
        snprintf(terminal, room, "pdfcairo size 16cm,12cm font 'Sans,11'");
    else if (!dot || strcmp(dot, ".gp"))
        return fail(error, size, "cannot tell the kind of picture from '%s': use .png, .svg, .pdf or .gp",
                    target->file);
    return true;
}

enum { PARTIAL = 4200 };

/* Written beside its target and renamed: never a half-written file. */
static FILE *open_partial(const char *file, char partial[PARTIAL], char *error, size_t size) {
    if (strlen(file) > 4000) {
        fail(error, size, "the file name is too long");
        return NULL;
    }
    snprintf(partial, PARTIAL, "%s.%ld.part", file, (long)getpid());
    FILE *to = fopen(partial, "w");
    if (!to)
        fail(error, size, "cannot write %s: %s", file, strerror(errno));
    return to;
}

bool plot_check(const char *file, char *error, size_t size) {
    char terminal[128], partial[PARTIAL];
    if (!choose_terminal(&(plot_target){.file = file}, terminal, sizeof terminal, error, size))
        return false;
    FILE *probe = open_partial(file, partial, error, size);
    if (!probe)
        return false;
    fclose(probe);
    unlink(partial);
    return true;
}

bool plot_draw(plot_figure *f, const plot_target *target, char *error, size_t size) {
    char terminal[128], dir[256], partial[PARTIAL];
    if (is_flat(f))
        return fail(error, size, "there is nothing to plot");
    if (!choose_terminal(target, terminal, sizeof terminal, error, size))
        return false;

    if (target->file) {
        FILE *probe = open_partial(target->file, partial, error, size);
        if (!probe)
            return false;
        if (!*terminal)
            write_script(probe, f, NULL, NULL);
        if (!close_checked(probe)) {
            int code = errno;
            unlink(partial);
            return fail(error, size, "cannot write %s: %s", target->file, strerror(code));
        }
    }
    bool ok = true;
    if (*terminal) {
        const char *tmp = getenv("TMPDIR");
        snprintf(dir, sizeof dir, "%.200s/fret-XXXXXX", tmp && *tmp ? tmp : "/tmp");
        if (!mkdtemp(dir)) {
            if (target->file)
                unlink(partial);
            return fail(error, size, "cannot make a temporary directory in %.200s: %s",
                        tmp && *tmp ? tmp : "/tmp", strerror(errno));
        }
        char absolute[8500];
        char cwd[4200];
        const char *output = NULL;
        if (target->file) {
            output = partial;
            if (partial[0] != '/' && getcwd(cwd, sizeof cwd)) {
                snprintf(absolute, sizeof absolute, "%s/%s", cwd, partial);
                output = absolute;
            }
        }
        ok = draw_in(dir, f, target, terminal, output, error, size);
        clear(dir);
    }
    if (target->file && ok) {
        struct stat info;
        if (stat(partial, &info) || info.st_size == 0)
            ok = fail(error, size, "cannot write %s: gnuplot left an empty file", target->file);
        else if (rename(partial, target->file))
            ok = fail(error, size, "cannot write %s: %s", target->file, strerror(errno));
    }
    if (target->file && !ok)
        unlink(partial);
    return ok;
}
