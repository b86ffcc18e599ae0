// SPDX-License-Identifier: MIT
//
// Makes calls of the C library fail, for scripts/faults; preloaded into the program under test.
//
//     STIPPLE_FAULT=KIND:K:ERROR    the K-th call of this kind fails with this errno (a number);
//                                   ERROR 0: a read or write of half the bytes;
//                                   K+ in place of K: all calls from the K-th on
//     STIPPLE_FAULT_LOG=FILE        gets "fired" when a call fails, and at the end of main the
//                                   number of calls of every kind
//     STIPPLE_FAULT_TRACE=1         also who made the call
//     STIPPLE_NO_TMPFILE=1          the file system has no files without names
//
// Only calls after the start of main count, and none of child processes. Calls inside glibc cannot
// be replaced, so functions on FILE are replaced in addition to those on descriptors. Writes to
// standard error never fail, because they carry the message that is checked.
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <execinfo.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <sys/uio.h>
#include <unistd.h>

enum kind {
    MALLOC,
    OPEN,
    READ,
    WRITE,
    CLOSE,
    LINK,
    UNLINK,
    SYNC,
    STAT,
    SEEK,
    CUT,
    MODE,
    MAP,
    THREAD,
    KINDS
};
static const char* const names[KINDS] = {"malloc", "open",   "read", "write", "close",
                                         "link",   "unlink", "sync", "stat",  "seek",
                                         "cut",    "mode",   "mmap", "thread"};
static atomic_long calls[KINDS];
static atomic_int armed;
static int chosen = KINDS, error_number, sticky, traced, nameless_refused, log_file = -1;
static long turn;
static atomic_int noted;
static __thread int inside __attribute__((tls_model("initial-exec")));

static void say(const char* text) { syscall(SYS_write, log_file, text, strlen(text)); }

static void note_failure(void) {
    if (log_file < 0) return;
    say("fired\n");
    if (!traced) return;
    void* frames[40];
    backtrace_symbols_fd(frames, backtrace(frames, 40), log_file);
}

/// FFTW ends the program if it has no memory, so its calls never fail.
static int is_exempt(const void* caller) {
    Dl_info place;
    return caller && dladdr(caller, &place) && strstr(place.dli_fname, "libfftw3") != NULL;
}

/// Whether this call fails, with errno set. With error 0 it transfers half of the bytes.
static int fails_for(enum kind kind, const void* caller) {
    if (!atomic_load(&armed) || inside) return 0;
    const long number = atomic_fetch_add(&calls[kind], 1) + 1;
    if ((int)kind != chosen || number < turn || (number > turn && !sticky)) return 0;
    if (is_exempt(caller)) return 0;
    inside = 1;  // calls made by the log itself do not count
    if (!noted) note_failure();
    noted = 1;
    inside = 0;
    errno = error_number;
    return 1;
}
static int fails(enum kind kind) { return fails_for(kind, NULL); }
#define NO_STORAGE fails_for(MALLOC, __builtin_return_address(0))

// Allocation: glibc's own names need no dlsym(), which would allocate.
void* __libc_malloc(size_t);
void* __libc_calloc(size_t, size_t);
void* __libc_realloc(void*, size_t);
void* __libc_memalign(size_t, size_t);
void* malloc(size_t n) { return NO_STORAGE ? NULL : __libc_malloc(n); }
void* calloc(size_t n, size_t m) { return NO_STORAGE ? NULL : __libc_calloc(n, m); }
void* realloc(void* p, size_t n) { return NO_STORAGE ? NULL : __libc_realloc(p, n); }
void* aligned_alloc(size_t a, size_t n) { return NO_STORAGE ? NULL : __libc_memalign(a, n); }
void* memalign(size_t a, size_t n) { return NO_STORAGE ? NULL : __libc_memalign(a, n); }
int posix_memalign(void** p, size_t a, size_t n) {
    if (NO_STORAGE) return ENOMEM;
    *p = __libc_memalign(a, n);
    return *p == NULL && n != 0 ? ENOMEM : 0;
}

// name(parameters) calls the next library's function of that name unless this call fails.
#define NEXT(result, name, parameters) \
    static result(*next) parameters;   \
    if (!next) next = (result(*) parameters)dlsym(RTLD_NEXT, #name)
#define REPLACED(kind, result, failed, name, parameters, arguments) \
    result name parameters {                                        \
        NEXT(result, name, parameters);                             \
        return fails(kind) ? failed : next arguments;               \
    }

#define OPENED(name, parameters, arguments)                                                      \
    int name parameters {                                                                        \
        va_list rest;                                                                            \
        va_start(rest, flags);                                                                   \
        const mode_t mode = flags & (O_CREAT | O_TMPFILE) ? va_arg(rest, mode_t) : 0;            \
        va_end(rest);                                                                            \
        NEXT(int, name, parameters);                                                             \
        if (nameless_refused && (flags & O_TMPFILE) == O_TMPFILE) return errno = EOPNOTSUPP, -1; \
        return fails(OPEN) ? -1 : next arguments;                                                \
    }
OPENED(open, (const char* path, int flags, ...), (path, flags, mode))
OPENED(open64, (const char* path, int flags, ...), (path, flags, mode))
OPENED(openat, (int folder, const char* path, int flags, ...), (folder, path, flags, mode))
OPENED(openat64, (int folder, const char* path, int flags, ...), (folder, path, flags, mode))
REPLACED(OPEN, FILE*, NULL, fopen, (const char* path, const char* mode), (path, mode))
REPLACED(OPEN, FILE*, NULL, fopen64, (const char* path, const char* mode), (path, mode))
REPLACED(OPEN, FILE*, NULL, fdopen, (int file, const char* mode), (file, mode))
REPLACED(OPEN, int, -1, mkostemp, (char* name, int flags), (name, flags))
REPLACED(LINK, int, -1, link, (const char* from, const char* to), (from, to))
REPLACED(LINK, int, -1, rename, (const char* from, const char* to), (from, to))
REPLACED(LINK, int, -1, linkat, (int f, const char* from, int t, const char* to, int flags),
         (f, from, t, to, flags))
REPLACED(LINK, int, -1, renameat, (int f, const char* from, int t, const char* to),
         (f, from, t, to))
REPLACED(UNLINK, int, -1, unlink, (const char* path), (path))
REPLACED(UNLINK, int, -1, unlinkat, (int folder, const char* path, int flags),
         (folder, path, flags))
REPLACED(SYNC, int, -1, fsync, (int file), (file))
REPLACED(SYNC, int, -1, fdatasync, (int file), (file))
REPLACED(STAT, int, -1, stat, (const char* path, struct stat* s), (path, s))
REPLACED(STAT, int, -1, lstat, (const char* path, struct stat* s), (path, s))
REPLACED(STAT, int, -1, fstat, (int file, struct stat* s), (file, s))
REPLACED(STAT, int, -1, access, (const char* path, int mode), (path, mode))
REPLACED(SEEK, off_t, -1, lseek, (int file, off_t to, int from), (file, to, from))
REPLACED(SEEK, off64_t, -1, lseek64, (int file, off64_t to, int from), (file, to, from))
REPLACED(CUT, int, -1, ftruncate, (int file, off_t size), (file, size))
REPLACED(MODE, int, -1, fchmod, (int file, mode_t mode), (file, mode))
REPLACED(MODE, int, -1, fchown, (int file, uid_t user, gid_t group), (file, user, group))
REPLACED(MAP, void*, MAP_FAILED, mmap, (void* p, size_t n, int a, int b, int file, off_t at),
         (p, n, a, b, file, at))
REPLACED(MAP, void*, MAP_FAILED, mmap64, (void* p, size_t n, int a, int b, int f, off64_t at),
         (p, n, a, b, f, at))
REPLACED(THREAD, int, error_number, pthread_create,
         (pthread_t * t, const pthread_attr_t* a, void* (*f)(void*), void* x), (t, a, f, x))

// Error 0 means half of the bytes; here the other calls fail.
#define MOVED(kind, result, name, parameters, arguments, size) \
    result name parameters {                                   \
        NEXT(result, name, parameters);                        \
        if (file != STDERR_FILENO && fails(kind)) {            \
            if (error_number) return -1;                       \
            size = (size + 1) / 2;                             \
        }                                                      \
        return next arguments;                                 \
    }
MOVED(READ, ssize_t, read, (int file, void* p, size_t n), (file, p, n), n)
MOVED(READ, ssize_t, pread, (int file, void* p, size_t n, off_t at), (file, p, n, at), n)
MOVED(READ, ssize_t, pread64, (int file, void* p, size_t n, off_t at), (file, p, n, at), n)
MOVED(WRITE, ssize_t, write, (int file, const void* p, size_t n), (file, p, n), n)
MOVED(WRITE, ssize_t, writev, (int file, const struct iovec* v, int n), (file, v, n), n)

// Streams are never shortened, and have no calls to repeat.
static int stream_fails(enum kind kind, FILE* file) {
    const int harmless = error_number == 0 || error_number == EINTR || error_number == EAGAIN;
    if (file == stderr || (harmless && chosen == (int)kind) || !fails(kind)) return 0;
    file->_flags |= _IO_ERR_SEEN;
    return 1;
}
size_t fwrite(const void* p, size_t size, size_t n, FILE* file) {
    NEXT(size_t, fwrite, (const void*, size_t, size_t, FILE*));
    return stream_fails(WRITE, file) ? 0 : next(p, size, n, file);
}
size_t fread(void* p, size_t size, size_t n, FILE* file) {
    NEXT(size_t, fread, (void*, size_t, size_t, FILE*));
    return stream_fails(READ, file) ? 0 : next(p, size, n, file);
}
int fflush(FILE* file) {
    NEXT(int, fflush, (FILE*));
    return file && stream_fails(WRITE, file) ? EOF : next(file);
}

// The descriptor is closed even if close() fails.
int close(int file) {
    NEXT(int, close, (int));
    const int failed = file > STDERR_FILENO && fails(CLOSE);
    const int result = next(file);
    return failed ? (errno = error_number, -1) : result;
}
int fclose(FILE* file) {
    NEXT(int, fclose, (FILE*));
    const int failed = fails(CLOSE);
    const int result = next(file);
    return failed ? (errno = error_number, EOF) : result;
}

static int (*program)(int, char**, char**);

static int counted_main(int count, char** words, char** environment) {
    atomic_store(&armed, 1);
    const int code = program(count, words, environment);
    atomic_store(&armed, 0);
    char line[64];
    for (int kind = 0; kind < KINDS && log_file >= 0; ++kind) {
        snprintf(line, sizeof line, "%s %ld\n", names[kind], atomic_load(&calls[kind]));
        say(line);
    }
    return code;
}

static void read_orders(void) {
    const char* path = getenv("STIPPLE_FAULT_LOG");
    const char* fault = getenv("STIPPLE_FAULT");
    if (path)
        log_file = (int)syscall(SYS_openat, AT_FDCWD, path,
                                O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0666);
    traced = getenv("STIPPLE_FAULT_TRACE") != NULL;
    nameless_refused = getenv("STIPPLE_NO_TMPFILE") != NULL;
    if (traced) backtrace((void* [1]){NULL}, 1);  // loads libgcc before any fault
    char name[16] = "", sign = 0;
    if (fault && (sscanf(fault, "%15[a-z]:%ld:%d", name, &turn, &error_number) == 3 ||
                  sscanf(fault, "%15[a-z]:%ld%c:%d", name, &turn, &sign, &error_number) == 4))
        for (int kind = 0; kind < KINDS; ++kind)
            if (strcmp(name, names[kind]) == 0) chosen = kind;
    sticky = sign == '+';
    unsetenv("LD_PRELOAD");  // children are not tested
}

int __libc_start_main(int (*main)(int, char**, char**), int count, char** words, void (*init)(void),
                      void (*fini)(void), void (*rtld)(void), void* stack_end) {
    NEXT(int, __libc_start_main,
         (int (*)(int, char**, char**), int, char**, void (*)(void), void (*)(void), void (*)(void),
          void*));
    read_orders();
    program = main;
    return next(counted_main, count, words, init, fini, rtld, stack_end);
}
