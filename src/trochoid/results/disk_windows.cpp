#include "disk.h"

#include <fmt/core.h>

#include <windows.h>
#include <cwctype>

namespace trochoid::results {

namespace fs = std::filesystem;

namespace {

/// Windows locks no folder, but objects with a name, which a kill frees as well.
std::string lock_name(const fs::path& folder) {
  std::uint64_t hash = 0xcbf29ce484222325U;  // FNV-1a, of what differs not only by case
  for (const wchar_t letter : folder.generic_wstring()) {
    hash ^= static_cast<std::uint64_t>(std::towlower(static_cast<wint_t>(letter)));
    hash *= 0x100000001b3U;
  }
  return fmt::format("Local\\trochoid-{:016x}", hash);
}

HANDLE handle_of(std::intptr_t handle) {
  return reinterpret_cast<HANDLE>(handle);
}

std::error_code last_error() {
  return {static_cast<int>(::GetLastError()), std::system_category()};
}

}  // namespace

const bool open_files_keep_their_folder = true;

FolderLock::FolderLock(const fs::path& folder, Patience patience) {
  const HANDLE mutex = ::CreateMutexA(nullptr, FALSE, lock_name(folder).c_str());
  if (mutex == nullptr) {
    return;
  }
  handle_ = reinterpret_cast<std::intptr_t>(mutex);
  const DWORD got =
      ::WaitForSingleObject(mutex, patience == Patience::none ? 0 : INFINITE);
  held_ = got == WAIT_OBJECT_0 || got == WAIT_ABANDONED;
}

FolderLock::~FolderLock() {
  if (held_) {
    ::ReleaseMutex(handle_of(handle_));
  }
  if (handle_ != -1) {
    ::CloseHandle(handle_of(handle_));
  }
}

Swap exchange(const fs::path& /*a*/, const fs::path& /*b*/) {
  return Swap::unknown;
}

std::error_code flush(const fs::path& path) {
  std::error_code ignored;
  if (fs::is_directory(path, ignored)) {
    return {};  // which cannot be asked
  }
  const HANDLE file =
      ::CreateFileW(path.c_str(), GENERIC_WRITE, FILE_SHARE_READ | FILE_SHARE_WRITE,
                    nullptr, OPEN_EXISTING, FILE_ATTRIBUTE_NORMAL, nullptr);
  if (file == INVALID_HANDLE_VALUE) {
    return last_error();
  }
  const std::error_code failed =
      ::FlushFileBuffers(file) != 0 ? std::error_code{} : last_error();
  ::CloseHandle(file);
  return failed;
}

std::optional<std::vector<std::string>> names_in(const fs::path& folder) {
  WIN32_FIND_DATAW entry{};
  const HANDLE search = ::FindFirstFileW((folder / L"*").c_str(), &entry);
  if (search == INVALID_HANDLE_VALUE) {
    return std::nullopt;
  }
  std::vector<std::string> names;
  do {
    const fs::path name(entry.cFileName);
    if (name != L"." && name != L"..") {
      names.push_back(name.string());
    }
  } while (::FindNextFileW(search, &entry) != 0);
  const bool whole = ::GetLastError() == ERROR_NO_MORE_FILES;
  ::FindClose(search);
  return whole ? std::optional(std::move(names)) : std::nullopt;
}

long process_number() noexcept {
  return static_cast<long>(::GetCurrentProcessId());
}

}  // namespace trochoid::results
