#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace trochoid::numerics {

/// @brief Several periodic functions as Chebyshev series on common panels.
///
/// Panels end where the functions are known to have kinks; where they have others, the
/// panels are halved until the series end within what is allowed.
class PeriodicPieces {
 public:
  /// f(x, values): the functions at x.
  using Function = std::function<void(double x, std::span<double> values)>;

  struct Options {
    double start = 0.0;           ///< where the period starts
    double period = 1.0;          ///< its length
    std::vector<double> breaks;   ///< known kinks, anywhere
    double longest = 1.0;         ///< panel
    double shortest = 1e-9;       ///< panel: a kink within is left as it is
    std::vector<double> allowed;  ///< error of each function
  };

  PeriodicPieces() = default;
  /// Calls f from several threads.
  PeriodicPieces(const Function& f, const Options& options);

  [[nodiscard]] std::size_t functions() const noexcept { return functions_; }
  [[nodiscard]] std::size_t panels() const noexcept { return ends_.size(); }
  /// Where the panels end, ascending; the first one starts at start().
  [[nodiscard]] std::span<const double> ends() const noexcept { return ends_; }
  [[nodiscard]] double start() const noexcept { return start_; }

  /// @param[out] out  shape (functions)
  void value(double x, std::span<double> out) const noexcept;

  /// @brief What a function never falls below, from the sizes of its series.
  [[nodiscard]] double lower_bound(std::size_t function) const noexcept {
    return lower_bounds_[function];
  }

  /// @brief Linear combinations of the functions.
  /// @param weights  row-major, shape (rows, functions)
  [[nodiscard]] PeriodicPieces combined(std::span<const double> weights) const;

  /// A part of a period, anywhere.
  struct Part {
    double from = 0.0;
    double to = 0.0;
  };
  /// @brief The same near some parts only; elsewhere the results are infinite.
  [[nodiscard]] PeriodicPieces combined(std::span<const double> weights,
                                        std::span<const Part> parts) const;

  /// @brief What the sum of weight times size never exceeds, from the sizes of the series.
  /// @param weights  not negative; of the first functions
  [[nodiscard]] double largest(std::span<const double> weights) const noexcept;

 private:
  struct Place {
    std::size_t panel;
    double t;  ///< in [-1, 1]
  };
  [[nodiscard]] Place place(double x) const noexcept;
  /// Whether a panel lies at one of the parts.
  [[nodiscard]] bool at(std::size_t panel, std::span<const Part> parts) const noexcept;
  void find_lower_bounds();

  std::size_t functions_ = 0;
  double start_ = 0.0;
  double period_ = 1.0;
  std::vector<double> ends_;
  std::vector<double> coefficients_;  ///< shape (panels, nodes, functions)
  std::vector<double> lower_bounds_;  ///< shape (functions)
};

}  // namespace trochoid::numerics
