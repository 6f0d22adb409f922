#include <fmt/core.h>
#include <trochoid/base/units.h>
#include <trochoid/signal/harmonic_fit.h>
#include <trochoid/signal/spindle_speed.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>
#include <set>
#include <stdexcept>

namespace trochoid::signal {

namespace {

using Complex = std::complex<double>;
constexpr int few_orders = 12;  ///< all of them where they hold the tooth passing
constexpr int score_parts = 20;

/// Orders that are looked at: below nine tenths of half the sampling rate.
std::vector<int> used_orders(const SpeedSearch& search, double mean_step) {
  std::set<int> orders{1, 2, 3, 4};
  for (int m = 1; m <= 3; ++m) orders.insert(m * search.teeth);
  if (3 * search.teeth <= few_orders) {
    for (int k = 5; k <= few_orders; ++k) orders.insert(k);
  }
  const double highest = 0.9 * std::numbers::pi / (mean_step * search.Omega * 1.05);
  std::vector<int> out;
  std::copy_if(orders.begin(), orders.end(), std::back_inserter(out),
               [&](int k) { return k <= highest; });
  return out;
}

TimedSamples centred(const Record& record) {
  TimedSamples s;
  const double middle = 0.5 * (record.time.front() + record.time.back());
  s.t.resize(record.size());
  std::transform(record.time.begin(), record.time.end(), s.t.begin(),
                 [&](double t) { return t - middle; });
  for (std::size_t c = 0; c < 3; ++c) {
    s.channel[c] = record.channel[c];
    const double mean = std::reduce(s.channel[c].begin(), s.channel[c].end()) /
                        static_cast<double>(record.size());
    for (double& y : s.channel[c]) y -= mean;
  }
  return s;
}

/// Sums of y e^(-i k Omega0 t) over short pieces, so that any speed close to Omega0 can
/// be tried at the cost of one term a piece.
struct Pieces {
  double Omega0 = 0.0;
  std::vector<double> t;  ///< middles
  std::vector<int> orders;
  std::vector<std::array<Complex, 3>> sum;  ///< shape (pieces, orders)
};

Pieces make_pieces(const TimedSamples& s, std::span<const int> orders, double Omega0,
                   std::size_t a_turn) {
  Pieces p{Omega0, {}, {orders.begin(), orders.end()}, {}};
  const double span = unit::turn / (Omega0 * static_cast<double>(a_turn));
  const auto count = static_cast<std::size_t>((s.t.back() - s.t.front()) / span) + 1;
  p.t.resize(count);
  p.sum.resize(count * orders.size());
  for (std::size_t b = 0; b < count; ++b) {
    p.t[b] = s.t.front() + (static_cast<double>(b) + 0.5) * span;
  }
  for (std::size_t n = 0; n < s.t.size(); ++n) {
    const auto b =
        std::min(count - 1, static_cast<std::size_t>((s.t[n] - s.t.front()) / span));
    for (std::size_t k = 0; k < orders.size(); ++k) {
      const Complex e = std::polar(1.0, -orders[k] * Omega0 * s.t[n]);
      for (std::size_t c = 0; c < 3; ++c) {
        p.sum[b * orders.size() + k][c] += s.channel[c][n] * e;
      }
    }
  }
  return p;
}

/// Squared harmonics of the pieces from `first` to `last` at a speed.
double power(const Pieces& p, double Omega, std::size_t first, std::size_t last) {
  double total = 0.0;
  for (std::size_t k = 0; k < p.orders.size(); ++k) {
    std::array<Complex, 3> sum{};
    const double rate = -p.orders[k] * (Omega - p.Omega0);
    const double step = p.t.size() > 1 ? p.t[1] - p.t[0] : 0.0;
    Complex e = std::polar(1.0, rate * p.t[first]);
    const Complex next = std::polar(1.0, rate * step);
    for (std::size_t b = first; b < last; ++b) {
      for (std::size_t c = 0; c < 3; ++c) {
        sum[c] += p.sum[b * p.orders.size() + k][c] * e;
      }
      e = {e.real() * next.real() - e.imag() * next.imag(),
           e.real() * next.imag() + e.imag() * next.real()};
    }
    for (const auto& z : sum) total += std::norm(z);
  }
  return total;
}

struct Candidate {
  double Omega = 0.0;
  bool at_edge = false;
};

/// Best speed of a grid of 2 n + 1 speeds about a middle.
Candidate best_of(const Pieces& p, double middle, double step, int n,
                  std::array<std::size_t, 2> part) {
  double best = -1.0;
  int at = 0;
  for (int j = -n; j <= n; ++j) {
    const double value = power(p, middle + j * step, part[0], part[1]);
    if (value > best) {
      best = value;
      at = j;
    }
  }
  return {middle + at * step, std::abs(at) == n};
}

/// Coarse search on some turns in the middle, then on ever longer parts.
Candidate search_grid(const Pieces& p, const SpeedSearch& search, std::size_t a_turn) {
  const auto count = p.t.size();
  const int highest = p.orders.back();
  const auto turns =
      static_cast<std::size_t>(std::clamp(800 / highest, 4, 64)) * a_turn;
  auto width = std::min(count, turns);
  const auto part = [&](std::size_t w) {
    return std::array<std::size_t, 2>{(count - w) / 2, (count - w) / 2 + w};
  };
  // A step that changes the phase of the highest order by an eighth turn at the ends.
  const auto step_of = [&](std::size_t w) {
    const double time = static_cast<double>(w) * unit::turn /
                        (search.Omega * static_cast<double>(a_turn));
    return unit::turn / (4.0 * highest * time);
  };
  double step = step_of(width);
  const int steps = static_cast<int>(std::ceil(search.range * search.Omega / step));
  auto found =
      best_of(p, search.Omega, search.range * search.Omega / steps, steps, part(width));
  if (found.at_edge) return found;
  while (width < count) {
    width = std::min(count, 2 * width);
    step = step_of(width);
    found = {best_of(p, found.Omega, step, 5, part(width)).Omega, false};
  }
  return found;
}

double standard_error(const TimedSamples& s, std::span<const int> orders,
                      const HarmonicFit& fit) {
  const double n = 3.0 * static_cast<double>(s.t.size());
  const double p = 3.0 * static_cast<double>(orders.size()) + 1.0;
  const double white = std::sqrt(fit.rss / std::max(n - p, 1.0) / fit.curvature);
  double squares = 0.0;
  for (const double g : scores(s, orders, fit, score_parts)) squares += g * g;
  return std::max(white, std::sqrt(squares) / fit.curvature);
}

SpeedEstimate refused(std::string why) {
  return {.ok = false, .message = std::move(why)};
}

SpeedEstimate refine(const TimedSamples& s, std::span<const int> orders,
                     const SpeedSearch& search, double Omega) {
  HarmonicFit fit;
  const double tight = 1e-9 * search.Omega;  // the step after it is beyond rounding
  for (int round = 0; round < 20; ++round) {
    fit = fit_harmonics(s, orders, Omega);
    if (!fit.ok || !(fit.curvature > 0.0)) {
      return refused("The record does not determine its own periodicity.");
    }
    Omega += std::clamp(fit.step, -0.01 * search.Omega, 0.01 * search.Omega);
    if (std::abs(fit.step) < tight) break;
  }
  double total = 0.0;
  for (const auto& channel : s.channel) {
    total += std::inner_product(channel.begin(), channel.end(), channel.begin(), 0.0);
  }
  SpeedEstimate e;
  e.explained = 1.0 - fit.rss / total;
  if (e.explained < 0.1) {
    return refused(fmt::format(
        "Only {:.1f} % of the force varies with the spindle: the speed cannot be "
        "determined.",
        100.0 * e.explained));
  }
  if (std::abs(Omega - search.Omega) > search.range * search.Omega) {
    return refused("The record is not periodic at any speed near the stated one.");
  }
  e.ok = true;
  e.Omega = Omega;
  e.se = standard_error(s, orders, fit);
  return e;
}

}  // namespace

SpeedEstimate spindle_speed(const Record& record, const SpeedSearch& search) {
  if (!(search.Omega > 0.0) || !(search.range > 0.0 && search.range < 0.5) ||
      search.teeth < 1) {
    throw std::invalid_argument("spindle_speed: speed, range or teeth out of range");
  }
  if (record.time.size() != record.size() || record.size() < 2) {
    return refused("The record has no times, so the speed cannot be determined.");
  }
  const double duration = record.time.back() - record.time.front();
  const double turns = duration * search.Omega / unit::turn;
  if (turns < 2.0) {
    return refused(
        fmt::format("The record lasts {:.2f} revolutions of the stated speed; "
                    "2 are needed to tell the speed.",
                    turns));
  }
  const auto orders =
      used_orders(search, duration / static_cast<double>(record.size() - 1));
  if (orders.empty()) {
    return refused("The record is sampled too rarely to show the spindle frequency.");
  }
  const auto s = centred(record);
  if (std::all_of(s.channel.begin(), s.channel.end(), [](const auto& channel) {
        return std::all_of(channel.begin(), channel.end(),
                           [](double y) { return std::abs(y) < 1e-12; });
      })) {
    return refused("The record is constant: the speed cannot be determined.");
  }
  // Pieces so short that the whole range of speeds turns the highest order by less
  // than an eighth of a turn within one.
  const auto a_turn =
      static_cast<std::size_t>(std::ceil(8.0 * search.range * orders.back()) + 4.0);
  const auto pieces = make_pieces(s, orders, search.Omega, a_turn);
  const auto found = search_grid(pieces, search, a_turn);
  if (found.at_edge) {
    return refused(
        fmt::format("Nothing within {:.0f} % of the stated speed is "
                    "periodic: the best is at the edge of the search.",
                    100.0 * search.range));
  }
  return refine(s, two_sided(orders), search, found.Omega);
}

std::vector<double> angle_from_time(std::span<const double> time, double Omega) {
  std::vector<double> angle(time.size());
  std::transform(time.begin(), time.end(), angle.begin(),
                 [&](double t) { return Omega * (t - time.front()); });
  return angle;
}

}  // namespace trochoid::signal
