#include <trochoid/correction/rigid_cut.h>

#include <trochoid/base/units.h>
#include <trochoid/dynamics/steady_state.h>
#include <trochoid/numerics/gauss_kronrod.h>

#include <algorithm>
#include <cmath>

namespace trochoid::correction {

namespace {

/// Nodes of a turn among which peaks are looked for.
constexpr double steps_per_turn = 1440;
/// Inside a panel, off its ends [rad].
constexpr double beside = 1e-9;

double wrapped(double angle) noexcept {
  return angle - unit::turn * std::floor(angle / unit::turn);
}

double difference_of(std::span<const Flute> flutes, double Flute::*value) {
  std::vector<double> values;
  for (const Flute& f : flutes) {
    values.push_back(f.*value);
  }
  return dynamics::relative_difference(values);
}

/// A largest value, and by how many steps the top of a parabola lies beside it.
struct Top {
  double value = 0.0;
  double shift = 0.0;
};

Top top_of(double before, double here, double after) noexcept {
  const double bend = before - 2 * here + after;
  if (!(bend < 0)) {
    return {here, 0.0};
  }
  const double shift = std::clamp((before - after) / (2 * bend), -0.5, 0.5);
  return {here - (before - after) * shift / 4, shift};
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
  std::vector<bool> inner;  ///< has neighbours at equal distance
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
      nodes.inner.push_back(i > 0 && i < steps);
      nodes.force.push_back(F);
    }
  }
  return nodes;
}

std::vector<Flute> RigidCut::peaks(const PeriodicMotion& X) const {
  const Nodes all = nodes(X);
  const std::size_t count = psi_.size();
  std::vector<Flute> flutes(count);
  const auto top = [&](std::size_t i, const auto& value) {
    return all.inner[i] ? top_of(value(i - 1), value(i), value(i + 1))
                        : Top{value(i), 0.0};
  };
  for (std::size_t i = 0; i < all.angle.size(); ++i) {
    const std::size_t j = turn_of(all.angle[i]);
    Flute& f = flutes[j];
    const auto F_x = [&](std::size_t k) { return std::abs(all.force[k][0]); };
    const auto F_y = [&](std::size_t k) { return std::abs(all.force[k][1]); };
    f.peak_x = std::max(f.peak_x, top(i, F_x).value);
    const Top y = top(i, F_y);
    if (y.value > f.peak_y) {
      f.peak_y = y.value;
      const double step = all.inner[i] ? all.angle[i + 1] - all.angle[i] : 0.0;
      f.peak_y_angle = wrapped(all.angle[i] + y.shift * step - psi_[j]);
    }
    for (std::size_t k = 0; k < count; ++k) {
      const auto h = [&](std::size_t n) { return all.chip[n * count + k]; };
      flutes[k].peak_chip = std::max(flutes[k].peak_chip, top(i, h).value);
      const auto own = [&](std::size_t n) { return all.own_y[n * count + k]; };
      flutes[k].own_peak_y = std::max(flutes[k].own_peak_y, top(i, own).value);
    }
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
      std::array<double, 3> F{};
      for (const Disk& disk : disks_) {
        add_force(disk, contact(X, disk, j, phi), F);
      }
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
