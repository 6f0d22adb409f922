#include "disk.h"

#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <memory>
#include <string_view>
#include <utility>

namespace trochoid::results {

namespace fs = std::filesystem;

const bool open_files_keep_their_folder = false;

FolderLock::FolderLock(const fs::path& folder, Patience patience) {
  const int descriptor = ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  handle_ = descriptor;
  const int how = LOCK_EX | (patience == Patience::none ? LOCK_NB : 0);
  while (descriptor >= 0 && !held_) {
    held_ = ::flock(descriptor, how) == 0;
    if (!held_ && errno != EINTR) break;
  }
}

FolderLock::~FolderLock() {
  if (handle_ >= 0) {
    ::close(static_cast<int>(handle_));
  }
}

Swap exchange(const fs::path& a, const fs::path& b) {
#if defined(RENAME_EXCHANGE)
  if (::renameat2(AT_FDCWD, a.c_str(), AT_FDCWD, b.c_str(), RENAME_EXCHANGE) == 0) {
    return Swap::done;
  }
  if (errno == ENOENT) {
    return Swap::no_such_place;
  }
#else
  static_cast<void>(a);
  static_cast<void>(b);
#endif
  return Swap::unknown;
}

std::error_code flush(const fs::path& path) {
  const auto reason = [](int error) {
    return std::error_code(error, std::generic_category());
  };
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) {
    return reason(errno);
  }
  const int failed = ::fsync(descriptor) == 0 ? 0 : errno;
  ::close(descriptor);
  // A file system that cannot be asked is not one that has failed.
  const bool asked = failed != EINVAL && failed != ENOTSUP && failed != EROFS;
  return reason(asked ? failed : 0);
}

std::optional<std::vector<std::string>> names_in(const fs::path& folder) {
  const std::unique_ptr<DIR, int (*)(DIR*)> open(::opendir(folder.c_str()), ::closedir);
  if (!open) {
    return std::nullopt;
  }
  std::vector<std::string> names;
  errno = 0;
  while (const dirent* entry = ::readdir(open.get())) {
    const std::string_view name = entry->d_name;
    if (name != "." && name != "..") {
      names.emplace_back(name);
    }
    errno = 0;
  }
  return errno == 0 ? std::optional(std::move(names)) : std::nullopt;
}

long process_number() noexcept {
  return ::getpid();
}

}  // namespace trochoid::results
