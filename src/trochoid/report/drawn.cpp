#include <trochoid/report/drawn.h>

#include <trochoid/results/json.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <numeric>
#include <utility>

namespace trochoid::report {

namespace {

void append_float(std::string& text, double value) {
  const auto rounded = static_cast<float>(value);
  if (!std::isfinite(rounded)) {
    text += "null";
    return;
  }
  std::array<char, 24> digits{};
  const auto end =
      std::to_chars(digits.data(), digits.data() + digits.size(), rounded).ptr;
  text.append(digits.data(), end);
}

void append_extremes(const std::vector<double>& values, std::size_t from,
                     std::size_t to, std::vector<std::size_t>& rows) {
  std::size_t low = from;
  std::size_t high = from;
  for (std::size_t i = from; i < to; ++i) {
    if (std::isnan(values[low]) || values[i] < values[low]) low = i;
    if (std::isnan(values[high]) || values[i] > values[high]) high = i;
  }
  rows.push_back(low);
  rows.push_back(high);
}

/// Rows where a run begins; the first one where there is no column `run`.
std::vector<std::size_t> starts_of_runs(const base::Table& table) {
  std::vector<std::size_t> starts = {0};
  const auto run =
      std::find_if(table.columns.begin(), table.columns.end(),
                   [](const auto& column) { return column.name == "run"; });
  if (run == table.columns.end()) return starts;
  for (std::size_t i = 1; i < run->values.size(); ++i) {
    if (run->values[i] != run->values[i - 1]) starts.push_back(i);
  }
  return starts;
}

using Column = base::Table::Column;

/// The column of that name, or null.
const Column* column_named(const base::Table& table, const char* name) {
  const auto column = std::find_if(table.columns.begin(), table.columns.end(),
                                   [&](const Column& c) { return c.name == name; });
  return column == table.columns.end() ? nullptr : &*column;
}

/// Of a map, height by height: both ends, and the smallest and largest value of short
/// stretches between.
std::vector<std::size_t> rows_of_map(const Column& height, const Column& value,
                                     std::size_t wanted) {
  const std::size_t count = height.values.size();
  std::vector<std::size_t> starts = {0};
  for (std::size_t i = 1; i < count; ++i) {
    if (height.values[i] != height.values[i - 1]) starts.push_back(i);
  }
  const std::size_t each = wanted / starts.size();
  const std::size_t stretches = each > 4 ? (each - 2) / 2 : 1;
  starts.push_back(count);
  std::vector<std::size_t> rows;
  for (std::size_t h = 0; h + 1 < starts.size(); ++h) {
    const std::size_t length = starts[h + 1] - starts[h];
    rows.push_back(starts[h]);
    rows.push_back(starts[h + 1] - 1);
    for (std::size_t s = 0; s < stretches; ++s) {
      const std::size_t from = starts[h] + length * s / stretches;
      const std::size_t to = starts[h] + length * (s + 1) / stretches;
      if (from < to) append_extremes(value.values, from, to, rows);
    }
  }
  return rows;
}

std::vector<std::size_t> ordered(std::vector<std::size_t> rows) {
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  return rows;
}

void append_table(std::string& text, const base::Table& table) {
  const std::size_t count = table.columns.empty() ? 0 : rows_of(table.columns.front());
  const auto rows = drawn_rows(table, drawn_cells);
  text += "{\"file\":" + results::json_quoted(table.file) +
          ",\"rows\":" + std::to_string(count) +
          ",\"drawn\":" + std::to_string(rows.size()) + ",\"columns\":[";
  for (std::size_t c = 0; c < table.columns.size(); ++c) {
    const auto& column = table.columns[c];
    text += (c > 0 ? ",{\"name\":" : "{\"name\":") + results::json_quoted(column.name);
    text += ",\"values\":[";
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (i > 0) text += ',';
      if (column.texts.empty()) {
        append_float(text, column.values[rows[i]]);
      } else {
        text += results::json_quoted(column.texts[rows[i]]);
      }
    }
    text += "]}";
  }
  text += "]}";
}

}  // namespace

std::vector<std::size_t> drawn_rows(const base::Table& table, std::size_t cells) {
  const std::size_t columns = table.columns.size();
  if (columns == 0) return {};
  const std::size_t count = rows_of(table.columns.front());
  std::vector<std::size_t> rows;
  if (count * columns <= cells) {
    rows.resize(count);
    std::iota(rows.begin(), rows.end(), std::size_t{0});
    return rows;
  }
  const Column* height = column_named(table, "height_mm");
  const Column* error = column_named(table, "error_mm");
  if (height != nullptr && error != nullptr) {
    return ordered(rows_of_map(*height, *error, cells / columns));
  }
  const auto starts = starts_of_runs(table);
  const std::size_t whole = cells / (4 * columns * starts.size());
  for (const std::size_t start : starts) {
    for (std::size_t i = start; i < std::min(start + whole, count); ++i) {
      rows.push_back(i);
    }
  }
  const std::size_t stretches =
      std::max<std::size_t>(1, 3 * cells / (8 * columns * columns));
  for (std::size_t s = 0; s < stretches; ++s) {
    const std::size_t from = count * s / stretches;
    const std::size_t to = count * (s + 1) / stretches;
    if (from == to) continue;
    for (const auto& column : table.columns) {
      if (column.texts.empty()) append_extremes(column.values, from, to, rows);
    }
  }
  return ordered(std::move(rows));
}

std::string tables_json(const std::vector<base::Table>& tables) {
  std::string text = "[";
  for (const auto& table : tables) {
    if (text.size() > 1) text += ',';
    append_table(text, table);
  }
  return text + ']';
}

}  // namespace trochoid::report
