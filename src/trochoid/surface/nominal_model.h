#pragma once

#include <trochoid/numerics/periodic_pieces.h>
#include <trochoid/surface/setting.h>

#include <array>
#include <memory>
#include <span>
#include <vector>

namespace trochoid::surface {

/// What a model says, and how it changes with the coefficients.
struct Prediction {
  std::vector<double> error;  ///< [m], shape (rows)
  std::vector<double> per_K;  ///< by K_tc, K_rc, K_te, K_re, shape (rows, columns)
  bool good = true;           ///< false: no periodic state was found
  double blind = 0.0;         ///< per_K below this is rounding [m per N/m^2]
};

/// @brief Nominal errors as a model predicts them, without runout.
class NominalModel {
 public:
  NominalModel(const Setting& setting, std::span<const Nominal> rows);
  /// @param stations  with the heights of stations_for; may serve several models
  NominalModel(const Setting& setting, std::span<const Nominal> rows,
               std::shared_ptr<const Stations> stations);

  /// @brief The compliance that these rows need.
  static std::shared_ptr<const Stations> stations_for(const Setting& setting,
                                                      std::span<const Nominal> rows);

  /// @brief As long as the deflection does not change the chip.
  [[nodiscard]] Prediction rigid(std::span<const double, columns> K) const;

  /// @brief With feedback of the deflection; `per_K` by differences, for K_tc and K_rc.
  [[nodiscard]] Prediction with_feedback(std::span<const double, columns> K,
                                         Feedback feedback) const;

  [[nodiscard]] std::size_t stations() const noexcept { return stations_->count(); }

 private:
  /// Rows that differ in x only are of one kind, or lie between a few kinds.
  struct Kind {
    std::size_t node = 0;  ///< of the heights
    double travel = 0.0;   ///< quasi_static [m]
  };
  struct Value {
    double error = 0.0;
    std::array<double, columns> per_K{};
  };
  /// A row, as the kinds at the nodes around its height.
  struct Row {
    double x = 0.0;  ///< [m]
    HeightShare share;
    std::array<std::size_t, 4> kinds{};
  };

  [[nodiscard]] Value value(const numerics::PeriodicPieces& moments,
                            std::size_t station, const Kind& kind) const;
  [[nodiscard]] Value at_level(const numerics::PeriodicPieces& moments,
                               std::size_t station, const Kind& kind,
                               Level level) const;
  [[nodiscard]] Value envelope(const numerics::PeriodicPieces& moments,
                               std::span<const double> row, double height) const;
  /// By K_tc or K_rc anywhere in the turn [m per N/m^2].
  [[nodiscard]] double largest_effect(const numerics::PeriodicPieces& moments) const;
  [[nodiscard]] Prediction with_feedback_once(std::span<const double, columns> K,
                                              Feedback feedback) const;
  [[nodiscard]] Prediction along_the_wall(const std::vector<Value>& grid) const;

  Setting setting_;
  std::vector<Kind> kinds_;
  std::vector<Row> rows_;
  std::shared_ptr<const Stations> stations_;
  EdgeMoments edges_;
  numerics::PeriodicPieces unit_;
};

}  // namespace trochoid::surface
