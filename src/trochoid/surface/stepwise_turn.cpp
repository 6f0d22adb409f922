#include <trochoid/surface/stepwise_turn.h>

#include <trochoid/base/units.h>
#include <trochoid/force/edge_curve.h>
#include <trochoid/numerics/gauss_kronrod.h>
#include <trochoid/surface/edge_nodes.h>
#include <trochoid/surface/fixed_point.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <numbers>

namespace trochoid::surface {
namespace {

using Values = std::vector<double>;

constexpr std::size_t steps_per_pitch = 72;
constexpr std::size_t radii = 33;  ///< heights between which radii are interpolated
constexpr double settled = 2e-5;   ///< change of the deflection in a turn, of its peak
constexpr int most_turns = 100;
/// Panels of the table [rad], and how good it is, as a part of the largest value.
constexpr double longest_panel = 0.2;
constexpr double shortest_panel = 0.01;
constexpr double table_tolerance = 3e-5;
/// Parts of an edge shorter than this are taken as they are; ends of chips are found to
/// this part of the depth.
constexpr double shortest_part = 1e-7;
constexpr double resolution = 1e-9;
/// Exact paths cut a little before and behind where a circle does [rad].
constexpr double beyond = 0.06;

/// A value between equal steps of a turn, by the cubic through four of them.
void between_steps(std::span<const double> table, std::size_t steps, double phi,
                   std::span<double> out) {
  const std::size_t n = out.size();
  double at = phi / unit::turn;
  at = (at - std::floor(at)) * static_cast<double>(steps);
  const auto first = static_cast<std::size_t>(at) % steps;
  const double t = at - std::floor(at);
  const std::array<double, 4> w = {
      -t * (t - 1) * (t - 2) / 6, (t + 1) * (t - 1) * (t - 2) / 2,
      -(t + 1) * t * (t - 2) / 2, (t + 1) * t * (t - 1) / 6};
  std::fill(out.begin(), out.end(), 0.0);
  for (std::size_t i = 0; i < w.size(); ++i) {
    const double* row = table.data() + (first + steps + i - 1) % steps * n;
    for (std::size_t q = 0; q < n; ++q) {
      out[q] += w[i] * row[q];
    }
  }
}

/// The edges of a cylinder, and what they meet.
class Edges {
 public:
  Edges(const force::Setup& setup, const force::Law& law,
        std::span<const double, columns> K, const Compliance& compliance)
      : edges_(setup),
        form_(force::form(law)),
        K_(K),
        basis_(compliance.basis()),
        a_p_(setup.cut.a_p),
        R_(setup.cutter.profile.D / 2),
        point_(edges_.point(0.5 * edges_.ends.back())) {
    const std::size_t teeth = edges_.psi.size();
    positions_.resize(radii * teeth);
    for (std::size_t i = 0; i < radii; ++i) {
      const force::EdgePoint p =
          edges_.point(edges_.ends.back() * static_cast<double>(i) / (radii - 1));
      geometry::edge_positions(edges_.setup.runout, edges_.psi, p.meridian.r, p.lag,
                               std::span(positions_).subspan(i * teeth, teeth));
    }
    lag_ = edges_.lag_at_ends.back();
    near_.resize(teeth);
    gained_.resize(teeth);
    L_.resize(basis_.size());
    nodes_ = EdgeNodes::make(edges_, form_, basis_);
  }

  [[nodiscard]] std::size_t teeth() const { return edges_.psi.size(); }
  [[nodiscard]] std::span<const double> back() const { return edges_.passage.back; }

  /// m_q, F_x, F_y with the deflections u now and, of each tooth and mark, before.
  void forces(double phi, std::span<const double> u, std::span<const double> before,
              std::span<double> out) {
    if (nodes_) {
      forces_at_nodes(phi, {u, before}, out);
      return;
    }
    u_ = u;
    before_ = before;
    out_ = out;
    std::fill(out.begin(), out.end(), 0.0);
    for (std::size_t j = 0; j < teeth(); ++j) {
      double theta = phi - edges_.psi[j];
      theta -= unit::turn * std::floor(theta / unit::turn);
      for (; theta - lag_ < std::numbers::pi + beyond; theta += unit::turn) {
        add_tooth(j, theta);
      }
    }
  }

 private:
  void forces_at_nodes(double phi, const NodeBend& bend, std::span<double> out) const {
    MomentSums sums;
    nodes_->at(phi, &bend, sums);
    const std::size_t points = basis_.size();
    std::fill(out.begin(), out.end(), 0.0);
    for (std::size_t c = 0; c < columns; ++c) {
      for (std::size_t q = 0; q < points; ++q) {
        out[q] += K_[c] * sums.across[c][q];
      }
      out[points] += K_[c] * sums.along[c];
    }
    for (std::size_t q = 0; q < points; ++q) {
      out[points + 1] += out[q];
    }
  }

  /// One passage of a tooth whose tip is at theta.
  void add_tooth(std::size_t j, double theta) {
    if (lag_ < 1e-6) {
      add_part(j, theta, {0.0, a_p_});
      return;
    }
    const bool exact = edges_.setup.chip.model == chip::Model::trochoidal;
    const double more = exact ? beyond : 0.0;
    // Heights at which the edge passes angles, from the last angle down.
    std::array<double, 6> z = {height(theta, std::numbers::pi + more),
                               height(theta, std::numbers::pi),
                               passes(theta, j, edges_.passage.stock.y_hi),
                               passes(theta, j, edges_.passage.stock.y_lo),
                               height(theta, 0.0),
                               height(theta, -more)};
    std::sort(z.begin(), z.end());
    for (std::size_t i = 0; i + 1 < z.size(); ++i) {
      const double from = std::clamp(z[i], 0.0, a_p_);
      const double to = std::clamp(z[i + 1], 0.0, a_p_);
      if (to > from) {
        add_part(j, theta, {from, to});
      }
    }
  }

  [[nodiscard]] double height(double tip, double angle) const {
    return (tip - angle) / lag_ * a_p_;
  }

  /// Where the edge passes the edge of the stock.
  double passes(double tip, std::size_t j, double y) {
    double z = height(tip, 0.0);
    if (!(std::abs(y) < 2 * R_)) {
      return z;
    }
    double shift = 0.0;
    for (int k = 0; k < 3; ++k) {
      z = height(tip, std::acos(std::clamp((y - shift) / radius(j, z), -1.0, 1.0)));
      basis_.weights(std::clamp(z, 0.0, a_p_), L_);
      shift = numerics::dot(L_, u_);
    }
    return z;
  }

  void stand_at(double z) {
    const double at = std::clamp(z / a_p_, 0.0, 1.0) * (radii - 1);
    const auto i = std::min(static_cast<std::size_t>(at), radii - 2);
    const double t = at - static_cast<double>(i);
    for (std::size_t k = 0; k < near_.size(); ++k) {
      const geometry::EdgePosition& a = positions_[i * near_.size() + k];
      const geometry::EdgePosition& b = positions_[(i + 1) * near_.size() + k];
      near_[k] = {a.R + t * (b.R - a.R), a.epsilon + t * (b.epsilon - a.epsilon)};
    }
  }

  double radius(std::size_t j, double z) {
    stand_at(z);
    return near_[j].R;
  }

  /// Gauss points between two heights; where the chip ends between them, anew up to
  /// there: an edge force is not small at the end of a chip.
  void add_part(std::size_t j, double tip, std::array<double, 2> z) {
    const numerics::KronrodRule& rule = numerics::kronrod_rule();
    const double half = 0.5 * (z[1] - z[0]);
    std::array<double, 15> at{};
    std::array<chip::Chip, 15> chips;
    std::size_t count = 0;
    std::size_t cutting = 0;
    for (std::size_t i = 0; i < rule.t.size(); ++i) {
      if (rule.gauss[i] > 0) {
        at[count] = z[0] + half * (1 + rule.t[i]);
        chips[count] = chip_at(j, tip, at[count]);
        cutting += chips[count].in_cut ? std::size_t{1} : std::size_t{0};
        ++count;
      }
    }
    if (cutting == 0) {
      return;
    }
    if (cutting < count && z[1] - z[0] > shortest_part * a_p_) {
      std::size_t last = 0;
      while (chips[last + 1].in_cut == chips[0].in_cut) {
        ++last;
      }
      const double end = chip_end(j, tip, at[last], at[last + 1], chips[last].in_cut);
      add_part(j, tip, {z[0], end});
      add_part(j, tip, {end, z[1]});
      return;
    }
    count = 0;
    for (const double weight : rule.gauss) {
      if (weight > 0) {
        add_point(j, tip, at[count], half * weight, chips[count]);
        ++count;
      }
    }
  }

  /// Where between two heights the chip ends, `first` in cut or not.
  double chip_end(std::size_t j, double tip, double from, double to, bool first) {
    for (int k = 0; k < 40 && to - from > resolution * a_p_; ++k) {
      const double middle = 0.5 * (from + to);
      (chip_at(j, tip, middle).in_cut == first ? from : to) = middle;
    }
    return 0.5 * (from + to);
  }

  /// Leaves near_ and L_ at that height.
  chip::Chip chip_at(std::size_t j, double tip, double z) {
    stand_at(z);
    basis_.weights(z, L_);
    const double theta = tip - lag_ * z / a_p_;
    const double now = numerics::dot(L_, u_);
    chip::Slice slice{.r = R_, .teeth = near_, .shift = now, .bent = true};
    if (!before_.empty()) {
      const double cosine = std::cos(theta);
      const std::size_t n = L_.size();
      for (std::size_t m = 0; m < teeth(); ++m) {
        const double then =
            numerics::dot(L_, before_.subspan((j * teeth() + m) * n, n));
        gained_[m] = cosine * (now - then);  // E-10
      }
      slice.advance = gained_;
    }
    return chip::chip_at(edges_.passage, slice, static_cast<int>(j), theta);
  }

  void add_point(std::size_t j, double tip, double z, double dz,
                 const chip::Chip& chip) {
    if (!chip.in_cut) {
      return;
    }
    stand_at(z);
    basis_.weights(z, L_);
    const force::ColumnWeights w =
        force::column_weights(form_, chip.h, point_.meridian.sin_kappa, point_.dS);
    const double angle = tip - lag_ * z / a_p_ + near_[j].epsilon;
    const double s = std::sin(angle);
    const double c = std::cos(angle);
    const double t = K_[0] * w.cutting[0] + K_[2] * w.edge;
    const double r = K_[1] * w.cutting[1] + K_[3] * w.edge;
    const auto [x, y] = force::in_plane(t, r, s, c);
    const double F_y = dz * y;  // E-2
    for (std::size_t q = 0; q < L_.size(); ++q) {
      out_[q] += L_[q] * F_y;  // E-3
    }
    out_[L_.size()] += dz * x;
    out_[L_.size() + 1] += F_y;
  }

  force::Edges edges_;
  std::shared_ptr<const EdgeNodes> nodes_;
  force::Form form_;
  std::span<const double, columns> K_;
  const numerics::LagrangeBasis& basis_;
  double a_p_;
  double R_;
  double lag_ = 0.0;  ///< of the top behind the tip [rad]
  force::EdgePoint point_;
  std::vector<geometry::EdgePosition> positions_;  ///< shape (radii, teeth)
  std::vector<geometry::EdgePosition> near_;
  Values gained_;
  Values L_;
  std::span<const double> u_;  ///< what forces() was given
  std::span<const double> before_;
  std::span<double> out_;
};

/// u at the basis points from moments.
void deflect(std::span<const double> G, std::span<const double> moments,
             std::span<double> u) {
  for (std::size_t p = 0; p < u.size(); ++p) {
    u[p] = numerics::dot(G.subspan(p * u.size(), u.size()), moments.first(u.size()));
  }
}

double angle_of(std::size_t step, std::size_t steps) {
  return unit::turn * static_cast<double>(step) / static_cast<double>(steps);
}

/// A turn that is passed over until it repeats.
struct Turn {
  Edges& edges;
  std::span<const double> G;
  std::size_t points;
  Feedback feedback;
  StepwiseTurn& marched;
  Values past;  ///< u over the turn, the newest known

  [[nodiscard]] std::span<double> moments(std::size_t step) const {
    return std::span(marched.moments).subspan(step * (points + 2), points + 2);
  }

  void bend_all() {
    for (std::size_t k = 0; k < marched.steps; ++k) {
      deflect(G, moments(k), std::span(past).subspan(k * points, points));
    }
  }

  /// @return the largest change of u; negative: at some angle none was found
  double pass_once(const fixed_point::Limits& limits) {
    const bool remembers = feedback == Feedback::regenerative;
    const std::span<const double> back = edges.back();
    const bool chip_changes = remembers || feedback == Feedback::direct;
    Values before(chip_changes ? back.size() * points : 0);
    Values u(points);
    double change = 0.0;
    bool found = false;
    for (std::size_t k = 0; k < marched.steps; ++k) {
      const double phi = angle_of(k, marched.steps);
      for (std::size_t m = 0; remembers && m < back.size(); ++m) {
        between_steps(past, marched.steps, phi - back[m],
                      std::span(before).subspan(m * points, points));
      }
      std::copy_n(past.begin() + static_cast<std::ptrdiff_t>(k * points), points,
                  u.begin());
      const auto image = [&](const Values& state, Values& result) {
        edges.forces(phi, state, before, moments(k));
        deflect(G, moments(k), result);
      };
      const Values begin = u;
      // An edge force jumps where a chip ends: then only nearly so.
      for (const double wider : {1.0, 50.0, 500.0}) {
        u = begin;
        const fixed_point::Limits allowed{wider * limits.allowed, limits.largest};
        found = fixed_point::solve_fixed_point(image, u, allowed);
        if (!found) {
          u = begin;
          found = fixed_point::solve_by_newton(image, u, allowed);
        }
        if (found) {
          break;
        }
      }
      if (!found) {
        return -1.0;
      }
      for (std::size_t p = 0; p < points; ++p) {
        change = std::max(change, std::abs(u[p] - past[k * points + p]));
        past[k * points + p] = u[p];
      }
    }
    return change;
  }
};

}  // namespace

// six parameters: a cut with its law and coefficients, what bends, and where to begin
StepwiseTurn stepwise_steady_state(const force::Setup& setup, const force::Law& law,
                                   std::span<const double, columns> K,
                                   const Compliance& compliance, Feedback feedback,
                                   const StepwiseTurn* start) {
  Edges edges(setup, law, K, compliance);
  const std::size_t points = compliance.basis().size();
  StepwiseTurn marched{.steps = steps_per_pitch * edges.teeth()};
  marched.moments.resize(marched.steps * (points + 2));
  const Values G = compliance.rows(compliance.basis().points());
  Turn turn{edges, G, points, feedback, marched, Values(marched.steps * points)};
  const Values none(points);
  for (std::size_t k = 0; k < marched.steps; ++k) {
    edges.forces(angle_of(k, marched.steps), none, {}, turn.moments(k));
  }
  marched.straight = marched.moments;
  if (start != nullptr && start->moments.size() == marched.moments.size()) {
    marched.moments = start->moments;
  }
  turn.bend_all();
  const double peak = fixed_point::largest_of(turn.past);
  const fixed_point::Limits limits{0.2 * settled * peak, 20 * peak};
  const bool remembers = feedback == Feedback::regenerative;
  marched.converged = peak == 0;
  for (int t = 0; t < most_turns && !marched.converged; ++t) {
    const double change = turn.pass_once(limits);
    if (change < 0) {
      break;
    }
    marched.converged = change <= settled * peak || (!remembers && t > 0);
  }
  return marched;
}

numerics::PeriodicPieces with_feedback(const numerics::PeriodicPieces& straight,
                                       const StepwiseTurn& turn) {
  const std::size_t width = straight.functions();
  Values change = turn.moments;
  Values largest(width);
  for (std::size_t k = 0; k < change.size(); ++k) {
    largest[k % width] = std::max(largest[k % width], std::abs(change[k]));
    change[k] -= turn.straight[k];
  }
  const double everywhere = *std::max_element(largest.begin(), largest.end());
  numerics::PeriodicPieces::Options options{
      .period = unit::turn,
      .breaks = {straight.ends().begin(), straight.ends().end()},
      .longest = longest_panel,
      .shortest = shortest_panel};
  for (const double value : largest) {
    options.allowed.push_back(table_tolerance * (value > 0 ? value : everywhere));
  }
  return {[&](double phi, std::span<double> out) {
            Values more(width);
            straight.value(phi, out);
            between_steps(change, turn.steps, phi, more);
            std::transform(out.begin(), out.end(), more.begin(), out.begin(),
                           std::plus<>());
          },
          options};
}

}  // namespace trochoid::surface
