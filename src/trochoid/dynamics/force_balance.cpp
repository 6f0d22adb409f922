#include <trochoid/dynamics/force_balance.h>

#include <algorithm>
#include <cmath>

namespace trochoid::dynamics {

namespace {

using Plane = std::array<double, 2>;
using ResponseOf = std::function<Response(const Force& F_g)>;

/// Directions tried, and halvings along one.
constexpr int most_directions = 60;
constexpr int most_halvings = 60;
/// A direction has done its part when so much of the difference is left.
constexpr double enough = 0.25;
constexpr double least_degree = 1e-4;

double size_of(const Plane& v) {
  return std::hypot(v[0], v[1]);
}

/// A guess, the force there, and the displacement between both.
struct Trial {
  Force guess{};
  Response there;
  Plane off{};  ///< [N]
  Plane r{};    ///< [m]
};

struct Balance {
  const ResponseOf& response_of;
  StepCompliance compliance;
  double share = 1.0;  ///< of the compliance

  [[nodiscard]] Trial trial(const Force& guess) const {
    Trial at{.guess = guess,
             .there = response_of({share * guess[0], share * guess[1], 0.0})};
    const auto& P = compliance.P;
    at.off = {at.there.F[0] - guess[0], at.there.F[1] - guess[1]};
    at.r = {P[0] * at.off[0] + P[1] * at.off[1], P[1] * at.off[0] + P[2] * at.off[1]};
    return at;
  }

  [[nodiscard]] Trial along(const Trial& from, const Plane& d, double t) const {
    return trial({from.guess[0] + t * d[0], from.guess[1] + t * d[1], 0.0});
  }

  /// The step of T-6; the difference itself where that has no finite one.
  [[nodiscard]] Plane newton(const Trial& at) const {
    const auto& J = at.there.per_q;
    const auto& P = compliance.P;
    const std::array<double, 4> damped = speed_feedback(at.there, compliance.V);
    const double a = 1 - J[0] * P[0] - J[1] * P[1] - damped[0];
    const double b = -J[0] * P[1] - J[1] * P[2] - damped[1];
    const double c = -J[2] * P[0] - J[3] * P[1] - damped[2];
    const double d = 1 - J[2] * P[1] - J[3] * P[2] - damped[3];
    const double det = a * d - b * c;
    const Plane step = {(d * at.off[0] - b * at.off[1]) / det,
                        (a * at.off[1] - c * at.off[0]) / det};
    return std::isfinite(step[0] + step[1]) ? step : at.off;
  }

  /// Nearer to where the difference along d has no component along itself at t = 0.
  [[nodiscard]] Trial best_along(const Trial& from, const Plane& d) const {
    const auto ahead = [&](const Trial& at) {
      return at.r[0] * from.r[0] + at.r[1] * from.r[1];
    };
    Trial best = along(from, d, 1.0);
    double low = 0.0;
    double high = ahead(best) < 0 ? 1.0 : 2.0;
    for (int k = 0; k < most_halvings && size_of(best.r) > enough * size_of(from.r);
         ++k) {
      const double t = 0.5 * (low + high);
      const Trial middle = along(from, d, t);
      (ahead(middle) < 0 ? high : low) = t;
      if (size_of(middle.r) < size_of(best.r)) {
        best = middle;
      }
    }
    return best;
  }
};

Trial nearest_balance(const Balance& balance, const Force& guess, double tolerance) {
  Trial best = balance.trial(guess);
  for (int k = 0; k < most_directions && size_of(best.r) > tolerance; ++k) {
    Trial next = balance.best_along(best, balance.newton(best));  // T-12
    if (!(size_of(next.r) < size_of(best.r))) {
      next = balance.best_along(best, best.off);
    }
    if (!(size_of(next.r) < size_of(best.r))) {
      break;
    }
    best = next;
  }
  return best;
}

/// From a tool that does not yield to one that does, by degrees.
Trial yielding_by_degrees(const Balance& whole, double tolerance) {
  Trial at = whole.trial({});
  Force F = at.there.F;
  double reached = 0.0;
  for (double step = 0.25; reached < 1 && step > least_degree;) {
    Balance part = whole;
    part.share = std::min(1.0, reached + step);
    for (auto* values : {&part.compliance.P, &part.compliance.V}) {
      for (double& value : *values) value *= part.share;
    }
    at = nearest_balance(part, F, tolerance);
    const bool found = size_of(at.r) <= tolerance;
    F = found ? at.guess : F;
    reached = found ? part.share : reached;
    step *= found ? 2.0 : 0.5;
  }
  return whole.trial(F);
}

}  // namespace

ForceBalance balanced_force(const ResponseOf& response_of,
                            const StepCompliance& compliance, const Force& F_g,
                            double tolerance) {
  const Balance balance{response_of, compliance};
  Trial best = nearest_balance(balance, F_g, tolerance);
  if (size_of(best.r) > tolerance) {
    const Trial other = yielding_by_degrees(balance, tolerance);
    if (size_of(other.r) < size_of(best.r)) {
      best = other;
    }
  }
  return {{best.guess[0], best.guess[1], best.there.F[2]},
          size_of(best.off),
          size_of(best.r)};
}

}  // namespace trochoid::dynamics
