/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Files that grow during a session. Depends on POSIX and text/error. */
#include "text/file.h"

#include <errno.h>
#include <fcntl.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

enum { IN_USE = -1 };

/* Truncates the log if it is a regular file. Returns 0, an error number, or IN_USE. */
static int begin_log(file_log *log, bool *overwrote) {
    struct stat info;
    if (fstat(log->fd, &info) || fcntl(log->fd, F_SETFL, O_WRONLY | O_APPEND) < 0)
        return errno;
    log->regular = S_ISREG(info.st_mode);
    *overwrote = log->regular && info.st_size > 0;
    if (log->regular && file_kept(&info))
        return IN_USE;
    return log->regular && ftruncate(log->fd, 0) ? errno : 0;
}

bool file_log_open(file_log *log, const char *name, file_stop stop, bool *overwrote, calc_error *error) {
    char *real = file_expand(name);
    *log = (file_log){.fd = -1, .stop = stop, .name = strdup(name)};
    *overwrote = false;
    int code = real && log->name ? 0 : ENOMEM;
    if (!code) /* O_NONBLOCK: a FIFO without a reader is refused, not waited for */
        log->fd = open(real, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | O_NOCTTY | O_NONBLOCK, 0666);
    if (!code)
        code = log->fd < 0 ? errno : begin_log(log, overwrote);
    free(real);
    if (!code) {
        file_keep(log->fd, true);
        return true;
    }
    file_log_close(log);
    return code == IN_USE ? file_kept_error(name, error) : calc_errno(error, code, "cannot write %s", name);
}

bool file_log_add(file_log *log, const char *bytes, size_t n, calc_error *error) {
    for (size_t done = 0; done < n;) {
        const ssize_t more = write(log->fd, bytes + done, n - done);
        if (more >= 0) {
            done += (size_t)more;
        } else if (errno != EINTR || (log->stop && *log->stop)) {
            calc_errno(error, errno, "cannot write %s", log->name);
            if (log->regular && done && ftruncate(log->fd, log->length)) /* all or nothing */
                log->regular = false;
            return false;
        }
    }
    log->length += (off_t)n;
    return true;
}

void file_log_close(file_log *log) {
    if (log->fd >= 0) {
        file_keep(log->fd, false);
        close(log->fd);
    }
    free(log->name);
    *log = (file_log){.fd = -1};
}
