/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Files: output that replaces its target completely or not at all, logs that grow, input by lines, and what
 * to clean up when a signal ends the program. Depends on POSIX, iconv and text/error. */
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

/* The stop flag, set by a signal handler; NULL: the work cannot be stopped. */
typedef const volatile sig_atomic_t *file_stop;

/* The name with a leading `~` or `~/` expanded; the caller frees it. NULL: out of memory. */
char *file_expand(const char *name);
/* The path DIR/fret/FILE, where DIR is the value of the environment variable if that is an absolute path,
 * else HOME/OTHERWISE. XDG ignores relative paths: the current directory may be a stranger's. Returns the
 * length of the beginning that the caller must not create; 0: no such directory. */
enum { FILE_PATH = 4096 };
size_t file_own_path(char path[FILE_PATH], const char *variable, const char *otherwise, const char *file);
/* Does the name end in `ending`, as ".csv"? */
bool file_ends(const char *name, const char *ending);

/* ---- output ------------------------------------------------------------------------------------- */

/* The outcome of writing a file. */
typedef struct file_report {
    bool overwrote;          /* the target existed and was replaced */
    bool direct;             /* a device or pipe was written: nothing was replaced */
    unsigned long long size; /* bytes written */
} file_report;

/* An open output file. A regular file is written under a temporary name beside its target (symbolic links
 * followed) and renamed over the target, with the target's mode, when it is complete; devices, pipes and the
 * descriptors named by /dev/stdout or /dev/fd/N are written directly. */
typedef struct file_out {
    FILE *to;   /* NULL: not open */
    char *name; /* as given, for messages */
    char *real; /* the target with symbolic links followed */
    char *part; /* the temporary name; NULL: written directly */
    int guard;  /* of the temporary file, for file_unguard */
    bool existed;
} file_out;

/* Opens a file for writing. Refuses directories, targets without permission to write, and files that the
 * session has open (file_keep). On failure returns false with the error and leaves no file behind. */
bool file_out_open(file_out *out, const char *name, file_stop stop, calc_error *error);

/* Closes the file and puts it in its place, or discards it if `keep` is false: the target is then as it was.
 * False with the error if a byte was lost; true if discarded. The report may be NULL. */
bool file_out_close(file_out *out, bool keep, file_report *report, calc_error *error);

/* A stream that passes its bytes to `take`, which returns how many it has accepted; NULL: out of memory. */
typedef ssize_t file_take(void *self, const char *bytes, size_t n);
FILE *file_stream(void *self, file_take *take);

/* A text in memory, written through a stream. Not open_memstream(3): that drops bytes silently when memory
 * runs out. The struct must not move while it is open. */
typedef struct file_text {
    FILE *to;
    char *text; /* after file_text_close, NUL-terminated; the caller frees it */
    size_t size, room;
    bool lost; /* out of memory: bytes are missing */
} file_text;

/* Both return false when memory is out; then there is nothing to free. */
bool file_text_open(file_text *t);
bool file_text_close(file_text *t);

/* Writes a size as "812 B", "12 kB" or "3.4 MB". */
void file_size_text(unsigned long long bytes, char text[16]);

/* A file that grows during a session, under its final name: what is written stays if the program crashes. */
typedef struct file_log {
    int fd; /* -1: not open */
    char *name;
    bool regular; /* a file that can be truncated, not a device or pipe */
    off_t length;
    file_stop stop;
} file_log;

bool file_log_open(file_log *log, const char *name, file_stop stop, bool *overwrote, calc_error *error);
/* Appends all the bytes or none. */
bool file_log_add(file_log *log, const char *bytes, size_t n, calc_error *error);
void file_log_close(file_log *log);

/* Registers (open) or removes a descriptor that the session keeps open: a recording, the history, a file that
 * is being read. The standard streams are always registered. Output must not replace such a file: what the
 * session writes there, or the user's data, would be lost. */
void file_keep(int fd, bool open);
struct stat;
/* Is it a registered file? */
bool file_kept(const struct stat *info);
/* Raises the error that a registered file cannot be written; returns false. */
bool file_kept_error(const char *name, calc_error *error);

/* ---- input -------------------------------------------------------------------------------------- */

enum { FILE_LINE_LIMIT = 16 << 20 }; /* most bytes of a line with its continuation lines */

typedef enum file_got { FILE_GOT_LINE, FILE_GOT_END, FILE_GOT_ERROR, FILE_GOT_STOP } file_got;

/* Callback: the next lines that the user types, without the last newline; the reader frees them. NULL: no
 * more, or interrupted if the stop flag is set. continued: they continue an unfinished line. */
typedef char *file_ask(bool continued);

/* An input read by lines: UTF-8 with or without a byte order mark, or UTF-16, which is converted to UTF-8. */
typedef struct file_in {
    int fd;              /* -1: not open */
    file_ask *ask;       /* the source of lines in place of a file, or NULL */
    bool owned;          /* file_in_close closes fd */
    bool ended;          /* it has been read to its end */
    bool waits;          /* reading may block: poll first */
    bool encoding_known; /* the first bytes have been read */
    iconv_t decoder;     /* of UTF-16, or NULL */
    size_t incomplete;   /* bytes of an incomplete UTF-16 character */
    char *name;
    char *block;
    size_t at, have; /* index of the next byte in the block, and bytes in it */
    char *line;      /* the last line read without its end, NUL-terminated; it may hold NULs */
    size_t length, room;
    unsigned long long number; /* of the first physical line of `line`, from 1 */
    unsigned long long read;   /* physical lines read so far */
    file_stop stop;
} file_in;

/* Opens a file; refuses directories. A FIFO without a writer blocks the first read, not this call. */
bool file_in_open(file_in *in, const char *name, file_stop stop, calc_error *error);
/* Reads an open descriptor, which file_in_close leaves open; `name` is for messages. */
bool file_in_take(file_in *in, int fd, const char *name, file_stop stop, calc_error *error);

/* Opens a file of statements; `-` is standard input. */
bool file_in_script(file_in *in, const char *name, file_stop stop, calc_error *error);
/* Reads lines from a copy of a text in memory, or from the callback. */
bool file_in_text(file_in *in, const char *text, const char *name, file_stop stop, calc_error *error);
bool file_in_typed(file_in *in, file_ask *ask, file_stop stop, calc_error *error);

/* Reads the next physical line into in->line. FILE_GOT_END: there is none; FILE_GOT_ERROR: reading failed,
 * memory is out or the line exceeds FILE_LINE_LIMIT; FILE_GOT_STOP: the stop flag is set. */
file_got file_in_line(file_in *in, calc_error *error);
/* Appends the lines that continue in->line, each after a newline; prompts and `\` become blanks. */
file_got file_in_rest(file_in *in, calc_error *error);
/* file_in_line, then file_in_rest: a logical line. */
file_got file_in_logical(file_in *in, calc_error *error);

void file_in_close(file_in *in);

/* ---- clean-up when a signal ends the program ---------------------------------------------------- */

/* Does the signal (1 to FILE_SIGNALS - 1) end a program by default? False for SIGINT, SIGPIPE, SIGXFSZ,
 * SIGKILL and those of a crash: they are handled elsewhere or not at all. */
#define FILE_SIGNALS NSIG
bool file_signal_ends(int number);

/* Block those signals and SIGINT, and restore the mask: between, create something and list it below. */
void file_signals_hold(sigset_t *before);
void file_signals_release(const sigset_t *before);

/* List what file_emergency has to undo: a file, a process group, a terminal with the modes to restore and the
 * bytes to send (not copied). Return a number for file_unguard; -1: list full or out of memory, give up. */
int file_guard_file(const char *path);
int file_guard_group(pid_t group);
int file_guard_terminal(const struct termios *modes, const char *farewell);
void file_unguard(int guard);

/* Kills listed groups, restores terminals, removes files. For signal handlers: no memory, no lock. */
void file_emergency(void);

#endif
