#pragma once

#include <trochoid/correction/amplitude.h>

namespace trochoid::correction {

/// What a motion does to the flutes: exactly, and quickly but nearly so.
struct FluteModels {
  FlutesOf exact;  ///< for example simulated; empty: `quick`
  FlutesOf quick;  ///< empty: those of the rigid cut with the motion
  int starts = 4;  ///< of the search, where the first leaves a difference
};

/// @brief The motion of a shape that makes the flutes alike: a level for each tooth, or
/// the harmonics themselves.
///
/// @eq R-26 min over the levels y_j, sum 0, of the sum over j of (v_j/mean(v) - 1)^2
/// @eq R-28 Shape::harmonics: the same over the amplitudes a_n, b_n of all harmonics
/// @eq R-29 where an exact model is given: y <- y - J^+ v(y), J from the quick one and
///          improved by J <- J + (v_new - v - J s) s^T/(s^T s), s the last step
/// @src derived: N - 1 unknowns for N - 1 differences; R-29 [broyden1965]
/// @note Two teeth, and least squares: amplitude_for. `factor` is by how much the
/// largest offset of the motion grew. What is better of this and of one factor is
/// returned.
Amplitude equal_flutes(Target target, const RigidCut& cut, Shape shape,
                       const ShapeOptions& options, const FluteModels& models = {});

}  // namespace trochoid::correction
