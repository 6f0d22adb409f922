#include "staged_folder.h"

#include <fmt/core.h>

#include <algorithm>
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
  cannot_write(place, error ? error.message() : "no name is free in its parent folder");
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
           return is_ours_in(folder, name) &&
                  is_of_type(folder / name, fs::file_type::regular);
         });
}

/// Its writer is no more: nobody holds the lock on it.
bool is_abandoned(const fs::path& folder) {
  return FolderLock(folder, Patience::none).held();
}

/// Of a step that failed, with what most often stands in its way.
std::string reason_of(const std::error_code& error) {
  const bool open =
      open_files_keep_their_folder && error == std::errc::permission_denied;
  return error.message() + (open ? " (is a file of it open in another program?)" : "");
}

/// The old folder aside, then the fresh one to its place; back again if that fails.
void put_in_two_steps(const fs::path& fresh, const fs::path& place) {
  const fs::path aside = make_beside(place, set_aside);
  std::error_code error;
  fs::remove(aside, error);  // not every system renames to a folder that is there
  // Asked first: of a rename some systems tell only that it failed.
  const bool replaces = !is_of_type(place, fs::file_type::not_found);
  if (replaces) {
    fs::rename(place, aside, error);
    if (error) cannot_write(place, reason_of(error));
  }
  fs::rename(fresh, place, error);
  if (error) {
    const std::string reason = reason_of(error);
    if (replaces) fs::rename(aside, place, error);
    cannot_write(place, reason);
  }
  fs::remove_all(aside, error);
}

}  // namespace

void cannot_write(const fs::path& path, const std::string& reason) {
  throw std::runtime_error("cannot write " + path.string() + ": " + reason);
}

void flush_to_disk(const fs::path& path, const fs::path& shown) {
  if (const std::error_code failed = flush(path)) {
    cannot_write(shown, failed.message());
  }
}

StagedFolder::StagedFolder(fs::path place) : place_(std::move(place)) {
  const PlaceLock lock(place_);
  mend(place_, lock);
  path_ = make_beside(place_, being_filled);
  try {
    lock_.emplace(path_, Patience::none);
  } catch (...) {  // of what is half made no destructor runs
    std::error_code error;
    fs::remove(path_, error);
    throw;
  }
}

StagedFolder::~StagedFolder() {
  std::error_code error;
  fs::remove_all(path_, error);
}

void StagedFolder::put_in_place(const PlaceLock& /*lock*/) {
  flush_to_disk(path_, place_);
  switch (exchange(path_, place_)) {
    case Swap::done:
      break;
    case Swap::no_such_place: {
      std::error_code error;
      fs::rename(path_, place_, error);
      if (error) cannot_write(place_, reason_of(error));
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
