#include <trochoid/base/units.h>
#include <trochoid/correction/command.h>
#include <trochoid/correction/shapes.h>

#include <algorithm>
#include <cmath>

namespace trochoid::correction {

namespace {

constexpr double part_of_resonance = 0.27;
/// A harmonic that is none, over the first.
constexpr double negligible = 1e-9;

Command leading(const PeriodicMotion& motion, const Plant& plant, double Omega,
                const CommandOptions& options) {
  const double lead =
      structure::low_frequency_delay(plant.actuator) + options.sample_time / 2;
  return {.ok = true, .wave = advanced(motion, Omega * lead), .lead = lead};
}

Command inverse(const PeriodicMotion& motion, const Plant& plant, double Omega,
                const CommandOptions& options) {
  Command command{.ok = true, .n_max = options.n_max};
  Harmonics wave = harmonics_of(motion, options.n_max);
  wave.mean /= response(plant, 0.0).real();
  double n = 0;
  for (auto& c : wave.c) {
    n += 1;
    const double omega = n * Omega;
    c *= std::polar(1.0, omega * options.sample_time / 2) /
         response(plant, omega);
  }
  command.wave = std::move(wave);
  return command;
}

/// a_0 x + a_1 x' + a_2 x'' of a polynomial.
Segment inverse_of(const Segment& s, const std::array<double, 3>& a) {
  const double width = s.to - s.from;
  Segment u = s;
  for (std::size_t k = 0; k < s.c.size(); ++k) {
    const double n = static_cast<double>(k);
    const double slope = k + 1 < s.c.size() ? (n + 1) * s.c[k + 1] / width : 0.0;
    const double curvature =
        k + 2 < s.c.size() ? (n + 1) * (n + 2) * s.c[k + 2] / (width * width) : 0.0;
    u.c[k] = a[0] * s.c[k] + a[1] * slope + a[2] * curvature;
  }
  return u;
}

Command inverse_in_time(const PeriodicMotion& motion, const Plant& plant, double Omega,
                        const CommandOptions& options) {
  Command command;
  if (!std::isfinite(range_of(motion).curvature)) {
    command.reason =
        "the inverse in time needs a motion whose slope is continuous (a sine, "
        "harmonics or quintic transitions): others would ask for infinite commands";
    return command;
  }
  auto a = structure::equation_coefficients(plant.actuator);
  a[1] *= Omega;
  a[2] *= Omega * Omega;
  PeriodicMotion wave = motion;
  if (auto* h = std::get_if<Harmonics>(&wave)) {
    h->mean *= a[0];
    double n = 0;
    for (auto& c : h->c) {
      n += 1;
      c *= std::complex<double>(a[0] - n * n * a[2], n * a[1]);
    }
  } else {
    for (Segment& s : std::get<Segments>(wave).all) {
      s = inverse_of(s, a);
    }
  }
  command.ok = true;
  command.wave = advanced(wave, Omega * options.sample_time / 2);
  return command;
}

}  // namespace

double most_frequency(const ActuatorLimits& limits, const Plant& plant) noexcept {
  return limits.most_frequency.value_or(part_of_resonance *
                                        structure::natural_frequency(plant.table) /
                                        unit::turn);
}

Command command_for(const PeriodicMotion& motion, Method method, const Plant& plant,
                    double Omega, const CommandOptions& options) {
  switch (method) {
    case Method::plain:
      return {.ok = true, .wave = motion};
    case Method::lead:
      return leading(motion, plant, Omega, options);
    case Method::inverse_in_time:
      return inverse_in_time(motion, plant, Omega, options);
    case Method::inverse:
    case Method::learning:
      break;
  }
  return inverse(motion, plant, Omega, options);
}

Followed followed(const RigidCut& cut, const PeriodicMotion& motion, const Plant& plant,
                  double Omega, const ActuatorLimits& limits) {
  const double by_resonance = most_frequency(limits, plant) * unit::turn / Omega;
  int n = static_cast<int>(
      std::min<double>(limits.most_harmonics, by_resonance * (1 + 1e-12)));
  for (n = std::max(n, 1);; --n) {
    Followed out{limited(cut, motion, n), n};
    const auto& c_n = std::get<Harmonics>(out.motion).c;
    if (n > 1 && std::abs(c_n.back()) <= negligible * std::abs(c_n.front())) {
      continue;
    }
    const Command c =
        command_for(out.motion, Method::inverse, plant, Omega, {.n_max = n});
    const Range range = range_of(c.wave);
    const bool fits = range.peak_to_peak() <= limits.stroke_high - limits.stroke_low &&
                      (!limits.slew || Omega * range.slope <= *limits.slew);
    if (n == 1 || fits) {
      return out;
    }
  }
}

}  // namespace trochoid::correction
