#include <trochoid/results/sweep.h>

#include <trochoid/results/text_table.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace trochoid::results {

namespace {

/// Name of the column of a path: `result.peak_xy_N` is `peak_xy_N`.
std::string column_name(const std::string& path) {
  constexpr std::string_view common = "result.";
  return path.starts_with(common) ? path.substr(common.size()) : path;
}

bool is_text(const SweepResult& r, std::size_t column) {
  return std::ranges::any_of(r.rows, [&](const SweepRow& row) {
    return std::holds_alternative<std::string>(row.cells[column]);
  });
}

std::string text_of(const Cell& cell) {
  const auto* text = std::get_if<std::string>(&cell);
  const auto* value = std::get_if<double>(&cell);
  return text != nullptr ? *text : std::isnan(*value) ? "" : fmt::format("{}", *value);
}

base::Table table_of(const SweepResult& r) {
  base::Table table{"sweep.csv", {}};
  for (std::size_t c = 0; c < r.keys.size() + r.take.size(); ++c) {
    auto& column = table.columns.emplace_back();
    column.name =
        c < r.keys.size() ? r.keys[c] : column_name(r.take[c - r.keys.size()]);
    const bool text = is_text(r, c);
    for (const SweepRow& row : r.rows) {
      if (text) {
        column.texts.push_back(text_of(row.cells[c]));
      } else {
        column.values.push_back(std::get<double>(row.cells[c]));
      }
    }
  }
  auto& status = table.columns.emplace_back();
  status.name = "status";
  for (const SweepRow& row : r.rows) {
    status.texts.push_back(row.status);
  }
  auto& message = table.columns.emplace_back();
  message.name = "message";
  for (const SweepRow& row : r.rows) {
    message.texts.push_back(row.message);
  }
  return table;
}

/// Between two of the sorted values, as far on as the share says.
double quantile(const std::vector<double>& sorted, double share) {
  const double place = share * static_cast<double>(sorted.size() - 1);
  const auto i = static_cast<std::size_t>(place);
  const double part = place - static_cast<double>(i);
  return i + 1 < sorted.size() ? sorted[i] + part * (sorted[i + 1] - sorted[i])
                               : sorted.back();
}

/// Numbers of the rows that answered, sorted.
std::vector<double> numbers_of(const SweepResult& r, std::size_t column) {
  std::vector<double> sorted;
  for (const SweepRow& row : r.rows) {
    const auto* value = std::get_if<double>(&row.cells[column]);
    if (row.status == "ok" && value != nullptr && !std::isnan(*value)) {
      sorted.push_back(*value);
    }
  }
  std::ranges::sort(sorted);
  return sorted;
}

/// What is said of one quantity: of rows drawn by chance its 95 % interval.
Value quantity(const SweepResult& r, std::size_t i) {
  const std::vector<double> sorted = numbers_of(r, r.keys.size() + i);
  Object object = {{"take", r.take[i]}, {"answers", sorted.size()}};
  if (sorted.empty()) {
    return object;
  }
  double mean = 0.0;
  for (const double value : sorted) {
    mean += value / static_cast<double>(sorted.size());
  }
  set(object, "min", sorted.front());
  set(object, "median", quantile(sorted, 0.5));
  set(object, "max", sorted.back());
  if (r.by_chance) {
    set(object, "mean", mean);
    set(object, "low", quantile(sorted, 0.025));
    set(object, "high", quantile(sorted, 0.975));
  }
  return object;
}

std::size_t count_of(const SweepResult& r, std::string_view status) {
  return static_cast<std::size_t>(
      std::ranges::count(r.rows, status, &SweepRow::status));
}

std::string short_table(const SweepResult& r) {
  std::vector<std::vector<std::string>> rows;
  rows.push_back(r.by_chance ? std::vector<std::string>{"", "median", "95 % from", "to"}
                             : std::vector<std::string>{"", "least", "median", "most"});
  for (std::size_t i = 0; i < r.take.size(); ++i) {
    const std::vector<double> sorted = numbers_of(r, r.keys.size() + i);
    if (sorted.empty()) {
      rows.push_back({column_name(r.take[i]), "no number", "", ""});
      continue;
    }
    const double middle = quantile(sorted, 0.5);
    const auto cell = [](double value) { return fmt::format("{:.5g}", value); };
    rows.push_back(r.by_chance
                       ? std::vector<std::string>{column_name(r.take[i]), cell(middle),
                                                  cell(quantile(sorted, 0.025)),
                                                  cell(quantile(sorted, 0.975))}
                       : std::vector<std::string>{column_name(r.take[i]),
                                                  cell(sorted.front()), cell(middle),
                                                  cell(sorted.back())});
  }
  return aligned(rows);
}

}  // namespace

Answer answer_of(const SweepResult& r) {
  Array quantities;
  for (std::size_t i = 0; i < r.take.size(); ++i) {
    quantities.push_back(quantity(r, i));
  }
  return {.command = "sweep",
          .heading = r.heading,
          .result = Object{{"command", r.command},
                           {"method", r.method},
                           {"rows", r.rows.size()},
                           {"failed", r.rows.size() - count_of(r, "ok")},
                           {"keys", r.keys},
                           {"quantities", quantities}},
          .short_table = short_table(r),
          .tables = {table_of(r)}};
}

}  // namespace trochoid::results
