#include <trochoid/results/sweep_rows.h>

#include <fmt/core.h>

#include <cmath>
#include <limits>
#include <utility>

namespace trochoid::results {

namespace {

constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

/// What stands for a number among the texts of a column.
const std::string no_text;

void add_cell(const Cell& cell, base::Table::Column& column) {
  const auto* value = std::get_if<double>(&cell);
  const auto* text = std::get_if<std::string>(&cell);
  if (text != nullptr && column.texts.empty()) {
    for (std::size_t i = 0; i < column.values.size(); ++i) {
      column.texts.push_back(no_text);
    }
  }
  if (text != nullptr || !column.texts.empty()) {
    column.texts.push_back(text != nullptr ? *text : no_text);
  }
  column.values.push_back(value != nullptr ? *value : no_number);
}

}  // namespace

SweepRows::SweepRows(const std::vector<SweepRow>& rows) {
  for (const SweepRow& row : rows) add(row);
}

void SweepRows::add(const SweepRow& row) {
  cells_.resize(row.cells.size());
  for (std::size_t c = 0; c < row.cells.size(); ++c) add_cell(row.cells[c], cells_[c]);
  status_.push_back(row.status);
  message_.push_back(row.message);
}

void SweepRows::cut(std::size_t size) {
  if (size >= this->size()) return;
  for (base::Table::Column& column : cells_) {
    column.values.resize(size);
    column.texts.cut(size);
  }
  status_.cut(size);
  message_.cut(size);
}

SweepRow SweepRows::row(std::size_t i) const {
  SweepRow row{.cells = {}, .status = status_[i], .message = message_[i]};
  for (const base::Table::Column& column : cells_) {
    const bool text = !column.texts.empty() && std::isnan(column.values[i]);
    row.cells.push_back(text ? Cell{column.texts[i]} : Cell{column.values[i]});
  }
  return row;
}

std::string SweepRows::text(std::size_t row, std::size_t cell) const {
  const base::Table::Column& column = cells_[cell];
  const double value = column.values[row];
  if (!std::isnan(value)) return fmt::format("{}", value);
  return column.texts.empty() ? std::string() : column.texts[row];
}

base::Table::Column SweepRows::column(std::string name, std::size_t cell,
                                      std::size_t step) const {
  base::Table::Column out{.name = std::move(name), .values = {}};
  for (std::size_t i = 0; i < size(); i += step) {
    if (has_texts(cell)) {
      out.texts.push_back(text(i, cell));
    } else {
      out.values.push_back(number(i, cell));
    }
  }
  return out;
}

}  // namespace trochoid::results
