#include <trochoid/force/sensor.h>

#include <algorithm>
#include <cmath>

namespace trochoid::force {

namespace {

/// Places in SixLoads.
constexpr std::size_t at_torque = 3;
constexpr std::size_t at_moment = 4;

/// Loads in the frame that turns with the tool: F_u, F_v, M_u, M_v.
std::array<double, 4> turned(const SixLoads& loads, double theta_u) noexcept {
  const double s = std::sin(theta_u);
  const double c = std::cos(theta_u);
  const auto u = [&](std::size_t i) { return loads[i] * s + loads[i + 1] * c; };
  const auto v = [&](std::size_t i) { return -loads[i] * c + loads[i + 1] * s; };
  return {u(0), v(0), u(at_moment), v(at_moment)};
}

/// @param turning  F_u, F_v, M_u, M_v
double value_of(const Channel& channel, const SixLoads& fixed,
                const std::array<double, 4>& turning, double Omega) noexcept {
  const auto value = [&] {
    switch (channel.axis) {
      case ChannelAxis::x:
        return fixed[0];
      case ChannelAxis::y:
        return fixed[1];
      case ChannelAxis::z:
        return fixed[2];
      case ChannelAxis::u:
        return turning[0];
      case ChannelAxis::v:
        return turning[1];
      case ChannelAxis::torque:
        return fixed[at_torque];
      case ChannelAxis::moment_x:
        return fixed[at_moment];
      case ChannelAxis::moment_y:
        return fixed[at_moment + 1];
      case ChannelAxis::moment_u:
        return turning[2];
      case ChannelAxis::moment_v:
        return turning[3];
      case ChannelAxis::power:
        return fixed[at_torque] * Omega;
    }
    return 0.0;
  };
  return channel.sign * value() + 0.0;  // no -0
}

bool any_channel(const Sensor& sensor, bool (*test)(ChannelAxis)) {
  return std::ranges::any_of(sensor.channels,
                             [&](const Channel& one) { return test(one.axis); });
}

bool reads_spindle_only(ChannelAxis axis) noexcept {
  return axis == ChannelAxis::torque || axis == ChannelAxis::power;
}

TurnMeans without_moments(const MeanLoads& mean) noexcept {
  return {
      .fixed = {mean.force[0], mean.force[1], mean.force[2], mean.torque, 0.0, 0.0}};
}

/// Only forces along the cut drive the spindle: coefficient 0 of cutting and of the edge.
bool drives(std::size_t column) noexcept {
  return column % 3 == 0;
}

}  // namespace

ChannelUnit unit_of(ChannelAxis axis) noexcept {
  if (axis == ChannelAxis::power) return ChannelUnit::watt;
  const bool moment = axis == ChannelAxis::torque || needs_gauge_length(axis);
  return moment ? ChannelUnit::newton_metre : ChannelUnit::newton;
}

bool needs_gauge_length(ChannelAxis axis) noexcept {
  return axis == ChannelAxis::moment_x || axis == ChannelAxis::moment_y ||
         axis == ChannelAxis::moment_u || axis == ChannelAxis::moment_v;
}

bool turns_with_tool(ChannelAxis axis) noexcept {
  return axis == ChannelAxis::u || axis == ChannelAxis::v ||
         axis == ChannelAxis::moment_u || axis == ChannelAxis::moment_v;
}

std::vector<double> channel_values(const Sensor& sensor,
                                   std::span<const SixLoads> loads,
                                   std::span<const double> phi, double Omega) {
  std::vector<double> out;
  out.reserve(loads.size() * sensor.channels.size());
  for (std::size_t i = 0; i < loads.size(); ++i) {
    const auto turning = turned(loads[i], phi[i] - sensor.angle);
    for (const Channel& channel : sensor.channels) {
      out.push_back(value_of(channel, loads[i], turning, Omega));
    }
  }
  return out;
}

namespace {

bool reads_forces_only(ChannelAxis axis) noexcept {
  return unit_of(axis) == ChannelUnit::newton;
}

/// @brief Loads for each coefficient of 1, as few of them as the channels need.
/// @return shape (columns), each of shape (n)
std::vector<std::vector<SixLoads>> loads_of_coefficients(const Setup& setup,
                                                         const Law& law,
                                                         const Sensor& sensor,
                                                         std::span<const double> phi,
                                                         double tolerance) {
  const std::size_t columns = form(law).columns();
  std::vector<std::vector<SixLoads>> out(columns, std::vector<SixLoads>(phi.size()));
  std::vector<double> one(columns, 0.0);
  const bool moments = any_channel(sensor, needs_gauge_length);
  const bool torque = any_channel(sensor, reads_spindle_only);
  for (std::size_t q = 0; q < columns; ++q) {
    if (!moments && !(torque && drives(q))) continue;
    one[q] = 1.0;
    out[q] = six_loads(setup, with_coefficients(law, one), phi,
                       moments ? std::optional(sensor.gauge_length) : std::nullopt,
                       tolerance);
    one[q] = 0.0;
  }
  if (moments || !any_channel(sensor, reads_forces_only)) return out;
  std::vector<double> C(3 * columns * phi.size());
  ForceMatrix(setup, law, tolerance).evaluate(phi, C);
  for (std::size_t i = 0; i < phi.size(); ++i) {
    for (std::size_t row = 0; row < 3; ++row) {
      for (std::size_t q = 0; q < columns; ++q) {
        out[q][i][row] = C[(3 * i + row) * columns + q];
      }
    }
  }
  return out;
}

}  // namespace

std::vector<double> channel_columns(const Setup& setup, const Law& law,
                                    const Sensor& sensor, std::span<const double> phi,
                                    double tolerance) {
  const std::size_t channels = sensor.channels.size();
  const auto loads = loads_of_coefficients(setup, law, sensor, phi, tolerance);
  const std::size_t columns = loads.size();
  std::vector<double> out(phi.size() * channels * columns);
  for (std::size_t q = 0; q < columns; ++q) {
    const auto values = channel_values(sensor, loads[q], phi, setup.cut.Omega);
    for (std::size_t i = 0; i < values.size(); ++i) {
      const bool zero =
          !drives(q) && reads_spindle_only(sensor.channels[i % channels].axis);
      out[i * columns + q] = zero ? 0.0 : values[i];
    }
  }
  return out;
}

std::vector<double> channel_means(const Setup& setup, const Law& law,
                                  const Sensor& sensor, double tolerance) {
  const std::size_t columns = form(law).columns();
  const std::size_t channels = sensor.channels.size();
  const bool along_edges =
      any_channel(sensor, needs_gauge_length) || any_channel(sensor, turns_with_tool);
  const double s = std::sin(sensor.angle);
  const double c = std::cos(sensor.angle);
  std::vector<double> out(channels * columns);
  std::vector<double> one(columns, 0.0);
  for (std::size_t q = 0; q < columns; ++q) {
    one[q] = 1.0;
    const Law unit_law = with_coefficients(law, one);
    one[q] = 0.0;
    const TurnMeans mean =
        along_edges ? turn_means(setup, unit_law, sensor.gauge_length, tolerance)
                    : without_moments(exact_mean(setup, unit_law, tolerance));
    const auto& [F_u, F_v, M_u, M_v] = mean.turning;
    const std::array<double, 4> turning = {F_u * c + F_v * s, F_v * c - F_u * s,
                                           M_u * c + M_v * s, M_v * c - M_u * s};
    for (std::size_t k = 0; k < channels; ++k) {
      const Channel& channel = sensor.channels[k];
      const bool zero = !drives(q) && reads_spindle_only(channel.axis);
      out[k * columns + q] =
          zero ? 0.0 : value_of(channel, mean.fixed, turning, setup.cut.Omega);
    }
  }
  return out;
}

}  // namespace trochoid::force
