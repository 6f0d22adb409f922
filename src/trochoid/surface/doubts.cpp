#include <trochoid/surface/doubts.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace trochoid::surface {

namespace {

std::vector<Reading> without_outliers(std::span<const Reading> readings,
                                      const Calibration& calibration) {
  std::vector<char> out(readings.size());
  for (const Outlier& o : calibration.outliers) {
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

/// Quick, and free of runout: the means of the readings, without feedback.
CoefficientFit fit_of_means(const Setting& setting, std::span<const Reading> readings,
                            const Calibration& calibration) {
  return chosen_fit(fit_models(setting, readings, calibration.datum, Feedback::none));
}

}  // namespace

std::optional<NegativeCoefficients> negative_coefficients(
    const Setting& setting, std::span<const Reading> readings,
    const Calibration& calibration) {
  const FoundCoefficients& found = calibration.coefficients;
  const bool all_zero = std::all_of(readings.begin(), readings.end(),
                                    [](const Reading& r) { return r.error == 0; });
  if (all_zero || (found.K_tc.value >= 0 && found.K_rc.value >= 0)) {
    return std::nullopt;
  }
  std::vector<Reading> turned = without_outliers(readings, calibration);
  for (Reading& r : turned) {
    r.error = -r.error;
  }
  const CoefficientFit other = fit_of_means(setting, turned, calibration);
  const bool sensible = other.ok && other.K_tc.value > 0 && other.K_rc.value > 0;
  return NegativeCoefficients{.wrong_sign = found.K_tc.value < 0 && sensible,
                              .K_tc = other.K_tc,
                              .K_rc = other.K_rc};
}

std::optional<OriginDoubt> origin_doubt(const Setting& setting,
                                        std::span<const Reading> readings,
                                        const Calibration& calibration, double length,
                                        double position) {
  constexpr double decisive = 12.0;  // of twice the logarithm of the likelihoods' ratio
  constexpr double at_the_end = 0.02;  // of the length of the wall
  if (readings.empty() || setting.model == Model::quasi_static) {
    return std::nullopt;
  }
  std::vector<Reading> moved = without_outliers(readings, calibration);
  const auto [first, last] =
      std::minmax_element(moved.begin(), moved.end(),
                          [](const Reading& a, const Reading& b) { return a.x < b.x; });
  const double low = first->x;
  const double high = last->x;
  const double by = position - 0.5 * (low + high);
  if (std::abs(by) < 0.1 * length || low + by < 0 || high + by > length) {
    return std::nullopt;
  }
  const auto count = static_cast<double>(moved.size());
  const double own = fit_of_means(setting, moved, calibration).rms;
  for (Reading& r : moved) {
    r.x += by;
  }
  const CoefficientFit other = fit_of_means(setting, moved, calibration);
  const bool better =
      other.ok && count * std::log(own * own / (other.rms * other.rms)) > decisive;
  // Readings that begin at the end of the wall are as a scan counts them; others were
  // counted from somewhere on purpose, and only a better fit speaks against that.
  if (!better && low > at_the_end * length) {
    return std::nullopt;
  }
  return OriginDoubt{low, by, better, own, other.rms, other.K_tc, other.K_rc};
}

std::optional<Estimate> eccentricity_hidden_by_feedback(
    const Setting& setting, std::span<const Reading> readings,
    std::span<const Datum> datum, FitOptions options, const Calibration& calibration) {
  constexpr double sure = 0.95;
  if (options.feedback != Feedback::none || !options.shared || !calibration.runout.ok) {
    return std::nullopt;
  }
  options.feedback.reset();
  const Calibration open = calibrate(setting, readings, datum, options);
  double weight = 0.0;
  for (const Explanation& e : open.explanations) {
    weight += e.feedback == Feedback::none ? 0.0 : e.weight;
  }
  return weight > sure ? std::optional(open.runout.eccentricity) : std::nullopt;
}

}  // namespace trochoid::surface
