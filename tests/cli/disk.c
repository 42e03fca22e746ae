/* Calls that reach the files of one folder: each is numbered and told, and one of them can be refused.
 *
 * DISK_FOLDER  the folder, whole and without links
 * DISK_CALLS   a file outside of it that gets a line a call: number, operation, refused or not, bytes, name, new name
 * DISK_FAULT   "number errno", or "number short": what becomes of one call */
#define _GNU_SOURCE
#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <stdarg.h>
#include <stdatomic.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/types.h>
#include <sys/uio.h>
#include <unistd.h>

#define SHORT (-1)
#define NEXT(name) (__typeof__(&name))dlsym(RTLD_NEXT, #name)

static char folder[PATH_MAX];
static size_t folder_length;
static int calls = -1;
static atomic_long count;
static long fault_number;
static int fault;

__attribute__((constructor)) static void begin(void) {
    const char *place = getenv("DISK_FOLDER"), *told = getenv("DISK_CALLS"), *asked = getenv("DISK_FAULT");
    if (!place || !told) return;
    char *kind = NULL;
    if (asked) fault_number = strtol(asked, &kind, 10);
    if (kind) fault = strstr(kind, "short") ? SHORT : atoi(kind);
    calls = (NEXT(open))(told, O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC, 0600);
    folder_length = strlen(place);
    if (calls >= 0 && folder_length < sizeof folder) memcpy(folder, place, folder_length + 1);
}

static int is_inside(const char *path) {
    return calls >= 0 && !strncmp(path, folder, folder_length)
        && (path[folder_length] == '/' || !path[folder_length]);
}

/* The name of what a descriptor is of. */
static int name_of(int fd, char *name) {
    char link[64];
    if (calls < 0 || fd == calls) return 0;
    snprintf(link, sizeof link, "/proc/self/fd/%d", fd);
    ssize_t length = readlink(link, name, PATH_MAX - 1);
    if (length < 0) return 0;
    name[length] = 0;
    return is_inside(name);
}

/* A path from the root, links in its folder followed. */
static int whole(int at, const char *path, char *name) {
    char given[PATH_MAX], above[PATH_MAX], *last;
    if (calls < 0 || !path) return 0;
    if (path[0] == '/' || at == AT_FDCWD) {
        if (snprintf(given, sizeof given, "%s", path) >= (int)sizeof given) return 0;
    } else {
        if (!name_of(at, above)) return 0;
        if (snprintf(given, sizeof given, "%s/%s", above, path) >= (int)sizeof given) return 0;
    }
    for (size_t end = strlen(given); end > 1 && given[end - 1] == '/';) given[--end] = 0;
    last = strrchr(given, '/');
    const char *base = last ? last + 1 : given;
    if (!strcmp(base, ".") || !strcmp(base, "..")) return realpath(given, name) && is_inside(name);
    char kept[PATH_MAX];
    snprintf(kept, sizeof kept, "%s", base);
    if (last) *last = 0;
    if (!realpath(!last ? "." : *given ? given : "/", above)) return 0;
    if (strlen(above) + strlen(kept) + 2 > PATH_MAX) return 0;
    strcpy(name, above);
    strcat(name, "/");
    strcat(name, kept);
    return is_inside(name);
}

/* What becomes of this call: nothing, an errno, or SHORT. */
static int next(long *number) {
    *number = ++count;
    return *number == fault_number ? fault : 0;
}

static void tell(long number, const char *operation, int refused, long bytes, const char *name, const char *to) {
    char line[3 * PATH_MAX];
    int kept = errno;
    int length = snprintf(line, sizeof line, "%ld\t%s\t%d\t%ld\t%s\t%s\n", number, operation, refused, bytes, name, to);
    (void)!(NEXT(write))(calls, line, length);
    errno = kept;
}

/* A call that is refused as a whole or not at all; a short one is none. */
#define REFUSED(operation, name, to)                                    \
    long number;                                                        \
    int refused = next(&number);                                        \
    if (refused > 0) {                                                  \
        tell(number, operation, refused, 0, name, to);                  \
        errno = refused;                                                \
        return -1;                                                      \
    }

static int opened(const char *symbol, int at, const char *path, int flags, mode_t mode) {
    int (*real)(int, const char *, int, ...) = (int (*)(int, const char *, int, ...))dlsym(RTLD_NEXT, symbol);
    char name[PATH_MAX];
    if (!whole(at, path, name)) return real(at, path, flags, mode);
    int writes = (flags & O_ACCMODE) != O_RDONLY;
    const char *operation = !writes ? "look" : flags & (O_TRUNC | O_EXCL) ? "create" : "open";
    REFUSED(operation, name, "")
    int fd = real(at, path, flags, mode);
    tell(number, fd < 0 ? "absent" : operation, 0, 0, name, "");
    return fd;
}

#define MODE                                                            \
    mode_t mode = 0;                                                    \
    if (flags & (O_CREAT | O_TMPFILE)) {                                \
        va_list rest;                                                   \
        va_start(rest, flags);                                          \
        mode = va_arg(rest, mode_t);                                    \
        va_end(rest);                                                   \
    }

int open(const char *path, int flags, ...) { MODE return opened("openat", AT_FDCWD, path, flags, mode); }
int open64(const char *path, int flags, ...) { MODE return opened("openat64", AT_FDCWD, path, flags, mode); }
int openat(int at, const char *path, int flags, ...) { MODE return opened("openat", at, path, flags, mode); }
int openat64(int at, const char *path, int flags, ...) { MODE return opened("openat64", at, path, flags, mode); }

/* What is read or written, whole, in part, or not. */
#define MOVED(operation, real, fd, size, all, part)                     \
    char name[PATH_MAX];                                                \
    if (!name_of(fd, name)) return real all;                            \
    REFUSED(operation, name, "")                                        \
    ssize_t moved = refused == SHORT && size > 1 ? real part : real all; \
    tell(number, operation, refused, moved, name, "");                  \
    return moved;

ssize_t read(int fd, void *to, size_t size) {
    MOVED("read", (NEXT(read)), fd, size, (fd, to, size), (fd, to, size / 2))
}
ssize_t pread(int fd, void *to, size_t size, off_t from) {
    MOVED("read", (NEXT(pread)), fd, size, (fd, to, size, from), (fd, to, size / 2, from))
}
ssize_t pread64(int fd, void *to, size_t size, off64_t from) {
    MOVED("read", (NEXT(pread64)), fd, size, (fd, to, size, from), (fd, to, size / 2, from))
}
ssize_t readv(int fd, const struct iovec *to, int parts) {
    MOVED("read", (NEXT(readv)), fd, parts, (fd, to, parts), (fd, to, 1))
}
ssize_t write(int fd, const void *from, size_t size) {
    MOVED("write", (NEXT(write)), fd, size, (fd, from, size), (fd, from, size / 2))
}
ssize_t pwrite(int fd, const void *from, size_t size, off_t to) {
    MOVED("write", (NEXT(pwrite)), fd, size, (fd, from, size, to), (fd, from, size / 2, to))
}
ssize_t pwrite64(int fd, const void *from, size_t size, off64_t to) {
    MOVED("write", (NEXT(pwrite64)), fd, size, (fd, from, size, to), (fd, from, size / 2, to))
}
ssize_t writev(int fd, const struct iovec *from, int parts) {
    MOVED("write", (NEXT(writev)), fd, parts, (fd, from, parts), (fd, from, 1))
}

#define OF_A_FILE(operation, real, fd, all)                             \
    char name[PATH_MAX];                                                \
    if (!name_of(fd, name)) return real all;                            \
    REFUSED(operation, name, "")                                        \
    int result = real all;                                              \
    tell(number, operation, 0, 0, name, "");                            \
    return result;

int fsync(int fd) { OF_A_FILE("sync", (NEXT(fsync)), fd, (fd)) }
int fdatasync(int fd) { OF_A_FILE("sync", (NEXT(fdatasync)), fd, (fd)) }
int ftruncate(int fd, off_t size) { OF_A_FILE("cut", (NEXT(ftruncate)), fd, (fd, size)) }
int ftruncate64(int fd, off64_t size) { OF_A_FILE("cut", (NEXT(ftruncate64)), fd, (fd, size)) }

/* A descriptor is gone even where closing it is refused (close(2), Linux). */
int close(int fd) {
    char name[PATH_MAX];
    if (!name_of(fd, name)) return (NEXT(close))(fd);
    long number;
    int refused = next(&number);
    int result = (NEXT(close))(fd);
    tell(number, "close", refused, 0, name, "");
    if (refused <= 0) return result;
    errno = refused;
    return -1;
}

#define OF_A_NAME(operation, real, at, path, all)                       \
    char name[PATH_MAX];                                                \
    if (!whole(at, path, name)) return real all;                        \
    REFUSED(operation, name, "")                                        \
    int result = real all;                                              \
    if (!result) tell(number, operation, 0, 0, name, "");               \
    else tell(number, "absent", 0, 0, name, "");                        \
    return result;

int mkdir(const char *path, mode_t mode) { OF_A_NAME("folder", (NEXT(mkdir)), AT_FDCWD, path, (path, mode)) }
int mkdirat(int at, const char *path, mode_t mode) { OF_A_NAME("folder", (NEXT(mkdirat)), at, path, (at, path, mode)) }
int unlink(const char *path) { OF_A_NAME("remove", (NEXT(unlink)), AT_FDCWD, path, (path)) }
int unlinkat(int at, const char *path, int flags) { OF_A_NAME("remove", (NEXT(unlinkat)), at, path, (at, path, flags)) }
int rmdir(const char *path) { OF_A_NAME("remove", (NEXT(rmdir)), AT_FDCWD, path, (path)) }

static int renamed(int at, const char *from, int to_at, const char *to, unsigned flags) {
    int (*real)(int, const char *, int, const char *, unsigned) = NEXT(renameat2);
    char name[PATH_MAX], new_name[PATH_MAX];
    if (!whole(at, from, name) | !whole(to_at, to, new_name)) return real(at, from, to_at, to, flags);
    REFUSED("rename", name, new_name)
    int result = real(at, from, to_at, to, flags);
    tell(number, result ? "absent" : "rename", 0, 0, name, new_name);
    return result;
}
int rename(const char *from, const char *to) { return renamed(AT_FDCWD, from, AT_FDCWD, to, 0); }
int renameat(int at, const char *from, int to_at, const char *to) { return renamed(at, from, to_at, to, 0); }
int renameat2(int at, const char *from, int to_at, const char *to, unsigned flags) {
    return renamed(at, from, to_at, to, flags);
}
