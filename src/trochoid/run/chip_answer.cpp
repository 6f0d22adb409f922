#include <trochoid/run/chip_answer.h>

#include <trochoid/base/units.h>
#include <trochoid/geometry/edge.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace trochoid::run {

namespace {

/// A slice with its own copy of the tooth positions.
struct OwnedSlice {
  OwnedSlice(const force::Setup& setup, double height)
      : teeth(setup.cutter.pitch.size()) {
    const geometry::Meridian m = geometry::meridian(setup.cutter.profile);
    const double s = geometry::arc_length_at(m, height);
    r = geometry::point_at(m, s).r;
    geometry::edge_positions(force::runout_of(setup),
                             geometry::tooth_angles(setup.cutter), r,
                             geometry::lag_at(setup.cutter, m, s).angle, teeth);
  }
  [[nodiscard]] chip::Slice slice() const { return {r, teeth}; }

  double r = 0.0;
  std::vector<geometry::EdgePosition> teeth;
};

/// Largest h on a piece, where h is smooth: samples, then a golden section.
double largest_chip(const chip::Passage& passage, const chip::Slice& slice, int tooth,
                    const chip::ChipPiece& piece) {
  constexpr int samples = 32;
  const auto h = [&](double theta) {
    return chip::chip_at(passage, slice, tooth, theta).h;
  };
  const double step = (piece.to - piece.from) / samples;
  int best = 0;
  for (int i = 1; i <= samples; ++i) {
    if (h(piece.from + i * step) > h(piece.from + best * step)) {
      best = i;
    }
  }
  double lo = piece.from + std::max(best - 1, 0) * step;
  double hi = piece.from + std::min(best + 1, samples) * step;
  constexpr double golden = 0.6180339887498949;
  for (int i = 0; i < 45; ++i) {
    const double a = hi - golden * (hi - lo);
    const double b = lo + golden * (hi - lo);
    (h(a) < h(b) ? lo : hi) = h(a) < h(b) ? a : b;
  }
  return std::max(h(0.5 * (lo + hi)), h(piece.from + best * step));
}

}  // namespace

SliceAnswer slice_answer(const force::Setup& setup, double height) {
  const OwnedSlice owned(setup, height);
  const chip::Slice slice = owned.slice();
  const chip::Passage passage = chip::passage(setup.cutter, setup.cut, setup.chip);
  SliceAnswer answer;
  for (int j = 0; j < setup.cutter.teeth(); ++j) {
    ToothEngagement tooth{.arcs = chip::engaged_arcs(passage, slice, j)};
    for (const auto& piece : chip::engaged_pieces(passage, slice, j, -90 * unit::deg)) {
      tooth.peak_chip =
          std::max(tooth.peak_chip, largest_chip(passage, slice, j, piece));
    }
    answer.teeth.push_back(std::move(tooth));
  }
  answer.removal = chip::removal(passage, slice);
  return answer;
}

base::Table chip_table(const force::Setup& setup, std::span<const double> edge_angles,
                       std::span<const double> heights) {
  base::Table table{
      "chip.csv",
      {{"tooth", {}}, {"edge_angle_deg", {}}, {"height_mm", {}}, {"h_mm", {}}}};
  const chip::Passage passage = chip::passage(setup.cutter, setup.cut, setup.chip);
  std::vector<OwnedSlice> slices;
  for (const double height : heights) {
    slices.emplace_back(setup, height);
  }
  for (int j = 0; j < setup.cutter.teeth(); ++j) {
    for (const double theta : edge_angles) {
      for (std::size_t i = 0; i < heights.size(); ++i) {
        table.columns[0].values.push_back(j + 1);
        table.columns[1].values.push_back(unit::in(theta, unit::deg));
        table.columns[2].values.push_back(unit::in(heights[i], unit::mm));
        table.columns[3].values.push_back(
            chip::chip_at(passage, slices[i].slice(), j, theta).h / unit::mm);
      }
    }
  }
  return table;
}

base::Table chip_curve(const force::Setup& setup, double height) {
  base::Table table{"chip_curve.csv", {{"theta_deg", {}}}};
  const OwnedSlice owned(setup, height);
  const chip::Passage passage = chip::passage(setup.cutter, setup.cut, setup.chip);
  for (int j = 0; j < setup.cutter.teeth(); ++j) {
    table.columns.push_back({fmt::format("h_tooth{}_mm", j + 1), {}});
  }
  for (int i = 0; i <= 440; ++i) {
    const double theta_deg = -20 + 0.5 * i;
    table.columns[0].values.push_back(theta_deg);
    for (int j = 0; j < setup.cutter.teeth(); ++j) {
      table.columns[static_cast<std::size_t>(j) + 1].values.push_back(
          chip::chip_at(passage, owned.slice(), j, theta_deg * unit::deg).h / unit::mm);
    }
  }
  return table;
}

double default_height(const force::Setup& setup) {
  const geometry::Meridian m = geometry::meridian(setup.cutter.profile);
  const bool reaches_axis =
      geometry::point_at(m, 0.0).r <= 1e-9 * setup.cutter.profile.D;
  return reaches_axis ? setup.cut.a_p : 0.0;
}

}  // namespace trochoid::run
