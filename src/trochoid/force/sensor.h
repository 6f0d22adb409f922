#pragma once

#include <trochoid/force/forces.h>

#include <array>
#include <span>
#include <string_view>
#include <vector>

/// What the channels of a dynamometer, a sensory tool holder or a power meter read.
namespace trochoid::force {

/// @brief What a channel reads of the force on the tool.
///
/// x, y, z are fixed to the workpiece. u and v turn with the tool, v by 90 deg from u
/// towards tooth 2. Moments are those of a force about the point at the gauge length.
enum class ChannelAxis {
  x,
  y,
  z,
  u,
  v,
  torque,
  moment_x,
  moment_y,
  moment_u,
  moment_v,
  power,
};

/// The names that files use, in the order of ChannelAxis.
inline constexpr std::array<std::string_view, 11> channel_axis_names{
    "x", "y", "z", "u", "v", "torque", "Mx", "My", "Mu", "Mv", "power"};

constexpr std::string_view name_of(ChannelAxis axis) noexcept {
  return channel_axis_names[static_cast<std::size_t>(axis)];
}

/// Unit of a channel.
enum class ChannelUnit { newton, newton_metre, watt };

/// The names that files use.
constexpr std::string_view name_of(ChannelUnit unit) noexcept {
  switch (unit) {
    case ChannelUnit::newton:
      return "N";
    case ChannelUnit::newton_metre:
      return "Nm";
    case ChannelUnit::watt:
      return "W";
  }
  return {};
}

ChannelUnit unit_of(ChannelAxis axis) noexcept;

/// Whether a channel reads a moment of which the height of the section counts.
bool needs_gauge_length(ChannelAxis axis) noexcept;

/// Whether a channel turns with the tool.
bool turns_with_tool(ChannelAxis axis) noexcept;

struct Channel {
  ChannelAxis axis = ChannelAxis::x;
  double sign = 1.0;  ///< 1 or -1
};

/// The channels that are recorded together.
struct Sensor {
  std::vector<Channel> channels;
  double angle = 0.0;  ///< of u from the tip of tooth 1 towards tooth 2 [rad]
  double gauge_length =
      0.0;  ///< of the section whose moments are read, above the tip [m]
};

/// @brief What each channel reads for a coefficient of 1, at the angles phi [rad].
///
/// @eq F-32 F_u = F_x sin(theta_u) + F_y cos(theta_u), F_v = -F_x cos(theta_u) +
///          F_y sin(theta_u), theta_u = phi - sensor angle; M_u, M_v alike;
///          power = torque Omega
/// @src derived
///
/// @param tolerance  as of forces
/// @return shape (n, channels, columns), in N, N m and W per SI unit of a coefficient
std::vector<double> channel_columns(const Setup& setup, const Law& law,
                                    const Sensor& sensor, std::span<const double> phi,
                                    double tolerance);

/// @brief Means of the same over a turn, by integrals along the edges (F-31).
/// @return shape (channels, columns)
std::vector<double> channel_means(const Setup& setup, const Law& law,
                                  const Sensor& sensor, double tolerance);

/// @brief What the channels read of given loads.
/// @param loads    shape (n)
/// @param phi      [rad], shape (n)
/// @param Omega    spindle speed [rad/s]
/// @return         shape (n, channels)
std::vector<double> channel_values(const Sensor& sensor,
                                   std::span<const SixLoads> loads,
                                   std::span<const double> phi, double Omega);

}  // namespace trochoid::force
