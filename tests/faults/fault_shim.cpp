// Loaded before the C library (LD_PRELOAD): makes the N-th call of one kind fail, or logs what is
// done to files. tests/faults/faults.py drives it by environment variables:
//   FAULT_KIND   write, sync, rename, open, memory or thread: which calls are counted
//   FAULT_AT     the number of the call that fails, from 1; 0: none does
//   FAULT_LASTS  1: all later calls of the kind fail, too (a full disk)
//   FAULT_COUNT  file that gets the number of calls at the end
//   FAULT_LOG    file that gets every change to files below FAULT_FOLDER, in order
// Calls count from the start of main() on, in this process alone.

#include <dlfcn.h>
#include <fcntl.h>
#include <limits.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <mutex>
#include <string_view>

namespace {

enum Kind { kNone, kWrite, kSync, kRename, kOpen, kMemory, kThread };

Kind armed = kNone;
long fail_at = 0;
bool fault_lasts = false;
std::atomic<long> calls{0};
int log_descriptor = -1;
char folder[PATH_MAX];

template <class Function>
Function* real(Function*, const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}
#define REAL(name) (*real(&name, #name))

thread_local bool in_loader = false;  // glibc's dlopen() does not survive a lack of memory

bool fails(Kind kind) {
  if (kind != armed || in_loader) return false;
  const long number = ++calls;
  return fail_at > 0 && (number == fail_at || (fault_lasts && number > fail_at));
}

Kind kind_of(std::string_view name) {
  constexpr std::string_view kNames[]{"none", "write",  "sync",  "rename",
                                      "open", "memory", "thread"};
  for (int k = 0; k < 7; ++k)
    if (name == kNames[k]) return Kind(k);
  return kNone;
}

void raw_write(int descriptor, const void* bytes, size_t size) {
  (void)syscall(SYS_write, descriptor, bytes, size);
}

void tell_count() {
  const char* file = getenv("FAULT_COUNT");
  const Kind kind = armed;
  armed = kNone;
  if (file == nullptr || kind == kNone) return;
  const int out = int(syscall(SYS_openat, AT_FDCWD, file, O_WRONLY | O_CREAT | O_TRUNC, 0666));
  char text[32];
  raw_write(out, text, size_t(snprintf(text, sizeof text, "%ld\n", calls.load())));
}

bool path_of(int descriptor, char (&path)[PATH_MAX]) {
  char link[64];
  snprintf(link, sizeof link, "/proc/self/fd/%d", descriptor);
  const ssize_t size = readlink(link, path, sizeof path - 1);
  if (size <= 0) return false;
  path[size] = '\0';
  return true;
}

/// The name of a file as its folder's descriptor has it.
struct FullName {
  char text[2 * PATH_MAX];
  FullName(int base, const char* path) {
    char start[PATH_MAX];
    if (log_descriptor >= 0 && path[0] != '/' && base != AT_FDCWD && path_of(base, start))
      snprintf(text, sizeof text, "%s/%s", start, path);
    else
      snprintf(text, sizeof text, "%s", path);
  }
};

/// A record: operation, sizes of two names and of the data, then these.
void log_change(char operation, const char* name, const char* other, const void* data,
                size_t size) {
  if (log_descriptor < 0 || strncmp(name, folder, strlen(folder)) != 0) return;
  static std::mutex mutex;
  const std::lock_guard lock(mutex);
  char head[64];
  const int n =
      snprintf(head, sizeof head, "%c %zu %zu %zu\n", operation, strlen(name), strlen(other), size);
  raw_write(log_descriptor, head, size_t(n));
  raw_write(log_descriptor, name, strlen(name));
  raw_write(log_descriptor, other, strlen(other));
  raw_write(log_descriptor, data, size);
}

void log_descriptor_change(char operation, int descriptor, const void* data, size_t size) {
  char path[PATH_MAX];
  if (log_descriptor >= 0 && path_of(descriptor, path)) log_change(operation, path, "", data, size);
}

int (*program_main)(int, char**, char**);

int armed_main(int argc, char** argv, char** environment) {
  const char* kind = getenv("FAULT_KIND");
  const char* at = getenv("FAULT_AT");
  const char* log = getenv("FAULT_LOG");
  fail_at = at != nullptr ? atol(at) : 0;
  fault_lasts = getenv("FAULT_LASTS") != nullptr;
  if (log != nullptr) {
    snprintf(folder, sizeof folder, "%s", getenv("FAULT_FOLDER"));
    log_descriptor = open(log, O_WRONLY | O_CREAT | O_TRUNC | O_APPEND | O_CLOEXEC, 0666);
  }
  unsetenv("LD_PRELOAD");
  atexit(tell_count);
  if (kind != nullptr) armed = kind_of(kind);
  const int status = program_main(argc, argv, environment);
  return status;
}

}  // namespace

extern "C" {

int __libc_start_main(int (*main)(int, char**, char**), int argc, char** argv, void (*init)(),
                      void (*fini)(), void (*rtld_fini)(), void* stack_end) {
  program_main = main;
  // Looked up now: dlerror() calls realloc(), and a dlsym() in there frees what dlerror() then
  // writes to.
  free(realloc(malloc(1), 2));
  const auto start =
      reinterpret_cast<decltype(&__libc_start_main)>(dlsym(RTLD_NEXT, "__libc_start_main"));
  return start(armed_main, argc, argv, init, fini, rtld_fini, stack_end);
}

ssize_t write(int descriptor, const void* bytes, size_t size) {
  if (fails(kWrite)) {
    errno = ENOSPC;
    return -1;
  }
  const ssize_t done = REAL(write)(descriptor, bytes, size);
  if (done > 0) log_descriptor_change('w', descriptor, bytes, size_t(done));
  return done;
}

int fsync(int descriptor) {
  if (fails(kSync)) {
    errno = EIO;
    return -1;
  }
  const int result = REAL(fsync)(descriptor);
  log_descriptor_change('s', descriptor, "", 0);
  return result;
}

int syncfs(int descriptor) {
  if (fails(kSync)) {
    errno = EIO;
    return -1;
  }
  const int result = REAL(syncfs)(descriptor);
  log_change('S', folder, "", "", 0);
  return result;
}

int ftruncate(int descriptor, off_t size) {
  const int result = REAL(ftruncate)(descriptor, size);
  log_descriptor_change('t', descriptor, &size, sizeof size);
  return result;
}

int renameat2(int from_folder, const char* from, int to_folder, const char* to, unsigned flags) {
  if (fails(kRename)) {
    errno = EIO;
    return -1;
  }
  const FullName source(from_folder, from), target(to_folder, to);
  const int result = int(syscall(SYS_renameat2, from_folder, from, to_folder, to, flags));
  const bool exchanged = (flags & RENAME_EXCHANGE) != 0;
  if (result == 0) log_change(exchanged ? 'x' : 'r', source.text, target.text, "", 0);
  return result;
}

int renameat(int from_folder, const char* from, int to_folder, const char* to) {
  return renameat2(from_folder, from, to_folder, to, 0);
}

int rename(const char* from, const char* to) { return renameat2(AT_FDCWD, from, AT_FDCWD, to, 0); }

int unlinkat(int base, const char* path, int flags) {
  const FullName name(base, path);
  const int result = REAL(unlinkat)(base, path, flags);
  if (result == 0) log_change('u', name.text, "", "", 0);
  return result;
}

int unlink(const char* path) { return unlinkat(AT_FDCWD, path, 0); }

int mkdirat(int base, const char* path, mode_t mode) {
  if (fails(kOpen)) {
    errno = EMFILE;
    return -1;
  }
  const FullName name(base, path);
  const int result = REAL(mkdirat)(base, path, mode);
  if (result == 0) log_change('d', name.text, "", "", 0);
  return result;
}

int mkdir(const char* path, mode_t mode) { return mkdirat(AT_FDCWD, path, mode); }

static int open_file(int base, const char* path, int flags, mode_t mode) {
  if (fails(kOpen)) {
    errno = EMFILE;
    return -1;
  }
  const int descriptor = int(syscall(SYS_openat, base, path, flags, mode));
  if (descriptor >= 0 && (flags & (O_CREAT | O_TRUNC)) != 0)
    log_change((flags & O_TRUNC) != 0 ? 'T' : 'c', FullName(base, path).text, "", "", 0);
  return descriptor;
}

#define OPEN_BODY(base)                                                  \
  va_list more;                                                          \
  va_start(more, flags);                                                 \
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(more, mode_t) : 0; \
  va_end(more);                                                          \
  return open_file(base, path, flags, mode);

int open(const char* path, int flags, ...) { OPEN_BODY(AT_FDCWD) }
int open64(const char* path, int flags, ...) { OPEN_BODY(AT_FDCWD) }
int openat(int base, const char* path, int flags, ...) { OPEN_BODY(base) }
int openat64(int base, const char* path, int flags, ...) { OPEN_BODY(base) }

void* dlopen(const char* file, int mode) noexcept {
  in_loader = true;
  void* library = REAL(dlopen)(file, mode);
  in_loader = false;
  return library;
}

void* malloc(size_t size) {
  static decltype(&malloc) next = nullptr;
  if (next == nullptr) next = real(&malloc, "malloc");
  if (fails(kMemory)) {
    errno = ENOMEM;
    return nullptr;
  }
  return next(size);
}

void* realloc(void* old, size_t size) {
  static decltype(&realloc) next = nullptr;
  if (next == nullptr) next = real(&realloc, "realloc");
  if (fails(kMemory)) {
    errno = ENOMEM;
    return nullptr;
  }
  return next(old, size);
}

int pthread_create(pthread_t* thread, const pthread_attr_t* attributes, void* (*run)(void*),
                   void* argument) {
  if (fails(kThread)) return EAGAIN;
  return REAL(pthread_create)(thread, attributes, run, argument);
}

}  // extern "C"
