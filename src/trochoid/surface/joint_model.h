#pragma once

#include <trochoid/surface/row_fit.h>
#include <trochoid/surface/tooth_model.h>

#include <array>
#include <memory>
#include <span>
#include <vector>

namespace trochoid::surface {

/// What a cut is fitted with: runout, where a turn begins, coefficients.
struct JointState {
  RunoutVector runout;
  double start = 0.0;  ///< where a turn begins along the wall [m]
  std::array<double, columns> K{};
};

/// @brief Every reading by the runout, the coefficients, and the feedback of the
/// deflection, if any.
///
/// @eq E-25 e(p) = e_0(p) + D(p_b) + D'(p_b) (p - p_b), D = e_fb - e_0
/// @src derived: the steady state of E-10 is slow to find, and what it adds to the
///      stiff chip is small and smooth: found at p_b, which follows the fit
class JointModel {
 public:
  /// @param stations  for e_0
  /// @param coarse    for D, a few along the wall
  JointModel(const Setting& setting, std::span<const Reading> readings,
             std::shared_ptr<const Stations> stations,
             std::shared_ptr<const Stations> coarse, Feedback feedback);

  /// Scaled to about one: the unknowns of RowFit.
  [[nodiscard]] std::vector<double> pack(const JointState& state) const;
  [[nodiscard]] JointState unpack(std::span<const double> p) const;

  /// @brief Find D and D' at p.
  /// @return by how much D differs from what it was said to be there, as root mean
  ///         square over the readings [m]; negative: no steady state was found
  double rebase(std::span<const double> p);

  /// @brief Find D at p and take it as the same everywhere: enough to compare starts.
  /// @return false: no steady state was found
  bool freeze(std::span<const double> p);

  /// Of the readings, in units of `error_scale` [m].
  /// @param steps  of differences; empty: small ones
  [[nodiscard]] Linearised at(std::span<const double> p, std::span<const double> steps);

  /// @brief Of the readings, in units of `error_scale` [m], with the feedback as it is at
  /// p; empty: no steady state was found.
  [[nodiscard]] std::vector<double> exact(std::span<const double> p) const;

  /// @brief Of any readings of this wall [m].
  [[nodiscard]] std::vector<double> predict(std::span<const Reading> readings,
                                            std::span<const double> p) const;

  [[nodiscard]] Feedback feedback() const noexcept { return feedback_; }
  [[nodiscard]] bool has_start() const noexcept { return model_.has_phase(); }

 private:
  /// With and without feedback, as `coarse` knows them.
  struct BothForces {
    ToothModel::Forces bent;
    std::shared_ptr<const ToothModel::Forces> straight;
  };
  /// By all unknowns, and about which place and by which differences they were found.
  struct Slopes {
    std::vector<double> at;
    std::vector<double> steps;
    std::vector<double> values;  ///< row-major, shape (readings, unknowns)
  };
  /// The differences between two sides, by one unknown.
  static void set_column(std::size_t k, std::span<const double> above,
                         std::span<const double> below, Slopes& slopes);
  static const Slopes& keep(Slopes found, std::vector<Slopes>& known);
  /// Without feedback: the same for e_0 and D.
  [[nodiscard]] std::shared_ptr<const ToothModel::Forces> forces_of(
      RunoutVector runout) const;
  [[nodiscard]] BothForces both(const JointState& state) const;
  /// D of the readings [m]; empty: no steady state was found.
  [[nodiscard]] std::vector<double> change(const JointState& state,
                                           const BothForces& forces) const;
  [[nodiscard]] std::vector<double> said(std::span<const double> p) const;
  /// Of the readings, in units of `error_scale` [m], shape (readings, unknowns).
  std::vector<double> slopes_at(std::span<const double> p,
                                std::span<const double> steps);
  /// Those found nearby, or at p.
  const Slopes& slopes_of_change(std::span<const double> p, const BothForces& forces);
  const Slopes& stiff_slopes(std::span<const double> p, std::span<const double> steps);

  Setting setting_;
  std::shared_ptr<const Stations> stations_;
  std::shared_ptr<const Stations> coarse_stations_;
  Feedback feedback_;
  ToothModel model_;
  ToothModel coarse_;
  std::vector<double> base_;    ///< p_b; empty: D is zero
  std::vector<double> change_;  ///< D(p_b) [m]
  std::vector<double> slopes_;  ///< D' [m], row-major, shape (readings, unknowns)
  std::vector<Slopes> slopes_of_change_;  ///< found so far
  std::vector<Slopes> stiff_slopes_;      ///< of e_0, found so far
  mutable std::vector<std::shared_ptr<const ToothModel::Forces>> known_;
  mutable ToothModel::Forces last_;  ///< with feedback
};

}  // namespace trochoid::surface
