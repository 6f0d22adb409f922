#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

/// What std::filesystem does not ask of a system: disk_posix.cpp, disk_windows.cpp.
namespace trochoid::results {

/// How long to wait for a lock.
enum class Patience { none, endless };

/// @brief A folder that no other program locks while this lives.
///
/// A kill frees it. Where the file system knows no locks, none is held.
class FolderLock {
 public:
  FolderLock(const std::filesystem::path& folder, Patience patience);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;
  [[nodiscard]] bool held() const noexcept { return held_; }

 private:
  std::intptr_t handle_ = -1;
  bool held_ = false;
};

enum class Swap { done, no_such_place, unknown };

/// @brief Two folders take each other's place in one step; unknown: not on this system.
Swap exchange(const std::filesystem::path& a, const std::filesystem::path& b);

/// @brief Wait until a file or folder is on the disk.
/// @return what the disk says of it; nothing where it cannot be asked
std::error_code flush(const std::filesystem::path& path);

/// @brief The names in a folder, in no order; none where it cannot be looked into.
///
/// Not by std::filesystem, which ends the program where there is no memory for it.
std::optional<std::vector<std::string>> names_in(const std::filesystem::path& folder);

/// @brief The number that no other program has that runs now.
long process_number() noexcept;

/// Whether a folder stays where it is as long as a file in it is open.
extern const bool open_files_keep_their_folder;

}  // namespace trochoid::results
