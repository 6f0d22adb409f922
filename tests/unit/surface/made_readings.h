#pragma once

#include "made_wall.h"

#include <trochoid/surface/find_runout.h>
#include <trochoid/surface/fit_models.h>

#include <random>
#include <vector>

namespace trochoid::surface {

/// Heights spread evenly over the middle of the axial depth.
inline std::vector<double> made_heights(int count, double a_p = 3e-3) {
  std::vector<double> out;
  for (int i = 0; i < count; ++i) out.push_back(a_p * (i + 1) / (count + 1));
  return out;
}

/// Where a profile is measured, and how.
struct Measured {
  std::vector<double> heights = made_heights(11);
  std::vector<double> places = {30e-3};  ///< along the wall [m]
  bool labelled = true;
  int per_tooth = 10;  ///< readings in each tooth feed, but for imprints
  int turns = 1;
};

/// Imprints of all teeth, one after the other, at each place and height.
inline std::vector<Reading> imprints(const Setting& s, Coefficients K,
                                     const Measured& at = {}) {
  std::vector<Reading> readings;
  for (const double x : at.places) {
    const auto cuts = height_cuts(s, K, at.heights, x);
    for (std::size_t k = 0; k < cuts.size(); ++k) {
      const double h = at.heights[k];
      const auto points = imprint_errors(cuts[k]);
      for (std::size_t i = 0; i < points.size(); ++i) {
        readings.push_back({.x = x,
                            .travel = x + s.setup.cut.f_z * static_cast<double>(i),
                            .height = h,
                            .error = points[i].error,
                            .tooth = at.labelled ? points[i].tooth : -1});
      }
    }
  }
  return readings;
}

/// The pulse of force over whole turns.
inline std::vector<Reading> pulses(const Setting& s, Coefficients K,
                                   const Measured& at) {
  std::vector<Reading> readings;
  const auto tips = edge_places(s.setup, 0.0);
  const double f = s.setup.cut.f_z * s.setup.cutter.teeth();
  for (const double x : at.places) {
    const auto cuts = height_cuts(s, K, at.heights, x);
    for (std::size_t i = 0; i < cuts.size(); ++i) {
      const double h = at.heights[i];
      const HeightCut& cut = cuts[i];
      for (int k = 0; k < at.turns * at.per_tooth * s.setup.cutter.teeth(); ++k) {
        const double travel = s.setup.cut.f_z * k / at.per_tooth;
        const double phi = s.phase + 2 * pi * travel / f;
        const std::size_t tooth = last_entered(tips, entry_angle(s.setup), phi);
        readings.push_back({.x = x,
                            .travel = travel,
                            .height = h,
                            .error = quasi_static_error(cut, tooth, phi).error});
      }
    }
  }
  return readings;
}

/// A real profile: what all passes leave.
inline std::vector<Reading> profiles(const Setting& s, Coefficients K,
                                     const Measured& at) {
  std::vector<Reading> readings;
  for (const double x : at.places) {
    const auto cuts = height_cuts(s, K, at.heights, x);
    for (std::size_t i = 0; i < cuts.size(); ++i) {
      const double h = at.heights[i];
      const HeightCut& cut = cuts[i];
      for (int k = 0; k < at.turns * at.per_tooth * s.setup.cutter.teeth(); ++k) {
        const double travel = s.setup.cut.f_z * (k + 0.5) / at.per_tooth;
        readings.push_back({.x = x,
                            .travel = x + travel,
                            .height = h,
                            .error = envelope_error(cut, x + travel).error});
      }
    }
  }
  return readings;
}

inline void add_noise(std::vector<Reading>& readings, double sigma, unsigned seed) {
  std::mt19937 random(seed);
  std::normal_distribution<double> noise(0.0, sigma);
  for (Reading& r : readings) r.error += noise(random);
}

inline ModelFits fitted(const Setting& s, const std::vector<Reading>& readings,
                        Datum datum = {}, Feedback feedback = Feedback::none) {
  return fit_models(s, readings, std::array{datum}, feedback);
}

}  // namespace trochoid::surface
