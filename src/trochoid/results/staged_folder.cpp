#include "staged_folder.h"

#include <fmt/core.h>

#include <dirent.h>
#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <random>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include "file_names.h"

namespace trochoid::results {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view being_filled = ".new-";
constexpr std::string_view set_aside = ".old-";
/// Chosen at random, behind these.
constexpr std::size_t letters = 6;

std::string reason_of(int error) {
  return std::generic_category().message(error);
}

int open_folder(const fs::path& folder) {
  return ::open(folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
}

/// Of this folder and kind, all but its last letters.
std::string hidden_name(const fs::path& place, std::string_view kind) {
  return fmt::format(".{}{}", place.filename().string(), kind);
}

/// A new folder beside the place, of a name that nobody else has.
fs::path make_beside(const fs::path& place, std::string_view kind) {
  static constexpr std::string_view alphabet = "abcdefghijklmnopqrstuvwxyz012345";
  std::random_device random;
  std::error_code error;
  constexpr int tries = 100;
  for (int i = 0; i < tries; ++i) {
    std::string name = hidden_name(place, kind);
    for (std::size_t k = 0; k < letters; ++k) {
      name += alphabet[random() % alphabet.size()];
    }
    const fs::path folder = place.parent_path() / name;
    if (fs::create_directory(folder, error)) {
      return folder;
    }
    if (error) break;  // else the name is taken
  }
  cannot_write(place, error ? error.message() : "no name is free beside it");
}

bool is_left_over(const fs::path& entry, const fs::path& place, std::string_view kind) {
  const std::string start = hidden_name(place, kind);
  const std::string name = entry.filename().string();
  return name.size() == start.size() + letters && name.starts_with(start);
}

bool is_of_type(const fs::path& path, fs::file_type type) {
  std::error_code error;
  return fs::symlink_status(path, error).type() == type;
}

bool holds_only_ours(const fs::path& folder) {
  const auto names = names_in(folder);
  return names && std::all_of(names->begin(), names->end(), [&](const auto& name) {
           return is_ours(name) && is_of_type(folder / name, fs::file_type::regular);
         });
}

/// Its writer is no more: nobody holds the lock on it.
bool is_abandoned(const fs::path& folder) {
  const int descriptor = open_folder(folder);
  const bool free = descriptor >= 0 && ::flock(descriptor, LOCK_EX | LOCK_NB) == 0;
  if (descriptor >= 0) {
    ::close(descriptor);
  }
  return free;
}

enum class Swap { done, no_such_place, unknown };

/// In one step, where system and file system know how.
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

/// The old folder aside, then the fresh one to its place; back again if that fails.
void put_in_two_steps(const fs::path& fresh, const fs::path& place) {
  const fs::path aside = make_beside(place, set_aside);
  std::error_code error;
  fs::rename(place, aside, error);
  const bool replaces = !error;
  if (error && error != std::errc::no_such_file_or_directory) {
    const std::error_code reason = error;
    fs::remove(aside, error);
    cannot_write(place, reason.message());
  }
  fs::rename(fresh, place, error);
  if (error) {
    const std::error_code reason = error;
    if (replaces) fs::rename(aside, place, error);
    cannot_write(place, reason.message());
  }
  fs::remove_all(aside, error);
}

}  // namespace

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

void cannot_write(const fs::path& path, const std::string& reason) {
  throw std::runtime_error("cannot write " + path.string() + ": " + reason);
}

void flush_to_disk(const fs::path& path, const fs::path& shown) {
  const int descriptor = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor < 0) {
    cannot_write(shown, reason_of(errno));
  }
  const int failed = ::fsync(descriptor) == 0 ? 0 : errno;
  ::close(descriptor);
  // A file system that cannot be asked is not one that has failed.
  if (failed != 0 && failed != EINVAL && failed != ENOTSUP && failed != EROFS) {
    cannot_write(shown, reason_of(failed));
  }
}

PlaceLock::PlaceLock(const fs::path& place)
    : descriptor_(open_folder(place.parent_path())) {
  while (descriptor_ >= 0 && !held_) {
    held_ = ::flock(descriptor_, LOCK_EX) == 0;
    if (!held_ && errno != EINTR) break;
  }
}

PlaceLock::~PlaceLock() {
  if (descriptor_ >= 0) {
    ::close(descriptor_);
  }
}

StagedFolder::StagedFolder(fs::path place) : place_(std::move(place)) {
  const PlaceLock lock(place_);
  mend(place_, lock);
  path_ = make_beside(place_, being_filled);
  descriptor_ = open_folder(path_);
  if (descriptor_ >= 0) {
    ::flock(descriptor_, LOCK_EX | LOCK_NB);
  }
}

StagedFolder::~StagedFolder() {
  std::error_code error;
  fs::remove_all(path_, error);
  if (descriptor_ >= 0) {
    ::close(descriptor_);
  }
}

void StagedFolder::put_in_place(const PlaceLock& /*lock*/) {
  flush_to_disk(path_, place_);
  switch (exchange(path_, place_)) {
    case Swap::done:
      break;
    case Swap::no_such_place: {
      std::error_code error;
      fs::rename(path_, place_, error);
      if (error) cannot_write(place_, error.message());
      break;
    }
    case Swap::unknown:
      put_in_two_steps(path_, place_);
      break;
  }
  flush_to_disk(place_.parent_path(), place_);
}

void mend(const fs::path& place, const PlaceLock& lock) {
  if (!lock.held()) {
    return;
  }
  std::vector<fs::path> unfinished;
  std::vector<fs::path> aside;
  std::error_code error;
  for (const std::string& name :
       names_in(place.parent_path()).value_or(std::vector<std::string>{})) {
    const fs::path folder = place.parent_path() / name;
    for (const auto& [kind, list] :
         {std::pair{being_filled, &unfinished}, std::pair{set_aside, &aside}}) {
      if (is_left_over(folder, place, kind) &&
          is_of_type(folder, fs::file_type::directory) && is_abandoned(folder) &&
          holds_only_ours(folder)) {
        list->push_back(folder);
      }
    }
  }
  const bool missing = is_of_type(place, fs::file_type::not_found);
  const auto whole = std::find_if(aside.begin(), aside.end(), holds_our_summary);
  if (missing && whole != aside.end()) {
    fs::rename(*whole, place, error);
    aside.erase(whole);
  }
  for (const auto* list : {&unfinished, &aside}) {
    for (const fs::path& folder : *list) {
      fs::remove_all(folder, error);
    }
  }
}

}  // namespace trochoid::results
