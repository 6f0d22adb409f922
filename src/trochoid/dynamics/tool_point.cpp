#include <trochoid/dynamics/tool_point.h>

#include <trochoid/structure/coupled_modes.h>
#include <trochoid/structure/identify_modes.h>
#include <trochoid/structure/thinned.h>

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

/// What was found along one axis.
struct ModesAlong {
  std::vector<FittedMode> real;
  std::vector<FittedMode> complex;  ///< empty: the real ones describe it
};

/// Modes of one body along one axis; none where it was not measured.
/// @param complex_too  whether complex ones are of use
ModesAlong modes_along(std::size_t axis, bool of_table, bool complex_too,
                       std::span<const MeasuredResponse> all, ToolPoint& point) {
  for (std::size_t i = 0; i < all.size(); ++i) {
    const MeasuredResponse& one = all[i];
    if (one.of_table != of_table || one.motion != axis || one.force != axis) continue;
    structure::ModesFit fit = structure::identify_modes(one.response, {});
    if (auto delayed = structure::delayed_fit(one.response, {}, fit)) {
      fit = std::move(delayed->fit);
      point.delays.push_back({i, delayed->delay});
    }
    ModesAlong out{.real = fit.modes, .complex = {}};
    if (!fit.ok && !point.no_modes) {
      point.no_modes = NoModes{i, fit.reason};
    }
    if (!complex_too) return out;
    if (const auto check = structure::complex_check(fit); check && check->complex()) {
      out.complex = check->fit.modes;
    }
    return out;
  }
  return {};
}

/// The modes of one axis, in both systems.
void add_along(const ModesAlong& found, double x, double y, bool of_table,
               ToolPoint& point) {
  const auto add = [&](const structure::Mode& m, System& to) {
    to.modes.push_back({m.mass, m.damping, m.stiffness, x, y, of_table});
  };
  for (const FittedMode& m : found.real) {
    add(m.mode(), point.real_modes);
    if (found.complex.empty()) add(m.mode(), point.modes);
  }
  for (const FittedMode& m : found.complex) {
    point.modes.modes.push_back(complex_mode(m, x, y));
    point.modes.modes.back().of_table = of_table;
    point.complex_modes = true;
  }
}

/// @brief A cross response without the delay that the direct ones have: the channels are
/// the same.
structure::FrequencyResponse at_one_time(const MeasuredResponse& cross,
                                         std::size_t index,
                                         std::span<const MeasuredResponse> all,
                                         ToolPoint& point) {
  structure::Delay mean;
  double count = 0.0;
  for (const FoundDelay& found : point.delays) {
    if (all[found.response].of_table != cross.of_table) continue;
    mean.time.value += found.delay.time.value;
    mean.time.se = std::max(mean.time.se, found.delay.time.se);
    ++count;
  }
  if (!(count > 0)) return cross.response;
  mean.time.value /= count;
  point.delays.push_back({index, mean});
  return structure::without_delay(cross.response, mean.time.value);
}

/// Modes of one body, as the chip feels them; a cross response couples the axes.
void add_modes(bool of_table, std::span<const MeasuredResponse> all, ToolPoint& point) {
  const auto cross = std::ranges::find_if(all, [&](const MeasuredResponse& one) {
    return one.of_table == of_table && one.motion != one.force;
  });
  const bool coupled = cross != all.end();
  const ModesAlong x = modes_along(0, of_table, !coupled, all, point);
  const ModesAlong y = modes_along(1, of_table, !coupled, all, point);
  const double sign = of_table ? -1.0 : 1.0;
  if (!coupled) {
    add_along(x, sign, 0.0, of_table, point);
    add_along(y, 0.0, sign, of_table, point);
    return;
  }
  const structure::FrequencyResponse together =
      at_one_time(*cross, static_cast<std::size_t>(cross - all.begin()), all, point);
  for (const auto& m : structure::coupled_modes(x.real, y.real, together)) {
    const ChipMode mode{m.mode.mass, m.mode.damping, m.mode.stiffness,
                        sign * m.x,  sign * m.y,     of_table};
    point.modes.modes.push_back(mode);
    point.real_modes.modes.push_back(mode);
  }
}

/// The receptance of modes along one axis.
std::complex<double> receptance(const System& system, std::size_t axis, double omega) {
  std::complex<double> sum;
  for (const ChipMode& m : system.modes) {
    const double along = axis == 0 ? m.x : m.y;
    const std::complex<double> moved(m.in_phase, m.lead * omega);
    sum +=
        along * along * moved /
        std::complex<double>(m.stiffness - m.mass * omega * omega, m.damping * omega);
  }
  return sum;
}

}  // namespace

ChipMode complex_mode(const FittedMode& mode, double x, double y) {
  const std::complex<double> Z = mode.phi.front() * mode.phi.front();
  const double omega = mode.omega.value;
  const double zeta = mode.zeta.value;
  const double mass = 1 / std::abs(Z);
  const double q = std::sqrt(1 - zeta * zeta);
  ChipMode out{mass, 2 * mass * zeta * omega, mass * omega * omega, x, y};
  out.lead = mass * Z.imag() / (omega * q);  // D-35
  out.in_phase = mass * Z.real() + zeta * omega * out.lead;
  return out;
}

Misfit misfit_near(const ToolPoint& point, const System& modes, double omega) {
  constexpr double near = 0.1;
  Misfit worst;
  for (std::size_t axis = 0; axis < 2; ++axis) {
    // Tool and table add up along an axis, in the response as in the modes.
    std::vector<double> lines;
    double noise = 0.0;
    for (std::size_t p = 0; p < point.response.parts.size(); ++p) {
      const MeasuredReceptance& part = point.response.parts[p];
      if (part.motion != axis || part.force != axis) continue;
      noise += point.noise[p] * point.noise[p];
      for (const double w : part.omega) {
        if (std::abs(w / omega - 1) < near) lines.push_back(w);
      }
    }
    double gap = 0.0;
    double size = 0.0;
    for (const double w : lines) {
      const std::complex<double> H = receptance(point.response, w)[3 * axis];
      gap += std::norm(receptance(modes, axis, w) - H);
      size += std::norm(H);
    }
    if (!(size > 0)) continue;
    const Misfit own{std::sqrt(gap / size),
                     std::sqrt(noise * static_cast<double>(lines.size()) / size)};
    if (own.modes > worst.modes) worst = own;
  }
  return worst;
}

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
  if (fit_modes) {
    add_modes(false, measured, point);
    add_modes(true, measured, point);
  }
  for (std::size_t i = 0; i < measured.size(); ++i) {
    MeasuredResponse one = measured[i];
    for (const FoundDelay& found : point.delays) {
      if (found.response != i) continue;
      one.response =
          structure::without_delay(std::move(one.response), found.delay.time.value);
    }
    MeasuredReceptance part = receptance_of(one);
    point.noise.push_back(structure::scatter_of_lines(part.H));
    point.response.parts.push_back(std::move(part));
  }
  add_transposed(point);
  return point;
}

}  // namespace trochoid::dynamics
