#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "disk.h"

namespace trochoid::results {

/// @brief Only one program at a time changes what lies beside a result folder.
///
/// A lock on the parent of the folder; where the file system knows none, there is none.
class PlaceLock {
 public:
  explicit PlaceLock(const std::filesystem::path& place)
      : lock_(place.parent_path(), Patience::endless) {}
  [[nodiscard]] bool held() const noexcept { return lock_.held(); }

 private:
  FolderLock lock_;
};

/// @brief A folder that is filled beside its place, and then put there whole.
///
/// It is hidden, `.NAME.new-XXXXXX`, and locked while it is filled, so that the next
/// program can tell a living one from what a kill left. Where the system swaps two
/// folders in one step, the place holds the old or the new one at every moment. Elsewhere
/// the old one is `.NAME.old-XXXXXX` in between, and `mend` puts it back.
class StagedFolder {
 public:
  /// Mends what earlier kills left beside `place`, too.
  /// @param place  absolute; its parent exists
  /// @throws std::runtime_error when no folder can be made there
  explicit StagedFolder(std::filesystem::path place);
  /// What was not put in place is removed.
  ~StagedFolder();
  StagedFolder(const StagedFolder&) = delete;
  StagedFolder& operator=(const StagedFolder&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

  /// @throws std::runtime_error when it cannot; the place is then as it was
  void put_in_place(const PlaceLock& lock);

 private:
  std::filesystem::path place_;
  std::filesystem::path path_;
  std::optional<FolderLock> lock_;
};

/// @brief Put back or remove what a killed program left beside `place`.
///
/// Only folders named as above, which nobody holds and that hold nothing but our files.
void mend(const std::filesystem::path& place, const PlaceLock& lock);

/// @brief Wait until what was written to a file or folder is on the disk.
/// @throws std::runtime_error naming `shown` when the disk says that it is not
void flush_to_disk(const std::filesystem::path& path,
                   const std::filesystem::path& shown);

/// @brief "cannot write PATH: REASON"
[[noreturn]] void cannot_write(const std::filesystem::path& path,
                               const std::string& reason);

}  // namespace trochoid::results
