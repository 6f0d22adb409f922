#include <trochoid/cases/case_source.h>
#include <trochoid/cases/number_text.h>
#include <trochoid/cases/rules.h>

#include <fmt/core.h>

#include <algorithm>
#include <functional>

namespace trochoid::cases {

namespace {

namespace fs = std::filesystem;

/// A file that a case names.
struct Named {
  std::string_view table;
  std::string key;             ///< its path
  std::string_view must_be;    ///< what it must be, in words
  std::string_view in_folder;  ///< as Key::in_folder
  files::FileRef& file;
};

void for_each_file(CaseTables& tables, const std::function<void(const Named&)>& use) {
  for (const TableEntry& table : tables_of(tables)) {
    for (std::size_t i = 0; i < table.count(); ++i) {
      table.describe(i, [&](const Key& key, const Field& field) {
        const auto path = [&] {
          return fmt::format("{}{}.{}", table.name,
                             table.many ? fmt::format("[{}]", i + 1) : "", key.name);
        };
        if (NamedFiles* const* all = std::get_if<NamedFiles*>(&field)) {
          for (auto& [name, one] : **all) {
            use({table.name, path() + "." + name, key.file, key.in_folder, one});
          }
          return;
        }
        files::FileRef* const* file = std::get_if<files::FileRef*>(&field);
        if (file == nullptr || (*file)->name.empty()) return;
        use({table.name, path(), key.file, key.in_folder, **file});
      });
    }
  }
}

/// @brief A file that a case names, seen from where we run.
/// @param named_at  the place of the name: the path is relative to that file, and that
///                  file to Findings::base
fs::path resolved(const std::string& file, const Location& named_at,
                  const Findings& findings) {
  const fs::path folder = findings.base / fs::path(named_at.file).parent_path();
  return (folder / file).lexically_normal();
}

/// Report a file that is not there or that cannot be a measurement.
void check_file(const Named& named, Findings& findings) {
  std::error_code error;
  const auto status = fs::status(named.file.path, error);
  std::string why;
  if (!fs::exists(status)) {
    const std::string& path = named.file.path;
    const bool plain = std::none_of(path.begin(), path.end(), [](char c) {
      return static_cast<unsigned char>(c) < 0x20;
    });
    why = fmt::format("there is no such file ({}){}", plain ? path : toml_string(path),
                      plain ? "" : "; in the name of a file write / in place of \\");
  } else if (fs::is_directory(status)) {
    why = "this is a folder";
  } else if (!fs::is_regular_file(status)) {
    why = "this is not a regular file";
  }
  if (!why.empty()) {
    report(findings, named.key,
           fmt::format("{} = {}: {}; must be {}, relative to the file that names it",
                       named.key, toml_string(named.file.name), why, named.must_be));
  }
}

/// The data of that name, if it is in memory.
void look_in_memory(const DataInMemory& data, const Named& named) {
  const auto take = [&](const auto& all, auto& target) {
    const auto found = all.find(named.file.name);
    if (found != all.end()) target = found->second;
  };
  if (named.table == "measurement") {
    take(data.records, named.file.numbers);
  } else {
    take(data.texts, named.file.bytes);
  }
}

}  // namespace

void settle_files(CaseTables& tables, const DataInMemory& data, Findings& findings) {
  for_each_file(tables, [&](const Named& named) {
    files::FileRef& file = named.file;
    const Location named_at = place_of(findings, named.key);
    file.location = to_string(named_at);
    file.path = file.name;
    look_in_memory(data, named);
    if (file.in_memory()) return;
    fs::path path = resolved(file.name, named_at, findings);
    std::error_code error;
    if (!named.in_folder.empty() && fs::is_directory(path, error)) {
      path /= named.in_folder;
    }
    file.path = path.generic_string();
  });
}

void check_files(CaseTables& tables, Findings& findings) {
  for_each_file(tables, [&](const Named& named) {
    if (!named.file.in_memory() && sound(findings, {named.key})) {
      check_file(named, findings);
    }
  });
}

void name_files_from(const fs::path& folder, CaseTables& tables) {
  for_each_file(tables, [&](const Named& named) {
    files::FileRef& file = named.file;
    if (file.in_memory() || fs::path(file.name).is_absolute()) return;
    const fs::path whole = fs::absolute(file.path).lexically_normal();
    file.name = folder.empty()
                    ? whole.generic_string()
                    : whole.lexically_relative(fs::absolute(folder).lexically_normal())
                          .generic_string();
  });
}

}  // namespace trochoid::cases
