#include <trochoid/force/slice.h>

#include <trochoid/base/index.h>
#include <trochoid/base/units.h>
#include <trochoid/geometry/edge.h>

#include <boost/math/tools/minima.hpp>

#include <algorithm>
#include <array>
#include <iterator>

namespace trochoid::force {

namespace {

/// Largest h on a piece, where h is smooth: samples, then Brent's method between them.
double largest_chip(const Slice& slice, std::size_t tooth,
                    const chip::ChipPiece& piece) {
  constexpr int samples = 32;
  constexpr int bits = 26;  // half of a double: h is flat where it is largest
  const auto h = [&](double theta) { return slice.chip_thickness(tooth, theta); };
  const double step = (piece.to - piece.from) / samples;
  std::array<double, samples + 1> at{};
  for (int i = 0; i <= samples; ++i) at[base::index(i)] = h(piece.from + i * step);
  const auto best =
      static_cast<int>(std::distance(at.begin(), std::ranges::max_element(at)));
  const auto [theta, negative] = boost::math::tools::brent_find_minima(
      [&](double x) { return -h(x); }, piece.from + std::max(best - 1, 0) * step,
      piece.from + std::min(best + 1, samples) * step, bits);
  return std::max(-negative, at[base::index(best)]);
}

}  // namespace

Slice::Slice(const Setup& setup, double height)
    : passage_(chip::passage(setup.cutter, setup.cut, setup.chip)),
      teeth_(setup.cutter.pitch.size()) {
  const geometry::Meridian m = geometry::meridian(setup.cutter.profile);
  const double s = geometry::arc_length_at(m, height);
  r_ = geometry::point_at(m, s).r;
  geometry::edge_positions(runout_of(setup), geometry::tooth_angles(setup.cutter), r_,
                           geometry::lag_at(setup.cutter, m, s).angle, teeth_);
  if (const auto* arcs = std::get_if<geometry::Arcs>(&setup.cut.engagement)) {
    const auto here = arcs->at(height);
    arcs_.assign(here.begin(), here.end());
  }
}

double Slice::chip_thickness(std::size_t tooth, double theta) const noexcept {
  return chip::chip_at(passage_, teeth(), static_cast<int>(tooth), theta).h;
}

Engagement engagement_at(const Setup& setup, double height) {
  const Slice slice(setup, height);
  Engagement engagement{.height = height};
  for (std::size_t j = 0; j < setup.cutter.pitch.size(); ++j) {
    const int tooth = static_cast<int>(j);
    ToothEngagement of_tooth{
        .arcs = chip::engaged_arcs(slice.passage(), slice.teeth(), tooth)};
    for (const chip::ChipPiece& piece :
         chip::engaged_pieces(slice.passage(), slice.teeth(), tooth, -90 * unit::deg)) {
      of_tooth.peak_chip = std::max(of_tooth.peak_chip, largest_chip(slice, j, piece));
    }
    engagement.teeth.push_back(std::move(of_tooth));
  }
  engagement.removal = chip::removal(slice.passage(), slice.teeth());
  return engagement;
}

double representative_height(const Setup& setup) {
  const geometry::Meridian m = geometry::meridian(setup.cutter.profile);
  const bool reaches_axis =
      geometry::point_at(m, 0.0).r <= 1e-9 * setup.cutter.profile.D;
  return reaches_axis ? setup.cut.a_p : 0.0;
}

ChipCurve chip_curve(const Setup& setup, double height) {
  const Slice slice(setup, height);
  ChipCurve curve;
  for (int i = 0; i <= 440; ++i) {
    curve.theta.push_back((-20 + 0.5 * i) * unit::deg);
  }
  for (std::size_t j = 0; j < setup.cutter.pitch.size(); ++j) {
    std::vector<double>& h = curve.h.emplace_back();
    for (const double theta : curve.theta) {
      h.push_back(slice.chip_thickness(j, theta));
    }
  }
  return curve;
}

ChipGrid chip_grid(const Setup& setup, std::span<const double> theta,
                   std::span<const double> heights) {
  ChipGrid grid{.theta = {theta.begin(), theta.end()},
                .height = {heights.begin(), heights.end()}};
  std::vector<Slice> slices;
  for (const double height : heights) {
    slices.emplace_back(setup, height);
  }
  for (std::size_t j = 0; j < setup.cutter.pitch.size(); ++j) {
    for (const double angle : theta) {
      for (const Slice& slice : slices) {
        grid.h.push_back(slice.chip_thickness(j, angle));
      }
    }
  }
  return grid;
}

}  // namespace trochoid::force
