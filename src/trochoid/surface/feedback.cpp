#include <trochoid/surface/feedback.h>

#include <trochoid/base/units.h>
#include <trochoid/surface/edge_nodes.h>
#include <trochoid/surface/fixed_point.h>
#include <trochoid/surface/turn.h>

#include <algorithm>
#include <atomic>
#include <cmath>

namespace trochoid::surface {

namespace {

using fixed_point::largest_of;
using fixed_point::Limits;
using fixed_point::solve_by_newton;
using fixed_point::solve_fixed_point;
using numerics::dot;
using Values = std::vector<double>;

/// One passage over the turn, with the deflections of the passage before as the past.
class Passage {
 public:
  Passage(const EdgeMoments& edges, std::span<const double, columns> K,
          const Compliance& compliance, Feedback feedback)
      : edges_(edges),
        K_(K),
        basis_(compliance.basis()),
        G_(compliance.rows(compliance.basis().points())),
        feedback_(feedback) {}

  /// u at the basis points over the spindle angle, or none: as straight as now.
  void remember(const numerics::PeriodicPieces* moments) {
    past_ = moments == nullptr ? numerics::PeriodicPieces{} : deflections(*moments);
  }

  /// Values of moments, F_x, F_y at phi; false where no state was found.
  bool at(double phi, const Limits& limits, std::span<double> out) const {
    const std::size_t points = basis_.size();
    Values u(points);
    if (past_.functions() > 0) {
      past_.value(phi, u);
    }
    Values unit(columns * edges_.values());
    Values before(edges_.back().size() * points);
    look_back(phi, before);
    const auto image = [&](const Values& state, Values& result) {
      forces(phi, state, before, unit, out);
      apply(out, result);
    };
    const Values start = u;
    if (solve_fixed_point(image, u, limits)) {
      return true;
    }
    u = start;
    if (solve_by_newton(image, u, limits)) {
      return true;
    }
    u.assign(points, 0.0);
    return solve_by_newton(image, u, limits);
  }

  [[nodiscard]] double largest_deflection(std::span<const double> moments) const {
    Values u(basis_.size());
    apply(moments, u);
    return largest_of(u);
  }

  [[nodiscard]] numerics::PeriodicPieces deflections(
      const numerics::PeriodicPieces& moments) const {
    const std::size_t points = basis_.size();
    Values weights(points * moments.functions());
    for (std::size_t p = 0; p < points; ++p) {
      std::copy_n(
          G_.begin() + static_cast<std::ptrdiff_t>(p * points), points,
          weights.begin() + static_cast<std::ptrdiff_t>(p * moments.functions()));
    }
    return moments.combined(weights);
  }

 private:
  void apply(std::span<const double> moments, Values& u) const {
    const std::size_t points = basis_.size();
    for (std::size_t p = 0; p < points; ++p) {
      u[p] = dot(std::span(G_).subspan(p * points, points), moments.first(points));
    }
  }

  /// Deflections when the teeth before each tooth left their marks, shape (teeth, teeth,
  /// points).
  void look_back(double phi, std::span<double> before) const {
    if (feedback_ != Feedback::regenerative || past_.functions() == 0) {
      return;
    }
    const std::span<const double> back = edges_.back();
    for (std::size_t k = 0; k < back.size(); ++k) {
      past_.value(phi - back[k], before.subspan(k * basis_.size(), basis_.size()));
    }
  }

  void forces(double phi, const Values& u, const Values& before, Values& unit,
              std::span<double> out) const {
    const bool chip_changes =
        feedback_ == Feedback::direct ||
        (feedback_ == Feedback::regenerative && past_.functions() > 0);
    NodeBend bend{.shift = u};
    if (chip_changes) {
      bend.before = before;
    }
    edges_.bent_at(phi, bend, unit);
    const std::size_t n = edges_.values();
    for (std::size_t q = 0; q < n; ++q) {
      out[q] = 0.0;
      for (std::size_t c = 0; c < columns; ++c) {
        out[q] += K_[c] * unit[c * n + q];
      }
    }
  }

  const EdgeMoments& edges_;
  std::span<const double, columns> K_;
  const numerics::LagrangeBasis& basis_;
  Values G_;  ///< deflection at the basis points from moments
  Feedback feedback_;
  numerics::PeriodicPieces past_;
};

/// Largest difference between two turns in the deflection, and the largest deflection.
std::pair<double, double> difference(const Passage& passage,
                                     const numerics::PeriodicPieces& a,
                                     const numerics::PeriodicPieces& b) {
  constexpr int samples = 180;
  Values x(a.functions());
  Values y(b.functions());
  double change = 0.0;
  double peak = 0.0;
  for (int i = 0; i < samples; ++i) {
    const double phi = unit::turn * (i + 0.5) / samples;
    a.value(phi, x);
    b.value(phi, y);
    peak = std::max(peak, passage.largest_deflection(x));
    for (std::size_t q = 0; q < x.size(); ++q) {
      x[q] -= y[q];
    }
    change = std::max(change, passage.largest_deflection(x));
  }
  return {change, peak};
}

}  // namespace

SteadyState steady_state(const EdgeMoments& edges, std::span<const double, columns> K,
                         const Compliance& compliance, Feedback feedback,
                         double tolerance) {
  Passage passage(edges, K, compliance, feedback);
  const auto rigid = [&](double phi, std::span<double> out) {
    Values unit(columns * edges.values());
    edges.at(phi, nullptr, unit);
    std::fill(out.begin(), out.end(), 0.0);
    for (std::size_t k = 0; k < unit.size(); ++k) {
      out[k % edges.values()] += K[k / edges.values()] * unit[k];
    }
  };
  const Values largest = largest_values(edges, 1, rigid);
  numerics::PeriodicPieces::Options options =
      panels_for(edges, edges.equal_teeth(), largest, tolerance);
  options.breaks = edges.kinks(true);
  const double rigid_deflection =
      passage.largest_deflection(Values(edges.values(), largest[0]));
  // A cutter that pulls itself in bends far beyond what a straight one would.
  const Limits limits{0.1 * tolerance * rigid_deflection, 20 * rigid_deflection};
  std::atomic<bool> found = true;
  const numerics::PeriodicPieces::Function f = [&](double phi, std::span<double> out) {
    // After the first failure nothing counts any more: flat tables end the search soon.
    if (!found || !passage.at(phi, limits, out)) {
      found = false;
      std::fill(out.begin(), out.end(), 0.0);
    }
  };
  const bool remembers = feedback == Feedback::regenerative && !edges.equal_teeth();
  SteadyState state{.moments = {f, options}, .turns = 1};
  constexpr int most_turns = 200;
  constexpr double settled = 10;  // the tables themselves are good to a few tolerances
  while (remembers && found && state.turns < most_turns) {
    passage.remember(&state.moments);
    numerics::PeriodicPieces next(f, options);
    const auto [change, peak] = difference(passage, state.moments, next);
    state.moments = std::move(next);
    ++state.turns;
    state.change = peak > 0 ? change / peak : 0.0;
    if (state.change <= settled * tolerance) {
      break;
    }
  }
  state.found = found;
  state.converged = found && (!remembers || state.change <= settled * tolerance);
  return state;
}

}  // namespace trochoid::surface
