#pragma once

#include <trochoid/base/table.h>

#include <cstddef>
#include <string>
#include <variant>
#include <vector>

namespace trochoid::results {

/// A number or a text; a number that is none where there is no value.
using Cell = std::variant<double, std::string>;

/// One row of a sweep.
struct SweepRow {
  std::vector<Cell> cells;  ///< values of the swept keys, drawn ones, what was taken
  std::string status;       ///< `ok`, `failed`, `wrong_input`
  std::string message;      ///< why, where it is not ok
};

/// @brief Many rows, column by column: 8 bytes a cell, and 8 for status and message.
class SweepRows {
 public:
  SweepRows() = default;
  explicit SweepRows(const std::vector<SweepRow>& rows);

  /// @pre as many cells as the rows before
  void add(const SweepRow& row);
  /// Forget rows behind the first ones.
  void cut(std::size_t size);

  [[nodiscard]] std::size_t size() const noexcept { return status_.size(); }
  [[nodiscard]] bool empty() const noexcept { return status_.empty(); }
  [[nodiscard]] SweepRow row(std::size_t i) const;

  /// NaN: there is none, or it is a text.
  [[nodiscard]] double number(std::size_t row, std::size_t cell) const {
    return cells_[cell].values[row];
  }
  /// As tables show it.
  [[nodiscard]] std::string text(std::size_t row, std::size_t cell) const;
  [[nodiscard]] bool has_texts(std::size_t cell) const {
    return !empty() && !cells_[cell].texts.empty();
  }
  [[nodiscard]] const std::string& status(std::size_t row) const {
    return status_[row];
  }
  [[nodiscard]] const base::Texts& statuses() const noexcept { return status_; }
  [[nodiscard]] const base::Texts& messages() const noexcept { return message_; }

  /// @brief One column of a table, of every step-th row.
  [[nodiscard]] base::Table::Column column(std::string name, std::size_t cell,
                                           std::size_t step) const;

 private:
  /// Each with all numbers; with all texts too where there is one.
  std::vector<base::Table::Column> cells_;
  base::Texts status_;
  base::Texts message_;
};

}  // namespace trochoid::results
