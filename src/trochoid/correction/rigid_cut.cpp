#include <trochoid/correction/rigid_cut.h>

#include <trochoid/base/units.h>
#include <trochoid/dynamics/steady_state.h>
#include <trochoid/force/forces.h>
#include <trochoid/geometry/edge.h>
#include <trochoid/numerics/gauss_kronrod.h>

#include <boost/math/tools/minima.hpp>

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

namespace {

/// Nodes of a turn among which peaks are looked for.
constexpr double steps_per_turn = 1440;
/// Inside a panel, off its ends [rad].
constexpr double beside = 1e-9;
/// Of the angle of a peak: its value is then good to rounding.
constexpr int angle_bits = 26;

double difference_of(std::span<const Flute> flutes, double Flute::*value) {
  std::vector<double> values;
  for (const Flute& f : flutes) {
    values.push_back(f.*value);
  }
  return dynamics::relative_difference(values);
}

/// The largest value at a node, and where its neighbours in the same panel are.
struct Top {
  double value = -1.0;
  double from = 0.0;
  double at = 0.0;
  double to = 0.0;
};

/// The largest value between the neighbours, and where it is: a force has kinks, so that
/// a parabola through three nodes would miss it.
template <typename F>
Top highest(const F& f, Top top) {
  const auto [at, less] = boost::math::tools::brent_find_minima(
      [&](double phi) { return -f(phi); }, top.from, top.to, angle_bits);
  if (-less > top.value) {
    top.value = -less;
    top.at = at;
  }
  return top;
}

}  // namespace

double peak_difference(std::span<const Flute> flutes) {
  return difference_of(flutes, &Flute::peak_y);
}

double area_difference(std::span<const Flute> flutes) {
  return difference_of(flutes, &Flute::chip_area);
}

std::vector<double> peaks_of_turns(const RigidCut& cut, std::span<const double> angle,
                                   std::span<const std::array<double, 3>> force,
                                   double offset) {
  std::vector<double> peaks(cut.psi().size(), 0.0);
  for (std::size_t i = 0; i < angle.size(); ++i) {
    double& peak = peaks[cut.turn_of(angle[i] + offset)];
    peak = std::max(peak, std::abs(force[i][1]));
  }
  return peaks;
}

std::vector<double> chip_differences(std::span<const double> rho) {
  std::vector<double> h_ro;
  for (std::size_t j = 0; j < rho.size(); ++j) {
    h_ro.push_back(rho[j] - rho[(j + rho.size() - 1) % rho.size()]);
  }
  return h_ro;
}

/// The force over a turn, at nodes that avoid every jump.
struct RigidCut::Nodes {
  std::vector<double> angle;
  std::vector<double> from;  ///< the node before in the same panel, or this one
  std::vector<double> to;    ///< the node after, or this one
  std::vector<std::array<double, 3>> force;
  std::vector<double> chip;   ///< shape (nodes, teeth)
  std::vector<double> own_y;  ///< |F_y| of each tooth, shape (nodes, teeth) [N]
};

/// Ends of the stretches in which no tip enters or leaves, no motion breaks, and one
/// tooth is nearest to the middle.
std::vector<double> RigidCut::panels(const PeriodicMotion& X) const {
  std::vector<double> ends = {0.0, unit::turn};
  const std::vector<double> breaks = breaks_of(X);
  for (std::size_t j = 0; j < psi_.size(); ++j) {
    const double lag = disks_.front().lag;
    ends.push_back(wrapped(psi_[j] + lag + arc_.from));
    ends.push_back(wrapped(psi_[j] + lag + arc_.to));
    const double before = pitch_[(j + psi_.size() - 1) % psi_.size()];
    ends.push_back(wrapped(psi_[j] + (arc_.from + arc_.to - before) / 2));
    for (int m = 1; m <= passage_.teeth; ++m) {
      for (const double at : breaks) {
        ends.push_back(wrapped(
            at + passage_.back[j * psi_.size() + static_cast<std::size_t>(m) - 1]));
      }
    }
  }
  std::sort(ends.begin(), ends.end());
  const auto near = [](double a, double b) { return b - a < 100 * beside; };
  ends.erase(std::unique(ends.begin(), ends.end(), near), ends.end());
  ends.back() = unit::turn;
  return ends;
}

RigidCut::Nodes RigidCut::nodes(const PeriodicMotion& X) const {
  Nodes nodes;
  const std::vector<double> ends = panels(X);
  for (std::size_t p = 0; p + 1 < ends.size(); ++p) {
    const double from = ends[p] + beside;
    const double length = ends[p + 1] - beside - from;
    const auto steps =
        std::max(2, static_cast<int>(std::ceil(length / unit::turn * steps_per_turn)));
    for (int i = 0; i <= steps; ++i) {
      const double phi = from + length * i / steps;
      std::array<double, 3> F{};
      for (std::size_t j = 0; j < psi_.size(); ++j) {
        std::array<double, 3> own{};
        for (const Disk& disk : disks_) {
          const Contact c = contact(X, disk, j, phi);
          add_force(disk, c, own);
          if (&disk == &disks_.front()) {
            nodes.chip.push_back(c.h);
          }
        }
        nodes.own_y.push_back(std::abs(own[1]));
        for (std::size_t q = 0; q < 3; ++q) {
          F[q] += own[q];
        }
      }
      nodes.angle.push_back(phi);
      nodes.from.push_back(from + length * std::max(0, i - 1) / steps);
      nodes.to.push_back(from + length * std::min(steps, i + 1) / steps);
      nodes.force.push_back(F);
    }
  }
  return nodes;
}

std::array<double, 3> RigidCut::force_of_tooth(const PeriodicMotion& X, std::size_t j,
                                               double phi) const {
  std::array<double, 3> F{};
  for (const Disk& disk : disks_) {
    add_force(disk, contact(X, disk, j, phi), F);
  }
  return F;
}

std::vector<Flute> RigidCut::peaks(const PeriodicMotion& X) const {
  const Nodes all = nodes(X);
  const std::size_t count = psi_.size();
  struct Tops {
    Top x, y, own, chip;
  };
  std::vector<Tops> tops(count);
  for (std::size_t i = 0; i < all.angle.size(); ++i) {
    const auto raise = [&](Top& top, double value) {
      if (value > top.value) {
        top = {value, all.from[i], all.angle[i], all.to[i]};
      }
    };
    Tops& whole = tops[turn_of(all.angle[i])];
    raise(whole.x, std::abs(all.force[i][0]));
    raise(whole.y, std::abs(all.force[i][1]));
    for (std::size_t k = 0; k < count; ++k) {
      raise(tops[k].own, all.own_y[i * count + k]);
      raise(tops[k].chip, all.chip[i * count + k]);
    }
  }
  std::vector<Flute> flutes(count);
  for (std::size_t j = 0; j < count; ++j) {
    const auto along = [&](std::size_t q) {
      return [&, q](double phi) { return std::abs(force(X, phi)[q]); };
    };
    const auto own = [&](double phi) { return std::abs(force_of_tooth(X, j, phi)[1]); };
    const auto h = [&](double phi) { return contact(X, disks_.front(), j, phi).h; };
    const Top y = highest(along(1), tops[j].y);
    flutes[j] = {.peak_x = highest(along(0), tops[j].x).value,
                 .peak_y = y.value,
                 .peak_y_angle = wrapped(y.at - psi_[j]),
                 .own_peak_y = highest(own, tops[j].own).value,
                 .peak_chip = highest(h, tops[j].chip).value};
  }
  return flutes;
}

double RigidCut::chip_area(const PeriodicMotion& X, std::size_t j,
                           std::span<const double> panels) const {
  std::array<double, 1> area{};
  const std::array<double, 1> allowed = {1e-12 * (passage_.feed * unit::turn + 1e-6)};
  const auto h = [&](double phi, double weight, std::array<double, 1>& sum) {
    sum[0] += weight * contact(X, disks_.front(), j, phi).h;
  };
  for (std::size_t p = 0; p + 1 < panels.size(); ++p) {
    numerics::add_integral<1>(panels[p], panels[p + 1], h, allowed, 1e-6, area);
  }
  return area[0];
}

std::vector<Flute> RigidCut::flutes(const PeriodicMotion& X) const {
  std::vector<Flute> flutes = peaks(X);
  const std::vector<double> ends = panels(X);
  for (std::size_t j = 0; j < flutes.size(); ++j) {
    flutes[j].chip_area = chip_area(X, j, ends);
  }
  return flutes;
}

Prediction RigidCut::predict(const PeriodicMotion& X, int samples) const {
  const std::size_t count = psi_.size();
  Prediction out;
  out.flutes = flutes(X);
  out.chip.resize(count);
  out.flute_force.resize(count);
  for (int i = 0; i < samples; ++i) {
    const double phi = unit::turn * i / samples;
    out.angle.push_back(phi);
    out.table.push_back(place_at(X, phi));
    out.force.emplace_back();
    for (std::size_t j = 0; j < count; ++j) {
      const std::array<double, 3> F = force_of_tooth(X, j, phi);
      for (std::size_t q = 0; q < 3; ++q) {
        out.force.back()[q] += F[q];
      }
      out.flute_force[j].push_back(F);
      out.chip[j].push_back(contact(X, disks_.front(), j, phi).h);
    }
  }
  return out;
}

}  // namespace trochoid::correction
