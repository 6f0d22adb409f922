#pragma once

#include <trochoid/cases/sweep.h>
#include <trochoid/sweep/found.h>

#include <cstddef>
#include <span>
#include <vector>

/// One case over many values: rows, their answers, and the work in parts that outlive a
/// kill.
namespace trochoid::sweep {

/// @brief The values of all keys in every row.
///
/// Chance is that of `seed` alone: the same on every machine and for every number of
/// threads.
class Samples {
 public:
  explicit Samples(const cases::Sweep& sweep);

  [[nodiscard]] std::size_t rows() const noexcept { return sweep_.rows; }
  /// @param row  below rows()
  /// @return one value for each key, in their order
  [[nodiscard]] std::vector<cases::Node> row(std::size_t row) const;

 private:
  [[nodiscard]] std::vector<std::size_t> places_in_grid(std::size_t row) const;

  cases::Sweep sweep_;
  /// By chance: from 0 to 1, shape (keys, rows); empty for grids and lists.
  std::vector<double> chance_;
};

/// @brief What all rows are set to: the swept keys, then those that are drawn.
///
/// Of a grid or a list each point has all draws, one after the other, and every point the
/// same ones: what differs between points is no chance. By chance each row has a draw of
/// its own.
class Rows {
 public:
  Rows(const cases::Sweep& sweep, Found found);

  [[nodiscard]] std::size_t size() const noexcept;
  [[nodiscard]] std::vector<cases::Node> row(std::size_t i) const;
  /// The first row with everything as found.
  [[nodiscard]] std::vector<cases::Node> first() const;

 private:
  Samples samples_;
  Found found_;
  std::size_t draws_ = 0;     ///< that there are; 0: nothing is drawn
  bool of_each_row_ = false;  ///< a draw belongs to a row, not to all points
  /// One list for each set, shape (its chances, draws).
  std::vector<std::vector<double>> chance_;
};

}  // namespace trochoid::sweep
