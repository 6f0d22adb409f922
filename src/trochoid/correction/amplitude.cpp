#include <trochoid/correction/amplitude.h>

#include <trochoid/correction/shapes.h>

#include <boost/math/tools/toms748_solve.hpp>

#include <array>
#include <cmath>
#include <cstdint>

namespace trochoid::correction {

namespace {

/// Factors between which the answer is looked for.
constexpr std::array<double, 9> factors = {0.0, 0.5, 0.9, 1.1, 1.3, 1.6, 2.0, 3.0, 4.0};
constexpr int bits = 30;  ///< of the factor

/// Sum of x_j v_j over the largest possible one: R-9.
double imbalance(const std::vector<double>& x, const std::vector<Flute>& flutes,
                 double Flute::*value) {
  double sum = 0.0;
  double size = 0.0;
  for (std::size_t j = 0; j < x.size(); ++j) {
    sum += x[j] * flutes[j].*value;
    size += std::abs(x[j] * flutes[j].*value);
  }
  return size > 0 ? sum / size : 0.0;
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

double root_factor(const std::function<double(double)>& f, std::string& reason) {
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

}  // namespace

Amplitude amplitude_for(Target target, const RigidCut& cut, const PeriodicMotion& X,
                        const FlutesOf& flutes) {
  const bool area = target == Target::chip_area;
  const FlutesOf of = flutes ? flutes : [&](const PeriodicMotion& motion) {
    return area ? cut.flutes(motion) : cut.peaks(motion);
  };
  const std::vector<double> x = levels(cut.offsets());
  Amplitude out;
  if (range_of(X).peak_to_peak() == 0) {
    out.reason = "this motion does not move";
    out.motion = X;
    out.flutes = cut.flutes(X);
    out.peak_difference = peak_difference(out.flutes);
    return out;
  }
  if (target == Target::least_squares) {
    out.factor = least_squares_factor(cut, X);
  } else {
    const auto f = [&](double factor) {
      return imbalance(x, of(scaled(X, factor)),
                       area ? &Flute::chip_area : &Flute::peak_y);
    };
    out.factor = root_factor(f, out.reason);
  }
  out.ok = out.reason.empty();
  out.motion = scaled(X, out.factor);
  out.peak_to_peak = range_of(out.motion).peak_to_peak();
  out.flutes = flutes ? flutes(out.motion) : cut.flutes(out.motion);
  out.peak_difference = peak_difference(out.flutes);
  return out;
}

}  // namespace trochoid::correction
