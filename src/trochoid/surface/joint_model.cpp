#include <trochoid/surface/joint_model.h>

#include <algorithm>
#include <cmath>

namespace trochoid::surface {

namespace {

constexpr double MN_m2 = 1e8;  // scale of coefficients

/// Steps for differences of e_0, wide enough to reach over the kinks that the readings
/// blur, and wider ones for D, which is known to the tolerance of its steady state only.
struct Steps {
  double runout;
  double start;
  double K;

  [[nodiscard]] double of(std::size_t k, std::size_t unknowns) const {
    return k < 2 ? runout : k + 2 >= unknowns ? K : start;
  }
};
constexpr Steps fine = {0.05, 0.01, 0.02};
/// Beyond, slopes of D are found anew: a micrometre, or 100 MPa.
constexpr double far_off = 1.0;
constexpr Steps wide = {0.3, 0.02, 0.2};
/// Within, slopes of e_0 stay as they are.
constexpr Steps close_by = {0.4, 0.05, 0.4};

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

JointModel::BothForces JointModel::both(const JointState& s) const {
  return {coarse_.forces_with(feedback_, s.runout, s.K), coarse_.forces(s.runout)};
}

std::vector<double> JointModel::change(const JointState& s,
                                       const BothForces& forces) const {
  if (!forces.bent.found) {
    return {};
  }
  std::vector<double> D = coarse_.predict(forces.bent, s.K, s.runout, s.start);
  const auto straight = coarse_.predict(forces.straight, s.K, s.runout, s.start);
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
      std::vector<double> q(p.begin(), p.end());
      const double step = wide.of(k, n);
      q[k] += step;
      const JointState near = unpack(q);
      const bool same_cut = has_start() && k == 2;
      const std::vector<double> there = change(near, same_cut ? forces : both(near));
      for (std::size_t i = 0; i < there.size(); ++i) {
        slopes_[i * n + k] = (there[i] - here[i]) / step;
      }
    }
  }
  base_.assign(p.begin(), p.end());
  change_ = here;
  return std::sqrt(moved / static_cast<double>(here.size()));
}

/// Slopes of e_0 [units of scale], found anew where the last ones were found far off.
const std::vector<double>& JointModel::stiff_slopes(std::span<const double> p,
                                                    std::span<const double> f,
                                                    const ToothModel::Forces& forces) {
  const std::size_t n = p.size();
  bool near = !stiff_at_.empty();
  for (std::size_t k = 0; near && k < n; ++k) {
    near = std::abs(p[k] - stiff_at_[k]) <= close_by.of(k, n);
  }
  if (near) {
    return stiff_slopes_;
  }
  stiff_at_.assign(p.begin(), p.end());
  stiff_slopes_.resize(f.size() * n);
  std::vector<double> q = stiff_at_;
  for (std::size_t k = 0; k < n; ++k) {
    const double step = fine.of(k, n);
    q[k] = p[k] + step;
    const JointState s = unpack(q);
    const auto moved = model_.predict(k < 2 ? model_.forces(s.runout) : forces, s.K,
                                      s.runout, s.start);
    q[k] = p[k];
    for (std::size_t i = 0; i < moved.size(); ++i) {
      stiff_slopes_[i * n + k] = (moved[i] - f[i]) / step / scale;
    }
  }
  return stiff_slopes_;
}

Linearised JointModel::at(std::span<const double> p) {
  const std::size_t n = p.size();
  const JointState here = unpack(p);
  const ToothModel::Forces forces = model_.forces(here.runout);
  Linearised out{.f = model_.predict(forces, here.K, here.runout, here.start)};
  out.J = stiff_slopes(p, out.f, forces);
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
  std::vector<double> e = all.model_.predict(all.model_.forces(state.runout), state.K,
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
