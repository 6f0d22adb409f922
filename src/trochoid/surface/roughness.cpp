#include <trochoid/surface/roughness.h>

#include <trochoid/numerics/gauss_kronrod.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

namespace trochoid::surface {
namespace {

/// Parts of a piece in which a height goes through its mean, or turns, once at most.
constexpr int parts_of_piece = 12;
constexpr double unbounded = std::numeric_limits<double>::infinity();

/// @brief A stretch of x on which a height is smooth.
struct Stretch {
  double from = 0.0;
  double to = 0.0;
  std::function<double(double)> height;
};

double root_between(const Stretch& s, double low, double high, double level) {
  const bool rises = s.height(low) < level;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) break;
    ((s.height(middle) < level) == rises ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// Lowest value (sign 1), or the negative of the highest (sign -1), near a sample.
double extreme_near(const Stretch& s, double low, double high, double sign) {
  constexpr double golden = 0.381966011250105;
  double a = low + golden * (high - low);
  double b = high - golden * (high - low);
  double at_a = sign * s.height(a);
  double at_b = sign * s.height(b);
  for (int i = 0; i < 60 && high - low > 1e-12; ++i) {
    if (at_a < at_b) {
      high = b;
      b = a;
      at_b = at_a;
      a = low + golden * (high - low);
      at_a = sign * s.height(a);
    } else {
      low = a;
      a = b;
      at_a = at_b;
      b = high - golden * (high - low);
      at_b = sign * s.height(b);
    }
  }
  return std::min(at_a, at_b);
}

struct Extremes {
  double lowest = unbounded;
  double highest = -unbounded;

  void add(double value) noexcept {
    lowest = std::min(lowest, value);
    highest = std::max(highest, value);
  }
};

void add_extremes(const Stretch& s, Extremes& out) {
  const double step = (s.to - s.from) / parts_of_piece;
  std::array<double, parts_of_piece + 1> z;
  for (int i = 0; i <= parts_of_piece; ++i) {
    z[static_cast<std::size_t>(i)] =
        s.height(i == parts_of_piece ? s.to : s.from + i * step);
    out.add(z[static_cast<std::size_t>(i)]);
  }
  for (std::size_t i = 0; i < z.size(); ++i) {
    const double before = z[i == 0 ? 0 : i - 1];
    const double after = z[std::min(i + 1, z.size() - 1)];
    const double low = s.from + step * static_cast<double>(i == 0 ? 0 : i - 1);
    const double high = std::min(s.to, s.from + step * static_cast<double>(i + 1));
    if (z[i] <= before && z[i] <= after) out.add(extreme_near(s, low, high, 1.0));
    if (z[i] >= before && z[i] >= after) out.add(-extreme_near(s, low, high, -1.0));
  }
}

/// Integral of f(height) over a stretch.
template <class Function>
double integral(const Stretch& s, double from, double to, const Function& f) {
  const numerics::KronrodRule& rule = numerics::kronrod_rule();
  const double half = 0.5 * (to - from);
  double sum = 0.0;
  for (std::size_t i = 0; i < rule.t.size(); ++i) {
    sum += rule.kronrod[i] * f(s.height(from + half * (1 + rule.t[i])));
  }
  return half * sum;
}

/// Integral of |z - level|, cut where z passes the level.
double integral_of_distance(const Stretch& s, double level) {
  const double step = (s.to - s.from) / parts_of_piece;
  double sum = 0.0;
  const auto distance = [&](double z) { return std::abs(z - level); };
  for (int i = 0; i < parts_of_piece; ++i) {
    const double from = s.from + i * step;
    const double to = i + 1 == parts_of_piece ? s.to : from + step;
    if ((s.height(from) < level) != (s.height(to) < level)) {
      const double root = root_between(s, from, to, level);
      sum += integral(s, from, root, distance) + integral(s, root, to, distance);
    } else {
      sum += integral(s, from, to, distance);
    }
  }
  return sum;
}

/// R_a, R_q and extremes of stretches about a level.
Roughness roughness_of(const std::vector<Stretch>& all, double level, double length) {
  Roughness out{.mean = level};
  Extremes ends;
  double square = 0.0;
  for (const Stretch& s : all) {
    out.Ra += integral_of_distance(s, level) / length;
    square +=
        integral(s, s.from, s.to, [&](double z) { return (z - level) * (z - level); });
    add_extremes(s, ends);
  }
  out.Rq = std::sqrt(square / length);
  out.lowest = ends.lowest;
  out.highest = ends.highest;
  out.Rt = ends.highest - ends.lowest;
  out.Rz = out.Rt;
  return out;
}

std::vector<Stretch> stretches(const PeriodicProfile& p) {
  std::vector<Stretch> all;
  for (std::size_t i = 0; i + 1 < p.breaks.size(); ++i) {
    if (!(p.breaks[i + 1] > p.breaks[i])) continue;
    all.push_back(
        {p.breaks[i], p.breaks[i + 1], [&p, i](double x) { return p.height(i, x); }});
  }
  return all;
}

double mean_height(const std::vector<Stretch>& all, double length) {
  double sum = 0.0;
  for (const Stretch& s : all) {
    sum += integral(s, s.from, s.to, [](double z) { return z; });
  }
  return sum / length;
}

/// @brief What a Gaussian filter takes away: the mean line of a periodic profile.
class MeanLine {
 public:
  MeanLine(const PeriodicProfile& p, double cutoff)
      : wave_(2 * std::numbers::pi / p.period) {
    constexpr double nothing = 40.0;  // exp(-40) is below rounding
    const double alpha = std::sqrt(std::numbers::ln2 / std::numbers::pi);
    const std::vector<Stretch> all = stretches(p);
    mean_ = mean_height(all, p.period);
    for (int k = 1;; ++k) {
      const double x = alpha * cutoff * k / p.period;
      const double exponent = std::numbers::pi * x * x;  // W-2
      if (exponent > nothing) break;
      add_harmonic(all, k, 2 * std::exp(-exponent) / p.period);
    }
  }

  [[nodiscard]] double operator()(double x) const noexcept {
    double sum = mean_;
    for (std::size_t k = 0; k < cosine_.size(); ++k) {
      const double angle = wave_ * static_cast<double>(k + 1) * x;
      sum += cosine_[k] * std::cos(angle) + sine_[k] * std::sin(angle);
    }
    return sum;
  }

 private:
  void add_harmonic(const std::vector<Stretch>& all, int k, double weight) {
    double c = 0.0;
    double s = 0.0;
    for (const Stretch& part : all) {
      // Short enough that a rule of 15 nodes follows the wave.
      const auto count = static_cast<int>(
          std::ceil((part.to - part.from) * wave_ * k / std::numbers::pi));
      const double step = (part.to - part.from) / std::max(count, 1);
      const numerics::KronrodRule& rule = numerics::kronrod_rule();
      for (int i = 0; i < std::max(count, 1); ++i) {
        for (std::size_t node = 0; node < rule.t.size(); ++node) {
          const double x = part.from + step * (i + 0.5 * (1 + rule.t[node]));
          const double z = 0.5 * step * rule.kronrod[node] * (part.height(x) - mean_);
          c += z * std::cos(wave_ * k * x);
          s += z * std::sin(wave_ * k * x);
        }
      }
    }
    cosine_.push_back(weight * c);
    sine_.push_back(weight * s);
  }

  double wave_;
  double mean_ = 0.0;
  std::vector<double> cosine_;
  std::vector<double> sine_;
};

/// The pieces of a profile between two places, several periods on, less a line.
std::vector<Stretch> unrolled(const PeriodicProfile& p, const MeanLine& line,
                              double from, double to) {
  std::vector<Stretch> all;
  for (double n = std::floor(from / p.period); n * p.period < to; n += 1) {
    const double shift = n * p.period;
    for (std::size_t i = 0; i + 1 < p.breaks.size(); ++i) {
      const double a = std::max(from, p.breaks[i] + shift);
      const double b = std::min(to, p.breaks[i + 1] + shift);
      if (!(b > a)) continue;
      all.push_back({a, b, [&p, &line, i, shift](double x) {
                       return p.height(i, x - shift) - line(x - shift);
                     }});
    }
  }
  return all;
}

}  // namespace

Roughness roughness(const PeriodicProfile& profile) {
  const std::vector<Stretch> all = stretches(profile);
  return roughness_of(all, mean_height(all, profile.period), profile.period);
}

Roughness filtered_roughness(const PeriodicProfile& profile, double cutoff) {
  constexpr int lengths = 5;
  const MeanLine line(profile, cutoff);
  const double end = lengths * cutoff;
  const std::vector<Stretch> all = unrolled(profile, line, 0.0, end);
  Roughness out = roughness_of(all, 0.0, end);
  out.cutoff = cutoff;
  out.Rz = 0.0;
  for (int i = 0; i < lengths; ++i) {
    Extremes ends;
    for (const Stretch& s : unrolled(profile, line, i * cutoff, (i + 1) * cutoff)) {
      add_extremes(s, ends);
    }
    out.Rz += (ends.highest - ends.lowest) / lengths;
  }
  return out;
}

std::vector<double> shares(const PeriodicProfile& profile, std::size_t teeth) {
  std::vector<double> out(teeth, 0.0);
  for (std::size_t i = 0; i + 1 < profile.breaks.size(); ++i) {
    out[static_cast<std::size_t>(profile.tooth[i])] +=
        (profile.breaks[i + 1] - profile.breaks[i]) / profile.period;
  }
  return out;
}

ProfilePoint profile_at(const PeriodicProfile& profile, double x) {
  const double u = x - profile.period * std::floor(x / profile.period);
  const auto above =
      std::upper_bound(profile.breaks.begin(), profile.breaks.end() - 1, u);
  const auto i = static_cast<std::size_t>(
      std::max<std::ptrdiff_t>(above - profile.breaks.begin() - 1, 0));
  const std::size_t piece = std::min(i, profile.tooth.size() - 1);
  return {profile.height(piece, u), profile.tooth[piece]};
}

}  // namespace trochoid::surface
