// Loaded before the C library: the n-th call by which a program changes the disk fails,
// or the program is killed there.
//   FAULT_AT  1, 2, ...; 0: none      FAULT  "error" | "errors", from there on | "kill"
//   FAULT_CALL  its name: only this call counts, from the start
//   NO_EXCHANGE  set: a file system that cannot swap two folders in one step
//   NO_LOCKS     set: one that knows no locks
// All calls are counted from the first hidden folder that is made.
#include <dirent.h>
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>
#include <cerrno>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

bool counting = false;
long calls = 0;

/// Is it this call's turn to fail?
bool fails(const char* call, int error) {
  const char* at = std::getenv("FAULT_AT");
  const char* how = std::getenv("FAULT");
  const char* only = std::getenv("FAULT_CALL");
  const bool counts = only == nullptr ? counting : std::strcmp(only, call) == 0;
  if (!counts || at == nullptr || how == nullptr) {
    return false;
  }
  const bool all = std::strcmp(how, "errors") == 0;
  if (++calls != std::atol(at) && !(all && calls > std::atol(at))) {
    return false;
  }
  if (std::strcmp(how, "kill") == 0) {
    raise(SIGKILL);
  }
  std::fputs("fault injected\n", stderr);
  errno = error;
  return true;
}

template <class Call, class... Arguments>
auto next(const char* name, Call* /*itself*/, Arguments... arguments) {
  return reinterpret_cast<Call*>(dlsym(RTLD_NEXT, name))(arguments...);
}

}  // namespace

extern "C" {

int mkdir(const char* path, mode_t mode) {
  if (strstr(path, "/.") != nullptr && strstr(path, ".new-") != nullptr)
    counting = true;
  if (fails("mkdir", ENOSPC)) return -1;
  return next("mkdir", &mkdir, path, mode);
}

FILE* fopen64(const char* path, const char* mode) {
  if (fails("fopen64", EMFILE)) return nullptr;
  return next("fopen64", &fopen64, path, mode);
}

int open(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = (flags & O_CREAT) != 0 ? va_arg(more, mode_t) : 0;
  va_end(more);
  if (fails("open", EMFILE)) return -1;
  return next("open", &open, path, flags, mode);
}

ssize_t write(int descriptor, const void* data, size_t size) {
  if (descriptor > STDERR_FILENO && fails("write", ENOSPC)) return -1;
  return next("write", &write, descriptor, data, size);
}

ssize_t writev(int descriptor, const struct iovec* parts, int count) {
  if (descriptor > STDERR_FILENO && fails("writev", ENOSPC)) return -1;
  return next("writev", &writev, descriptor, parts, count);
}

int fsync(int descriptor) {
  if (fails("fsync", EIO)) return -1;
  return next("fsync", &fsync, descriptor);
}

int flock(int descriptor, int operation) {
  if (getenv("NO_LOCKS") != nullptr) {
    errno = ENOLCK;
    return -1;
  }
  if (fails("flock", ENOLCK)) return -1;
  return next("flock", &flock, descriptor, operation);
}

int rename(const char* from, const char* to) {
  if (fails("rename", EIO)) return -1;
  return next("rename", &rename, from, to);
}

int renameat2(int from_at, const char* from, int to_at, const char* to,
              unsigned flags) {
  if (flags != 0 && getenv("NO_EXCHANGE") != nullptr) {
    errno = EINVAL;
    return -1;
  }
  if (fails("renameat2", EIO)) return -1;
  return next("renameat2", &renameat2, from_at, from, to_at, to, flags);
}

int unlink(const char* path) {
  if (fails("unlink", EACCES)) return -1;
  return next("unlink", &unlink, path);
}

int unlinkat(int at, const char* path, int flags) {
  if (fails("unlinkat", EACCES)) return -1;
  return next("unlinkat", &unlinkat, at, path, flags);
}

int remove(const char* path) {
  if (fails("remove", EACCES)) return -1;
  return next("remove", &remove, path);
}

DIR* opendir(const char* path) {
  if (fails("opendir", EMFILE)) return nullptr;
  return next("opendir", &opendir, path);
}

/// Only where it is asked for by name: what the C++ library reads is not meant.
struct dirent* readdir(DIR* folder) {
  if (std::getenv("FAULT_CALL") != nullptr && fails("readdir", EIO)) return nullptr;
  return next("readdir", &readdir, folder);
}

}  // extern "C"
