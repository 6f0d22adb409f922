#include <trochoid/surface/joint_fit.h>

#include <trochoid/base/units.h>
#include <trochoid/numerics/student.h>
#include <trochoid/surface/bent_start.h>
#include <trochoid/surface/folded_readings.h>
#include <trochoid/surface/joint_model.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace trochoid::surface {

namespace {

using Values = std::vector<double>;

constexpr double um = JointModel::scale;
constexpr double MN_m2 = 1e8;
constexpr std::size_t coarse_stations = 3;
/// Below, readings have no scatter: exact ones agree to rounding [um^2].
constexpr double least_variance = 1e-12;

/// What is fitted, row by row: folded readings, or means where runout is not fitted.
struct Fitted {
  std::vector<Reading> readings;
  Values error;  ///< [um]
  Values count;
  std::vector<std::size_t> of;  ///< which row a reading is in
  std::vector<Spot> spots;      ///< of every reading
  double within = 0.0;          ///< sum of squares about the means [um^2]
};

/// A way from unknowns to what the rows should be.
struct Way {
  RowModel model;
  std::function<double(std::span<const double>)> rebase;  ///< as of JointModel
  std::function<Values(std::span<const Reading>, std::span<const double>)> predict;
  std::vector<Values> starts;
};

/// One explanation as it was fitted.
struct Tried {
  Explanation what;
  Way way;
  DatumColumns form;  ///< of every reading
  RowFit fit;
};

std::vector<Datum> with_form(std::span<const Datum> datum, Form form) {
  std::vector<Datum> out(datum.begin(), datum.end());
  for (Datum& d : out) {
    d = decided(d, form);
  }
  return out;
}

/// Columns of the form, and what is known of them beforehand where they are decided on.
/// @return the columns of every reading
DatumColumns add_form(const Fitted& rows, std::span<const Datum> datum, Form form,
                      RowProblem& problem) {
  DatumColumns all = datum_columns(rows.spots, with_form(datum, form));
  const std::size_t n = all.count;
  problem.form = {n, Values(rows.error.size() * n), all.parts};
  Values readings(rows.error.size());
  for (const std::size_t row : rows.of) {
    readings[row] += 1.0;
  }
  for (std::size_t i = 0; i < rows.of.size(); ++i) {
    for (std::size_t k = 0; k < n; ++k) {
      problem.form.values[rows.of[i] * n + k] +=
          all.values[i * n + k] / readings[rows.of[i]];
    }
  }
  problem.prior.clear();
  for (const DatumPart& part : all.parts) {
    using Kind = DatumPart::Kind;
    const Datum& asked = datum[part.set];
    const bool open = !asked.decide || part.kind == Kind::lean ||
                      (part.kind == Kind::offset && asked.offset) ||
                      (part.kind == Kind::tilt && asked.tilt);
    const double usual = part.kind == Kind::offset ? usual_offset : usual_form;
    problem.prior.push_back(open ? 0.0 : std::pow(part.largest * um / usual, 2));
  }
  return all;
}

/// A reading lies where the mean that it belongs to does.
std::vector<Spot> spots_of(std::span<const Nominal> nominal, std::size_t readings) {
  std::vector<Spot> spots(readings);
  for (const Nominal& n : nominal) {
    for (const std::size_t i : n.readings) {
      spots[i] = {n.x, n.height, n.set};
    }
  }
  return spots;
}

void add_row(const Reading& reading, double count, Fitted& rows) {
  rows.readings.push_back(reading);
  rows.error.push_back(reading.error / um);
  rows.count.push_back(count);
}

Fitted fold(const Setting& setting, std::span<const Reading> readings,
            const ModelFits& found) {
  const ToothModel model(setting, readings, found.stations);
  FoldedReadings folded = fold_readings(setting, readings, model);
  Fitted rows{.spots = spots_of(found.nominal, readings.size())};
  for (std::size_t i = 0; i < folded.means.size(); ++i) {
    add_row(folded.means[i], folded.count[i], rows);
  }
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const double apart = (readings[i].error - folded.means[folded.of[i]].error) / um;
    rows.within += apart * apart;
  }
  rows.of = std::move(folded.of);
  return rows;
}

Fitted means_of(std::span<const Nominal> nominal, std::size_t readings) {
  Fitted rows{.of = std::vector<std::size_t>(readings),
              .spots = spots_of(nominal, readings)};
  for (const Nominal& n : nominal) {
    for (const std::size_t i : n.readings) {
      rows.of[i] = rows.readings.size();
    }
    add_row({.x = n.x,
             .travel = n.travel,
             .height = n.height,
             .error = n.error,
             .set = n.set},
            static_cast<double>(n.readings.size()), rows);
  }
  return rows;
}

JointState state_of(const Setting& setting, const RunoutFit& runout) {
  JointState state{.runout = {runout.eccentricity.value * std::cos(runout.angle.value),
                              runout.eccentricity.value * std::sin(runout.angle.value)},
                   .start = runout.start.value,
                   .K = wall_coefficients(setting.law)};
  state.K[0] = runout.K_tc.value;
  state.K[1] = runout.K_rc.value;
  return state;
}

Way joint_way(const Setting& setting, std::span<const Reading> readings,
              const ModelFits& found, const RunoutFit& runout, Feedback feedback) {
  auto model = std::make_shared<JointModel>(
      setting, readings, found.stations,
      feedback == Feedback::none ? found.stations
                                 : stations_for(setting, readings, coarse_stations),
      feedback);
  const JointState about = state_of(setting, runout);
  std::vector<Values> starts = {model->pack(about)};
  if (feedback != Feedback::none) {  // it may have moved the answer far
    const double size = 2 * std::max(runout.rms_without, runout.eccentricity.value);
    for (const JointState& state :
         bent_starts(setting, readings, feedback, about, size)) {
      starts.push_back(model->pack(state));
    }
  }
  return {[model](std::span<const double> p, std::span<const double> steps) {
            return model->at(p, steps);
          },
          [model](std::span<const double> p) { return model->rebase(p); },
          [model](std::span<const Reading> all, std::span<const double> p) {
            return model->predict(all, p);
          },
          std::move(starts)};
}

/// @param nominal  must live as long as the way
Way nominal_way(const Setting& setting, const ModelFits& found, Feedback feedback) {
  auto model = std::make_shared<NominalModel>(setting, found.nominal, found.stations);
  const CoefficientFit& fit = chosen_fit(found);
  const auto at = [model, feedback, rest = wall_coefficients(setting.law)](
                      std::span<const double> p, std::span<const double>) {
    auto K = rest;
    K[0] = MN_m2 * p[0];
    K[1] = MN_m2 * p[1];
    const Prediction there = feedback == Feedback::none
                                 ? model->rigid(K)
                                 : model->with_feedback(K, feedback);
    Linearised out{.good = there.good};
    for (std::size_t i = 0; i < there.error.size(); ++i) {
      out.f.push_back(there.error[i] / um);
      out.J.push_back(there.per_K[i * columns] * MN_m2 / um);
      out.J.push_back(there.per_K[i * columns + 1] * MN_m2 / um);
    }
    return out;
  };
  const auto predict = [at](std::span<const Reading>, std::span<const double> p) {
    Values e = at(p, {}).f;
    for (double& x : e) {
      x *= um;
    }
    return e;
  };
  return {at,
          [](std::span<const double>) { return 0.0; },
          predict,
          {{fit.K_tc.value / MN_m2, fit.K_rc.value / MN_m2}}};
}

/// Fit, and where the way knows the feedback at one place only, go there and fit again.
RowFit settle(const RowProblem& problem, const Way& way, Values start) {
  constexpr int most_rounds = 6;
  constexpr double negligible = 0.02;  // of the scatter of a reading
  if (way.rebase(start) < 0) {
    return {};
  }
  RowFit fit = fit_rows(problem, way.model, std::move(start));
  for (int k = 0; fit.ok && k < most_rounds; ++k) {
    const double moved = way.rebase(fit.p);
    if (moved < 0) {
      return {};
    }
    if (moved <= negligible * um * std::sqrt(problem.scatter.s2)) {
      break;
    }
    fit = fit_rows(problem, way.model, fit.p);
  }
  return fit;
}

/// Everything that explanations are tried on.
struct Given {
  const Setting& setting;
  std::span<const Reading> readings;
  std::span<const Datum> datum;
  const ModelFits& found;
  const RunoutFit& runout;
};

Way way_of(const Given& wall, const Fitted& rows, Feedback feedback) {
  return wall.runout.ok
             ? joint_way(wall.setting, rows.readings, wall.found, wall.runout, feedback)
             : nominal_way(wall.setting, wall.found, feedback);
}

/// Settled, and again from either side along what is known least: the valley between
/// coefficients and form is long and its floor rough.
RowFit settle_twice(const RowProblem& problem, const Way& way, const Values& start) {
  constexpr double aside = 1.5;  // standard errors of K_tc
  constexpr double gain = 0.3;   // of the cost
  constexpr int most_rounds = 3;
  RowFit best = settle(problem, way, start);
  for (int k = 0; best.ok && k < most_rounds; ++k) {
    const std::size_t n = best.p.size();
    const std::size_t width = best.own.size();
    const std::size_t K_tc = n - 2;
    const double before = best.cost;
    const RowFit from = best;
    for (const double side : {-aside, aside}) {
      Values p = from.p;
      for (std::size_t i = 0; i < n; ++i) {
        p[i] += side * from.covariance[i * width + K_tc] /
                std::sqrt(from.covariance[K_tc * width + K_tc]);
      }
      RowFit fit = settle(problem, way, std::move(p));
      if (fit.ok && fit.cost < best.cost) {
        best = std::move(fit);
      }
    }
    if (before - best.cost < gain) {
      break;
    }
  }
  return best;
}

/// The richest form with each feedback: what it leaves shows the scatter.
std::vector<Tried> try_feedbacks(const Given& wall, const Fitted& rows,
                                 std::span<const Feedback> feedbacks,
                                 const RowProblem& problem) {
  std::vector<Tried> tried;
  for (const Feedback feedback : feedbacks) {
    Tried one{.what = {.feedback = feedback}, .way = way_of(wall, rows, feedback)};
    for (const Values& start : one.way.starts) {
      RowFit fit;
      if (one.way.rebase(start) >= 0) {
        fit = fit_rows(problem, one.way.model, start);
      }
      if (fit.ok && (!one.fit.ok || fit.cost < one.fit.cost)) {
        one.fit = std::move(fit);
      }
    }
    if (one.fit.ok) {
      one.fit = settle(problem, one.way, one.fit.p);
    }
    if (one.fit.ok) {
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

Scatter scatter_after(const Given& wall, const Fitted& rows, const RowProblem& problem,
                      const RowFit& fit, bool shared) {
  Values prior(fit.p.size());
  for (const double p : problem.prior) {
    prior.push_back(p * problem.scatter.s2);
  }
  const force::Setup& setup = wall.setting.setup;
  Scatter scatter = estimate_scatter(
      {fit.columns, prior.size() + 1, rows.count}, prior,
      shared ? sharing_of(rows.readings, setup.cutter.teeth() * setup.cut.f_z)
             : std::vector<Sharing>{},
      rows.within, static_cast<double>(wall.readings.size()));
  scatter.s2 = std::max(scatter.s2, least_variance);
  return scatter;
}

/// Without the ways that are beyond hope.
void drop_hopeless(std::vector<Tried>& tried) {
  constexpr double hopeless = 40;  // chances of one in 10^8
  const double least = cheapest(tried).fit.cost;
  std::erase_if(tried, [&](const Tried& t) { return t.fit.cost > least + hopeless; });
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
  fit.eccentricity = estimate(um * std::sqrt(rho2), um * um * radial, freedom);
  double angle = std::atan2(s, c);
  angle += angle < 0 ? unit::turn : 0.0;
  fit.angle = estimate(angle, across, freedom);
  if (n == 5) {
    fit.start = estimate(f_z * m.mean[2], f_z * f_z * whole(2, 2), freedom);
  }
}

void put_coefficients(const Mixture& m, const Scatter& scatter, RunoutFit& fit) {
  const std::size_t n = m.mean.size();
  const auto put = [&](std::size_t k, Estimate& K) {
    const double variance = m.covariance[k * n + k];
    K = estimate(MN_m2 * m.mean[k], MN_m2 * MN_m2 * variance,
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
  fit.predicted = likeliest.way.predict(wall.readings, likeliest.fit.p);
  const std::size_t n = likeliest.form.count;
  double sum = 0.0;
  for (std::size_t i = 0; i < fit.predicted.size(); ++i) {
    for (std::size_t k = 0; k < n; ++k) {
      fit.predicted[i] += um * likeliest.fit.form[k] * likeliest.form.values[i * n + k];
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
  double sum = 0.0;
  for (const double r : tried.fit.residual) {
    sum += r * r;
  }
  what.rms = um * std::sqrt(sum / static_cast<double>(tried.fit.residual.size()));
  return what;
}

JointFit together(const Given& wall, const Scatter& scatter,
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
    fit.datum.push_back(estimate(um * likeliest.fit.form[k], um * um * variance,
                                 freedom_of(scatter, variance, likeliest.fit.own[at])));
  }
  put_predicted(wall, likeliest, fit);
  for (const Tried& t : tried) {
    result.explanations.push_back(described(t, scatter, wall.runout.ok));
  }
  result.own_scatter = um * std::sqrt(scatter.s2);
  double shared = 0.0;
  for (const double ratio : scatter.ratio) {
    shared += ratio;
  }
  result.shared_scatter = um * std::sqrt(scatter.s2 * shared);
  return result;
}

}  // namespace

JointFit fit_jointly(const Setting& setting, std::span<const Reading> readings,
                     std::span<const Datum> datum, const FitOptions& options,
                     const ModelFits& found, const RunoutFit& runout) {
  const Given wall{setting, readings, datum, found, runout};
  const Fitted rows = runout.ok ? fold(setting, readings, found)
                                : means_of(found.nominal, readings.size());
  std::vector<Feedback> feedbacks = {options.feedback.value_or(Feedback::none)};
  if (!options.feedback) {
    feedbacks.push_back(Feedback::regenerative);
  }
  const bool decide =
      std::any_of(datum.begin(), datum.end(), [](const Datum& d) { return d.decide; });
  const Form richest = decide ? Form::curvature : Form::none;
  RowProblem problem{.error = rows.error, .count = rows.count};
  const double rms = (runout.ok ? runout.rms : chosen_fit(found).rms) / um;
  problem.scatter.s2 = std::max(rms * rms, least_variance);
  DatumColumns form_columns = add_form(rows, datum, richest, problem);
  std::vector<Tried> tried = try_feedbacks(wall, rows, feedbacks, problem);
  if (tried.empty()) {
    return {.message = "no fit of all readings settled"};
  }
  drop_hopeless(tried);
  problem.scatter =
      scatter_after(wall, rows, problem, cheapest(tried).fit, options.shared);
  const std::size_t ways = tried.size();
  for (std::size_t w = 0; w < ways; ++w) {
    tried[w].fit = settle_twice(problem, tried[w].way, tried[w].fit.p);
    tried[w].what.form = richest;
    tried[w].form = form_columns;
  }
  for (int form = static_cast<int>(richest) - 1; form >= least_form(datum); --form) {
    form_columns = add_form(rows, datum, static_cast<Form>(form), problem);
    for (std::size_t w = 0; w < ways; ++w) {
      Tried one{
          .what = {.feedback = tried[w].what.feedback, .form = static_cast<Form>(form)},
          .way = tried[w].way,
          .form = form_columns};
      one.fit = settle_twice(problem, one.way, tried[w].fit.p);
      tried.push_back(std::move(one));
    }
  }
  std::erase_if(tried, [](const Tried& t) { return !t.fit.ok; });
  if (tried.empty()) {
    return {.message = "no fit of all readings settled"};
  }
  set_weights(tried);
  return together(wall, problem.scatter, tried);
}

}  // namespace trochoid::surface
