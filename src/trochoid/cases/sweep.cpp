#include <trochoid/cases/sweep.h>

#include <trochoid/base/error.h>
#include <trochoid/base/names.h>
#include <trochoid/cases/findings.h>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "sweep_column.h"

namespace trochoid::cases {

namespace {

constexpr int usual_count = 200;
constexpr const char* forms =
    "{ from, to, count }, { values = [...] }, { mean, sd } or { file, column }";

/// Reads one table of [sweep]; what no one asked for is a problem at the end.
class Keys {
 public:
  Keys(const Node& table, std::string path, Findings& findings)
      : table_(table), path_(std::move(path)), findings_(findings) {}

  [[nodiscard]] bool has(std::string_view key) const {
    return find(table_, key) != nullptr;
  }

  const Node* take(std::string_view key) {
    names_.emplace_back(key);
    return find(table_, key);
  }

  std::optional<double> number(std::string_view key) {
    const Node* node = take(key);
    if (node == nullptr) {
      return std::nullopt;
    }
    double value = std::numeric_limits<double>::quiet_NaN();
    if (const auto* real = std::get_if<double>(&node->value)) {
      value = *real;
    } else if (const auto* whole = std::get_if<std::int64_t>(&node->value)) {
      value = static_cast<double>(*whole);
    }
    if (!std::isfinite(value)) {
      wrong(*node, key, "must be a number");
      return std::nullopt;
    }
    return value;
  }

  std::optional<std::int64_t> whole(std::string_view key, std::int64_t from,
                                    std::int64_t to) {
    const Node* node = take(key);
    if (node == nullptr) {
      return std::nullopt;
    }
    const auto* value = std::get_if<std::int64_t>(&node->value);
    if (value == nullptr || *value < from || *value > to) {
      wrong(*node, key, fmt::format("must be a whole number from {} to {}", from, to));
      return std::nullopt;
    }
    return *value;
  }

  std::optional<std::string> text(std::string_view key) {
    const Node* node = take(key);
    const auto* value = node ? std::get_if<std::string>(&node->value) : nullptr;
    if (node != nullptr && value == nullptr) {
      wrong(*node, key, "must be a text");
    }
    return value == nullptr ? std::nullopt : std::optional(*value);
  }

  std::optional<bool> truth(std::string_view key) {
    const Node* node = take(key);
    const auto* value = node ? std::get_if<bool>(&node->value) : nullptr;
    if (node != nullptr && value == nullptr) {
      wrong(*node, key, "must be true or false");
    }
    return value == nullptr ? std::nullopt : std::optional(*value);
  }

  void wrong(const Node& node, std::string_view key, std::string_view why) {
    report(findings_, path_of(key), node.where,
           fmt::format("{} = {}: {}", path_of(key), to_string(node), why));
  }

  void finish() {
    for (const Member& member : std::get<Members>(table_.value)) {
      if (std::find(names_.begin(), names_.end(), member.key) == names_.end()) {
        report(findings_, path_of(member.key), member.where,
               fmt::format("{}: no such key{}", path_of(shown_key(member.key)),
                           suggestion(member.key, names_)));
      }
    }
  }

 private:
  [[nodiscard]] std::string path_of(std::string_view key) const {
    return path_ + "." + std::string(key);
  }

  const Node& table_;
  std::string path_;
  Findings& findings_;
  std::vector<std::string> names_;
};

bool is_value(const Node& node) {
  if (const auto* real = std::get_if<double>(&node.value)) {
    return std::isfinite(*real);
  }
  return std::holds_alternative<std::int64_t>(node.value) ||
         std::holds_alternative<std::string>(node.value) ||
         std::holds_alternative<bool>(node.value);
}

std::optional<ListedValues> listed(Keys& keys) {
  const Node* node = keys.take("values");
  const auto* list = std::get_if<Array>(&node->value);
  if (list == nullptr || list->empty() || !std::ranges::all_of(*list, is_value)) {
    keys.wrong(*node, "values", "must be a list of numbers, texts or true and false");
    return std::nullopt;
  }
  return ListedValues{*list};
}

std::optional<ListedValues> from_file(Keys& keys, const SweptKey& key,
                                      const std::filesystem::path& case_file) {
  const auto name = keys.text("file");
  const auto column = keys.text("column");
  if (!name || !column) {
    return std::nullopt;
  }
  ListedValues listed;
  const std::filesystem::path path = case_file.parent_path() / *name;
  for (const double value : column_of_file(path, *column, to_string(key.where))) {
    listed.values.push_back({.value = value, .where = key.where});
  }
  return listed;
}

/// What one key of `over` is set to; false: there is a problem, told already.
bool read_values(const Node& node, const std::filesystem::path& file, SweptKey& key,
                 Findings& findings) {
  const std::string path = "sweep.over." + shown_key(key.key);
  const std::size_t before = findings.problems.size();
  Keys keys(node, path, findings);
  if (keys.has("values")) {
    if (auto values = listed(keys)) {
      key.values = *std::move(values);
    }
  } else if (keys.has("file")) {
    if (auto values = from_file(keys, key, file)) {
      key.values = *std::move(values);
    } else if (findings.problems.size() == before) {
      report(findings, path, node.where, path + ": `column` is missing");
    }
  } else if (keys.has("mean")) {
    const auto mean = keys.number("mean");
    const auto sd = keys.number("sd");
    if (mean && sd && *sd > 0) {
      key.values = NormalValues{*mean, *sd};
    } else if (findings.problems.size() == before) {
      report(findings, path, node.where, path + ": `sd`, above 0, belongs to a mean");
    }
  } else {
    const auto from = keys.number("from");
    const auto to = keys.number("to");
    const auto count = keys.whole("count", 1, most_sweep_rows);
    if (from && to) {
      key.values = EvenValues{
          *from, *to,
          count ? std::optional(static_cast<int>(*count)) : std::optional<int>()};
    } else if (findings.problems.size() == before) {
      report(findings, path, node.where, fmt::format("{}: must be {}", path, forms));
    }
  }
  keys.finish();
  return findings.problems.size() == before;
}

void read_over(const Node& over, const std::filesystem::path& file, Sweep& sweep,
               Findings& findings) {
  const auto* members = std::get_if<Members>(&over.value);
  if (members == nullptr || members->empty()) {
    report(findings, "sweep.over", over.where,
           fmt::format("sweep.over = {}: must be a table of keys in quotes, each set "
                       "to {}",
                       to_string(over), forms));
    return;
  }
  for (const Member& member : *members) {
    SweptKey key{.key = member.key, .where = member.node.where, .values = {}};
    if (!std::holds_alternative<Members>(member.node.value)) {
      report(
          findings, "sweep.over." + member.key, member.where,
          fmt::format("sweep.over.{} = {}: must be {}; a key with points in it stands "
                      "in quotes: \"cut.spindle_rpm\" = ...",
                      shown_key(member.key), to_string(member.node), forms));
    } else if (read_values(member.node, file, key, findings)) {
      sweep.over.push_back(std::move(key));
    }
  }
}

/// How many values a key has by itself; 0: as many as are asked for.
std::size_t own_count(const SweptKey& key) {
  if (const auto* list = std::get_if<ListedValues>(&key.values)) {
    return list->values.size();
  }
  const auto* even = std::get_if<EvenValues>(&key.values);
  return even != nullptr ? static_cast<std::size_t>(even->count.value_or(0)) : 0;
}

void count_rows(std::optional<std::int64_t> count, Sweep& sweep, Findings& findings) {
  if (by_chance(sweep.method)) {
    sweep.rows = sweep.draws > 0
                     ? sweep.draws
                     : static_cast<std::size_t>(count.value_or(usual_count));
    return;
  }
  if (sweep.over.empty()) {
    sweep.rows = 1;
    return;
  }
  sweep.rows = sweep.method == SweepMethod::grid ? 1 : own_count(sweep.over.front());
  for (const SweptKey& key : sweep.over) {
    const std::string path = "sweep.over." + shown_key(key.key);
    const std::size_t own = own_count(key);
    if (own == 0) {
      report(
          findings, path, key.where,
          fmt::format("{}: method = \"{}\" needs a `count`, or `values`; a mean with "
                      "sd needs \"random\" or \"latin_hypercube\"",
                      path, name_of(sweep.method)));
    } else if (sweep.method == SweepMethod::list && own != sweep.rows) {
      report(findings, path, key.where,
             fmt::format("{}: {} values, but {} of the first key; a list goes through "
                         "all keys together",
                         path, own, sweep.rows));
    } else if (sweep.method == SweepMethod::grid) {
      if (own > most_sweep_rows / sweep.rows / std::max<std::size_t>(sweep.draws, 1)) {
        report(findings, path, key.where,
               fmt::format("{}: more than {} combinations", path, most_sweep_rows));
        return;
      }
      sweep.rows *= own;
    }
  }
  if (sweep.rows > most_sweep_rows / std::max<std::size_t>(sweep.draws, 1)) {
    report(findings, "sweep.draws", sweep.over.front().where,
           fmt::format("sweep.draws = {} of {} rows: more than {} rows", sweep.draws,
                       sweep.rows, most_sweep_rows));
  }
}

void read_take(Keys& keys, Sweep& sweep) {
  const Node* take = keys.take("take");
  if (take == nullptr) {
    return;
  }
  const auto* list = std::get_if<Array>(&take->value);
  const bool texts = list != nullptr && std::ranges::all_of(*list, [](const Node& n) {
                       return std::holds_alternative<std::string>(n.value);
                     });
  if (!texts) {
    keys.wrong(*take, "take", "must be a list of paths such as \"result.peak_xy_N\"");
    return;
  }
  for (const Node& path : *list) {
    sweep.take.push_back(std::get<std::string>(path.value));
  }
}

/// One entry of `covariance`; false: it is none.
bool read_drawn(const Node& node, const std::filesystem::path& file, Sweep& sweep,
                Findings& findings) {
  DrawnFile drawn{.where = node.where};
  const auto* name = std::get_if<std::string>(&node.value);
  if (std::holds_alternative<Members>(node.value)) {
    Keys keys(node, "sweep.covariance", findings);
    const Node* of = keys.take("file");
    name = of != nullptr ? std::get_if<std::string>(&of->value) : nullptr;
    drawn.group = keys.text("group").value_or("");
    keys.finish();
  }
  if (name == nullptr || name->empty()) {
    return false;
  }
  drawn.path = file.parent_path() / *name;
  sweep.covariance.push_back(std::move(drawn));
  return true;
}

/// `covariance` and `draws`, which belong together.
void read_draws(Keys& keys, const std::filesystem::path& file, Sweep& sweep,
                Findings& findings) {
  const Node* node = keys.take("covariance");
  const auto draws = keys.whole("draws", 1, most_draws);
  if (node == nullptr) {
    if (keys.has("draws")) {
      keys.wrong(*keys.take("draws"), "draws",
                 "`covariance` is missing: the summary.json of identify, modes or "
                 "calibrate that is drawn from");
    }
    return;
  }
  const auto* list = std::get_if<Array>(&node->value);
  const std::vector<Node> entries = list != nullptr ? *list : Array{*node};
  const bool right =
      !entries.empty() && std::ranges::all_of(entries, [&](const Node& n) {
        return read_drawn(n, file, sweep, findings);
      });
  if (!right) {
    keys.wrong(*node, "covariance",
               "must be a summary.json of identify, modes or calibrate, its folder, a "
               "list of them, or { file, group } for one group of records");
  }
  sweep.draws = static_cast<std::size_t>(draws.value_or(usual_count));
  if (by_chance(sweep.method) && keys.has("count")) {
    keys.wrong(*keys.take("count"), "count",
               "with `covariance` each row is one draw: `draws` says how many");
  }
}

}  // namespace

Sweep read_sweep(const Node& root, const std::filesystem::path& file) {
  Findings findings{.file = file.string()};
  const Node* table = find(root, "sweep");
  if (table == nullptr || !std::holds_alternative<Members>(table->value)) {
    report(
        findings, "sweep",
        fmt::format("[sweep] is missing (which keys of the case take which values); "
                    "for example over = {{ \"cut.spindle_rpm\" = {{ from = 800, to = "
                    "4000, count = 33 }} }}"));
    throw base::InputError(lines(findings));
  }
  Sweep sweep;
  Keys keys(*table, "sweep", findings);
  if (const auto method = keys.text("method")) {
    if (const auto named = base::named<SweepMethod>(*method)) {
      sweep.method = *named;
    } else {
      keys.wrong(
          *find(*table, "method"), "method",
          fmt::format("must be one of {}", fmt::join(base::names<SweepMethod>, ", ")));
    }
  }
  sweep.seed = static_cast<std::uint64_t>(
      keys.whole("seed", 0, std::numeric_limits<std::int64_t>::max()).value_or(1));
  const auto count = keys.whole("count", 1, most_sweep_rows);
  sweep.command = keys.text("command").value_or("");
  sweep.hdf5 = keys.truth("hdf5").value_or(false);
  read_take(keys, sweep);
  read_draws(keys, file, sweep, findings);
  if (const Node* over = keys.take("over")) {
    read_over(*over, file, sweep, findings);
  } else if (sweep.covariance.empty()) {
    report(
        findings, "sweep.over", table->where,
        "sweep.over is missing (which keys take which values), or `covariance` (what "
        "is drawn)");
  }
  keys.finish();
  if (findings.problems.empty()) {
    count_rows(count, sweep, findings);
  }
  if (!findings.problems.empty()) {
    throw base::InputError(lines(findings));
  }
  return sweep;
}

Node without_sweep(Node root) {
  std::erase_if(std::get<Members>(root.value),
                [](const Member& member) { return member.key == "sweep"; });
  return root;
}

}  // namespace trochoid::cases
