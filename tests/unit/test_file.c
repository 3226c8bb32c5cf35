/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Files out and in: modes, links, pipes, limits, faults. The Makefile links this program so that some calls
 * pass through the functions here. */
#include "text/file.h"

#include <errno.h>
#include <fcntl.h>
#include <pwd.h>
#include <stdarg.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <sys/un.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include "unit.h"

#if defined(__SANITIZE_ADDRESS__)
#define SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define SANITIZED 1
#endif
#endif

/* ---- calls that fail ----------------------------------------------------------------------------- */

/* One of the calls of a name fails, with this errno: after so many that succeed; -1: none. */
typedef struct fault {
    int left, code;
} fault;
static fault no_malloc = {-1, 0}, no_realloc = {-1, 0}, no_strdup = {-1, 0}, no_fcntl = {-1, 0},
             no_fstat = {-1, 0}, no_ftruncate = {-1, 0}, no_stat = {-1, 0}, no_open = {-1, 0},
             no_fdopen = {-1, 0};

static bool fails(fault *f) {
    if (f->left < 0 || f->left-- > 0)
        return false;
    errno = f->code;
    return true;
}

void *__real_malloc(size_t size);
void *__wrap_malloc(size_t size);
void *__wrap_malloc(size_t size) {
    return fails(&no_malloc) ? NULL : __real_malloc(size);
}

void *__real_realloc(void *old, size_t size);
void *__wrap_realloc(void *old, size_t size);
void *__wrap_realloc(void *old, size_t size) {
    return fails(&no_realloc) ? NULL : __real_realloc(old, size);
}

char *__real_strdup(const char *text);
char *__wrap_strdup(const char *text);
char *__wrap_strdup(const char *text) {
    return fails(&no_strdup) ? NULL : __real_strdup(text);
}

int __real_fcntl(int fd, int what, ...);
int __wrap_fcntl(int fd, int what, ...);
int __wrap_fcntl(int fd, int what, ...) {
    va_list args;
    va_start(args, what);
    const int argument = what == F_GETFL ? 0 : va_arg(args, int);
    va_end(args);
    return fails(&no_fcntl) ? -1 : __real_fcntl(fd, what, argument);
}

int __real_open(const char *path, int flags, ...);
int __wrap_open(const char *path, int flags, ...);
int __wrap_open(const char *path, int flags, ...) {
    va_list args;
    va_start(args, flags);
    const int mode = flags & O_CREAT ? va_arg(args, int) : 0;
    va_end(args);
    return fails(&no_open) ? -1 : __real_open(path, flags, mode);
}

FILE *__real_fdopen(int fd, const char *mode);
FILE *__wrap_fdopen(int fd, const char *mode);
FILE *__wrap_fdopen(int fd, const char *mode) {
    return fails(&no_fdopen) ? NULL : __real_fdopen(fd, mode);
}

int __real_fstat(int fd, struct stat *info);
int __wrap_fstat(int fd, struct stat *info);
int __wrap_fstat(int fd, struct stat *info) {
    return fails(&no_fstat) ? -1 : __real_fstat(fd, info);
}

int __real_stat(const char *path, struct stat *info);
int __wrap_stat(const char *path, struct stat *info);
int __wrap_stat(const char *path, struct stat *info) {
    return fails(&no_stat) ? -1 : __real_stat(path, info);
}

int __real_ftruncate(int fd, off_t length);
int __wrap_ftruncate(int fd, off_t length);
int __wrap_ftruncate(int fd, off_t length) {
    return fails(&no_ftruncate) ? -1 : __real_ftruncate(fd, length);
}

/* Where the user is at home, as the system says; NULL: it knows no such user. */
static char *home_of_user;
struct passwd *__wrap_getpwuid(uid_t user);
struct passwd *__wrap_getpwuid(uid_t user) {
    static struct passwd someone;
    (void)user;
    someone.pw_dir = home_of_user;
    return home_of_user ? &someone : NULL;
}

static calc_error error;

static calc_error *fresh(void) {
    error_clear(&error);
    return &error;
}

static void put(const char *name, const char *text) {
    FILE *f = fopen(name, "w");
    if (CHECK(f != NULL)) {
        fputs(text, f);
        fclose(f);
    }
}

/* Is this the file's whole text? */
static bool holds(const char *name, const char *text) {
    char got[256] = "";
    FILE *f = fopen(name, "r");
    if (!f)
        return false;
    size_t n = fread(got, 1, sizeof got - 1, f);
    fclose(f);
    return n == strlen(text) && memcmp(got, text, n) == 0;
}

static mode_t mode_of(const char *name) {
    struct stat info;
    return stat(name, &info) ? 0 : info.st_mode & 07777;
}

/* Entries of the working directory. */
static int entries(void) {
    FILE *list = popen("ls -A | wc -l", "r");
    int n = -1;
    if (!list || fscanf(list, "%d", &n) != 1)
        n = -1;
    if (list)
        pclose(list);
    return n;
}

static bool write_text(const char *name, const char *text, bool keep, file_report *report) {
    file_out out;
    if (!file_out_open(&out, name, NULL, fresh()))
        return false;
    fputs(text, out.to);
    return file_out_close(&out, keep, report, fresh());
}

/* Runs a check in a process of its own. */
static void apart(bool (*check)(void)) {
    fflush(stdout);
    pid_t child = fork();
    if (child == 0)
        _exit(check() ? 0 : 1);
    int status = -1;
    CHECK(child > 0 && waitpid(child, &status, 0) == child && status == 0);
}

static void replaces(void) {
    file_report report;
    umask(022);
    CHECK(write_text("new", "one\n", true, &report));
    CHECK(!report.overwrote && !report.direct && report.size == 4 && mode_of("new") == 0644);
    CHECK(chmod("new", 0640) == 0);
    CHECK(write_text("new", "second\n", true, &report));
    CHECK(report.overwrote && report.size == 7 && mode_of("new") == 0640 && holds("new", "second\n"));
    CHECK(write_text("new", "third\n", false, &report) && holds("new", "second\n"));
    CHECK(write_text("none", "third\n", false, NULL) && access("none", F_OK) != 0);
    CHECK(entries() == 1);
    /* two writers at once: each is whole, the later one stays */
    file_out a, b;
    CHECK(file_out_open(&a, "new", NULL, fresh()) && file_out_open(&b, "new", NULL, fresh()));
    fputs("aaaa", a.to), fputs("b", b.to);
    CHECK(file_out_close(&b, true, NULL, fresh()) && file_out_close(&a, true, NULL, fresh()));
    CHECK(holds("new", "aaaa") && entries() == 1);
    unlink("new");
}

static void links(void) {
    struct stat info;
    CHECK(mkdir("sub", 0755) == 0);
    put("sub/target", "old");
    CHECK(symlink("sub/hop", "link") == 0 && symlink("target", "sub/hop") == 0);
    file_report report;
    CHECK(write_text("link", "new", true, &report) && report.overwrote && holds("sub/target", "new"));
    CHECK(lstat("link", &info) == 0 && S_ISLNK(info.st_mode));
    unlink("sub/target"); /* a link that leads nowhere */
    CHECK(write_text("link", "again", true, &report) && !report.overwrote && holds("sub/target", "again"));
    char there[2100], far[400] = "";
    CHECK(getcwd(there, 2000) != NULL);
    strcat(there, "/sub/target");
    CHECK(unlink("link") == 0 && symlink(there, "link") == 0); /* from the root */
    CHECK(write_text("link", "from the root", true, &report) && holds("sub/target", "from the root"));
    for (int i = 0; i < 150; i++)
        strcat(far, "./");
    strcat(far, "sub/target");
    CHECK(unlink("link") == 0 && symlink(far, "link") == 0); /* of a long name */
    CHECK(write_text("link", "a long way", true, &report) && holds("sub/target", "a long way"));
    CHECK(symlink("round", "round") == 0 && !write_text("round", "x", true, NULL));
    CHECK(strstr(error.text, "cannot write round: ") != NULL);
    unlink("round"), unlink("link"), unlink("sub/hop"), unlink("sub/target"), rmdir("sub");
    CHECK(entries() == 0);
}

static bool read_only(void) {
    if (geteuid() == 0 && (chmod(".", 0777) || setgid(65534) || setuid(65534)))
        return false;
    return !write_text("kept", "new", true, NULL) &&
           strstr(error.text, "cannot write kept: Permission denied") && holds("kept", "old") &&
           entries() == 1;
}

static void refused(void) {
    put("kept", "old");
    CHECK(chmod("kept", 0444) == 0);
    apart(read_only);
    unlink("kept");
    static const char *const names[] = {".",         "",           "new/",       "no/such/place",
                                        "\x01/x",    "/dev/fd/1x", "/dev/fd/x1", "/dev/fd/123456",
                                        "/dev/fd/:", "/dev/fd/",   "/dev/fd/-1", "/dev/fd/999"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++)
        CHECK(!write_text(names[i], "x", true, NULL) && strstr(error.text, "cannot write "));
    char long_name[400];
    memset(long_name, 'x', 300);
    long_name[300] = 0;
    CHECK(!write_text(long_name, "x", true, NULL) && strstr(error.text, "too long"));
    memset(long_name, 'y', 255);
    long_name[255] = 0;
    CHECK(write_text(long_name, "x", true, NULL) && holds(long_name, "x"));
    unlink(long_name);
}

static void pipes(void) {
    CHECK(mkfifo("pipe", 0600) == 0);
    static volatile sig_atomic_t stop = 1;
    file_out out;
    CHECK(!file_out_open(&out, "pipe", &stop, fresh())); /* nobody reads */
    fflush(stdout);
    pid_t child = fork();
    if (child == 0) {
        file_report report;
        _exit(write_text("pipe", "through\n", true, &report) && report.direct && !report.overwrote ? 0 : 1);
    }
    file_in in;
    int status = -1;
    CHECK(file_in_open(&in, "pipe", NULL, fresh()));
    CHECK(file_in_line(&in, fresh()) == FILE_GOT_LINE && !strcmp(in.line, "through"));
    CHECK(file_in_line(&in, fresh()) == FILE_GOT_END);
    file_in_close(&in);
    CHECK(waitpid(child, &status, 0) == child && status == 0);
    stop = 1; /* nobody writes */
    CHECK(file_in_open(&in, "pipe", &stop, fresh()) && file_in_line(&in, fresh()) == FILE_GOT_STOP);
    file_in_close(&in);
    unlink("pipe");
}

static bool to_open_file(void) {
    int fd = open("log", O_WRONLY | O_CREAT | O_TRUNC, 0600);
    if (fd < 0 || dup2(fd, 1) != 1)
        return false;
    printf("before\n");
    file_report report;
    bool ok = write_text("/dev/stdout", "direct\n", true, &report) && report.direct;
    printf("after\n");
    fflush(stdout);
    return ok && holds("log", "before\ndirect\nafter\n");
}

static bool reader_gone(void) {
    int ends[2];
    char name[40];
    signal(SIGPIPE, SIG_IGN);
    if (pipe(ends) || close(ends[0]))
        return false;
    snprintf(name, sizeof name, "/dev/fd/%d", ends[1]);
    return !write_text(name, "x", true, NULL) && strstr(error.text, strerror(EPIPE));
}

static bool file_limit(void) {
    signal(SIGXFSZ, SIG_IGN);
    file_out out;
    if (setrlimit(RLIMIT_FSIZE, &(struct rlimit){10000, 10000}) || !file_out_open(&out, "big", NULL, fresh()))
        return false;
    for (int i = 0; i < 100000; i++)
        putc('x', out.to);
    fputs("the end", out.to);
    return !file_out_close(&out, true, NULL, fresh()) && strstr(error.text, strerror(EFBIG)) &&
           access("big", F_OK) != 0 && entries() == 0;
}

static void full(void) {
    CHECK(!write_text("/dev/full", "x", true, NULL));
    CHECK(!strcmp(error.text, "cannot write /dev/full: No space left on device"));
    file_out out; /* told even when a later flush has nothing left to write */
    CHECK(file_out_open(&out, "/dev/full", NULL, fresh()));
    fputs("x", out.to);
    fflush(out.to);
    error_clear(&error);
    CHECK(!file_out_close(&out, true, NULL, fresh()) && strstr(error.text, "No space left"));
    apart(to_open_file);
    unlink("log");
    apart(reader_gone);
    apart(file_limit);
    CHECK(entries() == 0);
}

/* A working directory whose absolute name no call takes. */
static bool deep(void) {
    char name[201];
    memset(name, 'd', 200);
    name[200] = 0;
    for (int i = 0; i < 25; i++)
        if (mkdir(name, 0755) || chdir(name))
            return false;
    file_report report;
    file_in in;
    bool ok = write_text("f", "deep\n", true, &report) && !report.overwrote &&
              write_text("f", "deeper\n", true, &report) && report.overwrote && symlink("f", "l") == 0 &&
              write_text("l", "deepest\n", true, &report) && holds("f", "deepest\n") &&
              file_in_open(&in, "f", NULL, fresh());
    ok = ok && file_in_line(&in, fresh()) == FILE_GOT_LINE && !strcmp(in.line, "deepest");
    if (ok)
        file_in_close(&in);
    unlink("f"), unlink("l");
    for (int i = 0; i < 25; i++)
        if (chdir("..") || rmdir(name))
            return false;
    return ok;
}

static void names_to(const char *name, const char *path) {
    char *got = file_expand(name);
    CHECK(got && !strcmp(got, path));
    free(got);
}

static void home(void) {
    char here[2000];
    CHECK(getcwd(here, sizeof here) != NULL && setenv("HOME", here, 1) == 0);
    CHECK(write_text("~/at-home", "x", true, NULL) && holds("at-home", "x"));
    file_in in;
    CHECK(file_in_open(&in, "~/at-home", NULL, fresh()));
    file_in_close(&in);
    unlink("at-home");
    for (int unset = 0; unset < 2; unset++) { /* the system knows */
        CHECK((unset ? unsetenv("HOME") : setenv("HOME", "", 1)) == 0);
        static char where[] = "/home/of/user", nowhere[] = "";
        home_of_user = where;
        names_to("~/x", "/home/of/user/x");
        names_to("~", "/home/of/user");
        home_of_user = nowhere;
        names_to("~/x", "~/x");
        home_of_user = NULL; /* nobody */
        names_to("~/x", "~/x");
    }
    static const char *const plain[] = {"a~", "~user", "./~", "a/~/b"};
    for (size_t i = 0; i < sizeof plain / sizeof *plain; i++)
        names_to(plain[i], plain[i]);
}

static void sizes(void) {
    static const struct {
        unsigned long long bytes;
        const char *text;
    } rows[] = {{0, "0 B"},          {999, "999 B"},
                {1000, "1.0 kB"},    {9949, "9.9 kB"},
                {9951, "10 kB"},     {12345, "12 kB"},
                {999499, "999 kB"},  {999500, "1.0 MB"},
                {3400000, "3.4 MB"}, {18446744073709551615u, "18 EB"}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        char text[16];
        file_size_text(rows[i].bytes, text);
        if (!CHECK(!strcmp(text, rows[i].text)))
            printf("%llu: %s\n", rows[i].bytes, text);
    }
}

/* ---- input -------------------------------------------------------------------------------------- */

static void lines(void) {
    FILE *f = fopen("in", "w");
    fwrite("a\n\nb\0c\nlast", 1, 11, f);
    fclose(f);
    static const struct {
        size_t length;
        const char *bytes;
    } want[] = {{1, "a"}, {0, ""}, {3, "b\0c"}, {4, "last"}};
    file_in in;
    CHECK(file_in_open(&in, "in", NULL, fresh()));
    for (size_t i = 0; i < 4; i++) {
        CHECK(file_in_line(&in, fresh()) == FILE_GOT_LINE && in.length == want[i].length);
        CHECK(!memcmp(in.line, want[i].bytes, want[i].length + 1) && in.number == i + 1);
    }
    CHECK(file_in_line(&in, fresh()) == FILE_GOT_END);
    CHECK(file_in_line(&in, fresh()) == FILE_GOT_END);
    file_in_close(&in);
    put("in", "");
    CHECK(file_in_open(&in, "in", NULL, fresh()) && file_in_line(&in, fresh()) == FILE_GOT_END);
    file_in_close(&in);

    put("in", "one\nx = \\\n1 + \\\n2\nend \\");
    CHECK(file_in_open(&in, "in", NULL, fresh()));
    CHECK(file_in_logical(&in, fresh()) == FILE_GOT_LINE && !strcmp(in.line, "one"));
    CHECK(file_in_logical(&in, fresh()) == FILE_GOT_LINE && !strcmp(in.line, "x =  \n1 +  \n2"));
    CHECK(in.number == 2 && in.read == 4);
    CHECK(file_in_logical(&in, fresh()) == FILE_GOT_LINE && !strcmp(in.line, "end  "));
    CHECK(in.number == 5 && file_in_logical(&in, fresh()) == FILE_GOT_END);
    file_in_close(&in);
    CHECK(!file_in_open(&in, ".", NULL, fresh()) && !strcmp(error.text, "cannot read .: Is a directory"));
    CHECK(!file_in_open(&in, "none", NULL, fresh()) &&
          !strcmp(error.text, "cannot read none: No such file or directory"));
    unlink("in");
}

/* One character as UTF-8 and as UTF-16, high byte first. */
static const struct {
    const char *utf8, *utf16;
    size_t length;
} characters[] = {{"a", "\0a", 2},
                  {"\xc2\xb5", "\0\xb5", 2},
                  {"\xe2\x82\xac", "\x20\xac", 2},
                  {"\xf0\x9f\x98\x80", "\xd8\x3d\xde\0", 4},
                  {"\xef\xbf\xbd", "\xd8\x3d", 2}, /* halves of a pair alone */
                  {"\n", "\0\n", 2},
                  {"\xef\xbf\xbd", "\xde\0", 2}};
enum { CHARACTERS = sizeof characters / sizeof *characters, TEXT = 120000 };

/* A text longer than a block; how long it is as UTF-16. */
static size_t write_characters(char *utf8, char *utf16, bool big) {
    size_t n = 0, m = 2;
    memcpy(utf16, big ? "\xfe\xff" : "\xff\xfe", 2);
    for (size_t i = 0; m < TEXT; i++) {
        const size_t which = (i + i / CHARACTERS) % CHARACTERS;
        if (characters[which].utf16[0] == '\xde' && m > 4 && (utf16[big ? m - 2 : m - 1] & '\xfc') == '\xd8')
            continue; /* the two would be a pair */
        n += (size_t)sprintf(utf8 + n, "%s", characters[which].utf8);
        for (size_t j = 0; j < characters[which].length; j++)
            utf16[m + (big ? j : j ^ 1)] = characters[which].utf16[j];
        m += characters[which].length;
    }
    return m;
}

/* Is what comes from the file this text? */
static bool reads(file_in *in, const char *text) {
    bool same = true;
    while (same && file_in_line(in, fresh()) == FILE_GOT_LINE) {
        same = !memcmp(text, in->line, in->length);
        text += in->length;
        same = same && *text == (*text ? '\n' : 0);
        text += *text == '\n';
    }
    file_in_close(in);
    return same && !*text;
}

/* Through a pipe, so many bytes at a time. */
static bool reads_piped(const char *bytes, size_t n, size_t at_once, const char *text) {
    int ends[2], status = -1;
    file_in in;
    if (pipe(ends))
        return false;
    fflush(stdout);
    pid_t child = fork();
    if (child == 0) {
        bool ok = true;
        for (size_t i = 0; i < n && ok; i += at_once) {
            const size_t more = n - i < at_once ? n - i : at_once;
            ok = write(ends[1], bytes + i, more) == (ssize_t)more;
        }
        _exit(!ok);
    }
    close(ends[1]);
    bool ok = file_in_take(&in, ends[0], "pipe", NULL, fresh()) && reads(&in, text);
    close(ends[0]);
    return waitpid(child, &status, 0) == child && status == 0 && ok;
}

static void encodings(void) {
    static char utf8[2 * TEXT], utf16[TEXT + 8];
    file_in in;
    for (int big = 0; big < 2; big++) {
        const size_t n = write_characters(utf8, utf16, big);
        FILE *f = fopen("in", "w");
        fwrite(utf16, 1, n, f);
        fclose(f);
        CHECK(file_in_open(&in, "in", NULL, fresh()) && reads(&in, utf8));
        CHECK(reads_piped(utf16, n, 1, utf8));
        CHECK(reads_piped(utf16, n, 3, utf8));
        CHECK(reads_piped(utf16, n, 8191, utf8));
    }
    /* marks alone, halves of them, a byte too many */
    static const struct {
        const char *bytes;
        size_t n;
        const char *text;
    } small[] = {{"\xff\xfe", 2, ""},
                 {"\xfe\xff", 2, ""},
                 {"\xef\xbb\xbf", 3, ""},
                 {"\xef\xbb\xbf"
                  "a\nb",
                  6, "a\nb"},
                 {"\xef\xbb", 2, "\xef\xbb"},
                 {"\xff", 1, "\xff"},
                 {"\xff\xfe\n", 3, "\xef\xbf\xbd"},
                 {"\xff\xfe\x3d\xd8", 4, "\xef\xbf\xbd"},
                 {"\xfe\xff\xfe\xff", 4, "\xef\xbb\xbf"}};
    for (size_t i = 0; i < sizeof small / sizeof *small; i++)
        for (size_t at_once = 1; at_once < 4; at_once++)
            CHECK(reads_piped(small[i].bytes, small[i].n, at_once, small[i].text));
    CHECK(file_in_text(&in,
                       "\xef\xbb\xbf"
                       "a",
                       "-c", NULL, fresh()) &&
          reads(&in, "a"));
    unlink("in");
}

/* Lines across blocks, and one byte around the limit. */
static void limits(void) {
    FILE *f = fopen("in", "w");
    for (int i = 0; i < FILE_LINE_LIMIT; i++)
        putc('a' + i % 23, f);
    fputs("\nb\n", f);
    fclose(f);
    file_in in;
    CHECK(file_in_open(&in, "in", NULL, fresh()));
    CHECK(file_in_line(&in, fresh()) == FILE_GOT_LINE && in.length == FILE_LINE_LIMIT);
    bool same = true;
    for (size_t i = 0; i < in.length; i++)
        same &= in.line[i] == (char)('a' + i % 23);
    CHECK(same && file_in_line(&in, fresh()) == FILE_GOT_LINE && !strcmp(in.line, "b"));
    file_in_close(&in);
    unlink("in");
    CHECK(file_in_open(&in, "/dev/zero", NULL, fresh()));
    CHECK(file_in_line(&in, fresh()) == FILE_GOT_ERROR);
    CHECK(!strcmp(error.text, "/dev/zero:1: the line is longer than 16 MB"));
    file_in_close(&in);
    /* so does the end of a line that is continued */
    f = fopen("in", "w");
    fprintf(f, "%*s\\\n1\n", FILE_LINE_LIMIT - 1, "x");
    fclose(f);
    CHECK(file_in_open(&in, "in", NULL, fresh()));
    CHECK(file_in_logical(&in, fresh()) == FILE_GOT_ERROR && strstr(error.text, "longer than 16 MB"));
    file_in_close(&in);
    /* continued lines count together */
    f = fopen("in", "w");
    for (int i = 0; i < 3; i++)
        fprintf(f, "%*s\\\n", FILE_LINE_LIMIT * 2 / 5, "x");
    fclose(f);
    CHECK(file_in_open(&in, "in", NULL, fresh()));
    CHECK(file_in_logical(&in, fresh()) == FILE_GOT_ERROR && strstr(error.text, "longer than 16 MB"));
    file_in_close(&in);
    unlink("in");
    static volatile sig_atomic_t stop = 1;
    CHECK(file_in_open(&in, "/dev/zero", &stop, fresh()));
    CHECK(file_in_line(&in, fresh()) == FILE_GOT_STOP);
    file_in_close(&in);
}

#ifndef SANITIZED /* the sanitizer needs all the addresses there are */
static bool out_of_memory(void) {
    file_in in;
    return file_in_open(&in, "/dev/zero", NULL, fresh()) &&
           setrlimit(RLIMIT_AS, &(struct rlimit){8 << 20, 8 << 20}) == 0 &&
           file_in_line(&in, fresh()) == FILE_GOT_ERROR && !strcmp(error.text, "/dev/zero:1: out of memory");
}

/* A text that finds no memory is lost as a whole, and says so. */
static bool lost_text(void) {
    file_text t;
    if (!file_text_open(&t) || setrlimit(RLIMIT_AS, &(struct rlimit){8 << 20, 8 << 20}))
        return false;
    for (int i = 0; i < 32 << 20; i++)
        putc('x', t.to);
    fputs("the end", t.to);
    return !file_text_close(&t);
}
#endif

static void texts(void) {
    file_text t;
    CHECK(file_text_open(&t));
    for (int i = 0; i < 20000; i++)
        fprintf(t.to, "%d\n", i);
    CHECK(file_text_close(&t) && t.size == 108890 && strlen(t.text) == t.size);
    CHECK(!strncmp(t.text, "0\n1\n2\n", 6) && !strcmp(t.text + t.size - 6, "19999\n"));
    free(t.text);
    CHECK(file_text_open(&t) && file_text_close(&t) && t.size == 0 && !*t.text);
    free(t.text);
    /* what a stream without a buffer has lost is told at its end, too */
    CHECK(file_text_open(&t) && setvbuf(t.to, NULL, _IONBF, 0) == 0);
    no_realloc = (fault){0, ENOMEM};
    for (int i = 0; i < 100; i++)
        fputs("12345678", t.to);
    CHECK(t.lost && !file_text_close(&t));
}

static volatile sig_atomic_t rung;

static void ring(int number) {
    (void)number;
    rung = 1;
}

/* The flag goes up while the first line of UTF-16 is waited for. */
static void stops(void) {
    static const char *const begun[] = {"", "\xff\xfe", "\xff\xfe\x61", "a"};
    for (size_t i = 0; i < sizeof begun / sizeof *begun; i++) {
        int ends[2];
        file_in in;
        const size_t n = strlen(begun[i]);
        CHECK(pipe(ends) == 0 && write(ends[1], begun[i], n) == (ssize_t)n);
        rung = 0;
        signal(SIGALRM, ring);
        CHECK(file_in_take(&in, ends[0], "pipe", &rung, fresh()));
        CHECK(setitimer(ITIMER_REAL, &(struct itimerval){.it_value = {.tv_usec = 50000}}, NULL) == 0);
        CHECK(file_in_line(&in, fresh()) == FILE_GOT_STOP && rung);
        file_in_close(&in);
        close(ends[0]), close(ends[1]);
    }
}

static void faults(void) {
#ifndef SANITIZED
    apart(out_of_memory);
    apart(lost_text);
#endif
    int fd = open("/proc/self/mem", O_RDONLY); /* its first page cannot be read */
    file_in in;
    if (fd >= 0) {
        CHECK(file_in_take(&in, fd, "mem", NULL, fresh()) && file_in_line(&in, fresh()) == FILE_GOT_ERROR);
        CHECK(!strcmp(error.text, "cannot read mem: Input/output error"));
        file_in_close(&in);
        close(fd);
    }
}

/* ---- emergency ---------------------------------------------------------------------------------- */

static bool emergency(void) {
    file_out out;
    int group, file;
    pid_t sleeper = fork();
    if (sleeper == 0) {
        for (;;)
            pause();
    }
    setpgid(sleeper, sleeper);
    mkdir("folder", 0700);
    put("folder/inside", "x");
    put("given-up", "x");
    file = file_guard_file("given-up");
    group = file_guard_group(sleeper);
    if (!file_out_open(&out, "half", NULL, fresh()) || file < 0 || group < 0 ||
        file_guard_file("folder/inside") < 0)
        return false;
    file_unguard(file);
    file_emergency();
    int status = 0;
    return waitpid(sleeper, &status, 0) == sleeper && WIFSIGNALED(status) && !rmdir("folder") &&
           access("given-up", F_OK) == 0 && entries() == 1 && unlink("given-up") == 0;
}

static bool too_many(void) {
    int n = 0;
    file_out out;
    while (file_guard_file("x") >= 0)
        n++;
    if (file_guard_group(1) >= 0 || file_guard_terminal(&(struct termios){0}, "") >= 0)
        return false;
    return n >= 32 && !file_out_open(&out, "one-more", NULL, fresh()) && entries() == 0;
}

/* Writing waits for someone to read a pipe that has a name; what is no pipe is not waited for. */
static void waits(void) {
    static const volatile sig_atomic_t never;
    const file_stop flags[] = {NULL, &never};
    for (int i = 0; i < 2; i++) {
        CHECK(mkfifo("slow", 0600) == 0);
        const pid_t reader = fork();
        if (reader == 0) {
            char got[8] = "";
            const struct timespec while_ = {.tv_nsec = 100000000};
            nanosleep(&while_, NULL);
            const int fd = open("slow", O_RDONLY);
            _exit(fd >= 0 && read(fd, got, sizeof got) == 4 && !memcmp(got, "late", 4) ? 0 : 1);
        }
        file_out out;
        int status = -1;
        if (CHECK(file_out_open(&out, "slow", flags[i], fresh()))) {
            fputs("late", out.to);
            CHECK(file_out_close(&out, true, NULL, fresh()));
        }
        CHECK(waitpid(reader, &status, 0) == reader && status == 0);
        unlink("slow");
    }
    struct sockaddr_un at = {.sun_family = AF_UNIX, .sun_path = "socket"};
    const int fd = socket(AF_UNIX, SOCK_STREAM, 0);
    CHECK(fd >= 0 && bind(fd, (struct sockaddr *)&at, sizeof at) == 0);
    CHECK(!write_text("socket", "x", true, NULL) && strstr(error.text, strerror(ENXIO)));
    close(fd);
    unlink("socket");
    file_out none = {.guard = -1}; /* never opened */
    CHECK(file_out_close(&none, true, NULL, fresh()) && !error.raised);
}

/* What memory that is out, and calls that fail, leave of a name. */
static void failing_calls(void) {
    file_out out;
    file_in in;
    CHECK(setenv("HOME", "/tmp", 1) == 0);
    no_malloc = (fault){0, ENOMEM};
    CHECK(!file_expand("~/x"));
    put("sub", "old"); /* a link that leads beside itself */
    CHECK(symlink("sub", "link") == 0);
    bool made = false;
    for (int i = 0; !made && i < 9; i++) {
        no_malloc = (fault){i, ENOMEM};
        made = write_text("link", "new", true, NULL);
        CHECK(made ? i > 1 : strstr(error.text, "cannot write link: out of memory") && holds("sub", "old"));
    }
    CHECK(made && holds("sub", "new") && entries() == 2);
    no_malloc.left = -1;
    for (int i = 0; i < 2; i++) { /* opened, and to be made to wait */
        no_fcntl = (fault){i, EIO};
        CHECK(!file_out_open(&out, "/dev/null", NULL, fresh()) && strstr(error.text, strerror(EIO)));
    }
    unlink("link"), unlink("sub");
    no_open = (fault){0, EACCES};
    CHECK(!file_out_open(&out, "/dev/null", NULL, fresh()) && strstr(error.text, strerror(EACCES)));
    static const char *const names[] = {"/dev/null", "new"};
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        no_fdopen = (fault){0, ENOMEM};
        CHECK(!file_out_open(&out, names[i], NULL, fresh()) && strstr(error.text, "out of memory"));
    }
    struct sockaddr_un at = {.sun_family = AF_UNIX, .sun_path = "socket"};
    const int fd = socket(AF_UNIX, SOCK_STREAM, 0);
    CHECK(fd >= 0 && bind(fd, (struct sockaddr *)&at, sizeof at) == 0);
    no_stat = (fault){1, ENOENT}; /* gone after it was refused */
    CHECK(!file_out_open(&out, "socket", NULL, fresh()) && strstr(error.text, "cannot write socket"));
    close(fd);
    unlink("socket");
    no_fstat = (fault){0, EIO};
    CHECK(!file_in_open(&in, "/dev/null", NULL, fresh()) && strstr(error.text, strerror(EIO)));
    for (int i = 0; i < 2; i++) {
        no_strdup = (fault){i, ENOMEM};
        CHECK(!file_in_text(&in, "text", "name", NULL, fresh()) && error.stop);
        CHECK(!strcmp(error.text, "cannot read name: out of memory"));
    }
    CHECK(file_in_text(&in, "text", "name", NULL, fresh()));
    file_in_close(&in);
    CHECK(entries() == 0);
}

/* What is written in part is cut off again; where it cannot be, that is tried no more. */
static bool cut_logs(void) {
    struct rlimit limit;
    file_log log;
    bool over = false, ok = file_log_open(&log, "log", NULL, &over, fresh()) && !over;
    signal(SIGXFSZ, SIG_IGN);
    ok = ok && file_log_add(&log, "12345678", 8, fresh()) && getrlimit(RLIMIT_FSIZE, &limit) == 0 &&
         setrlimit(RLIMIT_FSIZE, &(struct rlimit){10, limit.rlim_max}) == 0;
    ok = ok && !file_log_add(&log, "abcd", 4, fresh()) && strstr(error.text, strerror(EFBIG)) &&
         holds("log", "12345678");
    no_ftruncate = (fault){0, EIO};
    ok = ok && !file_log_add(&log, "abcd", 4, fresh()) && strstr(error.text, strerror(EFBIG)) &&
         holds("log", "12345678ab");
    ok = ok && !log.regular && !file_log_add(&log, "ef", 2, fresh()) && holds("log", "12345678ab");
    file_log_close(&log);
    return setrlimit(RLIMIT_FSIZE, &limit) == 0 && ok && unlink("log") == 0;
}

static int tapped = -1;       /* end of a pipe that is read late; -1: never */
static size_t drained, ticks; /* bytes so far */

/* A signal comes twice in vain; then someone reads, or the flag goes up. */
static void tick(int number) {
    static char bytes[1 << 16];
    (void)number;
    if (++ticks < 3)
        return;
    rung = 1;
    for (ssize_t n; tapped >= 0 && (n = read(tapped, bytes, sizeof bytes)) > 0;)
        drained += (size_t)n;
}

/* What a full pipe has not taken yet is written when signals have passed, unless the flag says to stop. */
static void interrupted_logs(void) {
    enum { BYTES = 400000 };
    static char text[BYTES];
    static const volatile sig_atomic_t never;
    static const file_stop flags[] = {NULL, &never, &rung};
    const struct sigaction wakes = {.sa_handler = tick};
    struct sigaction before;
    CHECK(sigaction(SIGALRM, &wakes, &before) == 0);
    for (int i = 0; i < 3; i++) {
        file_log log;
        bool over;
        rung = 0;
        drained = ticks = 0;
        CHECK(mkfifo("slow", 0600) == 0);
        const int end = open("slow", O_RDONLY | O_NONBLOCK);
        tapped = flags[i] == &rung ? -1 : end;
        CHECK(end >= 0 && file_log_open(&log, "slow", flags[i], &over, fresh()) && !over);
        const struct itimerval often = {{0, 5000}, {0, 5000}}, off = {{0, 0}, {0, 0}};
        CHECK(setitimer(ITIMER_REAL, &often, NULL) == 0);
        const bool ok = file_log_add(&log, text, BYTES, fresh());
        CHECK(setitimer(ITIMER_REAL, &off, NULL) == 0);
        CHECK(rung && ok == (i < 2));
        CHECK(ok || strstr(error.text, strerror(EINTR)));
        tick(0);
        CHECK(!ok || drained == BYTES);
        file_log_close(&log);
        close(end);
        unlink("slow");
    }
    CHECK(sigaction(SIGALRM, &before, NULL) == 0);
}

int main(int argc, char **argv) {
    unit_start("test_file", argc, argv);
    char dir[] = "/tmp/fret-unit-XXXXXX";
    if (!CHECK(mkdtemp(dir) && !chdir(dir)))
        return unit_finish();
    CASE(replaces());
    CASE(links());
    CASE(refused());
    CASE(pipes());
    CASE(waits());
    CASE(failing_calls());
    CASE(apart(cut_logs));
    CASE(interrupted_logs());
    CASE(full());
    CASE(apart(deep));
    CASE(home());
    CASE(sizes());
    CASE(faults()); /* before memory is kept that a long line has freed */
    CASE(lines());
    CASE(encodings());
    CASE(limits());
    CASE(texts());
    CASE(stops());
    CASE(apart(emergency));
    CASE(apart(too_many));
    CHECK(entries() == 0);
    CHECK(!chdir("/") && !rmdir(dir));
    return unit_finish();
}
