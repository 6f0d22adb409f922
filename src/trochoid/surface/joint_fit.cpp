#include <trochoid/surface/joint_fit.h>

#include <trochoid/surface/mixture.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace trochoid::surface {

namespace {

using Values = std::vector<double>;

constexpr double um = 1e-6;
/// Below, readings have no scatter: exact ones agree to rounding [um^2].
constexpr double least_variance = 1e-12;

Way way_of(const Given& wall, const FittedRows& rows, Feedback feedback) {
  return wall.runout.ok
             ? joint_way(wall.setting, rows.readings, wall.found, wall.runout, feedback)
             : nominal_way(wall.setting, wall.found, feedback);
}

/// The richest form with each feedback: what it leaves shows the scatter.
std::vector<Tried> try_feedbacks(const Given& wall, const FittedRows& rows,
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

/// Without the ways that are beyond hope, the cheapest first.
void drop_hopeless(std::vector<Tried>& tried) {
  constexpr double hopeless = 40;  // chances of one in 10^8
  const double least = cheapest(tried).fit.cost;
  std::erase_if(tried, [&](const Tried& t) { return t.fit.cost > least + hopeless; });
  std::ranges::stable_sort(tried, {}, [](const Tried& t) { return t.fit.cost; });
}

/// Settled, and once more with more care where it may count among those tried: less
/// evidence by so much is a chance of one in 10^5.
RowFit settle_among(const RowProblem& problem, const Way& way, const Values& start,
                    double& most_evidence) {
  constexpr double beyond_hope = 12.0;
  RowFit fit = settle(problem, way, start);
  if (!fit.ok || fit.evidence < most_evidence - beyond_hope) {
    return fit;
  }
  fit = settle_twice(problem, way, std::move(fit));
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
  return um * std::sqrt(sum / readings);
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
  double most_evidence = -std::numeric_limits<double>::infinity();
  for (std::size_t w = 0; w < ways; ++w) {
    RowFit again = settle_among(problem, tried[w].way, tried[w].fit.p, most_evidence);
    if (again.ok) {  // else the first one stays
      tried[w].fit = std::move(again);
    }
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
      one.fit = settle_among(problem, one.way, tried[w].fit.p, most_evidence);
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
  return together(wall, problem.scatter, tried);
}

}  // namespace trochoid::surface
