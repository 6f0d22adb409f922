#include <trochoid/cases/write_case.h>

#include <fmt/core.h>

#include <algorithm>
#include <iterator>

namespace trochoid::cases {

namespace {

template <class Table>
std::string inline_table(Table& table) {
  std::string text;
  describe(
      [&text](const Key& key, const Field& field) {
        if (const auto value = toml_text(key, field)) {
          text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", key.name, *value);
        }
      },
      table);
  return fmt::format("{{ {} }}", text);
}

template <class Inner>
std::optional<std::string> inner_text(std::optional<Inner>* inner) {
  return inner != nullptr && *inner ? std::optional(inline_table(**inner))
                                    : std::nullopt;
}

/// What every cut has, in any case.
bool is_of_a_cut(std::string_view table) {
  constexpr std::string_view names[] = {"tool", "runout", "cut",
                                        "chip", "force",  "sampling"};
  return std::find(std::begin(names), std::end(names), table) != std::end(names);
}

/// What a case about a whole program leaves out.
bool is_of_one_cut(std::string_view table) {
  return table == "cut" || table == "sampling";
}

using Left = bool (*)(std::string_view table);

std::string written(CaseTables& tables, Left left_out) {
  std::string text;
  const Visitor key_line = [&text](const Key& key, const Field& field) {
    if (const auto value = value_text(key, field)) {
      text += fmt::format("{} = {}\n", key.name, *value);
    }
  };
  describe(key_line, tables);
  for (const TableEntry& table : tables_of(tables)) {
    if (left_out != nullptr && left_out(table.name)) {
      continue;
    }
    for (std::size_t i = 0; i < table.count(); ++i) {
      text += text.empty() ? "" : "\n";
      text += heading(table) + '\n';
      table.describe(i, key_line);
    }
  }
  return text;
}

}  // namespace

std::optional<std::string> value_text(const Key& key, const Field& field) {
  if (CutTable* const* cut = std::get_if<CutTable*>(&field)) {
    return inline_table(**cut);
  }
  if (auto* const* clamping = std::get_if<std::optional<PreviousClamping>*>(&field)) {
    return inner_text(*clamping);
  }
  if (auto* const* wave = std::get_if<std::optional<geometry::Serration>*>(&field)) {
    return inner_text(*wave);
  }
  if (auto* const* frame = std::get_if<std::optional<files::SurfaceFrame>*>(&field)) {
    return inner_text(*frame);
  }
  return toml_text(key, field);
}

std::string write_case(CaseTables& tables) {
  return written(tables, nullptr);
}

std::string write_machine_case(CaseTables& tables) {
  return written(tables, is_of_a_cut);
}

std::string write_program_case(CaseTables& tables) {
  return written(tables, is_of_one_cut);
}

}  // namespace trochoid::cases
