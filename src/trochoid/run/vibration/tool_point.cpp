#include <trochoid/run/vibration/tool_point.h>

#include <trochoid/base/error.h>
#include <trochoid/base/units.h>
#include <trochoid/inputs/frf_file.h>
#include <trochoid/run/vibration/modes.h>
#include <trochoid/structure/coupled_modes.h>
#include <trochoid/structure/identify_modes.h>

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <utility>

namespace trochoid::run {

namespace {

using dynamics::MeasuredReceptance;
using Warnings = std::vector<base::Warning>;

/// Fewer lines are no response.
constexpr std::size_t fewest_lines = 8;
/// Noise above this fraction of the response at the chatter frequency is told.
constexpr double loud_noise = 0.02;
/// Lines between the half-power points of the strongest resonance that are few.
constexpr std::size_t few_lines = 5;

std::string name_of_part(const MeasuredReceptance& part) {
  constexpr std::array<const char*, 2> axes = {"x", "y"};
  return part.motion == part.force ? fmt::format("along {}", axes[part.motion])
                                   : fmt::format("of {} to a force along {}",
                                                 axes[part.motion], axes[part.force]);
}

/// A line at an end of the band belongs to it, whatever rounding did to it.
bool in_band(const inputs::MeasuredFrf& frf, double f) {
  return f >= frf.band[0] * (1 - 1e-12) && f <= frf.band[1] * (1 + 1e-12);
}

/// The lines of a response as receptance.
MeasuredReceptance lines_of(const inputs::MeasuredFrf& frf,
                            const structure::FrequencyResponse& response) {
  MeasuredReceptance part{static_cast<std::size_t>(frf.axis),
                          static_cast<std::size_t>(frf.force_axis.value_or(frf.axis)),
                          {},
                          {}};
  for (std::size_t i = 0; i < response.omega.size(); ++i) {
    const double omega = response.omega[i];
    if (omega > 0) {
      part.omega.push_back(omega);
      part.H.push_back(response.H[i] / structure::factor(response.kind, omega));
    }
  }
  if (part.omega.size() < fewest_lines) {
    throw base::InputError(
        {fmt::format("{}: {} has {} lines above 0 Hz{}; must have at least {}",
                     frf.source.file.location, frf.source.file.path, part.omega.size(),
                     frf.band.empty() ? "" : " in band_Hz", fewest_lines)});
  }
  return part;
}

std::size_t strongest_line(const MeasuredReceptance& part) {
  const auto most = std::max_element(
      part.H.begin(), part.H.end(),
      [](const auto& a, const auto& b) { return std::norm(a) < std::norm(b); });
  return static_cast<std::size_t>(most - part.H.begin());
}

/// A point moves with the force that pushes it: the imaginary part of a direct
/// receptance is negative, most of all at a resonance.
void check_sign(const inputs::MeasuredFrf& frf, const MeasuredReceptance& part) {
  double work = 0.0;
  for (std::size_t i = 0; i < part.H.size(); ++i) {
    work -= part.H[i].imag() * std::abs(part.H[i]);
  }
  if (part.motion == part.force && work <= 0) {
    throw base::InputError({fmt::format(
        "{}: {}: the tool point would move against the force (the imaginary part of "
        "the receptance is positive at its peaks): the sensor points against the "
        "hammer, or kind is wrong; change the sign of the response, or `kind`",
        frf.source.file.location, frf.source.file.path)});
  }
}

/// Scatter of the lines, from fourth differences: a resonance with several lines in it
/// leaves little of them. The median keeps peaks out.
double scatter(const MeasuredReceptance& part) {
  constexpr double of_white_noise = 70.0;  // 1 + 16 + 36 + 16 + 1
  constexpr double median_of_rayleigh = 1.1774;
  std::vector<double> sizes;
  for (std::size_t i = 2; i + 2 < part.H.size(); ++i) {
    sizes.push_back(std::abs(part.H[i - 2] - 4.0 * part.H[i - 1] + 6.0 * part.H[i] -
                             4.0 * part.H[i + 1] + part.H[i + 2]));
  }
  const auto middle = sizes.begin() + static_cast<std::ptrdiff_t>(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  return *middle / median_of_rayleigh / std::sqrt(of_white_noise);
}

void warn_few_lines(const MeasuredReceptance& part, Warnings& warnings) {
  const std::size_t peak = strongest_line(part);
  const double half_power = std::abs(part.H[peak]) / std::sqrt(2.0);
  const auto inside = std::count_if(part.H.begin(), part.H.end(), [&](const auto& H) {
    return std::abs(H) >= half_power;
  });
  if (static_cast<std::size_t>(inside) < few_lines) {
    warnings.push_back(
        {"few_lines",
         fmt::format(
             "Only {} lines of the response {} lie between the half-power "
             "points of its peak at {:.5g} Hz: the limit depth hangs on them. A "
             "longer record has a finer resolution.",
             inside, name_of_part(part), part.omega[peak] / unit::Hz)});
  }
  if (peak == 0 || peak + 1 == part.H.size()) {
    warnings.push_back(
        {"peak_at_the_edge",
         fmt::format("The response {} is largest at the edge of its band, {:.5g} Hz: a "
                     "resonance may lie outside, which nothing here can see.",
                     name_of_part(part), part.omega[peak] / unit::Hz)});
  }
}

/// Given in one direction, a cross response serves for the other: structures without
/// gyroscopic forces are symmetric.
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

using structure::FittedMode;
using structure::FrequencyResponse;

/// A response in its band.
FrequencyResponse in_band(const inputs::MeasuredFrf& frf, FrequencyResponse response) {
  if (frf.band.size() != 2) {
    return response;
  }
  FrequencyResponse out{.kind = response.kind, .omega = {}, .H = {}};
  for (std::size_t i = 0; i < response.omega.size(); ++i) {
    if (in_band(frf, response.omega[i] / unit::Hz)) {
      out.omega.push_back(response.omega[i]);
      out.H.push_back(response.H[i]);
    }
  }
  return out;
}

/// One measured response of a body.
struct Measured {
  const inputs::MeasuredFrf& frf;
  FrequencyResponse response;

  [[nodiscard]] bool is(inputs::ModeBody body, inputs::Axis motion,
                        inputs::Axis force) const {
    return frf.body == body && frf.axis == motion &&
           frf.force_axis.value_or(motion) == force;
  }
};

/// Modes of one body along one axis; none where it was not measured.
std::vector<FittedMode> along(inputs::ModeBody body, inputs::Axis axis,
                              const std::vector<Measured>& all, ToolPoint& point) {
  for (const Measured& one : all) {
    if (!one.is(body, axis, axis)) {
      continue;
    }
    structure::ModesFit fit = structure::identify_modes(one.response, {});
    if (!fit.ok && point.no_modes.empty()) {
      point.no_modes = fmt::format("{}: {}", one.frf.source.file.path, fit.reason);
    }
    return std::move(fit.modes);
  }
  return {};
}

/// Modes of one body, as the chip feels them; a cross response couples the axes.
void add_modes(inputs::ModeBody body, const std::vector<Measured>& all,
               ToolPoint& point) {
  using inputs::Axis;
  const auto x = along(body, Axis::x, all, point);
  const auto y = along(body, Axis::y, all, point);
  const bool of_table = body == inputs::ModeBody::table;
  const double sign = of_table ? -1.0 : 1.0;
  const auto add = [&](const structure::Mode& m, double to_x, double to_y) {
    point.modes.modes.push_back(
        {m.mass, m.damping, m.stiffness, sign * to_x, sign * to_y, of_table});
  };
  for (const Measured& one : all) {
    if (one.is(body, Axis::x, Axis::y) || one.is(body, Axis::y, Axis::x)) {
      for (const auto& m : structure::coupled_modes(x, y, one.response)) {
        add(m.mode, m.x, m.y);
      }
      return;
    }
  }
  for (const FittedMode& m : x) {
    add(m.mode, 1.0, 0.0);
  }
  for (const FittedMode& m : y) {
    add(m.mode, 0.0, 1.0);
  }
}

}  // namespace

ToolPoint tool_point(const inputs::Case& given, Warnings& warnings) {
  ToolPoint point;
  std::vector<Measured> all;
  for (const inputs::MeasuredFrf& frf : given.machine.measured_frfs) {
    inputs::FrfFile file = frf.response.get();
    warnings.insert(warnings.end(), file.notes.begin(), file.notes.end());
    all.push_back({frf, in_band(frf, std::move(file.response))});
    MeasuredReceptance part = lines_of(frf, all.back().response);
    check_sign(frf, part);
    warn_few_lines(part, warnings);
    point.noise.push_back(scatter(part));
    point.response.parts.push_back(std::move(part));
  }
  if (given.machine.modes.empty()) {
    add_modes(inputs::ModeBody::tool, all, point);
    add_modes(inputs::ModeBody::table, all, point);
  }
  add_transposed(point);
  return point;
}

void warn_of_response(const ToolPoint& point, double chatter, double step,
                      Warnings& warnings) {
  const dynamics::Band band = dynamics::band_of(point.response);
  const auto response = dynamics::receptance(point.response, chatter);
  for (std::size_t i = 0; i < point.response.parts.size(); ++i) {
    const MeasuredReceptance& part = point.response.parts[i];
    const double size = std::abs(response[3 * part.motion]);
    if (part.motion == part.force && point.noise[i] > loud_noise * size && size > 0) {
      warnings.push_back(
          {"noise",
           fmt::format("The lines of the response {} scatter by {:.1f} % of it at the "
                       "chatter frequency of {:.5g} Hz: a limit depth from it is no "
                       "better than that. Average more blows, or use modes.",
                       name_of_part(part), 100 * point.noise[i] / size,
                       chatter / unit::Hz)});
    }
  }
  if (chatter + step > band.to) {
    warnings.push_back(
        {"band_short_above",
         fmt::format("The response ends at {:.5g} Hz, less than a tooth passing "
                     "frequency above the chatter frequency of {:.5g} Hz: harmonics "
                     "beyond it count as rigid, and what vibrates there is not seen.",
                     band.to / unit::Hz, chatter / unit::Hz)});
  }
  if (chatter < 1.5 * band.from) {
    warnings.push_back(
        {"band_short_below",
         fmt::format(
             "The chatter frequency of {:.5g} Hz lies near the lower end of the "
             "response, {:.5g} Hz: below it the static compliance is taken from "
             "the lowest line, and a slower resonance is not seen.",
             chatter / unit::Hz, band.from / unit::Hz)});
  }
}

}  // namespace trochoid::run
