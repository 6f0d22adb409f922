#include <trochoid/structure/delay.h>

#include <trochoid/structure/identify_modes.h>

#include <algorithm>
#include <cmath>
#include <complex>

namespace trochoid::structure {

namespace {

/// Evidence of odds of 150 to 1.
constexpr double enough_evidence = 10.0;
/// Part of the phase that is left which a delay has to explain.
constexpr double least_share = 0.5;
/// A phase this small at the strongest lines is no matter [rad].
constexpr double least_phase = 0.01;
constexpr int most_fits = 4;
/// A delay that changes by less of its standard error stays.
constexpr double still = 0.5;

/// The phase that a fit leaves, against the frequency.
struct PhaseSlope {
  Known delay;         ///< [s]
  double share = 0.0;  ///< of the weighted square of the phase that it explains
  double phase = 0.0;  ///< that it makes at the lines that count [rad]
};

PhaseSlope phase_slope(const FittedResponse& one) {
  double xx = 0.0;
  double xy = 0.0;
  double yy = 0.0;
  double weights = 0.0;
  for (std::size_t i = 0; i < one.H.size(); ++i) {
    const double w = std::norm(one.fitted[i]);
    if (!(w > 0) || !(std::norm(one.H[i]) > 0)) continue;
    const double phase = std::arg(one.H[i] / one.fitted[i]);
    xx += w * one.omega[i] * one.omega[i];
    xy -= w * one.omega[i] * phase;
    yy += w * phase * phase;
    weights += w;
  }
  if (!(xx > 0) || !(yy > 0)) return {};
  PhaseSlope out;
  out.delay.value = xy / xx;
  const auto n = static_cast<double>(one.H.size());
  out.delay.se = std::sqrt(std::max(yy - xy * xy / xx, 0.0) / (n * xx));
  out.share = xy * xy / xx / yy;
  out.phase = std::abs(out.delay.value) * std::sqrt(xx / weights);
  return out;
}

/// By how much the mass of the lightest mode is off in a fit of the same response, where
/// that has its nearest mode.
double mass_error(const ModesFit& wrong, const ModesFit& right) {
  const auto lightest = std::ranges::min_element(
      right.modes, {}, [](const FittedMode& mode) { return mode.mass.value; });
  const auto same =
      std::ranges::min_element(wrong.modes, {}, [&](const FittedMode& mode) {
        return std::abs(mode.omega.value - lightest->omega.value);
      });
  return same->mass.value / lightest->mass.value - 1;
}

}  // namespace

FrequencyResponse without_delay(FrequencyResponse response, double delay) {
  for (std::size_t i = 0; i < response.H.size(); ++i) {
    response.H[i] *= std::polar(1.0, response.omega[i] * delay);
  }
  return response;
}

std::optional<DelayedFit> delayed_fit(const FrequencyResponse& response,
                                      const ModesOptions& options,
                                      const ModesFit& fit) {
  if (!fit.ok) return std::nullopt;
  const PhaseSlope first = phase_slope(fit.responses.front());
  if (first.share < least_share || first.phase < least_phase) return std::nullopt;
  DelayedFit out{.fit = fit, .delay = {.time = first.delay}};
  Known& delay = out.delay.time;
  for (int fits = 1;; ++fits) {  // M-36
    out.fit = identify_modes(without_delay(response, delay.value), options);
    if (!out.fit.ok) return std::nullopt;
    const Known rest = phase_slope(out.fit.responses.front()).delay;
    delay.se = rest.se;
    if (std::abs(rest.value) < still * rest.se || fits == most_fits) break;
    delay.value += rest.value;
  }
  const auto lines = static_cast<double>(out.fit.responses.front().omega.size());
  out.evidence = fit.criterion - out.fit.criterion - std::log(2 * lines);
  if (!(out.evidence > enough_evidence)) return std::nullopt;
  const auto complex = complex_check(fit);
  if (complex && complex->complex() && complex->evidence > out.evidence) {
    return std::nullopt;
  }
  out.delay.mass_error = mass_error(fit, out.fit);
  return out;
}

}  // namespace trochoid::structure
