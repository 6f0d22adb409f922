#include <trochoid/surface/plan_wall.h>

#include <trochoid/numerics/least_squares.h>
#include <trochoid/numerics/student.h>
#include <trochoid/surface/calibrate.h>
#include <trochoid/surface/nominal_model.h>
#include <trochoid/surface/tooth_model.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

namespace trochoid::surface {
namespace {

using Values = std::vector<double>;

/// Steps of the differences: of the runout and the start [m], of a coefficient [N/m^2].
constexpr double length_step = 1e-9;
constexpr double coefficient_step = 1e5;
/// Directions known worse than this against the best are not known.
constexpr double rank_tolerance = 1e-7;

RunoutVector expected_runout(const force::Setup& setup) {
  const geometry::Runout& r = setup.runout;
  return {r.eccentricity * std::cos(r.angle), r.eccentricity * std::sin(r.angle)};
}

/// Each reading as a mean of its own.
std::vector<Nominal> as_means(std::span<const Reading> readings) {
  std::vector<Nominal> rows;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    const Reading& r = readings[i];
    rows.push_back({.x = r.x,
                    .travel = r.travel,
                    .height = r.height,
                    .set = r.set,
                    .readings = {i}});
  }
  return rows;
}

/// Of means by K_tc and K_rc, shape (readings, 2).
Values by_means(const WallTrial& trial, std::span<const Reading> readings,
                const std::shared_ptr<const Stations>& stations) {
  const NominalModel model(trial.setting, as_means(readings), stations);
  const auto K = wall_coefficients(trial.setting.law);
  const Prediction at = trial.feedback == Feedback::none
                            ? model.rigid(K)
                            : model.with_feedback(K, trial.feedback);
  if (!at.good) {
    throw std::domain_error("no state was found in which deflection and chip agree");
  }
  Values out;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    out.push_back(at.per_K[i * columns]);
    out.push_back(at.per_K[i * columns + 1]);
  }
  return out;
}

/// What a wall looks like about what is expected, one unknown moved at a time.
struct Moved {
  const ToothModel& model;
  RunoutVector runout;
  double start;
  std::array<double, columns> K;
  ToothModel::Forces forces;
  Values here;

  Moved(const ToothModel& of, const WallTrial& trial)
      : model(of),
        runout(expected_runout(trial.setting.setup)),
        start(trial.start),
        K(wall_coefficients(trial.setting.law)),
        forces(of.forces(runout)),
        here(of.predict(forces, K, runout, start)) {}

  [[nodiscard]] Values difference(Values there, double step) const {
    for (std::size_t i = 0; i < there.size(); ++i) {
      there[i] = (there[i] - here[i]) / step;
    }
    return there;
  }
  [[nodiscard]] Values by_runout(std::size_t component) const {
    RunoutVector to = runout;
    (component == 0 ? to.c : to.s) += length_step;
    return difference(model.predict(model.forces(to), K, to, start), length_step);
  }
  [[nodiscard]] Values by_start() const {
    return difference(model.predict(forces, K, runout, start + length_step),
                      length_step);
  }
  [[nodiscard]] Values by_coefficient(std::size_t which) const {
    auto to = K;
    to[which] += coefficient_step;
    return difference(model.predict(forces, to, runout, start), coefficient_step);
  }
};

/// By rows from columns, and from a pair of each row after them.
Values by_rows(const std::vector<Values>& some, std::span<const double> pairs,
               std::size_t rows) {
  Values out;
  for (std::size_t i = 0; i < rows; ++i) {
    for (const Values& column : some) {
      out.push_back(column[i]);
    }
    if (!pairs.empty()) {
      out.insert(out.end(), {pairs[2 * i], pairs[2 * i + 1]});
    }
  }
  return out;
}

/// E-61, shape (readings) each; of every set its own.
std::vector<Values> form_columns(PlannedForm form, std::span<const Reading> readings) {
  std::vector<Values> out;
  std::size_t sets = 0;
  for (const Reading& r : readings) {
    sets = std::max(sets, r.set + 1);
  }
  for (std::size_t set = 0; set < sets; ++set) {
    double count = 0.0;
    double x = 0.0;
    double height = 0.0;
    for (const Reading& r : readings) {
      if (r.set == set) {
        count += 1.0;
        x += r.travel;
        height += r.height;
      }
    }
    bool along = false;
    const auto add = [&](const auto& value) {
      Values& column = out.emplace_back();
      for (const Reading& r : readings) {
        column.push_back(r.set == set ? value(r) : 0.0);
      }
    };
    for (const Reading& r : readings) {
      along = along || (r.set == set && std::abs(r.travel - x / count) > 1e-9);
    }
    const auto above = [&](const Reading& r) { return (r.height - height / count); };
    if (count == 0.0 || form == PlannedForm::none) {
      continue;
    }
    add([](const Reading&) { return 1.0; });
    if (form != PlannedForm::offset) {
      if (along) {
        add([&](const Reading& r) { return r.travel - x / count; });
      }
      add(above);
    }
    if (form == PlannedForm::curvature) {
      add([&](const Reading& r) { return above(r) * above(r); });
    }
  }
  return out;
}

/// J of E-60: some derivatives of each reading, then the form.
Values design_of(std::span<const double> derivatives, std::size_t count,
                 const PlannedReadings& planned, const std::vector<Values>& form) {
  Values J;
  for (std::size_t i = 0; i < planned.readings.size(); ++i) {
    const auto row = derivatives.subspan(planned.row[i] * count, count);
    J.insert(J.end(), row.begin(), row.end());
    for (const Values& column : form) {
      J.push_back(column[i]);
    }
  }
  return J;
}

/// Covariance of the unknowns over s^2; empty where they are not told apart.
numerics::LeastSquares solved(const Values& J, std::size_t unknowns) {
  const Values nothing(J.size() / unknowns);
  return numerics::least_squares(J, static_cast<int>(unknowns), nothing,
                                 rank_tolerance);
}

/// The coefficients from a covariance in which they stand at `at`.
void take_coefficients(const Values& C, std::size_t n, std::size_t at, double s,
                       WallPrediction& out) {
  const double tt = C[at * n + at];
  const double rr = C[(at + 1) * n + at + 1];
  out.se_K_tc = s * std::sqrt(tt);
  out.se_K_rc = s * std::sqrt(rr);
  out.correlation = C[at * n + at + 1] / std::sqrt(tt * rr);
}

/// Along the expected runout and across it; without any, the worst direction.
void take_runout(const Values& C, std::size_t n, RunoutVector r, double s,
                 WallPrediction& out) {
  const double cc = C[0];
  const double cs = C[1];
  const double ss = C[n + 1];
  const double rho2 = r.c * r.c + r.s * r.s;
  if (rho2 == 0.0) {
    const double middle = (cc + ss) / 2;
    out.se_eccentricity = s * std::sqrt(middle + std::hypot((cc - ss) / 2, cs));
    return;
  }
  const double along = (r.c * r.c * cc + 2 * r.c * r.s * cs + r.s * r.s * ss) / rho2;
  const double across = (r.s * r.s * cc - 2 * r.c * r.s * cs + r.c * r.c * ss) / rho2;
  out.se_eccentricity = s * std::sqrt(std::max(along, 0.0));
  out.se_angle = s * std::sqrt(std::max(across, 0.0) / rho2);
}

}  // namespace

ReadingDerivatives derivatives_of(const WallTrial& trial,
                                  std::span<const Reading> readings) {
  const auto stations = NominalModel::stations_for(trial.setting, as_means(readings));
  const ToothModel model(trial.setting, readings, stations);
  ReadingDerivatives out{.means = by_means(trial, readings, stations),
                         .why_no_runout = model.why_no_runout()};
  if (!out.why_no_runout.empty()) {
    return out;
  }
  const Moved moved(model, trial);
  std::vector<Values> some = {moved.by_runout(0), moved.by_runout(1)};
  if (model.has_phase() && trial.setting.setup.runout.eccentricity > 0.0) {
    some.push_back(moved.by_start());
  }
  out.of_runout = some.size();
  if (trial.feedback != Feedback::none) {
    out.single = by_rows(some, out.means, readings.size());
    return out;
  }
  some.push_back(moved.by_coefficient(0));
  some.push_back(moved.by_coefficient(1));
  out.single = by_rows(some, {}, readings.size());
  return out;
}

WallPrediction prediction_of(const WallTrial& trial, const ReadingDerivatives& all,
                             const PlannedReadings& planned) {
  const std::vector<Values> form = form_columns(trial.form, planned.readings);
  const std::size_t n = 2 + form.size();
  const std::size_t whole = n + all.of_runout;
  WallPrediction out;
  if (planned.readings.size() <= whole) {
    return out;
  }
  out.factor = numerics::student_t(
      0.975, static_cast<double>(planned.readings.size()) - static_cast<double>(whole));
  const auto means = solved(design_of(all.means, 2, planned, form), n);
  out.condition = means.condition;
  if (means.inverse_gram.empty() || !(means.condition <= worst_condition)) {
    return out;
  }
  out.told = true;
  take_coefficients(means.inverse_gram, n, 0, trial.noise, out);
  if (all.of_runout == 0) {
    return out;
  }
  const auto joint =
      solved(design_of(all.single, 2 + all.of_runout, planned, form), whole);  // E-60
  if (joint.inverse_gram.empty()) {
    return out;
  }
  const RunoutVector runout = expected_runout(trial.setting.setup);
  take_runout(joint.inverse_gram, whole, runout, trial.noise, out);
  // As calibrate chooses its answer.
  const RunoutFit seen{.ok = true,
                       .eccentricity = {.value = std::hypot(runout.c, runout.s),
                                        .se = *out.se_eccentricity}};
  if (trial.setting.model == Model::envelope && trial.feedback == Feedback::none &&
      is_seen(seen)) {
    take_coefficients(joint.inverse_gram, whole, all.of_runout, trial.noise, out);
  }
  return out;
}

namespace {

/// Places in a tooth feed; more readings are laid over more turns.
constexpr int per_tooth = 4;
/// Heights that differ by less are one [m].
constexpr double same_planned_height = 1e-10;

std::vector<double> sorted(std::span<const double> heights) {
  std::vector<double> out(heights.begin(), heights.end());
  std::sort(out.begin(), out.end());
  const auto same = [](double a, double b) { return b - a < same_planned_height; };
  out.erase(std::unique(out.begin(), out.end(), same), out.end());
  return out;
}

}  // namespace

int whole_places(int per_height, int teeth) noexcept {
  const int in_each = (std::max(per_height, 1) + teeth - 1) / teeth;
  const int whole =
      in_each <= 2 ? in_each : per_tooth * ((in_each + per_tooth - 1) / per_tooth);
  return whole * teeth;
}

std::vector<double> heights_of(const WallDesign& design, double a_p) {
  std::vector<double> out;
  for (int i = 0; i < design.heights; ++i) {
    const double share = design.heights > 1 ? i / (design.heights - 1.0) - 0.5 : 0.0;
    out.push_back(a_p * (0.5 + design.spread * share));
  }
  return out;
}

WallCatalogue::WallCatalogue(const WallTrial& trial, std::span<const double> heights,
                             double position)
    : trial_(trial), heights_(sorted(heights)) {
  const double f_z = trial.setting.setup.cut.f_z;
  const bool numbered = trial.setting.model == Model::imprint;
  for (const double height : heights_) {
    for (int k = 0; k < trial.setting.setup.cutter.teeth(); ++k) {
      for (int p = 0; p < per_tooth; ++p) {
        const double within = numbered ? 0.0 : (p + 0.5) / per_tooth;
        rows_.push_back({.x = position,
                         .travel = position + f_z * (k + within),
                         .height = height,
                         .tooth = numbered ? k : -1});
      }
    }
  }
  derivatives_ = derivatives_of(trial, rows_);
}

std::size_t WallCatalogue::place_of(double height) const {
  const auto at =
      std::lower_bound(heights_.begin(), heights_.end(), height - same_planned_height);
  if (at == heights_.end() || std::abs(*at - height) > 2 * same_planned_height) {
    throw std::invalid_argument("a height that is not in the catalogue");
  }
  return static_cast<std::size_t>(at - heights_.begin());
}

void WallCatalogue::add(std::size_t height, int in_each, int turn,
                        PlannedReadings& out) const {
  const force::Setup& setup = trial_.setting.setup;
  const int teeth = setup.cutter.teeth();
  const int places = teeth * per_tooth;
  for (int i = 0; i < teeth * in_each; ++i) {
    // One, two half a tooth feed apart, or all.
    const int stride = per_tooth / in_each;
    const int place = i * stride + stride / 2 - (in_each == per_tooth ? 0 : 1);
    const auto row =
        height * static_cast<std::size_t>(places) + static_cast<std::size_t>(place);
    Reading reading = rows_[row];
    reading.travel += turn * teeth * setup.cut.f_z;
    out.readings.push_back(reading);
    out.row.push_back(row);
  }
}

PlannedReadings WallCatalogue::readings_of(const WallDesign& design) const {
  const int teeth = trial_.setting.setup.cutter.teeth();
  const int in_each = whole_places(design.per_height, teeth) / teeth;
  PlannedReadings out;
  for (const double height : heights_of(design, trial_.setting.setup.cut.a_p)) {
    const std::size_t at = place_of(height);
    for (int left = in_each, turn = 0; left > 0; left -= per_tooth, ++turn) {
      add(at, std::min(left, per_tooth), turn, out);
    }
  }
  return out;
}

PlannedReadings WallCatalogue::readings_at(double height, int count) const {
  const std::size_t at = place_of(height);
  const int places = trial_.setting.setup.cutter.teeth() * per_tooth;
  PlannedReadings out;
  for (int i = 0; i < count; ++i) {
    const auto row = at * static_cast<std::size_t>(places) +
                     static_cast<std::size_t>(i * places / count % places);
    out.readings.push_back(rows_[row]);
    out.row.push_back(row);
  }
  return out;
}

WallPrediction WallCatalogue::predict(const PlannedReadings& planned) const {
  return prediction_of(trial_, derivatives_, planned);
}

}  // namespace trochoid::surface
