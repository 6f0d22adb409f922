#pragma once

#include <trochoid/numerics/periodic_pieces.h>
#include <trochoid/surface/setting.h>

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace trochoid::surface {

/// Runout as it enters a fit: rho (cos(lambda), sin(lambda)) [m].
struct RunoutVector {
  double c = 0.0;
  double s = 0.0;
};

/// @brief Every reading by itself: which tooth made it, and with which runout.
///
/// quasi_static knows the tooth by the spindle angle, imprint by its label or by the
/// order along the feed, envelope by where a turn begins along the wall.
class ToothModel {
 public:
  /// @param stations  that know the heights of the readings
  ToothModel(const Setting& setting, std::span<const Reading> readings,
             std::shared_ptr<const Stations> stations);
  ToothModel(const Setting& setting, std::span<const Reading> readings);

  /// Why the readings cannot show runout; empty: they can.
  [[nodiscard]] const std::string& why_no_runout() const noexcept {
    return why_no_runout_;
  }
  /// Are the teeth known, or may all be renumbered?
  [[nodiscard]] bool labelled() const noexcept { return labelled_; }
  /// Does the model depend on where a turn begins?
  [[nodiscard]] bool has_phase() const noexcept {
    return setting_.model == Model::envelope;
  }

  /// Forces along the edges of a cutter with runout.
  struct Forces {
    RunoutVector runout;
    std::vector<double> angles;  ///< where single values are known [rad], ascending
    std::vector<double> values;  ///< shape (angles, columns x values of EdgeMoments)
    numerics::PeriodicPieces table;  ///< envelope
  };
  [[nodiscard]] Forces forces(RunoutVector runout) const;

  /// @brief Errors of all readings.
  /// @param runout  of the tooth paths; the forces may be those of another
  /// @param x_0     where a turn begins along the wall [m]
  /// @return shape (readings) [m]
  [[nodiscard]] std::vector<double> predict(const Forces& forces,
                                            std::span<const double, columns> K,
                                            RunoutVector runout, double x_0) const;

 private:
  struct Place {
    double phi = 0.0;       ///< quasi_static [rad]
    std::size_t tooth = 0;  ///< imprint
    std::size_t height = 0;
    std::vector<double> weights;  ///< of the stations
  };

  void find_teeth();
  [[nodiscard]] double slope(const numerics::PeriodicPieces& moments,
                             std::size_t station, double height,
                             const force::Setup& setup) const;
  [[nodiscard]] force::Setup with(RunoutVector runout) const;
  [[nodiscard]] double angle_of(const Place& place, const force::Setup& setup) const;
  [[nodiscard]] double deflection_at(const Forces& forces,
                                     std::span<const double, columns> K,
                                     const Place& place) const;
  [[nodiscard]] std::vector<double> predict_envelope(const Forces& forces,
                                                     std::span<const double, columns> K,
                                                     const force::Setup& setup,
                                                     double x_0) const;

  Setting setting_;
  std::vector<Reading> readings_;
  std::vector<double> heights_;    ///< distinct [m]
  std::vector<std::size_t> rows_;  ///< of the stations, shape (heights)
  std::vector<Place> places_;
  std::shared_ptr<const Stations> stations_;
  bool labelled_ = true;
  std::string why_no_runout_;
};

}  // namespace trochoid::surface
