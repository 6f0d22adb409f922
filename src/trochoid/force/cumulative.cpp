#include <trochoid/force/cumulative.h>

#include <trochoid/base/units.h>
#include <trochoid/chip/harmonics.h>
#include <trochoid/chip/intervals.h>
#include <trochoid/chip/near_marks.h>
#include <trochoid/geometry/edge.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trochoid::force {

namespace {

/// Where a turn of theta starts: behind the tool, where nothing is in cut.
constexpr double start = -std::numbers::pi / 2;
/// Below this lag the difference of F-5 would lose more digits than its limit [rad].
constexpr double smallest_lag = 1e-8;
/// Sines are resolved to 1e-13 on panels of this length [rad].
constexpr double longest_chip_panel = 0.8;

}  // namespace

CumulativeForce::CumulativeForce(const Setup& setup, const Law& law, double tolerance)
    : passage_(chip::passage(setup.cutter, setup.cut, setup.chip)),
      form_(form(law)),
      r_(setup.cutter.profile.D / 2),
      a_p_(setup.cut.a_p),
      psi_(geometry::tooth_angles(setup.cutter)),
      teeth_(psi_.size()) {
  const double slope = 2 * std::tan(setup.cutter.helix) / setup.cutter.lag_diameter;
  lag_ = slope * a_p_ < smallest_lag ? 0.0 : slope * a_p_;
  if (setup.edge_length == EdgeLength::true_length) {
    edge_factor_ = std::hypot(1.0, r_ * slope);
  }
  geometry::edge_positions(runout_of(setup), psi_, r_, 0.0, teeth_);
  find_near_marks();
  if (lag_ > 0) {
    const std::size_t tables = teeth_alike(setup) ? 1 : psi_.size();
    tables_.reserve(tables);
    for (std::size_t j = 0; j < tables; ++j) {
      tabulate(j, tolerance);
    }
  }
}

void CumulativeForce::find_near_marks() {
  const double least = std::ranges::min(teeth_, {}, &geometry::EdgePosition::R).R;
  if (passage_.marks < 2 || passage_.feed > chip::largest_feed * least) {
    return;
  }
  for (std::size_t j = 0; j < teeth_.size(); ++j) {
    near_.push_back(chip::near_marks(passage_, slice(), static_cast<int>(j)));
  }
}

EdgeMoments CumulativeForce::integrand(std::size_t tooth, double theta) const noexcept {
  const chip::Slice slice = this->slice();
  const chip::Chip chip =
      chip::chip_at(passage_, slice, static_cast<int>(tooth), theta);
  if (!chip.in_cut) {
    return {};
  }
  const double s = std::sin(theta + teeth_[tooth].epsilon);
  const double c = std::cos(theta + teeth_[tooth].epsilon);
  const ColumnWeights w = column_weights(form_, chip.h, 1.0, edge_factor_);
  return {w.cutting[0] * s, w.cutting[0] * c, w.cutting[1] * s, w.cutting[1] * c,
          w.cutting[2],     w.edge * s,       w.edge * c,       w.edge};
}

void CumulativeForce::tabulate(std::size_t tooth, double tolerance) {
  const chip::Slice slice = this->slice();
  const auto pieces =
      chip::engaged_pieces(passage_, slice, static_cast<int>(tooth), start);
  const auto f = [&](double theta) { return integrand(tooth, theta); };
  EdgeMoments allowed{};
  for (const chip::ChipPiece& piece : pieces) {
    const EdgeMoments middle = f(0.5 * (piece.from + piece.to));
    for (std::size_t q = 0; q < allowed.size(); ++q) {
      allowed[q] = std::max(allowed[q], std::abs(middle[q]));
    }
  }
  // Sine and cosine parts share a scale: either may vanish in the middle.
  const double largest = 0.05 * tolerance;
  const auto edges = allowed.begin() + 5;
  const double cutting = largest * *std::max_element(allowed.begin(), edges);
  const double edge = largest * *std::max_element(edges, allowed.end());
  std::fill(allowed.begin(), edges, cutting);
  std::fill(edges, allowed.end(), edge);
  tables_.emplace_back(start, unit::turn);
  for (const chip::ChipPiece& piece : pieces) {
    tables_.back().append(piece.from, piece.to, f, longest_chip_panel, allowed);
  }
  tables_.back().finish();
}

EdgeMoments CumulativeForce::moments(double phi) const noexcept {
  EdgeMoments sum{};
  for (std::size_t j = 0; j < psi_.size(); ++j) {
    const double theta = phi - psi_[j];
    if (lag_ == 0) {
      const EdgeMoments g = integrand(j, theta);
      for (std::size_t q = 0; q < sum.size(); ++q) {
        sum[q] += a_p_ * g[q];
      }
    } else {  // F-5
      const auto& table = tables_[tables_.size() == 1 ? 0 : j];
      table.add_to(sum, theta, a_p_ / lag_);
      table.add_to(sum, theta - lag_, -a_p_ / lag_);
    }
  }
  return sum;
}

void CumulativeForce::forces(const MomentWeights& weights, std::span<const double> phi,
                             std::span<std::array<double, 3>> out) const {
  if (lag_ == 0) {
    for (std::size_t i = 0; i < phi.size(); ++i) {
      const EdgeMoments m = moments(phi[i]);
      for (std::size_t row = 0; row < 3; ++row) {
        out[i][row] = 0.0;
        for (std::size_t q = 0; q < m.size(); ++q) {
          out[i][row] += weights[row][q] * m[q];
        }
      }
    }
    return;
  }
  // A fourth, empty component lets the compiler work on whole vectors.
  const std::array<EdgeMoments, 4> padded{weights[0], weights[1], weights[2]};
  std::vector<numerics::PiecewiseIntegral<4>> tables;
  tables.reserve(tables_.size());
  for (const auto& table : tables_) {
    tables.push_back(table.combined(padded));
  }
  const double lead = a_p_ / lag_;
  for (std::size_t i = 0; i < phi.size(); ++i) {
    std::array<double, 4> sum{};
    for (std::size_t j = 0; j < psi_.size(); ++j) {
      const auto& table = tables[tables.size() == 1 ? 0 : j];
      const double theta = phi[i] - psi_[j];
      table.add_to(sum, theta, lead);
      table.add_to(sum, theta - lag_, -lead);
    }
    out[i] = {sum[0], sum[1], sum[2]};
  }
}

}  // namespace trochoid::force
