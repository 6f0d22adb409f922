#include <trochoid/surface/joint_fit.h>

#include <trochoid/base/units.h>
#include <trochoid/surface/forward_models.h>
#include <trochoid/surface/joint_model.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>

namespace trochoid::surface {
namespace {

/// @brief Everything that explanations are tried on.
struct Given {
  const Setting& setting;
  std::span<const Reading> readings;
  std::span<const Datum> datum;
  const ModelFits& found;
  const RunoutFit& runout;
};

/// @brief One explanation as it was fitted.
struct Tried {
  Explanation what;
  ForwardModel forward;
  DatumColumns form;  ///< of every reading
  RowFit fit;
};

/// @brief The answer of all explanations model_average (E-24).
/// @param tried  likeliest first, not empty, their weights set
JointFit model_average(const Given& wall, const Scatter& scatter,
                       std::span<const Tried> tried);

using Values = std::vector<double>;

/// Unknowns turned by whole pitches to where those of another explanation lie: without
/// numbers on the teeth both are the same wall.
Values turned_towards(const Values& to, const Values& p, int teeth) {
  Values best = p;
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < teeth; ++k) {
    const double angle = unit::turn * k / teeth;
    Values q = p;
    q[0] = std::cos(angle) * p[0] - std::sin(angle) * p[1];
    q[1] = std::sin(angle) * p[0] + std::cos(angle) * p[1];
    q[2] += k;
    q[2] -= teeth * std::round((q[2] - to[2]) / teeth);
    const double apart = std::hypot(q[0] - to[0], q[1] - to[1]);
    if (apart < least) {
      least = apart;
      best = q;
    }
  }
  return best;
}

/// Mean and covariance over all explanations.
struct Mixture {
  Values mean;
  Values covariance;  ///< row-major
  Values own;         ///< variance of the likeliest if no error were shared
};

Mixture mixture_of(const Given& wall, std::span<const Tried> tried) {
  const Values& likeliest = tried.front().fit.p;
  const std::size_t n = likeliest.size();
  const bool turn =
      wall.runout.ok && !wall.runout.labelled && wall.setting.model == Model::envelope;
  std::vector<Values> all;
  Mixture m{Values(n), Values(n * n), tried.front().fit.own};
  for (const Tried& t : tried) {
    all.push_back(
        turn ? turned_towards(likeliest, t.fit.p, wall.setting.setup.cutter.teeth())
             : t.fit.p);
    for (std::size_t k = 0; k < n; ++k) {
      m.mean[k] += t.what.weight * all.back()[k];
    }
  }
  for (std::size_t e = 0; e < tried.size(); ++e) {
    const std::size_t width = n + tried[e].fit.form.size();
    for (std::size_t a = 0; a < n; ++a) {
      for (std::size_t b = 0; b < n; ++b) {
        m.covariance[a * n + b] +=
            tried[e].what.weight *
            (tried[e].fit.covariance[a * width + b] +
             (all[e][a] - m.mean[a]) * (all[e][b] - m.mean[b]));  // E-24
      }
    }
  }
  return m;
}

/// Degrees of freedom of a variance of which a part is that of shared errors.
int freedom_of(const Scatter& scatter, double whole, double own) {
  double shared = std::numeric_limits<double>::infinity();
  for (std::size_t l = 0; l < scatter.ratio.size(); ++l) {
    if (scatter.ratio[l] > 0) {
      shared = std::min(shared, scatter.freedom[l + 1]);
    }
  }
  const double more = std::max(0.0, whole - own);
  const double least = std::isinf(shared) ? 0.0 : more * more / shared;
  const double sum = own * own / scatter.freedom.front() + least;
  const double both = own + more;
  return sum > 0 ? std::max(1, static_cast<int>(both * both / sum))
                 : static_cast<int>(scatter.freedom.front());
}

void put_runout(const Mixture& m, const Scatter& scatter, double f_z, RunoutFit& fit) {
  const std::size_t n = m.mean.size();
  const double c = m.mean[0];
  const double s = m.mean[1];
  const double rho2 = std::max(c * c + s * s, 1e-30);
  const auto along = [&](double x, double y, const auto& G) {
    return (x * x * G(0, 0) + 2 * x * y * G(0, 1) + y * y * G(1, 1)) / rho2;
  };
  const auto whole = [&](std::size_t i, std::size_t k) {
    return m.covariance[i * n + k];
  };
  const double radial = along(c, s, whole);
  const double across = along(-s, c, whole) / rho2;
  const int freedom =
      freedom_of(scatter, whole(0, 0) + whole(1, 1), m.own[0] + m.own[1]);
  fit.eccentricity = estimate(error_scale * std::sqrt(rho2),
                              error_scale * error_scale * radial, freedom);
  double angle = std::atan2(s, c);
  angle += angle < 0 ? unit::turn : 0.0;
  fit.angle = estimate(angle, across, freedom);
  const std::array<std::size_t, 4> place = {0, 1, n - 2, n - 1};
  const std::array<double, 4> unit = {error_scale, error_scale, coefficient_scale,
                                      coefficient_scale};
  for (std::size_t a = 0; a < 4; ++a) {
    for (std::size_t b = 0; b < 4; ++b) {
      fit.covariance[4 * a + b] = unit[a] * unit[b] * whole(place[a], place[b]);
    }
  }
  if (n == 5) {
    fit.start = estimate(f_z * m.mean[2], f_z * f_z * whole(2, 2), freedom);
  }
}

void put_coefficients(const Mixture& m, const Scatter& scatter, RunoutFit& fit) {
  const std::size_t n = m.mean.size();
  const auto put = [&](std::size_t k, Estimate& K) {
    const double variance = m.covariance[k * n + k];
    K = estimate(coefficient_scale * m.mean[k],
                 coefficient_scale * coefficient_scale * variance,
                 freedom_of(scatter, variance, m.own[k]));
  };
  put(n - 2, fit.K_tc);
  put(n - 1, fit.K_rc);
  fit.correlation =
      m.covariance[(n - 2) * n + n - 1] /
      std::sqrt(m.covariance[(n - 2) * n + n - 2] * m.covariance[(n - 1) * n + n - 1]);
}

/// What the likeliest explanation says of all readings, its form included.
void put_predicted(const Given& wall, const Tried& likeliest, RunoutFit& fit) {
  fit.predicted = likeliest.forward.predict(wall.readings, likeliest.fit.p);
  const std::size_t n = likeliest.form.count;
  double sum = 0.0;
  for (std::size_t i = 0; i < fit.predicted.size(); ++i) {
    for (std::size_t k = 0; k < n; ++k) {
      fit.predicted[i] +=
          error_scale * likeliest.fit.form[k] * likeliest.form.values[i * n + k];
    }
    sum += std::pow(wall.readings[i].error - fit.predicted[i], 2);
  }
  fit.rms = std::sqrt(sum / static_cast<double>(fit.predicted.size()));
}

Explanation described(const Tried& tried, const Scatter& scatter, bool with_runout) {
  Explanation what = tried.what;
  const Mixture alone{tried.fit.p, {}, tried.fit.own};
  const std::size_t n = tried.fit.p.size();
  const std::size_t width = n + tried.fit.form.size();
  Mixture m = alone;
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t b = 0; b < n; ++b) {
      m.covariance.push_back(tried.fit.covariance[a * width + b]);
    }
  }
  RunoutFit fit;
  put_coefficients(m, scatter, fit);
  if (with_runout) {
    put_runout(m, scatter, 1.0, fit);
  }
  what.K_tc = fit.K_tc;
  what.K_rc = fit.K_rc;
  what.correlation = fit.correlation;
  what.eccentricity = fit.eccentricity;
  return what;
}

JointFit model_average(const Given& wall, const Scatter& scatter,
                       std::span<const Tried> tried) {
  JointFit result{.ok = true, .message = {}, .with_runout = wall.runout.ok};
  const Mixture m = mixture_of(wall, tried);
  RunoutFit& fit = result.fit;
  fit = wall.runout;
  put_coefficients(m, scatter, fit);
  if (wall.runout.ok) {
    put_runout(m, scatter, wall.setting.setup.cut.f_z, fit);
  }
  const Tried& likeliest = tried.front();
  fit.datum.clear();
  const std::size_t width = likeliest.fit.own.size();
  for (std::size_t k = 0; k < likeliest.fit.form.size(); ++k) {
    const std::size_t at = likeliest.fit.p.size() + k;
    const double variance = likeliest.fit.covariance[at * width + at];
    fit.datum.push_back(estimate(error_scale * likeliest.fit.form[k],
                                 error_scale * error_scale * variance,
                                 freedom_of(scatter, variance, likeliest.fit.own[at])));
  }
  put_predicted(wall, likeliest, fit);
  for (const Tried& t : tried) {
    result.explanations.push_back(described(t, scatter, wall.runout.ok));
  }
  result.own_scatter = error_scale * std::sqrt(scatter.s2);
  double shared = 0.0;
  for (const double ratio : scatter.ratio) {
    shared += ratio;
  }
  result.shared_scatter = error_scale * std::sqrt(scatter.s2 * shared);
  return result;
}

using Values = std::vector<double>;

/// Below, readings have no scatter: exact ones agree to rounding [um^2].
constexpr double least_variance = 1e-12;

ForwardModel forward_model_of(const Given& wall, const FittedRows& rows,
                              Feedback feedback) {
  return wall.runout.ok ? joint_forward_model(wall.setting, rows.readings, wall.found,
                                              wall.runout, feedback)
                        : nominal_forward_model(wall.setting, wall.found, feedback);
}

/// More chi^2 than the best is hopeless: chances of one in 10^8.
constexpr double hopeless = 40;

/// From the best of several starts, each with the feedback as it is there.
RowFit fit_from_starts(const RowProblem& problem, const ForwardModel& forward) {
  RowFit best;
  for (const Values& start : forward.starts) {
    RowFit fit;
    if (forward.freeze(start)) {
      fit = fit_rows(problem, forward.model, start);
    }
    if (fit.ok && (!best.ok || fit.cost < best.cost)) {
      best = std::move(fit);
    }
  }
  return best;
}

/// The richest form with each feedback: what it leaves shows the scatter.
std::vector<Tried> try_feedbacks(const Given& wall, const FittedRows& rows,
                                 std::span<const Feedback> feedbacks,
                                 const RowProblem& problem) {
  constexpr double beyond_mending = 3 * hopeless;  // a frozen feedback is not far off
  std::vector<Tried> tried;
  double least = std::numeric_limits<double>::infinity();
  for (const Feedback feedback : feedbacks) {
    Tried one{.what = {.feedback = feedback},
              .forward = forward_model_of(wall, rows, feedback)};
    one.fit = fit_from_starts(problem, one.forward);
    if (!one.fit.ok || one.fit.cost > least + beyond_mending) {
      continue;
    }
    one.fit = fit_rebased(problem, one.forward, one.fit.p);
    if (one.fit.ok) {
      least = std::min(least, one.fit.cost);
      tried.push_back(std::move(one));
    }
  }
  return tried;
}

const Tried& cheapest(std::span<const Tried> tried) {
  return *std::min_element(
      tried.begin(), tried.end(),
      [](const Tried& a, const Tried& b) { return a.fit.cost < b.fit.cost; });
}

/// Forms below what is stated of every file are no choice.
int least_form(std::span<const Datum> datum) {
  Form least = Form::curvature;
  for (const Datum& d : datum) {
    const Form stated = d.tilt ? Form::tilt : d.offset ? Form::offset : Form::none;
    least = d.decide ? std::min(least, stated) : least;
  }
  return static_cast<int>(least);
}

Scatter scatter_after(const Given& wall, const FittedRows& rows,
                      const RowProblem& problem, const RowFit& fit, bool shared) {
  Values prior(fit.p.size());
  for (const double p : problem.prior) {
    prior.push_back(p * problem.scatter.s2);
  }
  const force::Setup& setup = wall.setting.setup;
  Scatter scatter = estimate_scatter(
      {fit.columns, prior.size() + 1, rows.count}, prior,
      shared ? sharing_of(rows.readings, setup.cutter.teeth() * setup.cut.f_z)
             : std::vector<Sharing>{},
      rows.within, rows.independent);
  scatter.s2 = std::max(scatter.s2, least_variance);
  return scatter;
}

/// Without the models that are beyond hope, the cheapest first.
void drop_hopeless(std::vector<Tried>& tried) {
  const double least = cheapest(tried).fit.cost;
  std::erase_if(tried, [&](const Tried& t) { return t.fit.cost > least + hopeless; });
  std::ranges::stable_sort(tried, {}, [](const Tried& t) { return t.fit.cost; });
}

/// Settled, and with more care where it may count among those tried: less evidence by so
/// much is a chance of one in 10^5.
RowFit fit_among(const RowProblem& problem, const ForwardModel& forward,
                 const Values& start, double& most_evidence) {
  constexpr double beyond_hope = 12.0;
  if (forward.rebase(start) < 0) {
    return {};
  }
  RowFit fit = fit_rows(problem, forward.model, start);
  if (!fit.ok || fit.evidence < most_evidence - 2 * beyond_hope) {
    return fit;
  }
  fit = fit_rebased(problem, forward, fit.p);
  if (!fit.ok || fit.evidence < most_evidence - beyond_hope) {
    return fit;
  }
  if (forward.values) {
    fit = fit_along_errors(problem, forward.values, std::move(fit));
  }
  most_evidence = std::max(most_evidence, fit.evidence);
  return fit;
}

/// Of all readings, what they scatter about their means included [m].
double rms_of(const FittedRows& rows, const RowFit& fit) {
  double sum = rows.within;
  for (std::size_t i = 0; i < fit.residual.size(); ++i) {
    sum += rows.count[i] * fit.residual[i] * fit.residual[i];
  }
  double readings = 0.0;
  for (const double n : rows.count) {
    readings += n;
  }
  return error_scale * std::sqrt(sum / readings);
}

void set_weights(std::vector<Tried>& tried) {
  double most = -std::numeric_limits<double>::infinity();
  double sum = 0.0;
  for (const Tried& t : tried) {
    most = std::max(most, t.fit.evidence);
  }
  for (Tried& t : tried) {
    t.what.weight = std::exp(t.fit.evidence - most);
    sum += t.what.weight;
  }
  for (Tried& t : tried) {
    t.what.weight /= sum;
  }
  std::stable_sort(tried.begin(), tried.end(), [](const Tried& a, const Tried& b) {
    return a.what.weight > b.what.weight;
  });
}

}  // namespace

JointFit fit_jointly(const Setting& setting, std::span<const Reading> readings,
                     std::span<const Datum> datum, const FitOptions& options,
                     const StatedFits& stated) {
  const ModelFits& found = stated.models;
  const RunoutFit& runout = stated.runout;
  const Given wall{setting, readings, datum, found, runout};
  const FittedRows rows = runout.ok ? folded_rows(setting, readings, found)
                                    : mean_rows(found.nominal, readings.size());
  std::vector<Feedback> feedbacks = {options.feedback.value_or(Feedback::none)};
  if (!options.feedback) {
    feedbacks.push_back(Feedback::regenerative);
  }
  const bool decide =
      std::any_of(datum.begin(), datum.end(), [](const Datum& d) { return d.decide; });
  const Form richest = decide ? Form::curvature : Form::none;
  RowProblem problem{
      .error = rows.error, .count = rows.count, .independent = rows.independent};
  const double rms = (runout.ok ? runout.rms : chosen_fit(found).rms) / error_scale;
  problem.scatter.s2 = std::max(rms * rms, least_variance);
  DatumColumns form_columns = add_form(rows, datum, richest, problem);
  std::vector<Tried> tried = try_feedbacks(wall, rows, feedbacks, problem);
  if (tried.empty()) {
    return {.message = "no fit of all readings settled"};
  }
  drop_hopeless(tried);
  problem.scatter =
      scatter_after(wall, rows, problem, cheapest(tried).fit, options.shared);
  const std::size_t models = tried.size();
  double most_evidence = -std::numeric_limits<double>::infinity();
  for (std::size_t w = 0; w < models; ++w) {
    RowFit again = fit_among(problem, tried[w].forward, tried[w].fit.p, most_evidence);
    if (again.ok) {  // else the first one stays
      tried[w].fit = std::move(again);
    }
    tried[w].what.form = richest;
    tried[w].form = form_columns;
  }
  for (int form = static_cast<int>(richest) - 1; form >= least_form(datum); --form) {
    form_columns = add_form(rows, datum, static_cast<Form>(form), problem);
    for (std::size_t w = 0; w < models; ++w) {
      Tried one{
          .what = {.feedback = tried[w].what.feedback, .form = static_cast<Form>(form)},
          .forward = tried[w].forward,
          .form = form_columns};
      one.fit = fit_among(problem, one.forward, tried[w].fit.p, most_evidence);
      tried.push_back(std::move(one));
    }
  }
  std::erase_if(tried, [](const Tried& t) { return !t.fit.ok; });
  if (tried.empty()) {
    return {.message = "no fit of all readings settled"};
  }
  for (Tried& t : tried) {
    t.what.rms = rms_of(rows, t.fit);
  }
  set_weights(tried);
  return model_average(wall, problem.scatter, tried);
}

}  // namespace trochoid::surface
