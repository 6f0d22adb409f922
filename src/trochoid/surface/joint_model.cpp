#include <trochoid/surface/joint_model.h>

#include <algorithm>
#include <cmath>

namespace trochoid::surface {

namespace {

/// Steps of differences: to begin with, at least, and at most; wide for D as well, which
/// is known to the tolerance of its steady state only.
struct Steps {
  double runout;
  double start;
  double K;

  [[nodiscard]] double of(std::size_t k, std::size_t unknowns) const {
    return k < 2 ? runout : k + 2 >= unknowns ? K : start;
  }
};
constexpr Steps fine = {0.05, 0.01, 0.02};
/// Forces and slopes that are kept for the next time.
constexpr std::size_t most_known = 12;
/// Beyond, slopes of D are found anew: a micrometre, or 100 MPa.
constexpr double far_from_base = 1.0;
constexpr Steps wide = {0.3, 0.05, 0.3};
constexpr Steps of_change = {0.5, 0.05, 0.5};
constexpr Steps least = {1e-3, 1e-3, 1e-3};

}  // namespace

JointModel::JointModel(const Setting& setting, std::span<const Reading> readings,
                       std::shared_ptr<const Stations> stations,
                       std::shared_ptr<const Stations> coarse, Feedback feedback)
    : setting_(setting),
      stations_(stations),
      coarse_stations_(coarse),
      feedback_(feedback),
      model_(setting, readings, std::move(stations)),
      coarse_(setting, readings, std::move(coarse)) {}

std::vector<double> JointModel::pack(const JointState& state) const {
  std::vector<double> p = {state.runout.c / error_scale, state.runout.s / error_scale};
  if (has_start()) {
    p.push_back(state.start / setting_.setup.cut.f_z);
  }
  p.push_back(state.K[0] / coefficient_scale);
  p.push_back(state.K[1] / coefficient_scale);
  return p;
}

JointState JointModel::unpack(std::span<const double> p) const {
  JointState state{.runout = {error_scale * p[0], error_scale * p[1]},
                   .K = wall_coefficients(setting_.law)};
  if (has_start()) {
    state.start = p[2] * setting_.setup.cut.f_z;
  }
  state.K[0] = coefficient_scale * p[p.size() - 2];
  state.K[1] = coefficient_scale * p[p.size() - 1];
  return state;
}

std::shared_ptr<const ToothModel::Forces> JointModel::forces_of(
    RunoutVector runout) const {
  for (const auto& known : known_) {
    if (known->runout.c == runout.c && known->runout.s == runout.s) {
      return known;
    }
  }
  if (known_.size() == most_known) {
    known_.erase(known_.begin());
  }
  known_.push_back(std::make_shared<ToothModel::Forces>(model_.forces(runout)));
  return known_.back();
}

JointModel::BothForces JointModel::both(const JointState& s) const {
  const auto straight = forces_of(s.runout);
  BothForces forces{coarse_.forces_with(feedback_, *straight, s.K,
                                        last_.turns.empty() ? nullptr : &last_),
                    straight};
  if (forces.bent.found) {
    last_ = forces.bent;
  }
  return forces;
}

std::vector<double> JointModel::change(const JointState& s,
                                       const BothForces& forces) const {
  if (!forces.bent.found) {
    return {};
  }
  std::vector<double> D = coarse_.predict(forces.bent, s.K, s.runout, s.start);
  const auto straight = coarse_.predict(*forces.straight, s.K, s.runout, s.start);
  std::transform(D.begin(), D.end(), straight.begin(), D.begin(), std::minus<>());
  return D;
}

std::vector<double> JointModel::said(std::span<const double> p) const {
  std::vector<double> D = change_;
  for (std::size_t i = 0; i < D.size(); ++i) {
    for (std::size_t k = 0; k < p.size(); ++k) {
      D[i] += slopes_[i * p.size() + k] * (p[k] - base_[k]);
    }
  }
  return D;
}

double JointModel::rebase(std::span<const double> p) {
  if (feedback_ == Feedback::none) {
    return 0.0;
  }
  const BothForces forces = both(unpack(p));
  const std::vector<double> here = change(unpack(p), forces);
  if (here.empty()) {
    return -1.0;
  }
  double moved = 0.0;
  const std::vector<double> before =
      base_.empty() ? std::vector<double>(here.size()) : said(p);
  for (std::size_t i = 0; i < here.size(); ++i) {
    moved += (here[i] - before[i]) * (here[i] - before[i]);
  }
  base_.assign(p.begin(), p.end());
  change_ = here;
  slopes_ = slopes_of_change(p, forces).values;
  return std::sqrt(moved / static_cast<double>(here.size()));
}

bool JointModel::freeze(std::span<const double> p) {
  if (feedback_ == Feedback::none) {
    return true;
  }
  std::vector<double> here = change(unpack(p), both(unpack(p)));
  if (here.empty()) {
    return false;
  }
  base_.assign(p.begin(), p.end());
  slopes_.assign(here.size() * p.size(), 0.0);
  change_ = std::move(here);
  return true;
}

void JointModel::set_column(std::size_t k, std::span<const double> above,
                            std::span<const double> below, Slopes& slopes) {
  const std::size_t n = slopes.at.size();
  const std::size_t rows = std::min(above.size(), below.size());
  slopes.values.resize(std::max(slopes.values.size(), rows * n));
  for (std::size_t i = 0; i < rows; ++i) {
    slopes.values[i * n + k] = (above[i] - below[i]) / (2 * slopes.steps[k]);
  }
}

const JointModel::Slopes& JointModel::keep(Slopes found, std::vector<Slopes>& known) {
  if (known.size() == most_known) {
    known.erase(known.begin());
  }
  known.push_back(std::move(found));
  return known.back();
}

const JointModel::Slopes& JointModel::slopes_of_change(std::span<const double> p,
                                                       const BothForces& forces) {
  const std::size_t n = p.size();
  for (const Slopes& known : slopes_of_change_) {
    double far = 0.0;
    for (std::size_t k = 0; k < n; ++k) {
      far = std::max(far, std::abs(p[k] - known.at[k]));
    }
    if (far <= far_from_base) {
      return known;
    }
  }
  // Zero where no steady state is found on both sides.
  Slopes found{.at = {p.begin(), p.end()},
               .values = std::vector<double>(change_.size() * n)};
  for (std::size_t k = 0; k < n; ++k) {
    found.steps.push_back(of_change.of(k, n));
    const auto there = [&](double by) {
      std::vector<double> q(p.begin(), p.end());
      q[k] += by;
      const JointState state = unpack(q);
      const bool same_cut = has_start() && k == 2;
      return change(state, same_cut ? forces : both(state));
    };
    set_column(k, there(found.steps[k]), there(-found.steps[k]), found);
  }
  return keep(std::move(found), slopes_of_change_);
}

/// Of e_0: found anew where none were found close by with like steps.
const JointModel::Slopes& JointModel::stiff_slopes(std::span<const double> p,
                                                   std::span<const double> steps) {
  const std::size_t n = p.size();
  for (const Slopes& known : stiff_slopes_) {
    bool near = true;
    for (std::size_t k = 0; near && k < n; ++k) {
      near = std::abs(p[k] - known.at[k]) <= 2 * steps[k] &&
             2 * known.steps[k] > steps[k] && known.steps[k] < 2 * steps[k];
    }
    if (near) {
      return known;
    }
  }
  Slopes found{.at = {p.begin(), p.end()}, .steps = {steps.begin(), steps.end()}};
  std::vector<double> q = found.at;
  const auto predicted = [&](std::size_t k, double by) {
    q[k] = p[k] + by;
    const JointState s = unpack(q);
    q[k] = p[k];
    return model_.predict(*forces_of(s.runout), s.K, s.runout, s.start);
  };
  for (std::size_t k = 0; k < n; ++k) {
    set_column(k, predicted(k, steps[k]), predicted(k, -steps[k]), found);
  }
  return keep(std::move(found), stiff_slopes_);
}

Linearised JointModel::at(std::span<const double> p, std::span<const double> steps) {
  const JointState here = unpack(p);
  Linearised out{
      .f = model_.predict(*forces_of(here.runout), here.K, here.runout, here.start)};
  if (!base_.empty()) {
    const std::vector<double> D = said(p);
    std::transform(out.f.begin(), out.f.end(), D.begin(), out.f.begin(), std::plus<>());
  }
  for (double& f : out.f) {
    f /= error_scale;
  }
  out.slopes = [this, at = std::vector<double>(p.begin(), p.end()),
                with = std::vector<double>(steps.begin(), steps.end())] {
    return slopes_at(at, with);
  };
  return out;
}

std::vector<double> JointModel::exact(std::span<const double> p) const {
  const JointState here = unpack(p);
  std::vector<double> f =
      model_.predict(*forces_of(here.runout), here.K, here.runout, here.start);
  if (feedback_ != Feedback::none) {
    const std::vector<double> D = change(here, both(here));
    if (D.empty()) {
      return {};
    }
    std::transform(f.begin(), f.end(), D.begin(), f.begin(), std::plus<>());
  }
  for (double& e : f) {
    e /= error_scale;
  }
  return f;
}

std::vector<double> JointModel::slopes_at(std::span<const double> p,
                                          std::span<const double> steps) {
  const std::size_t n = p.size();
  std::vector<double> own(n);
  for (std::size_t k = 0; k < n; ++k) {
    own[k] = steps.empty() ? fine.of(k, n)
                           : std::clamp(steps[k], least.of(k, n), wide.of(k, n));
  }
  std::vector<double> J = stiff_slopes(p, own).values;
  if (!base_.empty()) {
    std::transform(J.begin(), J.end(), slopes_.begin(), J.begin(), std::plus<>());
  }
  for (double& slope : J) {
    slope /= error_scale;
  }
  return J;
}

std::vector<double> JointModel::predict(std::span<const Reading> readings,
                                        std::span<const double> p) const {
  JointModel all(setting_, readings, stations_, coarse_stations_, feedback_);
  const JointState state = unpack(p);
  std::vector<double> e = all.model_.predict(*all.forces_of(state.runout), state.K,
                                             state.runout, state.start);
  if (feedback_ != Feedback::none) {
    const std::vector<double> D = all.change(state, all.both(state));
    for (std::size_t i = 0; i < D.size(); ++i) {
      e[i] += D[i];
    }
  }
  return e;
}

}  // namespace trochoid::surface
