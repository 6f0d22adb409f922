#include <trochoid/run/wall/doubts.h>

#include <trochoid/base/units.h>
#include <trochoid/run/wall/setting.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace trochoid::run {

namespace {

using surface::CoefficientFit;
using surface::Reading;

std::vector<Reading> without_outliers(std::span<const Reading> readings,
                                      const surface::Calibration& calibration) {
  std::vector<char> out(readings.size());
  for (const surface::Outlier& o : calibration.outliers) {
    out[o.reading] = 1;
  }
  std::vector<Reading> rest;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    if (out[i] == 0) {
      rest.push_back(readings[i]);
    }
  }
  return rest;
}

CoefficientFit fit_of_means(const inputs::Case& given,
                            std::span<const Reading> readings,
                            const surface::Calibration& calibration) {
  return chosen_fit(surface::fit_models(wall_setting(given), readings,
                                        calibration.datum, surface::Feedback::none));
}

std::string both(const inputs::Case& given, const surface::Estimate& K_tc,
                 const surface::Estimate& K_rc) {
  const auto names = force::coefficient_quantities(given.law);
  return fmt::format("{} = {:.4g} and {} = {:.4g}", names[0].key,
                     K_tc.value / names[0].unit, names[1].key,
                     K_rc.value / names[1].unit);
}

}  // namespace

std::string why_negative(const inputs::Case& given, std::span<const Reading> readings,
                         const surface::Calibration& calibration) {
  const surface::FoundCoefficients& found = calibration.coefficients;
  const bool all_zero = std::all_of(readings.begin(), readings.end(),
                                    [](const Reading& r) { return r.error == 0; });
  if (all_zero || (found.K_tc.value >= 0 && found.K_rc.value >= 0)) {
    return {};
  }
  std::vector<Reading> turned = without_outliers(readings, calibration);
  for (Reading& r : turned) {
    r.error = -r.error;
  }
  const CoefficientFit other = fit_of_means(given, turned, calibration);
  if (found.K_tc.value < 0 && other.ok && other.K_tc.value > 0 &&
      other.K_rc.value > 0) {
    return fmt::format(
        "the readings have the wrong sign: positive must be where material is left; "
        "turned round they give {}",
        both(given, other.K_tc, other.K_rc));
  }
  const auto names = force::coefficient_quantities(given.law);
  const bool first = found.K_tc.value < 0;
  const surface::Estimate& e = first ? found.K_tc : found.K_rc;
  const force::Quantity& name = names[first ? 0 : 1];
  return fmt::format(
      "the readings do not tell {}: it comes out as {:.3g}, known to lie between {:.3g} "
      "and {:.3g}; readings at more heights, or a wall that bends more, would tell it",
      name.key, e.value / name.unit, e.low / name.unit, e.high / name.unit);
}

std::string origin_doubt(const inputs::Case& given, std::span<const Reading> readings,
                         const surface::Calibration& calibration) {
  constexpr double decisive = 12.0;  // of twice the logarithm of the likelihoods' ratio
  constexpr double at_the_end = 0.02;  // of the length of the wall
  if (!given.machine.wall || readings.empty() ||
      wall_setting(given).model == surface::Model::quasi_static) {
    return {};
  }
  std::vector<Reading> moved = without_outliers(readings, calibration);
  const auto [first, last] =
      std::minmax_element(moved.begin(), moved.end(),
                          [](const Reading& a, const Reading& b) { return a.x < b.x; });
  const double length = given.machine.wall->length;
  const double low = first->x;
  const double high = last->x;
  const double by = wall_position(given) - 0.5 * (low + high);
  if (std::abs(by) < 0.1 * length || low + by < 0 || high + by > length) {
    return {};
  }
  const auto count = static_cast<double>(moved.size());
  const double own = fit_of_means(given, moved, calibration).rms;
  for (Reading& r : moved) {
    r.x += by;
  }
  const CoefficientFit other = fit_of_means(given, moved, calibration);
  const bool better =
      other.ok && count * std::log(own * own / (other.rms * other.rms)) > decisive;
  if (!better && low > at_the_end * length) {
    return {};
  }
  return fmt::format(
      "x begins at {:.4g} mm: is it counted from the start of the scan? It counts from "
      "the end of the wall. {:.4g} mm farther along, about position_mm, {} {}.",
      low / unit::mm, by / unit::mm, both(given, other.K_tc, other.K_rc),
      better ? fmt::format("fit better ({:.3g} instead of {:.3g} um left)",
                           other.rms / unit::um, own / unit::um)
             : "fit as well");
}

void withdraw_hidden_runout(const inputs::Case& given,
                            std::span<const Reading> readings,
                            std::span<const surface::Datum> datum,
                            surface::Calibration& calibration) {
  constexpr double sure = 0.95;
  surface::FitOptions fit = wall_fit(given);
  if (fit.feedback != surface::Feedback::none || !fit.shared ||
      !calibration.runout.ok) {
    return;
  }
  fit.feedback.reset();
  const surface::Calibration open =
      surface::calibrate(wall_setting(given), readings, datum, fit);
  double weight = 0.0;
  for (const surface::Explanation& e : open.explanations) {
    weight += e.feedback == surface::Feedback::none ? 0.0 : e.weight;
  }
  if (weight > sure) {
    calibration.runout.ok = false;
    calibration.runout.message = fmt::format(
        "the readings follow the feedback of the deflection, which feedback = \"none\" "
        "leaves out: with it the eccentricity is {:.3g} +- {:.2g} um",
        open.runout.eccentricity.value / unit::um,
        (open.runout.eccentricity.high - open.runout.eccentricity.low) / 2 / unit::um);
    calibration.runout_seen = false;
  }
}

}  // namespace trochoid::run
