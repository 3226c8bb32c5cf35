/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Output files: written beside their target, then renamed over it. Depends on POSIX and text/error. */
#define _GNU_SOURCE /* mkostemp */
#include "text/file.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <pwd.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { LINKS = 40, PAUSE = 20 /* ms between two checks of the stop flag */ };

static bool cannot_write(const file_out *out, int code, calc_error *error) {
    return calc_errno(error, code, "cannot write %s", out->name);
}

static char *joined(const char *path, size_t n, const char *name) {
    char *text = malloc(n + strlen(name) + 1);
    if (text) {
        memcpy(text, path, n);
        strcpy(text + n, name);
    }
    return text;
}

char *file_expand(const char *name) {
    const char *home = NULL;
    if (name[0] == '~' && (name[1] == '/' || !name[1])) {
        home = getenv("HOME");
        const struct passwd *user = home && *home ? NULL : getpwuid(getuid());
        if (user)
            home = user->pw_dir;
    }
    return home && *home ? joined(home, strlen(home), name + 1) : strdup(name);
}

size_t file_own_path(char path[FILE_PATH], const char *variable, const char *otherwise, const char *file) {
    const char *given = getenv(variable), *home = getenv("HOME");
    const bool there = given && *given == '/';
    if (!there && !home)
        return 0;
    const int n = there ? snprintf(path, FILE_PATH, "%s/fret/%s", given, file)
                        : snprintf(path, FILE_PATH, "%s/%s/fret/%s", home, otherwise, file);
    return n >= FILE_PATH ? 0 : there ? strlen(given) : strlen(home) + 1;
}

/* The path of `name` in the directory of `path`. The caller frees it; NULL: out of memory. */
static char *beside(const char *path, const char *name) {
    const char *slash = strrchr(path, '/');
    return joined(path, slash ? (size_t)(slash - path) + 1 : 0, name);
}

bool file_ends(const char *name, const char *ending) {
    const size_t n = strlen(name), m = strlen(ending);
    return n >= m && !strcmp(name + n - m, ending);
}

/* The descriptor that a name such as /dev/stdout or /dev/fd/3 stands for, or -1. */
static int descriptor(const char *path) {
    static const struct {
        const char *name;
        int fd;
    } standard[] = {{"/dev/stdin", 0}, {"/dev/stdout", 1}, {"/dev/stderr", 2}};
    for (size_t i = 0; i < sizeof standard / sizeof *standard; i++)
        if (!strcmp(path, standard[i].name))
            return standard[i].fd;
    int fd, n = 0;
    const bool numbered =
        sscanf(path, "/dev/fd/%5d%n", &fd, &n) == 1 || sscanf(path, "/proc/self/fd/%5d%n", &fd, &n) == 1;
    return numbered && !path[n] ? fd : -1;
}

/* Follows the links of out->real by hand: realpath(3) fails in directories deeper than PATH_MAX. The target
 * of a dangling link will be created. Returns 0 or an error number. */
static int follow_links(file_out *out) {
    for (int i = 0; i < LINKS; i++) {
        if (descriptor(out->real) >= 0)
            return 0;
        char text[FILE_PATH];
        const ssize_t n = readlink(out->real, text, sizeof text - 1);
        if (n < 0)
            return errno == EINVAL || errno == ENOENT ? 0 : errno;
        text[n] = 0;
        char *next = *text == '/' ? strdup(text) : beside(out->real, text);
        if (!next)
            return ENOMEM;
        free(out->real);
        out->real = next;
    }
    return ELOOP;
}

/* Opens a device, a pipe or a copy of an open descriptor. A FIFO opens only when it has a reader: until then
 * this waits and watches the stop flag. Returns -1 with errno. */
static int open_direct(const char *path, file_stop stop) {
    int copy = descriptor(path);
    if (copy >= 0) {
        fflush(stdout); /* keeps the order of the output */
        return fcntl(copy, F_DUPFD_CLOEXEC, 3);
    }
    for (;;) {
        int fd = open(path, O_WRONLY | O_CLOEXEC | O_NOCTTY | O_NONBLOCK);
        if (fd >= 0) {
            int flags = fcntl(fd, F_GETFL);
            if (flags < 0 || fcntl(fd, F_SETFL, flags & ~O_NONBLOCK) < 0) {
                int code = errno;
                close(fd);
                errno = code;
                return -1;
            }
            return fd;
        }
        struct stat info;
        if (errno != ENXIO || stat(path, &info) || !S_ISFIFO(info.st_mode))
            return -1;
        if (stop && *stop) {
            errno = EINTR;
            return -1;
        }
        poll(NULL, 0, PAUSE);
    }
}

enum { KEPT = 64 }; /* enough for two recordings, the history, nested scripts and what they read */

/* The registered files: 1 + descriptor, or 0 for a free row. */
static int kept[KEPT] = {1 + STDIN_FILENO, 1 + STDOUT_FILENO, 1 + STDERR_FILENO};

void file_keep(int fd, bool open) {
    int i = 0;
    while (i < KEPT && kept[i] != (open ? 0 : 1 + fd))
        i++;
    if (i < KEPT)
        kept[i] = open ? 1 + fd : 0;
}

bool file_kept(const struct stat *info) {
    struct stat other;
    for (int i = 0; i < KEPT; i++)
        if (kept[i] && !fstat(kept[i] - 1, &other) && other.st_dev == info->st_dev &&
            other.st_ino == info->st_ino)
            return true;
    return false;
}

bool file_kept_error(const char *name, calc_error *error) {
    return calc_fail(error, 0, 0, "cannot write %s: this session is using it", name);
}

/* Creates the temporary file, with the target's owner and mode if it exists. Returns -1 with errno. */
static int open_part(file_out *out, const struct stat *old) {
    if (old && faccessat(AT_FDCWD, out->real, W_OK, AT_EACCESS))
        return -1;
    out->part = beside(out->real, ".fret-XXXXXX");
    if (!out->part) {
        errno = ENOMEM;
        return -1;
    }
    sigset_t before;
    file_signals_hold(&before);
    int fd = mkostemp(out->part, O_CLOEXEC), code = errno;
    if (fd >= 0) {
        mode_t mode = umask(0);
        umask(mode);
        mode = old ? old->st_mode & 07777 : 0666 & ~mode;
        out->guard = file_guard_file(out->part);
        /* fchown works for the superuser only; for others no set-user-ID bit may pass to a file of theirs */
        if (old && fchown(fd, old->st_uid, old->st_gid))
            mode &= 0777;
        if (out->guard < 0 || fchmod(fd, mode)) {
            code = out->guard < 0 ? ENOMEM : errno;
            close(fd);
            unlink(out->part);
            fd = -1;
        }
    }
    file_signals_release(&before);
    errno = code;
    return fd;
}

static void out_free(file_out *out) {
    file_unguard(out->guard);
    free(out->name);
    free(out->real);
    free(out->part);
    *out = (file_out){.guard = -1};
}

static bool open_error(file_out *out, int code, calc_error *error) {
    cannot_write(out, code, error);
    out_free(out);
    return false;
}

bool file_out_open(file_out *out, const char *name, file_stop stop, calc_error *error) {
    struct stat info;
    *out = (file_out){.guard = -1, .name = strdup(name), .real = file_expand(name)};
    if (!out->name || !out->real) {
        out_free(out);
        return calc_no_memory(error);
    }
    size_t n = strlen(out->real);
    int code = n && out->real[n - 1] != '/' ? follow_links(out) : n ? EISDIR : ENOENT;
    if (code)
        return open_error(out, code, error);
    out->existed = !stat(out->real, &info);
    if (!out->existed && errno != ENOENT)
        return open_error(out, errno, error);
    if (out->existed && S_ISDIR(info.st_mode))
        return open_error(out, EISDIR, error);
    bool direct = descriptor(out->real) >= 0 || (out->existed && !S_ISREG(info.st_mode));
    if (out->existed && !direct && file_kept(&info)) {
        out_free(out);
        return file_kept_error(name, error);
    }
    int fd = direct ? open_direct(out->real, stop) : open_part(out, out->existed ? &info : NULL);
    out->to = fd < 0 ? NULL : fdopen(fd, "w");
    if (out->to)
        return true;
    code = errno;
    if (fd >= 0) {
        close(fd);
        if (out->part)
            unlink(out->part);
    }
    return open_error(out, code, error);
}

/* A stream remembers that a write failed, but not why: another write to the lost file tells. */
static int write_error(const file_out *out) {
    static const char again[4096];
    return write(fileno(out->to), again, out->part ? sizeof again : 1) < 0 ? errno : EIO;
}

bool file_out_close(file_out *out, bool keep, file_report *report, calc_error *error) {
    if (!out->to)
        return true;
    struct stat info = {.st_size = 0};
    int code = fflush(out->to) ? errno : ferror(out->to) ? write_error(out) : 0;
    if (out->part && !code && keep && (fsync(fileno(out->to)) || fstat(fileno(out->to), &info)))
        code = errno;
    off_t end = out->part ? info.st_size : ftello(out->to);
    if (fclose(out->to) && !code)
        code = errno;
    sigset_t before;
    file_signals_hold(&before); /* once renamed, the file must not be removed by file_emergency */
    if (out->part && keep && !code && rename(out->part, out->real))
        code = errno;
    if (out->part && (!keep || code))
        unlink(out->part);
    file_unguard(out->guard);
    out->guard = -1;
    file_signals_release(&before);
    bool ok = !keep || !code;
    if (!ok)
        cannot_write(out, code, error);
    if (report)
        *report = (file_report){.overwrote = out->existed && out->part && keep,
                                .direct = !out->part,
                                .size = end > 0 ? (unsigned long long)end : 0};
    out_free(out);
    return ok;
}

void file_size_text(unsigned long long bytes, char text[16]) {
    static const char *const units[] = {"B", "kB", "MB", "GB", "TB", "PB", "EB"};
    double v = (double)bytes;
    size_t i = 0;
    for (; v >= 999.5; i++)
        v /= 1000;
    snprintf(text, 16, i && v < 9.95 ? "%.1f %s" : "%.0f %s", v, units[i]);
}
