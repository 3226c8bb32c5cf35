/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The one room for files: output that replaces its target whole or not at all, logs that grow, input by lines
 * that tells every failure from the end of the file, and a list of what must go when a signal ends the
 * program. */
#ifndef TEXT_FILE_H
#define TEXT_FILE_H

#include <iconv.h>
#include <signal.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <sys/types.h>
#include <termios.h>

#include "text/error.h"

/* Set by a signal handler; NULL: nothing can stop the work. */
typedef const volatile sig_atomic_t *file_stop;

/* A name as the shell takes it: `~` and `~/...` are the home directory. To be freed; NULL: out of memory. */
char *file_expand(const char *name);
/* The path of a file of the program's own, in the directory that the variable names, else in the one below
 * home. Returns how much of it is not ours to make; 0: nowhere. A relative directory is none, as the XDG
 * specification has it: what lies in the current directory may be a stranger's. */
enum { FILE_PATH = 4096 };
size_t file_own_path(char path[FILE_PATH], const char *variable, const char *otherwise, const char *file);
/* Is this the ending of the name, as ".csv"? */
bool file_ends(const char *name, const char *ending);

/* ---- output ------------------------------------------------------------------------------------- */

/* What became of an output file. */
typedef struct file_report {
    bool overwrote;          /* the target held a file before */
    bool direct;             /* a device or pipe: nothing was replaced */
    unsigned long long size; /* bytes written */
} file_report;

/* A file on its way out. A regular target is written under another name in its own directory (symbolic links
 * followed) and takes its place, with its mode, when it is whole; devices, pipes and the open files behind
 * /dev/stdout and /dev/fd are written directly. */
typedef struct file_out {
    FILE *to;   /* NULL: not open */
    char *name; /* as given, for messages */
    char *real; /* what links lead to */
    char *part; /* NULL: direct */
    int guard;
    bool existed;
} file_out;

/* Refuses directories, targets without permission to write, and what the session is using (file_keep).
 * False with the error, and nothing left behind. */
bool file_out_open(file_out *out, const char *name, file_stop stop, calc_error *error);

/* Puts the file in its place, or gives it up when `keep` is false: the target is then as it was. False with
 * the error when a byte was lost; true when given up. The report may be NULL. */
bool file_out_close(file_out *out, bool keep, file_report *report, calc_error *error);

/* A stream whose bytes go to the function, which answers how many it has taken; NULL: out of memory. */
typedef ssize_t file_take(void *self, const char *bytes, size_t n);
FILE *file_stream(void *self, file_take *take);

/* A text written as a file is. open_memstream(3) will not do: it loses in silence what finds no memory. It
 * stays where it is while it is open. */
typedef struct file_text {
    FILE *to;
    char *text; /* after closing, NUL-terminated and to be freed */
    size_t size, room;
    bool lost;
} file_text;

/* Both false: out of memory, and nothing is to be freed. */
bool file_text_open(file_text *t);
bool file_text_close(file_text *t);

/* "812 B", "12 kB", "3.4 MB": at most 15 bytes. */
void file_size_text(unsigned long long bytes, char text[16]);

/* A file that grows as a session goes on: in its place from the beginning, and what has been written stays,
 * whatever ends the program. */
typedef struct file_log {
    int fd; /* -1: not open */
    char *name;
    bool regular;
    off_t length;
    file_stop stop;
} file_log;

bool file_log_open(file_log *log, const char *name, file_stop stop, bool *overwrote, calc_error *error);
/* Whole or not at all. */
bool file_log_add(file_log *log, const char *bytes, size_t n, calc_error *error);
void file_log_close(file_log *log);

/* What is open as long as the session goes on, besides standard output and standard error: a recording, the
 * history, a transcript that is replayed; or not any more. Another file in its
 * place would lose what has been written there, or is going to be. */
void file_keep(int fd, bool open);
struct stat;
/* Is it behind one of these? */
bool file_kept(const struct stat *info);
/* "cannot write NAME: ...", for such a one; false. */
bool file_kept_error(const char *name, calc_error *error);

/* ---- input -------------------------------------------------------------------------------------- */

enum { FILE_LINE_LIMIT = 16 << 20 }; /* bytes of a line, continued or not */

typedef enum file_got { FILE_GOT_LINE, FILE_GOT_END, FILE_GOT_ERROR, FILE_GOT_STOP } file_got;

/* More lines as someone types them, without the end of the last, to be freed; NULL: no more, or not now,
 * where the stop flag is set. continued: of a line that goes on. */
typedef char *file_ask(void *self, bool continued);

/* A file read by lines. Where it begins with a mark of byte order, it is UTF-8, or UTF-16 that becomes UTF-8.
 */
typedef struct file_in {
    int fd;        /* -1: not open */
    file_ask *ask; /* in place of a file, or NULL */
    void *self;    /* for it */
    bool owned, ended, waits, told;
    iconv_t decoder; /* of UTF-16, or NULL */
    size_t halves;   /* bytes that are no whole character yet */
    char *name;
    char *block;
    size_t at, have; /* of the block */
    char *line;      /* the last line, without its end, NUL after it; it may hold NULs */
    size_t length, room;
    unsigned long long number; /* of the line's first physical line, from 1 */
    unsigned long long read;   /* physical lines so far */
    file_stop stop;
} file_in;

/* Refuses directories. A FIFO without a writer is waited for when it is read, not here. */
bool file_in_open(file_in *in, const char *name, file_stop stop, calc_error *error);
/* Reads an open descriptor, which stays open; `name` is for messages. */
bool file_in_take(file_in *in, int fd, const char *name, file_stop stop, calc_error *error);

/* A file of statements: `-` is standard input. */
bool file_in_script(file_in *in, const char *name, file_stop stop, calc_error *error);
/* Reads a text that is in memory; or what is typed. */
bool file_in_text(file_in *in, const char *text, const char *name, file_stop stop, calc_error *error);
bool file_in_typed(file_in *in, file_ask *ask, void *self, file_stop stop, calc_error *error);

/* The next line in in->line and in->length. FILE_GOT_ERROR: reading failed, memory ran out or the line is
 * longer than the limit; FILE_GOT_STOP: the stop flag was set. Neither ever passes for the end. */
file_got file_in_line(file_in *in, calc_error *error);
/* The lines that continue it, behind it: marks and the prompts that lines begin with become blanks, the
 * ends of lines newlines. */
file_got file_in_rest(file_in *in, calc_error *error);
/* Both: a logical line. */
file_got file_in_logical(file_in *in, calc_error *error);

void file_in_close(file_in *in);

/* ---- what must not stay behind ------------------------------------------------------------------ */

/* The signals that end a program at which nothing is done about them, but for Ctrl-C and crashes. Numbers are
 * 1 to FILE_SIGNALS - 1. */
#define FILE_SIGNALS NSIG
bool file_signal_ends(int number);

/* The calls between hold the signals that end the program back: what is made is then listed, or not made. */
void file_signals_hold(sigset_t *before);
void file_signals_release(const sigset_t *before);

/* List a file, a process group, or the terminal with the modes to go back to and the bytes to send it (not
 * copied). Returns a number for file_unguard, -1 when the list is full or memory is out: do not go on then.
 */
int file_guard_file(const char *path);
int file_guard_group(pid_t group);
int file_guard_terminal(const struct termios *modes, const char *farewell);
void file_unguard(int guard);

/* Kills the groups, puts terminals right, removes files. For signal handlers: it takes no
 * memory and no lock. */
void file_emergency(void);

#endif
