#pragma once

#include <trochoid/engagement/record.h>
#include <trochoid/engagement/record_means.h>

#include <array>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

// A program as a record of it is compared with it.
namespace trochoid::engagement {

/// A step, or some of one speed that follow one another, where they are laid.
struct Row {
  double time = 0.0;      ///< of its middle [s]
  double duration = 0.0;  ///< [s]
  double feeding =
      0.0;             ///< time of the feed moves up to its middle, in the program [s]
  double turns = 1.0;  ///< of the spindle, at most 1
  std::size_t group = 0;  ///< rows whose common mean does not matter
  std::array<double, 3> mean{};

  [[nodiscard]] double from() const noexcept { return time - 0.5 * duration; }
  [[nodiscard]] double to() const noexcept { return time + 0.5 * duration; }
};

/// @return shape (steps), at the times of the program
std::vector<Row> rows_of(std::span<const Step> steps, Reads reads);

/// @brief Rows from a start on, with all feeds slower by a factor: rapids take as long as
/// ever.
std::vector<Row> laid(std::span<const Row> rows, double start, double slower);

/// Rows evenly taken.
std::vector<Row> some_of(std::span<const Row> rows, std::size_t most);

/// Neighbours of one group as one row, up to a duration [s].
std::vector<Row> merged(std::span<const Row> rows, double longest);

/// Where rows are laid.
struct Place {
  double start = 0.0;  ///< [s]
  double stretch = 1.0;
};

/// How rows agree with a record.
struct Agreement {
  double correlation = -1.0;  ///< where the record has them
  double covered = 0.0;       ///< part of their time that it has
};
Agreement agreement(std::span<const Row> rows, const Means& means, const Place& at);

/// @brief The start at which rows agree best, looked for about a place and finer and finer.
/// @param reach  how far about it [s]
double best_start(std::span<const Row> rows, const Means& means, const Place& about,
                  double reach);

/// The record in bins of equal time.
class Bins {
 public:
  Bins(const Recorded& record, const Means& means, double bin);

  [[nodiscard]] std::size_t size() const noexcept { return mean_.size(); }
  [[nodiscard]] double width() const noexcept { return bin_; }
  [[nodiscard]] double start() const noexcept { return start_; }
  [[nodiscard]] const std::array<double, 3>& operator[](std::size_t k) const noexcept {
    return mean_[k];
  }
  /// Sums up to a bin.
  struct Sum {
    std::array<double, 3> value{};
    double square = 0.0;
  };
  [[nodiscard]] const Sum& up_to(std::size_t k) const noexcept { return sum_[k]; }

 private:
  double bin_;
  double start_;
  std::vector<std::array<double, 3>> mean_;
  std::vector<Sum> sum_;  ///< shape (size + 1)
};

/// A start of the program, and how the whole record agrees with it: what the record has
/// before and after the program should be air.
struct Lag {
  double start = 0.0;   ///< [s]
  double whole = -1.0;  ///< correlation
  /// Another start that is not far worse, far from it [s]; NaN: there is none.
  double other = std::numeric_limits<double>::quiet_NaN();
};

/// @brief Every bin of the record is tried as the start.
/// @param rows  at times from 0 on
Lag best_lag(std::span<const Row> rows, const Bins& record);

/// @brief Correlation of the whole record with rows that are laid over it.
double whole_agreement(std::span<const Row> rows, const Bins& record);

/// A bin for a program of this length that is not shorter than a turn or two samples.
/// @param most  bins of the program
double bin_of(std::span<const Step> steps, const Recorded& record, std::size_t most);

/// Whether a record can be laid over a program.
bool can_align(std::span<const Step> steps, const Recorded& record);

}  // namespace trochoid::engagement
