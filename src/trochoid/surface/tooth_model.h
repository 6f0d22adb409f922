#pragma once

#include <trochoid/numerics/periodic_pieces.h>
#include <trochoid/surface/setting.h>
#include <trochoid/surface/stepwise_turn.h>

#include <memory>
#include <span>
#include <string>
#include <vector>

namespace trochoid::surface {

struct StationMoments;

/// Runout as it enters a fit: rho (cos(lambda), sin(lambda)) [m].
struct RunoutVector {
  double c = 0.0;
  double s = 0.0;
};

/// @brief The stations that the places and heights of readings ask for.
/// @param most  of them, along the wall
std::shared_ptr<const Stations> stations_for(const Setting& setting,
                                             std::span<const Reading> readings,
                                             std::size_t most);

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
  /// The tooth that made a reading, 0-based; of a real surface none did alone.
  [[nodiscard]] std::size_t tooth(std::size_t reading) const noexcept {
    return places_[reading].tooth;
  }
  /// Where the model is computed.
  [[nodiscard]] const HeightGrid& heights() const noexcept { return stations_->grid(); }
  /// Does the model depend on where a turn begins?
  [[nodiscard]] bool has_phase() const noexcept {
    return setting_.model == Model::envelope;
  }

  /// Forces along the edges of a cutter with runout.
  struct Forces {
    RunoutVector runout;
    std::vector<double> angles;  ///< where single values are known [rad], ascending
    std::vector<double> values;  ///< shape (angles, columns x values of EdgeMoments)
    numerics::PeriodicPieces table;  ///< envelope, and pulses at many angles
    /// With feedback instead: at each station, the coefficients in it; or none.
    std::shared_ptr<const std::vector<numerics::PeriodicPieces>> bent;
    std::vector<StepwiseTurn> turns;  ///< of which these are
    bool found = true;                ///< false: no steady state was found
  };
  [[nodiscard]] Forces forces(RunoutVector runout) const;
  /// @brief The same in the steady state that the deflection leads to (E-10).
  /// @param straight  those without feedback
  /// @param K         of which they are; predict leaves its own aside
  /// @param close_by  of another cut close to this one: where to begin; or none
  [[nodiscard]] Forces forces_with(Feedback feedback, const Forces& straight,
                                   std::span<const double, columns> K,
                                   const Forces* close_by = nullptr) const;

  /// @brief Errors of all readings.
  /// @param runout  of the tooth paths; the forces may be those of another
  /// @param x_0     where a turn begins along the wall [m]
  /// @return shape (readings) [m]
  /// @note  not from several threads: it keeps the profiles that it made last
  [[nodiscard]] std::vector<double> predict(const Forces& forces,
                                            std::span<const double, columns> K,
                                            RunoutVector runout, double x_0) const;

 private:
  /// What the passes leave over a turn of the feed at each node, shape (nodes)(stations,
  /// points), and of which cut.
  struct Profiles {
    RunoutVector forces;
    RunoutVector runout;
    std::array<double, columns> K{};
    std::shared_ptr<const std::vector<numerics::PeriodicPieces>> bent;
    std::vector<std::vector<double>> at_nodes;
  };
  struct Place {
    double phi = 0.0;       ///< quasi_static, within a turn [rad]
    std::size_t tooth = 0;  ///< imprint
    HeightShare height;
  };

  void find_teeth();
  /// In [0, a turn) [rad]: single values are known at such angles.
  [[nodiscard]] static double within_turn(double phi) noexcept;
  [[nodiscard]] force::Setup with(RunoutVector runout) const;
  /// Angles at which single values of the force are wanted, ascending [rad].
  [[nodiscard]] std::vector<double> angles(const force::Setup& setup) const;
  /// Sums over the coefficients of what `forces` knows at an angle, shape (values).
  static void moments_at(const Forces& forces, std::span<const double, columns> K,
                         double phi, std::span<double> out);
  /// Deflection at a place and an angle [m].
  [[nodiscard]] double deflection_at(const Forces& forces,
                                     std::span<const double, columns> K, double phi,
                                     std::size_t station, std::size_t node) const;
  /// At the stations and nodes, from one error of each, shape (readings).
  template <class ErrorAt>
  [[nodiscard]] std::vector<double> along_the_wall(const ErrorAt& error_at) const;

  [[nodiscard]] std::vector<double> predict_pulses(const Forces& forces,
                                                   std::span<const double, columns> K,
                                                   const force::Setup& setup) const;
  [[nodiscard]] std::vector<double> predict_imprints(const Forces& forces,
                                                     std::span<const double, columns> K,
                                                     const force::Setup& setup) const;
  [[nodiscard]] std::vector<double> predict_envelope(const Forces& forces,
                                                     std::span<const double, columns> K,
                                                     const force::Setup& setup,
                                                     RunoutVector runout,
                                                     double x_0) const;
  /// Those of a cut: as they were made before, or anew.
  [[nodiscard]] std::shared_ptr<const Profiles> profiles_of(
      const Forces& forces, std::span<const double, columns> K, RunoutVector runout,
      const force::Setup& setup) const;
  /// @param moments  of all stations, or of each
  [[nodiscard]] std::vector<double> profiles(const StationMoments& moments,
                                             const force::Setup& setup,
                                             std::size_t node) const;

  Setting setting_;
  std::vector<Reading> readings_;
  std::vector<Place> places_;
  std::shared_ptr<const Stations> stations_;
  bool labelled_ = true;
  std::string why_no_runout_;
  mutable std::vector<std::shared_ptr<const Profiles>> known_;  ///< the newest last
};

}  // namespace trochoid::surface
