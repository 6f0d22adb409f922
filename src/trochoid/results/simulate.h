#pragma once

#include <trochoid/force/sensor.h>
#include <trochoid/force/slice.h>
#include <trochoid/force/statistics.h>
#include <trochoid/identification/identify.h>
#include <trochoid/results/answer.h>

#include <array>
#include <optional>
#include <string>
#include <vector>

namespace trochoid::results {

/// A measurement beside the computed forces.
struct Comparison {
  std::string file;
  identification::Run run;  ///< measured force on the tool
  double Omega = 0.0;       ///< spindle speed found in the record [rad/s]
  identification::PhaseMatch match;
};

/// @brief What `simulate` answers: chip, forces and loads of a cut.
struct SimulateResult {
  Heading heading;
  std::vector<double> phi;          ///< spindle angle of each sample [rad]
  std::vector<force::Loads> loads;  ///< at each of them
  double Omega = 0.0;               ///< [rad/s]
  force::ForceStatistics force;     ///< over all samples
  force::MomentStatistics moments;
  std::optional<force::Vector3> closed_form_mean;  ///< F-8 [N], where it holds
  std::optional<double> gauge_length;              ///< of the bending moment [m]
  /// What the channels of the dynamometer read: matrix times force on the tool.
  std::optional<std::array<std::array<double, 3>, 3>> channels;
  force::Sensor sensor = {};                ///< its channels, where they have names
  std::vector<double> channel_values = {};  ///< shape (samples, channels)
  std::vector<double> channel_means = {};   ///< over a turn, by integrals
  force::Engagement engagement;             ///< at one height
  std::vector<force::Engagement> at_heights = {};  ///< at the heights asked for
  bool conserves = true;               ///< whether removal is told of `at_heights`
  force::EdgeGrid edges = {};          ///< at the heights asked for
  force::MeanLoads exact_mean = {};    ///< over a turn (F-31)
  force::ChipGrid chips;               ///< at the angles and heights asked for
  force::ChipCurve curve;              ///< at the height of `engagement`
  std::vector<Comparison> comparison;  ///< one a measurement
};

/// @brief Force and torque of the cut in a sentence, and what speaks for or against them:
/// teeth that idle, chips that do not add up, the records they were compared with.
std::string simulation_sentence(const SimulateResult& result);

Answer answer_of(const SimulateResult& result);

/// The same for whom the numbers of summary.json are enough.
Answer answer_without_tables(const SimulateResult& result);

}  // namespace trochoid::results
