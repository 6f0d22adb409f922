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

Slice::Own::Own(const Setup& setup, const chip::Passage& passage, double height)
    : edges(setup.cutter, runout_of(setup)), teeth(edges, passage) {
  teeth.stand_at(height);
}

Slice::Slice(const Setup& setup, double height)
    : alike_(edges_alike(setup)),
      passage_(chip::passage(setup.cutter, setup.cut, setup.chip)),
      own_(std::make_shared<const Own>(setup, passage_, height)) {
  if (!alike_) {
    return;
  }
  teeth_.resize(setup.cutter.pitch.size());
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
  return alike_ ? chip::chip_at(passage_, alike(), static_cast<int>(tooth), theta).h
                : own_->teeth.chip(tooth, theta).h;
}

int Slice::mark(std::size_t tooth, double theta) const noexcept {
  return chip_thickness(tooth, theta) > 0 ? own_->teeth.nearest_mark(tooth, theta) : 0;
}

std::vector<chip::Arc> Slice::engaged_arcs(std::size_t tooth) const {
  if (alike_) {
    return chip::engaged_arcs(passage_, alike(), static_cast<int>(tooth));
  }
  const chip::TeethAtHeight& own = own_->teeth;
  return own.there(tooth)
             ? chip::engaged_arcs(own.passage(), own.slice(tooth), own.place(tooth))
             : std::vector<chip::Arc>{};
}

std::vector<chip::ChipPiece> Slice::engaged_pieces(std::size_t tooth) const {
  constexpr double opposite = -90 * unit::deg;
  if (alike_) {
    return chip::engaged_pieces(passage_, alike(), static_cast<int>(tooth), opposite);
  }
  const chip::TeethAtHeight& own = own_->teeth;
  return own.there(tooth) ? chip::engaged_pieces(own.passage(), own.slice(tooth),
                                                 own.place(tooth), opposite)
                          : std::vector<chip::ChipPiece>{};
}

chip::Removal Slice::removal() const {
  if (alike_) {
    return chip::removal(passage_, alike());
  }
  const chip::TeethAtHeight& own = own_->teeth;
  for (std::size_t j = 0; j < own.teeth(); ++j) {
    if (own.there(j)) return chip::removal(own.passage(), own.slice(j));
  }
  return {};
}

Engagement engagement_at(const Setup& setup, double height) {
  const Slice slice(setup, height);
  Engagement engagement{.height = height};
  for (std::size_t j = 0; j < setup.cutter.pitch.size(); ++j) {
    ToothEngagement of_tooth{.arcs = slice.engaged_arcs(j)};
    for (const chip::ChipPiece& piece : slice.engaged_pieces(j)) {
      of_tooth.peak_chip = std::max(of_tooth.peak_chip, largest_chip(slice, j, piece));
    }
    engagement.teeth.push_back(std::move(of_tooth));
  }
  engagement.removal = slice.removal();
  return engagement;
}

double representative_height(const Setup& setup) {
  const geometry::Meridian m = geometry::meridian(setup.cutter.profile);
  const bool reaches_axis =
      geometry::point_at(m, 0.0).r <= 1e-9 * setup.cutter.profile.D;
  if (reaches_axis || edges_alike(setup)) {
    return reaches_axis ? setup.cut.a_p : 0.0;
  }
  // The lowest at which all teeth are there that reach the stock.
  const geometry::ToothEdges edges(setup.cutter, runout_of(setup));
  double height = 0.0;
  for (std::size_t j = 0; j < edges.teeth(); ++j) {
    const double lowest = edges.lowest_height(j);
    if (lowest < setup.cut.a_p) height = std::max(height, lowest);
  }
  return height;
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

std::vector<std::size_t> idle_teeth(const ChipCurve& curve) {
  constexpr double hardly = 0.02;
  std::vector<double> peaks;
  for (const auto& h : curve.h) peaks.push_back(std::ranges::max(h));
  const double peak = peaks.empty() ? 0.0 : std::ranges::max(peaks);
  std::vector<std::size_t> idle;
  for (std::size_t j = 0; j < peaks.size() && peak > 0.0; ++j) {
    if (peaks[j] < hardly * peak) idle.push_back(j);
  }
  return idle;
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
        grid.mark.push_back(slice.mark(j, angle));
      }
    }
  }
  return grid;
}

EdgeGrid edge_grid(const Setup& setup, std::span<const double> heights) {
  const geometry::ToothEdges edges(setup.cutter, runout_of(setup));
  EdgeGrid grid{.height = {heights.begin(), heights.end()}, .edges = {}, .lowest = {}};
  for (const double height : heights) {
    for (std::size_t j = 0; j < edges.teeth(); ++j) {
      grid.edges.push_back(edges.edge_at(j, height));
      if (setup.edge_length == EdgeLength::axial) grid.edges.back().dS_dz = 1.0;
    }
  }
  for (std::size_t j = 0; j < edges.teeth(); ++j) {
    grid.lowest.push_back(edges.lowest_height(j));
  }
  return grid;
}

}  // namespace trochoid::force
