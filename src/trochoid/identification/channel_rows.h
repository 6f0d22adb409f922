#pragma once

#include <trochoid/identification/channel_fit.h>

#include <cstddef>
#include <span>
#include <vector>

/// Equations of a fit to the channels of a sensor.
namespace trochoid::identification {

/// To which tan(tilt) is scaled.
inline constexpr double tilt_scale = 1e-3;

/// Values of one measurement, weighted.
struct ChannelBlock {
  geometry::Cut cut;
  std::vector<double> angle;  ///< recorded [rad]; empty: means
  std::vector<double> root;   ///< of the samples behind each angle, shape (angles or 1)
  std::vector<double> weight;     ///< 1/sd of each channel
  std::vector<double> offset_se;  ///< as of ChannelData
  std::vector<double> y;          ///< weighted, shape (angles or 1, channels)
  /// Orthonormal courses that are no force: constant and slope; empty: none.
  std::vector<std::vector<double>> drift;
  double inner_rss =
      0.0;  ///< of samples about the mean of those at their angle, weighted
  double equations = 0.0;  ///< samples times channels, less what drift takes

  [[nodiscard]] std::size_t angles() const noexcept { return root.size(); }
  [[nodiscard]] bool is_mean() const noexcept { return angle.empty(); }
};

/// Where in the space of nonlinear unknowns.
struct ChannelPoint {
  geometry::Runout runout;
  std::vector<double> phase;  ///< [rad], one a measurement; 0 of means
  double sensor = 0.0;        ///< [rad]
};

/// @brief A fit to channels that is to be made. Constant once made.
struct ChannelProblem {
  force::Setup setup;
  force::Law law;
  force::Sensor sensor;
  ChannelRequest request;
  std::vector<ChannelBlock> blocks;
  std::size_t columns = 0;                    ///< coefficients
  double length = 0.0;                        ///< [m] by which runout is scaled
  std::vector<std::size_t> free_phases = {};  ///< blocks whose phase is searched
  /// Error of forces where each tooth has an edge of its own, relative to the largest.
  double own_tolerance = 1e-7;

  [[nodiscard]] std::size_t teeth() const noexcept { return setup.cutter.pitch.size(); }
  [[nodiscard]] std::size_t channels() const noexcept { return sensor.channels.size(); }
  /// Nonlinear unknowns: offsets, eccentricity, axial offsets, tilt, phases, sensor.
  [[nodiscard]] std::size_t unknowns() const noexcept;
};

ChannelProblem channel_problem(const force::Setup& setup, const force::Law& law,
                               const force::Sensor& sensor,
                               std::span<const ChannelData> data,
                               const ChannelRequest& request);

ChannelPoint point_of(const ChannelProblem& problem, std::span<const double> p);
std::vector<double> parameters_of(const ChannelProblem& problem,
                                  const ChannelPoint& point);

/// @brief What an unknown is, where it is one of the runout; nothing: phase or sensor.
std::optional<Found> runout_unknown(const ChannelProblem& problem, std::size_t i);

/// @brief Step for a difference by an unknown. Forces over offsets have kinks where axial
/// offsets are among them, a sample each: steps of about a standard error go over them.
double step_of(const ChannelProblem& problem, std::size_t i);

/// @brief Rows of one measurement at a point, weighted, without drift.
/// @return row-major, shape (angles or 1, channels, columns)
std::vector<double> block_rows(const ChannelProblem& problem, const ChannelPoint& point,
                               std::size_t block);

/// The same of all, one after the other.
std::vector<double> rows_at(const ChannelProblem& problem, const ChannelPoint& point);

/// @brief A block with each so many-th of its angles, without drift.
ChannelBlock every(const ChannelBlock& block, std::size_t channels, std::size_t step);

/// @brief The same problem with fewer angles of each record, and rougher forces: to search
/// from far away.
ChannelProblem rougher(const ChannelProblem& problem);

/// All weighted values.
std::vector<double> values_of(const ChannelProblem& problem);

}  // namespace trochoid::identification
