#include <trochoid/correction/amplitude.h>

#include <boost/math/tools/minima.hpp>
#include <boost/math/tools/toms748_solve.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace trochoid::correction {

namespace {

/// Factors between which the answer is looked for.
constexpr std::array<double, 9> factors = {0.0, 0.5, 0.9, 1.1, 1.3, 1.6, 2.0, 3.0, 4.0};
constexpr int bits = 30;          ///< of a root
constexpr int minimum_bits = 12;  ///< of a minimum

/// What is to be equal.
struct Goal {
  double Flute::*value = nullptr;
  FlutesOf flutes;
};

Goal goal_of(Target target, const RigidCut& cut, const FlutesOf& flutes) {
  const bool area = target == Target::chip_area;
  Goal goal{value_of(target), flutes};
  if (!flutes) {
    goal.flutes = [&cut, area](const PeriodicMotion& X) {
      return area ? cut.flutes(X) : cut.peaks(X);
    };
  }
  return goal;
}

/// v_j over their mean, less 1.
std::vector<double> differences(const Goal& goal, const PeriodicMotion& X) {
  std::vector<double> v;
  double mean = 0.0;
  for (const Flute& f : goal.flutes(X)) {
    v.push_back(f.*goal.value);
    mean += v.back();
  }
  mean /= static_cast<double>(v.size());
  for (double& x : v) {
    x = mean > 0 ? x / mean - 1 : 0.0;
  }
  return v;
}

double size_of(const std::vector<double>& v) {
  double sum = 0.0;
  for (const double x : v) {
    sum += x * x;
  }
  return sum;
}

/// R-10, from the rms with factors 0, 1 and 2: e is linear in the factor.
double least_squares_factor(const RigidCut& cut, const PeriodicMotion& X) {
  const auto cost = [&](double a) {
    const double rms = chip_rms(cut, scaled(X, a));
    return rms * rms;
  };
  const double at_0 = cost(0);
  const double at_1 = cost(1);
  const double at_2 = cost(2);
  const double bend = at_0 - 2 * at_1 + at_2;  // 2 sum of g^2
  return bend > 0 ? (3 * at_0 - 4 * at_1 + at_2) / (2 * bend) : 0.0;
}

/// R-9 for two teeth.
double root_factor(const Goal& goal, const PeriodicMotion& X, std::string& reason) {
  const auto f = [&](double factor) {
    const auto v = differences(goal, scaled(X, factor));
    return v[0] - v[1];
  };
  double last = f(factors[0]);
  if (last == 0) {
    reason = "the flutes cut alike without any motion";
    return 0.0;
  }
  for (std::size_t i = 1; i < factors.size(); ++i) {
    const double next = f(factors[i]);
    if ((last > 0) != (next > 0)) {
      std::uintmax_t most = 40;
      const auto bracket = boost::math::tools::toms748_solve(
          f, factors[i - 1], factors[i], last, next,
          boost::math::tools::eps_tolerance<double>(bits), most);
      return (bracket.first + bracket.second) / 2;
    }
    last = next;
  }
  reason = "no amplitude of this motion up to four times its levels makes them equal";
  return 1.0;
}

/// R-9 for more teeth.
double best_factor(const Goal& goal, const PeriodicMotion& X, std::string& reason) {
  const auto f = [&](double factor) {
    return size_of(differences(goal, scaled(X, factor)));
  };
  std::array<double, factors.size()> cost{};
  std::transform(factors.begin(), factors.end(), cost.begin(), f);
  const auto least = static_cast<std::size_t>(
      std::min_element(cost.begin(), cost.end()) - cost.begin());
  if (least == 0) {
    reason = "no amplitude of this motion makes the flutes more alike";
    return 0.0;
  }
  std::uintmax_t most = 30;
  return boost::math::tools::brent_find_minima(
             f, factors[least - 1], factors[std::min(least + 1, factors.size() - 1)],
             minimum_bits, most)
      .first;
}

void finish(const RigidCut& cut, const FlutesOf& flutes, Amplitude& out) {
  out.ok = out.reason.empty();
  out.peak_to_peak = range_of(out.motion).peak_to_peak();
  out.flutes = flutes ? flutes(out.motion) : cut.flutes(out.motion);
  out.peak_difference = peak_difference(out.flutes);
}

}  // namespace

Amplitude amplitude_for(Target target, const RigidCut& cut, const PeriodicMotion& X,
                        const FlutesOf& flutes) {
  Amplitude out;
  out.motion = X;
  if (range_of(X).peak_to_peak() == 0) {
    out.reason = "this motion does not move";
    finish(cut, flutes, out);
    return out;
  }
  if (target == Target::least_squares) {
    out.factor = least_squares_factor(cut, X);
  } else {
    const Goal goal = goal_of(target, cut, flutes);
    out.factor = cut.teeth() == 2 ? root_factor(goal, X, out.reason)
                                  : best_factor(goal, X, out.reason);
  }
  out.motion = scaled(X, out.factor);
  finish(cut, flutes, out);
  return out;
}

}  // namespace trochoid::correction
