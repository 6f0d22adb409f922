#include <trochoid/base/error.h>
#include <trochoid/base/nesting.h>
#include <trochoid/base/printable.h>
#include <trochoid/base/read_text.h>
#include <trochoid/cases/document.h>
#include <trochoid/cases/inches.h>
#include <trochoid/cases/number_text.h>

#include <fmt/core.h>
#include <toml++/toml.h>

#include <algorithm>
#include <system_error>

namespace trochoid::cases {

namespace {

constexpr std::uintmax_t largest_case_file = 16U << 20U;

Location location(const std::string& file, const toml::source_region& region) {
  return {file, std::max(1, static_cast<int>(region.begin.line)),
          std::max(1, static_cast<int>(region.begin.column))};
}

Node converted(const std::string& file, const toml::node& from);

Node converted_table(const std::string& file, const toml::table& from) {
  Members members;
  for (const auto& [key, value] : from) {
    members.push_back(
        {std::string(key.str()), location(file, key.source()), converted(file, value)});
  }
  // toml++ sorts by name; people read from top to bottom.
  std::stable_sort(members.begin(), members.end(), [](const auto& a, const auto& b) {
    return std::pair(a.where.line, a.where.column) <
           std::pair(b.where.line, b.where.column);
  });
  return {std::move(members), location(file, from.source())};
}

Node converted(const std::string& file, const toml::node& from) {
  if (const toml::table* table = from.as_table()) {
    return converted_table(file, *table);
  }
  Node node{{}, location(file, from.source())};
  if (const toml::array* array = from.as_array()) {
    Array entries;
    for (const toml::node& entry : *array) {
      entries.push_back(converted(file, entry));
    }
    node.value = std::move(entries);
  } else if (const auto* text = from.as_string()) {
    node.value = text->get();
  } else if (const auto* whole = from.as_integer()) {
    node.value = whole->get();
  } else if (const auto* number = from.as_floating_point()) {
    node.value = number->get();
  } else if (const auto* truth = from.as_boolean()) {
    node.value = truth->get();
  }
  return node;
}

[[noreturn]] void refuse(const Location& where, const std::string& why) {
  throw base::InputError({to_string(where) + ": " + why});
}

std::string content_of(const std::filesystem::path& file) {
  const Location start{file.string()};
  std::error_code error;
  const auto status = std::filesystem::status(file, error);
  if (!std::filesystem::exists(status)) {
    refuse(start, "there is no such file; `trochoid new simulate` writes a case file");
  }
  if (std::filesystem::is_directory(status)) {
    refuse(start, "this is a folder; a case file (TOML) is expected");
  }
  if (!std::filesystem::is_regular_file(status)) {
    refuse(start, "this is not a regular file; a case file (TOML) is expected");
  }
  if (std::filesystem::file_size(file, error) > largest_case_file) {
    refuse(start, "larger than 16 MiB; this cannot be a case file");
  }
  auto text = base::read_text(file);
  if (!text) {
    refuse(start, "the file cannot be read; look at its permissions");
  }
  return *std::move(text);
}

constexpr std::size_t longest_value_shown = 60;

std::string shortened(std::string text, std::size_t longest = longest_value_shown) {
  if (text.size() > longest) {
    text.resize(longest);
    // Do not end inside a UTF-8 sequence.
    while (!text.empty() &&
           (static_cast<unsigned char>(text.back()) & 0xC0U) == 0x80U) {
      text.pop_back();
    }
    if (!text.empty() && static_cast<unsigned char>(text.back()) >= 0xC0U) {
      text.pop_back();
    }
    text += "...";
  }
  return text;
}

struct Printer {
  std::string operator()(const DateOrTime&) const { return "(a date or a time)"; }
  std::string operator()(bool value) const { return value ? "true" : "false"; }
  std::string operator()(std::int64_t value) const { return std::to_string(value); }
  std::string operator()(double value) const { return number_text(value); }
  std::string operator()(const std::string& value) const { return toml_string(value); }
  std::string operator()(const Array& entries) const {
    std::string text;
    for (const Node& entry : entries) {
      text += (text.empty() ? "" : ", ") + to_string(entry);
      if (text.size() > longest_value_shown) {
        break;
      }
    }
    return "[" + text + "]";
  }
  std::string operator()(const Members& members) const {
    return members.empty() ? "{}" : "{ " + members.front().key + " = ... }";
  }
};

/// What is likely meant by the usual slips.
std::string_view hint(std::string_view why) {
  if (why.ends_with("saw ','")) {
    return "; numbers have a decimal point";
  }
  if (why.find("could not determine value type") != std::string_view::npos) {
    return "; a text needs quotes: key = \"value\"";
  }
  if (why.find("unknown escape sequence") != std::string_view::npos) {
    return "; in the name of a file write / in place of \\";
  }
  return {};
}

}  // namespace

std::string to_string(const Location& where) {
  if (where.line == 0 || where.line == beside_the_file) {
    return where.line == 0 ? "case" : "--set";
  }
  return fmt::format("{}:{}:{}", where.file, where.line, where.column);
}

const Node* find(const Node& table, std::string_view key) {
  const auto* members = std::get_if<Members>(&table.value);
  if (members == nullptr) {
    return nullptr;
  }
  const auto found = std::find_if(members->begin(), members->end(),
                                  [&](const Member& m) { return m.key == key; });
  return found == members->end() ? nullptr : &found->node;
}

std::string to_string(const Node& node) {
  return shortened(std::visit(Printer{}, node.value));
}

Node parse_file(const std::filesystem::path& file) {
  return parse_text(content_of(file), file.string());
}

Node parse_text(const std::string& text, const std::string& name) {
  if (const auto deep = base::too_deep(text)) {
    refuse({name, deep->line, deep->column},
           std::string(deep->why) + "; no case file needs that");
  }
  try {
    const toml::table table = toml::parse(text, name);
    Node root = converted_table(name, table);
    root.where = {name};
    take_inches(root);
    return root;
  } catch (const toml::parse_error& error) {
    const std::string_view why = error.description();
    refuse(location(name, error.source()),
           fmt::format("not valid TOML: {}{}", shortened(base::one_line(why), 200),
                       hint(why)));
  }
}

}  // namespace trochoid::cases
