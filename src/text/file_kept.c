/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What the session has open as long as it goes on: no other file takes its place. Knows descriptors alone. */
#include <sys/stat.h>
#include <unistd.h>

#include "text/file.h"

enum { KEPT = 16 }; /* a recording and the one after it, the history, transcripts in transcripts */

/* 1 + a descriptor, or 0. */
static int kept[KEPT] = {1 + STDOUT_FILENO, 1 + STDERR_FILENO};

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
