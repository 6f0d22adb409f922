#include <trochoid/correction/rigid_cut.h>

#include <trochoid/base/units.h>
#include <trochoid/force/forces.h>
#include <trochoid/geometry/edge.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace trochoid::correction {

namespace {

double wrapped(double angle) noexcept {
  return angle - unit::turn * std::floor(angle / unit::turn);
}

void check(const force::Setup& setup, const force::Law& law, int slices) {
  const geometry::Profile& p = setup.cutter.profile;
  if (p.R != 0 || p.alpha != 0 || p.beta != 0) {
    throw std::invalid_argument("the cutter is no cylinder");
  }
  if (setup.cutter.teeth() < 1 || slices < 1) {
    throw std::invalid_argument("a cut has at least one tooth and one slice");
  }
  if (!(setup.cut.a_p >= 0) || !(setup.cut.f_z >= 0)) {
    throw std::invalid_argument("depth and feed must not be negative");
  }
  const auto& rho = setup.runout.radial_offsets;
  if (!std::all_of(rho.begin(), rho.end(), [](double r) { return std::isfinite(r); })) {
    throw std::invalid_argument("a radial offset is no number");
  }
  const auto& m = force::form(law).m;
  if (!(*std::max_element(m.begin(), m.end()) < 1)) {
    throw std::invalid_argument("an exponent of the power law is 1 or more");
  }
}

}  // namespace

RigidCut::RigidCut(const force::Setup& setup, const force::Law& law, int slices)
    : law_(force::terms(law)),
      D_(setup.cutter.profile.D),
      passage_(chip::passage(setup.cutter, setup.cut, setup.chip)),
      psi_(geometry::tooth_angles(setup.cutter)),
      pitch_(setup.cutter.pitch),
      arc_(chip::tooth_arc(setup.cut.engagement, D_, D_ / 2)) {
  check(setup, law, slices);
  const geometry::Profile& p = setup.cutter.profile;
  const geometry::Meridian meridian = geometry::meridian(p);
  const double width = setup.cut.a_p / slices;
  const geometry::Runout runout = force::runout_of(setup);
  for (int i = 0; i < slices; ++i) {
    const double s = geometry::arc_length_at(meridian, (i + 0.5) * width);
    const geometry::Lag lag = geometry::lag_at(setup.cutter, meridian, s);
    const geometry::MeridianPoint point = geometry::point_at(meridian, s);
    Disk disk{lag.angle, width, 1.0, {}};
    if (setup.edge_length == force::EdgeLength::true_length) {
      disk.dS = geometry::edge_length_factor(point, lag);
    }
    disk.teeth.resize(psi_.size());
    geometry::edge_positions(runout, psi_, point.r, lag.angle, disk.teeth);
    disks_.push_back(std::move(disk));
  }
}

double RigidCut::feed() const noexcept {
  return passage_.feed * unit::turn;
}

double RigidCut::nominal_chip() const noexcept {
  const double at = std::clamp(unit::turn / 4, arc_.from, arc_.to);
  return feed() / static_cast<double>(psi_.size()) * std::sin(at);
}

int RigidCut::teeth() const noexcept {
  return passage_.teeth;
}

std::vector<double> RigidCut::offsets() const {
  std::vector<double> rho;
  double mean = 0.0;
  for (const geometry::EdgePosition& tooth : disks_.front().teeth) {
    rho.push_back(tooth.R - D_ / 2);
    mean += rho.back() / static_cast<double>(psi_.size());
  }
  for (double& r : rho) {
    r -= mean;
  }
  return rho;
}

RigidCut::Contact RigidCut::contact(const PeriodicMotion& X, const Disk& disk,
                                    std::size_t j, double phi) const {
  const double theta = phi - psi_[j] - disk.lag;
  const double u = wrapped(theta);
  if (!(u > arc_.from && u < arc_.to)) {
    return {};
  }
  const chip::Slice slice{D_ / 2, disk.teeth};
  Contact c{std::numeric_limits<double>::infinity(), 0, 0.0,
            theta + disk.teeth[j].epsilon};
  const double sine = std::sin(c.theta);
  const double now = place_at(X, phi);
  for (int m = 1; m <= passage_.marks; ++m) {
    double h = chip::chip_over_mark(passage_, slice, static_cast<int>(j), theta, m);
    if (m < passage_.teeth) {  // a whole turn ago the table stood as now
      const double back =
          passage_.back[j * psi_.size() + static_cast<std::size_t>(m) - 1];
      h -= (now - place_at(X, phi - back)) * sine;
    }
    if (h < c.h) {
      c.h = h;
      c.mark = m;
    }
  }
  c.margin = c.h;
  if (!(c.h > chip::h_threshold)) {
    c.h = 0.0;
    c.mark = 0;
  }
  return c;
}

void RigidCut::add_force(const Disk& disk, const Contact& c,
                         std::array<double, 3>& F) const noexcept {
  if (c.mark == 0) {
    return;
  }
  const force::ColumnWeights w = force::column_weights(law_.form, c.h, 1.0, disk.dS);
  std::array<double, 3> f{};  // t, r, a
  for (std::size_t q = 0; q < 3; ++q) {
    f[q] = w.cutting[q] * law_.K[q] + w.edge * law_.K_e[q];
    f[q] *= disk.width;
  }
  const double s = std::sin(c.theta);
  const double k = std::cos(c.theta);
  F[0] -= f[0] * k + f[1] * s;
  F[1] += f[0] * s - f[1] * k;
  F[2] -= f[2];
}

RigidCut::TipChip RigidCut::chip(const PeriodicMotion& X, int tooth, double phi) const {
  const Contact c = contact(X, disks_.front(), static_cast<std::size_t>(tooth),
                            phi + disks_.front().lag);
  return {c.h, c.mark, c.margin};
}

std::array<double, 3> RigidCut::force(const PeriodicMotion& X, double phi) const {
  std::array<double, 3> F{};
  for (const Disk& disk : disks_) {
    for (std::size_t j = 0; j < psi_.size(); ++j) {
      add_force(disk, contact(X, disk, j, phi), F);
    }
  }
  return F;
}

std::size_t RigidCut::turn_of(double phi) const noexcept {
  const double middle = (arc_.from + arc_.to) / 2;
  for (std::size_t j = 0; j < psi_.size(); ++j) {
    const double before = pitch_[(j + psi_.size() - 1) % psi_.size()];
    const double since = wrapped(phi - psi_[j] - middle + before / 2);
    if (since < (before + pitch_[j]) / 2) {
      return j;
    }
  }
  return 0;
}

}  // namespace trochoid::correction
