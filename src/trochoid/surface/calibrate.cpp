#include <trochoid/surface/calibrate.h>

#include <trochoid/numerics/median.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

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

/// Farther off than so many standard deviations, or this.
constexpr double outlier_deviations = 5.0;
constexpr double never_far = 0.25e-6;  // [m]
/// So many times farther from the median of all readings than most of them: a slip of the
/// unit or the point, which no fit survives.
constexpr double wild = 20.0;
/// More than this share are no outliers: the model does not fit.
constexpr double most_outliers = 0.15;

/// The readings that count, and which they were.
struct Kept {
  std::vector<Reading> readings;
  std::vector<std::size_t> index;
};

Kept all_of(std::span<const Reading> readings) {
  Kept kept{.readings = {readings.begin(), readings.end()}};
  for (std::size_t i = 0; i < readings.size(); ++i) {
    kept.index.push_back(i);
  }
  return kept;
}

/// Leave out what lies far from what is predicted, in parts of outlier_deviations.
/// @return whether anything does
bool leave_out(std::span<const double> predicted, double far, Kept& kept,
               std::vector<Outlier>& outliers) {
  std::vector<double> size;
  for (std::size_t i = 0; i < predicted.size(); ++i) {
    size.push_back(std::abs(kept.readings[i].error - predicted[i]));
  }
  const double s = 1.4826 * numerics::median(size);
  const double most = far * std::max(outlier_deviations * s, never_far);  // E-26
  const auto count = static_cast<double>(std::count_if(
      size.begin(), size.end(), [&](double distance) { return distance > most; }));
  const auto before = static_cast<double>(outliers.size());
  const double whole = before + static_cast<double>(size.size());
  if (count == 0 || before + count > most_outliers * whole) {
    return false;
  }
  Kept rest;
  for (std::size_t i = 0; i < size.size(); ++i) {
    if (size[i] > most) {
      outliers.push_back({kept.index[i], kept.readings[i].error - predicted[i]});
    } else {
      rest.readings.push_back(kept.readings[i]);
      rest.index.push_back(kept.index[i]);
    }
  }
  kept = std::move(rest);
  return true;
}

/// What is wild before anything is fitted; each measurement has a zero of its own.
void leave_out_wild(Kept& kept, std::vector<Outlier>& outliers) {
  if (kept.readings.empty()) return;
  std::map<std::size_t, std::vector<double>> errors;
  for (const Reading& r : kept.readings) errors[r.set].push_back(r.error);
  std::map<std::size_t, double> middle;
  for (auto& [set, of_set] : errors) middle[set] = numerics::median(std::move(of_set));
  std::vector<double> median;
  for (const Reading& r : kept.readings) median.push_back(middle.at(r.set));
  leave_out(median, wild, kept, outliers);
}

StatedFits fit_stated(const Setting& setting, const Kept& kept,
                      std::span<const Datum> datum, Feedback feedback,
                      const std::function<void()>& means_fitted) {
  StatedFits fit{.models = fit_models(setting, kept.readings, datum, feedback)};
  if (chosen_fit(fit.models).ok) {
    fit.runout = runout_of(setting, kept.readings, datum, fit.models, means_fitted);
  }
  return fit;
}

std::vector<double> predicted_by(const StatedFits& fit, std::size_t readings) {
  return fit.runout.ok ? fit.runout.predicted : predicted_means(fit.models, readings);
}

FoundCoefficients found_by(const RunoutFit& joint) {
  return {joint.K_tc, joint.K_rc, joint.correlation, joint.datum, joint.rms};
}

void count_stated(const Setting& setting, Feedback feedback, Calibration& c) {
  const CoefficientFit& means = chosen_fit(c.models);
  c.with_runout =
      c.runout_seen && setting.model == Model::envelope && feedback == Feedback::none;
  c.coefficients = c.with_runout
                       ? found_by(c.runout)
                       : FoundCoefficients{means.K_tc, means.K_rc, means.correlation,
                                           means.datum, means.rms};
}

void count_joint(const JointFit& joint, Calibration& c) {
  c.explanations = joint.explanations;
  c.own_scatter = joint.own_scatter;
  c.shared_scatter = joint.shared_scatter;
  c.coefficients = found_by(joint.fit);
  c.with_runout = joint.with_runout;
  if (joint.with_runout) {
    c.runout = joint.fit;
  }
}

/// What was found of the readings that count, said of all of them.
void spread_out(const Kept& kept, std::span<const Reading> readings, Calibration& c) {
  std::vector<double> all(readings.size());
  for (std::size_t i = 0; i < kept.index.size(); ++i) {
    all[kept.index[i]] = c.predicted[i];
  }
  for (const Outlier& out : c.outliers) {
    all[out.reading] = readings[out.reading].error - out.residual;
  }
  c.predicted = std::move(all);
  for (Nominal& n : c.models.nominal) {
    for (std::size_t& i : n.readings) {
      i = kept.index[i];
    }
  }
}

/// The fits, and whether anything was left to decide.
struct Fits {
  StatedFits stated;
  JointFit joint;
  std::vector<double> predicted;  ///< of what is kept
};

/// Fit, leave out what lies far off, and fit again until nothing does.
/// What may be decided: of too few heights no form, beyond what is stated.
std::vector<Datum> decidable(std::span<const Datum> datum,
                             std::span<const Reading> readings) {
  constexpr std::size_t fewest_heights = 5;
  std::set<double> heights;
  for (const Reading& r : readings) {
    if (heights.size() < fewest_heights) {
      heights.insert(r.height);
    }
  }
  std::vector<Datum> out(datum.begin(), datum.end());
  for (Datum& d : out) {
    d.decide = d.decide && heights.size() >= fewest_heights;
  }
  return out;
}

// six parameters: a wall with how it is fitted, and what becomes of its readings
Fits fit_robustly(const Setting& setting, std::span<const Datum> datum,
                  const FitOptions& options, Kept& kept, std::vector<Outlier>& outliers,
                  const std::function<void()>& means_fitted) {
  constexpr int most_rounds = 4;
  std::vector<Datum> first(datum.begin(), datum.end());
  for (Datum& d : first) {
    d = decided(d, Form::offset);
  }
  const bool robust = options.robust && setting.model != Model::quasi_static;
  const bool open =
      options.shared || !options.feedback ||
      std::any_of(datum.begin(), datum.end(), [](const Datum& d) { return d.decide; });
  if (options.robust) leave_out_wild(kept, outliers);
  Fits fits;
  for (int round = 0; round < most_rounds; ++round) {
    const bool may_leave = robust && round + 1 < most_rounds;
    fits.stated = fit_stated(setting, kept, first,
                             options.feedback.value_or(Feedback::none), means_fitted);
    if (!chosen_fit(fits.stated.models).ok) {
      break;
    }
    fits.predicted = predicted_by(fits.stated, kept.readings.size());
    if (may_leave && leave_out(fits.predicted, 1.0, kept, outliers)) {
      continue;
    }
    if (open) {
      fits.joint = fit_jointly(setting, kept.readings, datum, options, fits.stated);
    }
    if (!fits.joint.ok) {
      break;
    }
    fits.predicted = fits.joint.fit.predicted;
    if (!may_leave || !leave_out(fits.predicted, 1.0, kept, outliers)) {
      break;
    }
  }
  return fits;
}

}  // namespace

bool is_seen(const RunoutFit& runout) noexcept {
  return runout.ok && runout.eccentricity.value > clear_runout * runout.eccentricity.se;
}

Calibration calibrate(const Setting& setting, std::span<const Reading> readings,
                      std::span<const Datum> datum, const FitOptions& options,
                      const std::function<void()>& means_fitted) {
  static_cast<void>(side_of(setting));
  Calibration c;
  Kept kept = all_of(readings);
  c.datum = decidable(datum, readings);
  Fits fits = fit_robustly(setting, c.datum, options, kept, c.outliers, means_fitted);
  c.models = std::move(fits.stated.models);
  c.runout = std::move(fits.stated.runout);
  c.predicted = std::move(fits.predicted);
  c.ok = chosen_fit(c.models).ok;
  c.message = chosen_fit(c.models).message;
  if (!c.ok) {
    return c;
  }
  if (fits.joint.ok) {
    count_joint(fits.joint, c);
  }
  for (Datum& d : c.datum) {
    d = decided(d, fits.joint.ok ? c.explanations.front().form : Form::offset);
  }
  c.runout_seen = is_seen(c.runout);
  if (!fits.joint.ok) {
    count_stated(setting, options.feedback.value_or(Feedback::none), c);
  }
  std::vector<Spot> spots;
  for (const Nominal& n : c.models.nominal) {
    spots.push_back({n.x, n.height, n.set});
  }
  c.datum_parts = datum_columns(spots, c.datum).parts;
  spread_out(kept, readings, c);
  return c;
}

}  // namespace trochoid::surface
