#include <trochoid/dynamics/tool_point.h>

#include <trochoid/structure/coupled_modes.h>
#include <trochoid/structure/identify_modes.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

namespace trochoid::dynamics {

namespace {

using structure::FittedMode;

void add_transposed(ToolPoint& point) {
  const auto has = [&](std::size_t motion, std::size_t force) {
    return std::any_of(point.response.parts.begin(), point.response.parts.end(),
                       [&](const MeasuredReceptance& part) {
                         return part.motion == motion && part.force == force;
                       });
  };
  for (std::size_t i = 0; i < 2; ++i) {
    if (has(i, 1 - i) && !has(1 - i, i)) {
      const std::size_t count = point.response.parts.size();
      for (std::size_t k = 0; k < count; ++k) {
        MeasuredReceptance part = point.response.parts[k];
        if (part.motion == i && part.force == 1 - i) {
          std::swap(part.motion, part.force);
          point.noise.push_back(point.noise[k]);
          point.response.parts.push_back(std::move(part));
        }
      }
      return;
    }
  }
}

/// Modes of one body along one axis; none where it was not measured.
std::vector<FittedMode> modes_along(std::size_t axis, bool of_table,
                                    std::span<const MeasuredResponse> all,
                                    ToolPoint& point) {
  for (std::size_t i = 0; i < all.size(); ++i) {
    const MeasuredResponse& one = all[i];
    if (one.of_table != of_table || one.motion != axis || one.force != axis) continue;
    structure::ModesFit fit = structure::identify_modes(one.response, {});
    if (!fit.ok && !point.no_modes) {
      point.no_modes = NoModes{i, fit.reason};
    }
    return std::move(fit.modes);
  }
  return {};
}

/// Modes of one body, as the chip feels them; a cross response couples the axes.
void add_modes(bool of_table, std::span<const MeasuredResponse> all, ToolPoint& point) {
  const auto x = modes_along(0, of_table, all, point);
  const auto y = modes_along(1, of_table, all, point);
  const double sign = of_table ? -1.0 : 1.0;
  const auto add = [&](const structure::Mode& m, double to_x, double to_y) {
    point.modes.modes.push_back(
        {m.mass, m.damping, m.stiffness, sign * to_x, sign * to_y, of_table});
  };
  for (const MeasuredResponse& one : all) {
    if (one.of_table == of_table && one.motion != one.force) {
      for (const auto& m : structure::coupled_modes(x, y, one.response)) {
        add(m.mode, m.x, m.y);
      }
      return;
    }
  }
  for (const FittedMode& m : x) {
    add(m.mode(), 1.0, 0.0);
  }
  for (const FittedMode& m : y) {
    add(m.mode(), 0.0, 1.0);
  }
}

}  // namespace

MeasuredReceptance receptance_of(const MeasuredResponse& measured) {
  MeasuredReceptance part{measured.motion, measured.force, {}, {}};
  const structure::FrequencyResponse& response = measured.response;
  for (std::size_t i = 0; i < response.omega.size(); ++i) {
    const double omega = response.omega[i];
    if (omega > 0) {
      part.omega.push_back(omega);
      part.H.push_back(response.H[i] / structure::factor(response.kind, omega));
    }
  }
  return part;
}

bool moves_against_force(const MeasuredReceptance& part) {
  double work = 0.0;
  for (const std::complex<double>& H : part.H) {
    work -= H.imag() * std::abs(H);
  }
  return part.motion == part.force && work <= 0;
}

ToolPoint tool_point(std::span<const MeasuredResponse> measured, bool fit_modes) {
  ToolPoint point;
  for (const MeasuredResponse& one : measured) {
    MeasuredReceptance part = receptance_of(one);
    point.noise.push_back(scatter(part));
    point.response.parts.push_back(std::move(part));
  }
  if (fit_modes) {
    add_modes(false, measured, point);
    add_modes(true, measured, point);
  }
  add_transposed(point);
  return point;
}

}  // namespace trochoid::dynamics
