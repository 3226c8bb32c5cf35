/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Loaded before the C library: lets one allocation fail, or be the moment of an interrupt. Counting begins
 * when a file named `arm` is closed, or with FAULT_EARLY at once, and ends when one named `disarm` is opened;
 * FAULT=n fails the n-th (with FAULT_SIZE of those of so many bytes), with FAULT_INTERRUPT there is Ctrl-C
 * instead, and FAULT_COUNT names a file for how many there were. For glibc; with LEAKS the next library's
 * functions allocate, which may be a leak detector's. What curses allocates is left alone: it crashes where
 * it cannot. */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdarg.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/syscall.h>
#include <unistd.h>

#ifdef LEAKS
static _Alignas(16) char early[4096]; /* for dlsym, which allocates */
static size_t used;
static int asking;
static struct {
    void *(*malloc)(size_t), *(*calloc)(size_t, size_t), *(*realloc)(void *, size_t),
        *(*aligned)(size_t, size_t);
    void (*free)(void *);
} next;

/* All at once: dlsym frees, too. */
static int ready(void) {
    static const char *const names[] = {"malloc", "calloc", "realloc", "aligned_alloc", "free"};
    void *found[5];
    if (!next.free && !asking) {
        asking = 1;
        for (int i = 0; i < 5; i++)
            found[i] = dlsym(RTLD_NEXT, names[i]);
        memcpy(&next, found, sizeof next);
        asking = 0;
    }
    return !asking;
}

static void *begin(size_t size) {
    void *p = early + used;
    used += (size + 15) / 16 * 16;
    return used <= sizeof early ? p : NULL;
}

static int is_early(const void *p) {
    return (uintptr_t)p - (uintptr_t)early < sizeof early;
}

static void *__libc_malloc(size_t size) {
    return ready() ? next.malloc(size) : begin(size);
}

static void *__libc_calloc(size_t count, size_t size) {
    return ready() ? next.calloc(count, size) : begin(count * size);
}

static void *__libc_realloc(void *old, size_t size) {
    if (ready() && !is_early(old))
        return next.realloc(old, size);
    void *p = __libc_malloc(size);
    return p && old ? memcpy(p, old, size) : p;
}

static void *__libc_memalign(size_t alignment, size_t size) {
    return ready() ? next.aligned(alignment, size) : NULL;
}

void free(void *p) {
    if (ready() && !is_early(p))
        next.free(p);
}
#else
extern void *__libc_malloc(size_t size);
extern void *__libc_calloc(size_t count, size_t size);
extern void *__libc_realloc(void *old, size_t size);
extern void *__libc_memalign(size_t alignment, size_t size);
#endif

static int armed, arming = -1;
static long seen, wanted;
static size_t just;

static void arm(void) {
    const char *n = getenv("FAULT"), *size = getenv("FAULT_SIZE");
    wanted = n ? atol(n) : 0;
    just = size ? (size_t)atol(size) : 0;
    armed = 1;
}

__attribute__((constructor)) static void begin_early(void) {
    if (getenv("FAULT_EARLY"))
        arm();
}

static int is_curses(void *caller) {
    Dl_info where;
    return dladdr(caller, &where) &&
           (strstr(where.dli_fname, "libncurses") || strstr(where.dli_fname, "libtinfo"));
}

static int fails(void *caller, size_t size) {
    if (!armed || (just && size != just) || is_curses(caller) || ++seen != wanted)
        return 0;
    if (getenv("FAULT_INTERRUPT")) {
        kill(getpid(), SIGINT);
        return 0;
    }
    errno = ENOMEM;
    return 1;
}

void *malloc(size_t size) {
    return fails(__builtin_return_address(0), size) ? NULL : __libc_malloc(size);
}

void *calloc(size_t count, size_t size) {
    return fails(__builtin_return_address(0), count * size) ? NULL : __libc_calloc(count, size);
}

void *realloc(void *old, size_t size) {
    return fails(__builtin_return_address(0), size) ? NULL : __libc_realloc(old, size);
}

void *aligned_alloc(size_t alignment, size_t size) {
    return fails(__builtin_return_address(0), size) ? NULL : __libc_memalign(alignment, size);
}

/* the C library's own would hide who calls */
char *strdup(const char *text) {
    const size_t size = strlen(text) + 1;
    char *copy = fails(__builtin_return_address(0), size) ? NULL : __libc_malloc(size);
    return copy ? memcpy(copy, text, size) : NULL;
}

static int named(const char *path, const char *name) {
    const char *slash = strrchr(path, '/');
    return !strcmp(slash ? slash + 1 : path, name);
}

int open(const char *path, int flags, ...) {
    va_list args;
    va_start(args, flags);
    const mode_t mode = flags & O_CREAT ? va_arg(args, mode_t) : 0;
    va_end(args);
    if (named(path, "disarm"))
        armed = 0;
    const int fd = (int)syscall(SYS_openat, AT_FDCWD, path, flags, mode);
    if (named(path, "arm"))
        arming = fd;
    return fd;
}

int close(int fd) {
    if (fd == arming) {
        arm();
        arming = -1;
    }
    return (int)syscall(SYS_close, fd);
}

__attribute__((destructor)) static void tell(void) {
    const char *name = getenv("FAULT_COUNT");
    FILE *to = name ? fopen(name, "w") : NULL;
    if (to) {
        fprintf(to, "%ld\n", seen);
        fclose(to);
    }
}
