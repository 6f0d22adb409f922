#include <trochoid/cases/inches.h>
#include <trochoid/cases/read_table.h>
#include <trochoid/cases/read_value.h>
#include <trochoid/cases/tables.h>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>

namespace trochoid::cases {

std::string home_of(std::string_view key) {
  if (key == "title" || key == "schema" || key == "include") {
    return fmt::format("; {} stands above all tables", key);
  }
  CaseTables tables;
  for (const TableEntry& entry : tables_of(tables)) {
    if (entry.count() == 0) {
      entry.add();
    }
    bool here = false;
    entry.describe(0,
                   [&](const Key& k, const Field&) { here = here || k.name == key; });
    if (here) {
      return fmt::format("; {} belongs to {}", key, heading(entry));
    }
  }
  return {};
}

namespace {

void forget_inheritance(Node& node) {
  node.inherited = false;
  if (auto* members = std::get_if<Members>(&node.value)) {
    for (Member& member : *members) {
      forget_inheritance(member.node);
    }
  }
}

bool any_below(const std::set<std::string>& paths, const std::string& table) {
  return std::any_of(paths.begin(), paths.end(), [&](const std::string& path) {
    return path == table || path.starts_with(table + ".");
  });
}

/// A file with more problems than this needs other help.
constexpr std::size_t most_hints = 100;

struct TableReader {
  const Node& table;
  const std::string& path;
  const Reading& reading;
  Findings& findings;
  std::vector<std::string> known = {};
  std::map<std::string, std::string, std::less<>> must_be = {};  ///< of each known key
  std::map<std::string, std::string, std::less<>> missing = {};  ///< key to message
  std::map<std::string, std::string, std::less<>> chosen = {};

  [[nodiscard]] std::string path_of(std::string_view key) const {
    return path.empty() ? std::string(key) : fmt::format("{}.{}", path, key);
  }

  void operator()(const Key& key, const Field& field) {
    known.emplace_back(key.name);
    must_be[known.back()] =
        fmt::format("must be {} ({})", expectation(key, field), key.meaning);
    const std::string key_path = path_of(key.name);
    const Node* node = find(table, key.name);
    if (node == nullptr) {
      if (lacks(key)) {
        note_missing(key, key_path);
      }
    } else if (applies(key, field, *node, key_path)) {
      read(*node, key, field, key_path);
    }
    if (const auto* choice = std::get_if<Choice>(&field)) {
      if (findings.wrong.count(key_path) == 0) {
        chosen[std::string(key.name)] =
            std::string(choice->names[static_cast<std::size_t>(choice->get())]);
      }
    }
  }

  void read(const Node& node, const Key& key, const Field& field,
            const std::string& key_path) const {
    findings.places[key_path] = node.where;
    if (CutTable* const* cut = std::get_if<CutTable*>(&field)) {
      read_override(node, **cut, key, key_path);
      return;
    }
    if (auto* const* clamping = std::get_if<std::optional<PreviousClamping>*>(&field)) {
      read_inner(node, **clamping, key, key_path);
      return;
    }
    if (auto* const* wave = std::get_if<std::optional<geometry::Serration>*>(&field)) {
      read_inner(node, **wave, key, key_path);
      return;
    }
    if (auto* const* frame = std::get_if<std::optional<files::SurfaceFrame>*>(&field)) {
      read_inner(node, **frame, key, key_path);
      return;
    }
    const std::size_t before = findings.problems.size();
    read_value(node, key_path, key, field, findings);
    if (reading.only_own && node.inherited) {
      findings.problems.resize(before);
    }
  }

  template <class Inner>
  void read_inner(const Node& node, std::optional<Inner>& inner, const Key& key,
                  const std::string& key_path) const {
    if (!std::holds_alternative<Members>(node.value)) {
      report(findings, key_path, node.where,
             fmt::format("{} = {}: not a table; must be {} ({})", key_path,
                         to_string(node), expectation(key, &inner), key.meaning));
      return;
    }
    read_table(
        node, key_path, [&inner](const Visitor& v) { describe(v, inner.emplace()); },
        reading, findings);
  }

  void read_override(const Node& node, CutTable& cut, const Key& key,
                     const std::string& key_path) const {
    if (!std::holds_alternative<Members>(node.value)) {
      report(findings, key_path, node.where,
             fmt::format("{} = {}: not a table; must be {} ({})", key_path,
                         to_string(node), expectation(key, &cut), key.meaning));
      return;
    }
    if (reading.cut == nullptr) {
      return;  // that [cut] is missing, or no table, has been said
    }
    Node over = node;
    forget_inheritance(over);
    Reading inner = reading;
    inner.only_own = true;
    read_table(
        merged(*reading.cut, over), key_path,
        [&cut](const Visitor& v) { describe(v, cut); }, inner, findings);
  }

  /// 1: the key has a meaning here; 0: it has none; -1: its selector is wrong itself.
  [[nodiscard]] int belongs(const Key& key) const {
    if (key.only.selector.empty()) {
      return 1;
    }
    const auto choice = chosen.find(key.only.selector);
    if (choice == chosen.end()) {
      return -1;
    }
    const auto& values = key.only.values;
    return std::find(values.begin(), values.end(), choice->second) != values.end() ? 1
                                                                                   : 0;
  }

  [[nodiscard]] bool lacks(const Key& key) const {
    const bool needed =
        key.need == Need::always ||
        (key.need == Need::coefficient && reading.coefficients_needed) ||
        (key.need == Need::cutting && reading.coefficients_needed &&
         reading.cutting_needed);
    const bool replaced = !key.rival.empty() && find(table, key.rival) != nullptr;
    const bool said_before = reading.only_own && any_below(findings.wrong, "cut");
    return needed && !replaced && !said_before && belongs(key) == 1;
  }

  /// Told at the end only: the key may be there with another spelling.
  void note_missing(const Key& key, const std::string& key_path) {
    std::string why;
    if (!key.only.selector.empty()) {
      why = fmt::format(" for {} = \"{}\"", key.only.selector,
                        chosen.find(key.only.selector)->second);
    }
    if (!key.rival.empty()) {
      why += fmt::format(", and so is {}", key.rival);
    }
    findings.wrong.insert(key_path);
    missing[known.back()] =
        fmt::format("{} is missing{}; {}", key_path, why, must_be[known.back()]);
  }

  /// The key of this table that may be meant: where another table has the key, one that
  /// differs in a letter only.
  [[nodiscard]] std::string near_key(std::string_view key, bool has_home) const {
    std::string near = nearest(key, known);
    if (!has_home) return near;
    std::size_t differ = near.size() == key.size() ? 0 : key.size();
    for (std::size_t i = 0; i < near.size() && near.size() == key.size(); ++i) {
      differ += near[i] == key[i] ? 0U : 1U;
    }
    return differ == 1 ? near : std::string();
  }

  void report_unknown(const Member& member) {
    const std::string shown = path_of(shown_key(member.key));
    std::string hint;
    if (const std::string mm = key_in_mm(member.key); find(table, mm) != nullptr) {
      report(findings, shown, member.where,
             fmt::format("{} = {}: {} is given as well; give one of them", shown,
                         shown_value(member.key, member.node), mm));
      return;
    }
    if (findings.problems.size() < most_hints) {
      hint = home_of(member.key);
      const std::string near = near_key(member.key, !hint.empty());
      if (hint.empty() || !near.empty()) hint = suggestion(member.key, known);
      if (!near.empty()) {
        missing.erase(near);
        hint += " " + must_be[near];
      }
    }
    report(findings, shown, member.where,
           fmt::format("{} = {}: no such key{}", shown,
                       shown_value(member.key, member.node), hint));
  }

  void finish() {
    for (const Member& member : std::get<Members>(table.value)) {
      const bool is_known =
          std::find(known.begin(), known.end(), member.key) != known.end();
      if (!is_known && !(reading.only_own && member.node.inherited)) {
        report_unknown(member);
      }
    }
    for (const std::string& key : known) {
      const auto message = missing.find(key);
      if (message != missing.end()) {
        report(findings, path_of(key), table.where, message->second);
      }
    }
  }

  /// Whether a key that is there is to be read; reports one that has no meaning here.
  bool applies(const Key& key, const Field& field, const Node& node,
               const std::string& key_path) const {
    const Node* rival = key.rival.empty() ? nullptr : find(table, key.rival);
    if (rival != nullptr && node.inherited && !rival->inherited) {
      return false;
    }
    const int here = belongs(key);
    if (here != 0) {
      return here > 0;
    }
    const Node* selector = find(table, key.only.selector);
    const bool outvoted = node.inherited && selector != nullptr && !selector->inherited;
    if (outvoted || (key.neutral && number_in(node) == key.neutral)) {
      return false;
    }
    report(findings, key_path, node.where,
           fmt::format("{} = {}: has no meaning for {} = \"{}\"; belongs to \"{}\" "
                       "only, where it must be {} ({})",
                       key_path, shown_value(key.name, node), key.only.selector,
                       chosen.find(key.only.selector)->second,
                       fmt::join(key.only.values, "\", \""), expectation(key, field),
                       key.meaning));
    return false;
  }
};

}  // namespace

void read_table(const Node& table, const std::string& path,
                const std::function<void(const Visitor&)>& describe,
                const Reading& reading, Findings& findings) {
  if (!path.empty()) {
    findings.places[path] = table.where;
  }
  TableReader reader{table, path, reading, findings};
  describe([&reader](const Key& key, const Field& field) { reader(key, field); });
  if (!path.empty()) {  // the top of the file holds tables: read_case.cpp knows them
    reader.finish();
  }
}

}  // namespace trochoid::cases
