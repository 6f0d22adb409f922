#pragma once

#include <trochoid/inputs/sweep.h>

#include <cstddef>
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
  explicit Samples(const inputs::Sweep& sweep);

  [[nodiscard]] std::size_t rows() const noexcept { return sweep_.rows; }
  /// @param row  below rows()
  /// @return one value for each key, in their order
  [[nodiscard]] std::vector<inputs::Node> row(std::size_t row) const;

 private:
  [[nodiscard]] std::vector<std::size_t> places_in_grid(std::size_t row) const;

  inputs::Sweep sweep_;
  /// By chance: from 0 to 1, shape (keys, rows); empty for grids and lists.
  std::vector<double> chance_;
};

}  // namespace trochoid::sweep
