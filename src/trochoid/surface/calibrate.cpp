#include <trochoid/surface/calibrate.h>

#include <algorithm>

namespace trochoid::surface {

namespace {

/// Eccentricity that is clearly different from none, in its own standard errors.
constexpr double clear_runout = 3.0;

RunoutFit runout_of(const Setting& setting, std::span<const Reading> readings,
                    std::span<const Datum> datum, const ModelFits& models,
                    const std::function<void()>& means_fitted) {
  if (std::all_of(readings.begin(), readings.end(),
                  [](const Reading& r) { return r.error == 0; })) {
    return {.message = "all readings are zero"};
  }
  if (means_fitted) {
    means_fitted();
  }
  return find_runout(setting, readings, datum, models);
}

}  // namespace

bool is_seen(const RunoutFit& runout) noexcept {
  return runout.ok && runout.eccentricity.value > clear_runout * runout.eccentricity.se;
}

Calibration calibrate(const Setting& setting, std::span<const Reading> readings,
                      std::span<const Datum> datum, Feedback feedback,
                      const std::function<void()>& means_fitted) {
  static_cast<void>(side_of(setting));
  Calibration c{.models = fit_models(setting, readings, datum, feedback)};
  const CoefficientFit& means = chosen_fit(c.models);
  if (!means.ok) {
    c.message = means.message;
    return c;
  }
  c.ok = true;
  c.runout = runout_of(setting, readings, datum, c.models, means_fitted);
  c.runout_seen = is_seen(c.runout);
  c.with_runout =
      c.runout_seen && setting.model == Model::envelope && feedback == Feedback::none;
  const RunoutFit& joint = c.runout;
  c.coefficients = c.with_runout
                       ? FoundCoefficients{joint.K_tc, joint.K_rc, joint.correlation,
                                           joint.datum, joint.rms}
                       : FoundCoefficients{means.K_tc, means.K_rc, means.correlation,
                                           means.datum, means.rms};
  c.predicted =
      c.runout.ok ? c.runout.predicted : predicted_means(c.models, readings.size());
  return c;
}

}  // namespace trochoid::surface
