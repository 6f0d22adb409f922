#include <trochoid/base/units.h>
#include <trochoid/force/cumulative.h>
#include <trochoid/force/forces.h>
#include <trochoid/force/turn_teeth.h>
#include <trochoid/geometry/edge.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace trochoid::force {
namespace {

constexpr double pi = std::numbers::pi;
constexpr LinearEdge K{2600e6, 1500e6, 330e6, 7e3, 3e3, 1e3};

using Random = std::mt19937;
using Cut = Setup;  // gtest has a Setup of its own

double between(Random& random, double a, double b) {
  return std::uniform_real_distribution<double>(a, b)(random);
}
int one_of(Random& random, int n) {
  return std::uniform_int_distribution<int>(0, n - 1)(random);
}

geometry::Engagement random_engagement(Random& random, double D) {
  switch (one_of(random, 4)) {
    case 0:
      return geometry::Slot{};
    case 1:
      return geometry::UpMilling{std::pow(10.0, between(random, -3, 0)) * D};
    case 2:
      return geometry::DownMilling{std::pow(10.0, between(random, -3, 0)) * D};
    default: {
      const double y = between(random, -0.6, 0.4) * D;
      return geometry::Band{y, y + between(random, 0.01, 0.9) * D};
    }
  }
}

/// Straight, hardly twisted or up to 60 degrees; 1 to 8 teeth, offsets up to five feeds.
Cut random_cut(Random& random) {
  Cut cut;
  const double D = between(random, 2e-3, 30e-3);
  cut.cutter.profile = geometry::cylinder(D);
  cut.cutter.pitch.resize(static_cast<std::size_t>(1 + one_of(random, 8)));
  const int twist = one_of(random, 8);
  cut.cutter.helix = twist == 0   ? 0.0
                     : twist == 1 ? std::pow(10.0, between(random, -10, -1))
                                  : between(random, 0, 60) * unit::deg;
  cut.cutter.lag_diameter = D;
  cut.cut = {.engagement = random_engagement(random, D),
             .a_p = between(random, 0.05, 3) * D,
             .f_z = between(random, 2e-6, 200e-6),
             .Omega = 90.0};
  constexpr std::array<double, 4> feeds = {0.0, 0.3, 1.0, 5.0};
  const double offset =
      feeds[static_cast<std::size_t>(one_of(random, 4))] * cut.cut.f_z;
  const bool unequal = one_of(random, 2) == 0;
  double sum = 0.0;
  for (double& p : cut.cutter.pitch) sum += p = unequal ? between(random, 0.6, 1.4) : 1;
  for (double& p : cut.cutter.pitch) {
    p *= 2 * pi / sum;
    cut.runout.radial_offsets.push_back(offset * between(random, -1, 1));
  }
  cut.chip.model = static_cast<chip::Model>(one_of(random, 4));
  cut.chip.lookback =
      one_of(random, 3) == 0 ? chip::Lookback::previous : chip::Lookback::all;
  cut.edge_length =
      one_of(random, 2) == 0 ? EdgeLength::true_length : EdgeLength::axial;
  return cut;
}

double largest(const std::vector<Vector3>& F) {
  double out = 0.0;
  for (const Vector3& f : F) out = std::max(out, std::hypot(f[0], f[1], f[2]));
  return out;
}

double difference(const Vector3& a, const Vector3& b) {
  return std::max(
      {std::abs(a[0] - b[0]), std::abs(a[1] - b[1]), std::abs(a[2] - b[2])});
}

std::vector<double> turn_of(int count) {
  std::vector<double> phi;
  for (int i = 0; i < count; ++i) phi.push_back(2 * pi * (i + 0.3217) / count);
  return phi;
}

/// What F-5 gives with its tables.
std::vector<Vector3> by_tables(const Cut& cut, std::span<const double> phi) {
  std::vector<Vector3> out(phi.size());
  CumulativeForce(cut, K, 1e-12)
      .forces({{{0, -K.K_tc, -K.K_rc, 0, 0, -K.K_re, -K.K_te, 0},
                {K.K_tc, 0, 0, -K.K_rc, 0, K.K_te, -K.K_re, 0},
                {0, 0, 0, 0, -K.K_ac, 0, 0, -K.K_ae}}},
              phi, out);
  return out;
}

bool is_polynomial(const Cut& cut) {
  const bool found = turn_teeth(cut, 1e-9).has_value();
  // The series must do for every feed of practice.
  EXPECT_TRUE(found || cut.cutter.teeth() * cut.cut.f_z > 0.02 * cut.cutter.profile.D);
  return found;
}

TEST(Turn, OfAnyCutIsThatOfTheTables) {  // [F-10] [F-11] [F-12]
  Random random(11);
  const auto phi = turn_of(48);
  int compared = 0;
  for (int n = 0; n < 8000; ++n) {
    const Cut cut = random_cut(random);
    const double lag =
        2 * std::tan(cut.cutter.helix) * cut.cut.a_p / cut.cutter.lag_diameter;
    // Between, the differences of the tables lose digits.
    if ((lag > 0 && lag < 1e-6) || !is_polynomial(cut)) {
      continue;
    }
    ++compared;
    const auto F = forces(cut, K, phi, 1e-6);
    const auto expected = by_tables(cut, phi);
    const double peak = largest(expected);
    for (std::size_t i = 0; i < phi.size(); ++i) {
      ASSERT_LE(difference(F[i], expected[i]), 1e-8 * peak)
          << n << " at " << phi[i] << ", lag " << lag;
    }
  }
  EXPECT_GT(compared, 6000);
}

/// Forces by nothing but the chip at an angle: its changes found by looking closely, and
/// Gauss nodes between them.
class PlainForces {
 public:
  explicit PlainForces(const Cut& cut)
      : cut_(cut),
        passage_(chip::passage(cut.cutter, cut.cut, cut.chip)),
        psi_(geometry::tooth_angles(cut.cutter)),
        teeth_(psi_.size()),
        lag_(2 * std::tan(cut.cutter.helix) * cut.cut.a_p / cut.cutter.lag_diameter) {
    if (cut.edge_length == EdgeLength::true_length) {
      e_ = 1 / std::cos(cut.cutter.helix);
    }
    geometry::edge_positions(runout_of(cut), psi_, r(), 0.0, teeth_);
    for (int j = 0; j < cut.cutter.teeth(); ++j) changes_.push_back(find_changes(j));
  }

  [[nodiscard]] Vector3 at(double phi) const {
    Vector3 sum{};
    for (std::size_t j = 0; j < psi_.size(); ++j) {
      const double tip = phi - psi_[j];
      std::vector<double> shares = {0.0, 1.0};  // of the depth
      for (const double change : changes_[j]) {
        const double past = tip - change;
        for (double x = past - 2 * pi * std::floor(past / (2 * pi)); x < lag_;
             x += 2 * pi) {
          if (x > 0) shares.push_back(x / lag_);
        }
      }
      const int parts = static_cast<int>(lag_ / 0.4);
      for (int i = 1; i < parts; ++i) shares.push_back(static_cast<double>(i) / parts);
      std::sort(shares.begin(), shares.end());
      for (std::size_t i = 0; i + 1 < shares.size(); ++i) {
        add(static_cast<int>(j), tip, shares[i], shares[i + 1], sum);
      }
    }
    return sum;
  }

  /// Angles of the tip of tooth 1 at which something changes.
  [[nodiscard]] std::vector<double> steps() const {
    std::vector<double> out;
    for (std::size_t j = 0; j < psi_.size(); ++j) {
      for (const double change : changes_[j]) out.push_back(change + psi_[j]);
    }
    return out;
  }
  [[nodiscard]] double lag() const { return lag_; }

 private:
  [[nodiscard]] double r() const { return cut_.cutter.profile.D / 2; }
  [[nodiscard]] chip::Chip chip(int j, double theta) const {
    return chip::chip_at(passage_, {r(), teeth_}, j, theta);
  }
  [[nodiscard]] int code(int j, double theta) const {
    const chip::Chip c = chip(j, theta);
    return c.in_cut ? c.bounds : -1;
  }

  void find_between(int j, double lo, double hi, std::vector<double>& out) const {
    const int before = code(j, lo);
    const int after = code(j, hi);
    if (before == after) return;
    if (hi - lo < 1e-14) {
      out.push_back(0.5 * (lo + hi));
      return;
    }
    const double middle = 0.5 * (lo + hi);
    if (!(middle > lo && middle < hi)) {
      out.push_back(middle);
      return;
    }
    find_between(j, lo, middle, out);
    find_between(j, middle, hi, out);
  }

  [[nodiscard]] std::vector<double> find_changes(int j) const {
    std::vector<double> grid;
    for (int i = 0; i <= 720; ++i) grid.push_back(-pi / 2 + 2 * pi * i / 720);
    for (const double y : {passage_.stock.y_lo, passage_.stock.y_hi}) {
      for (const double R : {r(), teeth_[static_cast<std::size_t>(j)].R}) {
        if (std::abs(y) >= R) continue;
        for (double side = 1e-7; side < 0.1; side *= 3) {
          grid.push_back(std::acos(y / R) - side);
          grid.push_back(std::acos(y / R) + side);
        }
      }
    }
    for (double side = 1e-7; side < 0.1; side *= 3) {
      for (const double end : {0.0, pi}) {
        grid.push_back(end - side);
        grid.push_back(end + side);
      }
    }
    std::sort(grid.begin(), grid.end());
    std::vector<double> out;
    for (std::size_t i = 0; i + 1 < grid.size(); ++i) {
      find_between(j, grid[i], grid[i + 1], out);
    }
    return out;
  }

  void add(int j, double tip, double from, double to, Vector3& sum) const {
    constexpr std::array<double, 5> node = {0.1488743389816312, 0.4333953941292472,
                                            0.6794095682990244, 0.8650633666889845,
                                            0.9739065285171717};
    constexpr std::array<double, 5> weight = {0.2955242247147529, 0.2692667193099963,
                                              0.2190863625159820, 0.1494513491505806,
                                              0.0666713443086881};
    for (std::size_t k = 0; k < node.size(); ++k) {
      for (const double side : {-1.0, 1.0}) {
        const double share = 0.5 * (from + to) + 0.5 * (to - from) * side * node[k];
        const double dz = 0.5 * (to - from) * weight[k] * cut_.cut.a_p;
        const double theta = tip - share * lag_;
        const chip::Chip c = chip(j, theta);
        if (!c.in_cut) continue;
        const double t = (K.K_tc * c.h + K.K_te * e_) * dz;
        const double radial = (K.K_rc * c.h + K.K_re * e_) * dz;
        sum[0] += -t * std::cos(theta) - radial * std::sin(theta);
        sum[1] += t * std::sin(theta) - radial * std::cos(theta);
        sum[2] -= (K.K_ac * c.h + K.K_ae * e_) * dz;
      }
    }
  }

  Cut cut_;
  chip::Passage passage_;
  std::vector<double> psi_;
  std::vector<geometry::EdgePosition> teeth_;
  std::vector<std::vector<double>> changes_;
  double lag_;
  double e_ = 1.0;
};

TEST(Turn, OfAnyCutIsThatOfGaussNodesBetweenItsChanges) {  // [F-10] [F-11] [F-13]
  Random random(12);
  for (int n = 0; n < 1000; ++n) {
    const Cut cut = random_cut(random);
    if (!is_polynomial(cut)) continue;
    const PlainForces plain(cut);
    std::vector<double> phi;
    for (int i = 0; i < 4; ++i) phi.push_back(between(random, -7, 14));
    // While an edge goes past a change; in a short lag the angle of the change would
    // have to be known to more digits than it has.
    const auto steps = plain.steps();
    for (int i = 0; i < 4 && plain.lag() > 1e-4 && !steps.empty(); ++i) {
      const auto step =
          static_cast<std::size_t>(one_of(random, static_cast<int>(steps.size())));
      phi.push_back(steps[step] + plain.lag() * between(random, 0, 1));
    }
    const double peak = largest(forces(cut, K, turn_of(200), 1e-6));
    const auto F = forces(cut, K, phi, 1e-6);
    for (std::size_t i = 0; i < phi.size(); ++i) {
      ASSERT_LE(difference(F[i], plain.at(phi[i])), 1e-8 * peak)
          << n << " at " << phi[i] << ", lag " << plain.lag();
    }
  }
}

}  // namespace
}  // namespace trochoid::force
