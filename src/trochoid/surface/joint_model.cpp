#include <trochoid/surface/joint_model.h>

#include <algorithm>
#include <cmath>

namespace trochoid::surface {

namespace {

constexpr double MN_m2 = 1e8;  // scale of coefficients

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
/// Forces that are kept for the next time.
constexpr std::size_t most_known = 12;
/// Beyond, slopes of D are found anew: a micrometre, or 100 MPa.
constexpr double far_off = 1.0;
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
  std::vector<double> p = {state.runout.c / scale, state.runout.s / scale};
  if (has_start()) {
    p.push_back(state.start / setting_.setup.cut.f_z);
  }
  p.push_back(state.K[0] / MN_m2);
  p.push_back(state.K[1] / MN_m2);
  return p;
}

JointState JointModel::unpack(std::span<const double> p) const {
  JointState state{.runout = {scale * p[0], scale * p[1]},
                   .K = wall_coefficients(setting_.law)};
  if (has_start()) {
    state.start = p[2] * setting_.setup.cut.f_z;
  }
  state.K[0] = MN_m2 * p[p.size() - 2];
  state.K[1] = MN_m2 * p[p.size() - 1];
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
  double far = 0.0;
  for (std::size_t k = 0; k < slopes_at_.size(); ++k) {
    far = std::max(far, std::abs(p[k] - slopes_at_[k]));
  }
  if (slopes_.empty() || far > far_off) {
    const std::size_t n = p.size();
    slopes_at_.assign(p.begin(), p.end());
    slopes_.assign(here.size() * n, 0.0);
    for (std::size_t k = 0; k < n; ++k) {
      const double step = of_change.of(k, n);
      const auto there = [&](double by) {
        std::vector<double> q(p.begin(), p.end());
        q[k] += by;
        const JointState state = unpack(q);
        const bool same_cut = has_start() && k == 2;
        return change(state, same_cut ? forces : both(state));
      };
      const std::vector<double> above = there(step);
      const std::vector<double> below = there(-step);
      for (std::size_t i = 0; i < std::min(above.size(), below.size()); ++i) {
        slopes_[i * n + k] = (above[i] - below[i]) / (2 * step);
      }
    }
  }
  base_.assign(p.begin(), p.end());
  change_ = here;
  return std::sqrt(moved / static_cast<double>(here.size()));
}

/// Slopes of e_0 [units of scale], found anew where the last ones were found far off, or
/// with other steps.
const std::vector<double>& JointModel::stiff_slopes(std::span<const double> p,
                                                    std::span<const double> steps) {
  const std::size_t n = p.size();
  bool near = !stiff_at_.empty();
  for (std::size_t k = 0; near && k < n; ++k) {
    const double apart = std::abs(p[k] - stiff_at_[k]);
    near = apart <= 2 * steps[k] && 2 * stiff_steps_[k] > steps[k] &&
           stiff_steps_[k] < 2 * steps[k];
  }
  if (near) {
    return stiff_slopes_;
  }
  stiff_at_.assign(p.begin(), p.end());
  stiff_steps_.assign(steps.begin(), steps.end());
  std::vector<double> q = stiff_at_;
  const auto predicted = [&](std::size_t k, double by) {
    q[k] = p[k] + by;
    const JointState s = unpack(q);
    q[k] = p[k];
    return model_.predict(*forces_of(s.runout), s.K, s.runout, s.start);
  };
  for (std::size_t k = 0; k < n; ++k) {
    const auto above = predicted(k, steps[k]);
    const auto below = predicted(k, -steps[k]);
    stiff_slopes_.resize(above.size() * n);
    for (std::size_t i = 0; i < above.size(); ++i) {
      stiff_slopes_[i * n + k] = (above[i] - below[i]) / (2 * steps[k]) / scale;
    }
  }
  return stiff_slopes_;
}

Linearised JointModel::at(std::span<const double> p, std::span<const double> steps) {
  const std::size_t n = p.size();
  std::vector<double> own(n);
  for (std::size_t k = 0; k < n; ++k) {
    own[k] = steps.empty() ? fine.of(k, n)
                           : std::clamp(steps[k], least.of(k, n), wide.of(k, n));
  }
  const JointState here = unpack(p);
  Linearised out{
      .f = model_.predict(*forces_of(here.runout), here.K, here.runout, here.start)};
  out.J = stiff_slopes(p, own);
  if (!base_.empty()) {
    const std::vector<double> D = said(p);
    for (std::size_t i = 0; i < D.size(); ++i) {
      out.f[i] += D[i];
      for (std::size_t k = 0; k < n; ++k) {
        out.J[i * n + k] += slopes_[i * n + k] / scale;
      }
    }
  }
  for (double& f : out.f) {
    f /= scale;
  }
  return out;
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
