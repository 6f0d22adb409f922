#pragma once

#include <trochoid/force/setup.h>
#include <trochoid/surface/choices.h>
#include <trochoid/surface/feedback.h>
#include <trochoid/surface/pass.h>
#include <trochoid/surface/readings.h>
#include <trochoid/surface/stations.h>

namespace trochoid::surface {

/// @brief Everything that makes a wall except the cutting coefficients.
struct Setting {
  force::Setup setup;  ///< a cylinder; an up or a down cut
  force::Law law;      ///< its exponents and edge coefficients count
  BodiesAt bodies;
  Load load = Load::distributed;
  Model model = Model::envelope;
  double phase = 0.0;                      ///< spindle angle where travel is 0 [rad]
  double probe_radius = 0.0;               ///< of the measuring tip [m]; 0: a point
  double tolerance = 1e-5;                 ///< of force and deflection, relative
  StockLeft left = {};                     ///< by a pass before; for error_map only
  std::vector<AlsoBends> also_bends = {};  ///< for error_map only
};

/// @brief The side of the finished wall.
/// @throws std::invalid_argument for a slot or a band, which leave no single wall
Side side_of(const Setting& setting);

/// @brief Angle at which the pass of a tooth through the stock begins.
/// @eq E-12 down: theta_e = pi - p; up: theta_e = 0; p = arccos(1 - a_e/R)
/// @src derived: where a circle of radius R meets the stock of G-11
double entry_angle(const force::Setup& setup);

}  // namespace trochoid::surface
