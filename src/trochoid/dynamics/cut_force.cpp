#include <trochoid/dynamics/cut_force.h>

#include <trochoid/chip/chip.h>
#include <trochoid/dynamics/power_of.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace trochoid::dynamics {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
/// q at the delayed moment.
Displaced delayed(const EngagedGrid& grid, std::size_t node, std::size_t tooth,
                  std::size_t m, const History& past) noexcept {
  if (grid.delays.empty()) {
    const auto back = -static_cast<std::ptrdiff_t>((m + 1) * grid.pitch);
    return {past.x[back], past.y[back]};
  }
  const Delay& d = grid.delays[(node * grid.teeth + tooth) * grid.lookback + m];
  const auto a = -static_cast<std::ptrdiff_t>(d.back);
  const auto b = a + 1;
  const auto& w = d.weight;
  return {w[0] * past.x[a] + w[1] * past.x[b] + w[2] * past.dx[a] + w[3] * past.dx[b],
          w[0] * past.y[a] + w[1] * past.y[b] + w[2] * past.dy[a] + w[3] * past.dy[b]};
}

/// Force per width at the thinnest chip that counts [N/m]: with an exponent near 1 a power
/// law is a jump there.
double least_force(const force::Terms& law) {
  double sum = 0.0;
  for (std::size_t e = 0; e < 2; ++e) {
    const double m = law.form.power ? law.form.m[e] : 0.0;
    sum += std::abs(law.K[e]) * chip::h_threshold *
           std::pow(chip::h_threshold / force::h_0, -m);
  }
  return sum;
}

}  // namespace

NearPower::NearPower(double m, std::size_t teeth) : m_(m), anchors_(teeth) {
  double coefficient = 1.0;
  for (std::size_t k = 0; k < series_.size(); ++k) {
    series_[k] = coefficient;
    coefficient *= -(m + static_cast<double>(k)) / static_cast<double>(k + 1);
  }
}

double NearPower::renew(Anchor& anchor, double h) const noexcept {
  anchor = {1 / h, power_of(h / force::h_0, -m_)};
  return anchor.value;
}

force::Terms flank_terms(const force::Setup& setup) noexcept {
  force::Terms flank = force::damping_terms(setup.process_damping);
  const double v = setup.cutter.profile.D / 2 * setup.cut.Omega;
  for (double& K : flank.K) {
    K /= v;
  }
  return flank;
}

CutForce::CutForce(const force::Law& law, const EngagedGrid& grid,
                   const force::Terms& flank)
    : grid_(grid), law_(force::terms(law)), flank_(flank) {
  std::size_t most = 1;
  double most_edge = 0.0;
  double most_width = 0.0;
  for (const auto* ranges : {&grid.before, &grid.after}) {
    for (const Contacts& range : *ranges) {
      std::size_t points = 0;
      double edge = 0.0;
      double width = 0.0;
      for (std::size_t k = range.first; k < range.last; ++k) {
        const Stretch& stretch = grid.stretches[k];
        points += stretch.count;
        for (std::size_t i = 0; i < stretch.count; ++i) {
          edge += grid.edge[stretch.first + i];
          width += grid.width[stretch.first + i];
        }
      }
      most = std::max(most, points);
      most_edge = std::max(most_edge, edge);
      most_width = std::max(most_width, width);
    }
  }
  constant_.resize(most);
  marks_.resize(grid.lookback);
  watched_.assign(grid.teeth, none);
  crossings_.reserve(grid.teeth);
  const auto& [form, K, K_e] = law_;
  damps_ = flank.K[0] != 0 || flank.K[1] != 0;
  watches_ = grid.one_point && (K_e[0] != 0 || K_e[1] != 0 || damps_);
  jump_per_speed_ = 2 * std::hypot(flank.K[0], flank.K[1]) * most_width;
  largest_jump_ =
      2 * (std::hypot(K_e[0], K_e[1]) * most_edge + least_force(law_) * most_width);
  if (!form.power) {
    return;
  }
  const auto& m = form.m;
  axial_ = K[2] != 0 || K_e[2] != 0;
  for (std::size_t e = 0; e < m.size(); ++e) {
    directions_[e] = {m[e], 1 - m[e], K[e], e, NearPower(m[e], grid.teeth)};
    for (std::size_t other = e; other-- > 0;) {
      if (directions_[other].same_as == other && (m[other] == m[e] || K[e] == 0)) {
        directions_[e].same_as = other;
      }
    }
  }
}

void CutForce::prepare_edges(std::size_t node, const History& past) noexcept {
  double* least = constant_.data();
  const std::size_t begin =
      contacts_.first < contacts_.last ? grid_.stretches[contacts_.first].first : 0;
  points_ = points_at(begin, 0);
  for (std::size_t k = contacts_.first; k < contacts_.last; ++k) {
    const Stretch& stretch = grid_.stretches[k];
    for (std::size_t m = 0; m < grid_.lookback; ++m) {
      marks_[m] = delayed(grid_, node, stretch.tooth, m, past);
    }
    chips_over_marks(points_at(stretch.first, stretch.count),
                     grid_.above.data() + stretch.marks, marks_, least);
    least += stretch.count;
    points_.count += stretch.count;
  }
}

PointsInCut CutForce::points_at(std::size_t first, std::size_t count) const noexcept {
  return {count, grid_.sine.data() + first, grid_.cosine.data() + first,
          grid_.width.data() + first, grid_.edge.data() + first};
}

Response CutForce::edge_response(double q_x, double q_y) const noexcept {
  const ForceSums sums = force_of_points(points_, constant_.data(), {q_x, q_y}, law_);
  Response out;
  std::copy_n(sums.begin(), out.F.size(), out.F.begin());
  std::copy_n(sums.begin() + out.F.size(), out.per_q.size(), out.per_q.begin());
  return out;
}

void CutForce::add_damping(const std::array<double, 2>& q,
                           const std::array<double, 2>& v,
                           Response& out) const noexcept {
  auto& B = out.per_speed;  // T-16
  if (grid_.one_point) {
    for (std::size_t k = contacts_.first; k < contacts_.last; ++k) {
      if (chip(k - contacts_.first, k, q[0], q[1]) > chip::h_threshold) {
        Response point;
        const double w = grid_.width[k];
        add(grid_.sine[k], grid_.cosine[k], {}, {flank_.K[0] * w, flank_.K[1] * w, 0.0},
            point);
        for (std::size_t a = 0; a < B.size(); ++a) B[a] += point.per_q[a];
      }
    }
  } else {  // what a chip of that law would make is what its speed makes
    const ForceSums sums =
        force_of_points(points_, constant_.data(), {q[0], q[1]}, flank_);
    std::copy_n(sums.begin() + out.F.size(), B.size(), B.begin());
  }
  out.F[0] += B[0] * v[0] + B[1] * v[1];
  out.F[1] += B[2] * v[0] + B[3] * v[1];
}

std::vector<std::pair<std::size_t, double>> CutForce::chips(double q_x,
                                                            double q_y) const {
  std::vector<std::pair<std::size_t, double>> chips;
  std::size_t at = 0;
  for (std::size_t k = contacts_.first; k < contacts_.last; ++k) {
    const Stretch& stretch = grid_.stretches[k];
    chips.emplace_back(stretch.tooth, chip(at, stretch.first, q_x, q_y));
    at += stretch.count;
  }
  return chips;
}

void CutForce::remember_chips(double q_x, double q_y) noexcept {
  std::fill(watched_.begin(), watched_.end(), none);
  for (std::size_t k = contacts_.first; k < contacts_.last; ++k) {
    watched_[grid_.stretches[k].tooth] = chip(k - contacts_.first, k, q_x, q_y);
  }
}

void CutForce::find_crossings(const std::array<double, 2>& q,
                              const std::array<double, 2>& v) noexcept {
  crossings_.clear();
  for (std::size_t k = contacts_.first; k < contacts_.last; ++k) {
    const double from = watched_[grid_.stretches[k].tooth];
    const double to = chip(k - contacts_.first, k, q[0], q[1]);
    const bool crosses = from > 0 ? to <= 0 : (from <= 0 && to > 0);  // NaN: neither
    if (!crosses) {
      continue;
    }
    const double s = grid_.sine[k];
    const double c = grid_.cosine[k];
    const double e = (to > 0 ? 1 : -1) * grid_.edge[k];
    const double pressed = grid_.width[k] / grid_.edge[k] * (v[0] * s + v[1] * c);
    const double K_t = law_.K_e[0] + flank_.K[0] * pressed;
    const double K_r = law_.K_e[1] + flank_.K[1] * pressed;
    crossings_.push_back(
        {from / (from - to),
         {-e * (K_t * c + K_r * s), e * (K_t * s - K_r * c), -e * law_.K_e[2]}});
  }
}

}  // namespace trochoid::dynamics
