#include <trochoid/force/turn_waves.h>

#include <trochoid/base/units.h>

#include <algorithm>
#include <cmath>

namespace trochoid::force {
namespace {

/// h cos(x), h sin(x) and h, weighted, from the harmonic k of h with factors a and b:
/// cos(x) cos(k x) = (cos((k + 1) x) + cos((k - 1) x))/2, and so on.
void add_harmonic(const TurnWeights& w, std::size_t k, double a, double b,
                  WaveRow g) noexcept {
  const double half_a = 0.5 * a;
  const double half_b = 0.5 * b;
  const Triple even = mixed(w.h_cos, half_a, w.h_sin, half_b);
  const Triple odd = mixed(w.h_cos, half_b, w.h_sin, -half_a);
  g[2 * k - 1] = plus(g[2 * k - 1], w.h_one, a);
  g[2 * k] = plus(g[2 * k], w.h_one, b);
  g[2 * k + 1] = plus(g[2 * k + 1], mixed(w.h_cos, half_a, w.h_sin, -half_b), 1.0);
  g[2 * k + 2] = plus(g[2 * k + 2], mixed(w.h_cos, half_b, w.h_sin, half_a), 1.0);
  if (k == 1) {
    g[0] = plus(g[0], even, 1.0);
  } else {
    g[2 * k - 3] = plus(g[2 * k - 3], even, 1.0);
    g[2 * k - 2] = plus(g[2 * k - 2], odd, 1.0);
  }
}

}  // namespace

Turned::Turned(double angle, int highest) noexcept {
  const double c = std::cos(angle);
  const double s = std::sin(angle);
  cosine[0] = 1.0;
  sine[0] = 0.0;
  for (std::size_t k = 1; k <= static_cast<std::size_t>(highest); ++k) {
    cosine[k] = cosine[k - 1] * c - sine[k - 1] * s;
    sine[k] = sine[k - 1] * c + cosine[k - 1] * s;
  }
}

void integrand(const numerics::TrigPolynomial* h, const TurnWeights& weights,
               double edge_factor, WaveRow g) noexcept {
  std::fill(g.begin(), g.end(), Triple{});
  g[0] = scaled(weights.e_one, edge_factor);
  g[1] = scaled(weights.e_cos, edge_factor);
  g[2] = scaled(weights.e_sin, edge_factor);
  if (h == nullptr) {
    return;
  }
  g[0] = plus(g[0], weights.h_one, h->a[0]);
  g[1] = plus(g[1], weights.h_cos, h->a[0]);
  g[2] = plus(g[2], weights.h_sin, h->a[0]);
  for (std::size_t k = 1; k <= static_cast<std::size_t>(h->highest); ++k) {
    add_harmonic(weights, k, h->a[k], h->b[k], g);
  }
}

void integrate(ConstWaveRow g, double factor, WaveRow G) noexcept {
  G[0] = scaled(g[0], factor);
  for (std::size_t i = 1; i + 1 < g.size(); i += 2) {
    const std::size_t k = (i + 1) / 2;
    const double f = factor / static_cast<double>(k);
    G[i] = scaled(g[i + 1], -f);  // F-10
    G[i + 1] = scaled(g[i], f);
  }
}

void shift_back(ConstWaveRow p, const Turned& by, double factor, WaveRow out) noexcept {
  out[0] = scaled(p[0], factor);
  for (std::size_t i = 1; i + 1 < p.size(); i += 2) {
    const double c = factor * by.cosine[(i + 1) / 2];
    const double s = factor * by.sine[(i + 1) / 2];
    out[i] = mixed(p[i], c, p[i + 1], -s);
    out[i + 1] = mixed(p[i + 1], c, p[i], s);
  }
}

void add(ConstWaveRow p, double factor, WaveRow sum) noexcept {
  for (std::size_t i = 0; i < p.size(); ++i) {
    Triple next;  // read before anything is written, this becomes whole vectors
    for (std::size_t q = 0; q < next.size(); ++q) {
      next[q] = sum[i][q] + factor * p[i][q];
    }
    sum[i] = next;
  }
}

Triple waves_at(ConstWaveRow p, const Turned& x) noexcept {
  Triple out{};
  for (std::size_t i = 1; i + 1 < p.size(); i += 2) {
    out = plus(out, p[i], x.cosine[(i + 1) / 2]);
    out = plus(out, p[i + 1], x.sine[(i + 1) / 2]);
  }
  return out;
}

Triple wave_slope_at(ConstWaveRow p, const Turned& x) noexcept {
  Triple out{};
  for (std::size_t i = 1; i + 1 < p.size(); i += 2) {
    const std::size_t k = (i + 1) / 2;
    out = plus(out, p[i], -static_cast<double>(k) * x.sine[k]);
    out = plus(out, p[i + 1], static_cast<double>(k) * x.cosine[k]);
  }
  return out;
}

namespace {

/// Segments shorter than this are none [rad].
constexpr double shortest = 1e-14;

}  // namespace

TurnSum::TurnSum(int highest) : highest_(highest) {
  constexpr std::size_t usual = 32;  // rows, steps
  rows_.reserve(usual * waves_of(highest));
  steps_.reserve(usual);
}

int TurnSum::keep(ConstWaveRow row) {
  const std::size_t place = rows_.size() / waves_of(highest_);
  rows_.insert(rows_.end(), row.begin(), row.end());
  return static_cast<int>(place);
}

ConstWaveRow TurnSum::row(int place) const noexcept {
  const std::size_t count = waves_of(highest_);
  return std::span(rows_).subspan(static_cast<std::size_t>(place) * count, count);
}

void TurnSum::step(double at, int place, double sign, const Triple& constant,
                   Part part) {
  if (at >= unit::turn) {
    return;
  }
  steps_.push_back({at, place, sign, sign, part,
                    mixed(constant, sign, row(place).front(), -sign * at)});
}

void TurnSum::jump(double at, int place, double sign, Part part) {
  if (at < unit::turn) {
    steps_.push_back({at, place, 0.0, sign, part, scaled(row(place).front(), sign)});
  }
}

void TurnSum::constant(double at, const Triple& value, Part part) {
  if (at < unit::turn) {
    steps_.push_back({at, -1, 0.0, 0.0, part, value});
  }
}

void TurnSum::panel(double from, double to, const TurnPanel& panel) {
  if (from >= unit::turn || to <= 0 || !(to > from)) {
    return;
  }
  supports_.push_back({from, to, static_cast<int>(panels_.size())});
  panels_.push_back(panel);
  constant(from, {}, Part::first);  // segments end where panels do
  constant(to, {}, Part::last);
}

void TurnSum::apply(const Step& step, std::span<Triple> sum) const noexcept {
  sum[0] = plus(sum[0], step.constant, 1.0);
  if (step.place < 0) {
    return;
  }
  const ConstWaveRow p = row(step.place);
  sum[1] = plus(sum[1], p[0], step.linear);
  add(p.subspan(1), step.sign, sum.subspan(2));
}

TurnPolynomial TurnSum::finish() {
  std::vector<std::pair<double, int>> order;
  order.reserve(steps_.size() + 1);
  for (const Step& step : steps_) {
    order.emplace_back(step.at, static_cast<int>(order.size()));
  }
  std::sort(order.begin(), order.end());
  order.emplace_back(unit::turn, -1);
  TurnPolynomial turn;
  turn.highest = highest_;
  std::size_t segments = 1;
  for (std::size_t i = 0; i + 1 < order.size(); ++i) {
    if (order[i + 1].first > std::max(order[i].first, 0.0) + shortest) {
      ++segments;
    }
  }
  turn.ends.reserve(segments);
  turn.terms.reserve(segments * turn.terms_of_segment());
  std::vector<Triple> sum(turn.terms_of_segment());
  double from = 0.0;
  int open = 0;
  for (const auto& [at, place] : order) {
    if (at > from + shortest || place < 0) {
      turn.ends.push_back(at);
      turn.terms.insert(turn.terms.end(), sum.begin(), sum.end());
      from = at;
    }
    if (place >= 0) {
      const Step& step = steps_[static_cast<std::size_t>(place)];
      apply(step, sum);
      open += static_cast<int>(step.part);
      if (open == 0) {
        std::fill(sum.begin(), sum.end(), Triple{});
      }
    }
  }
  turn.panels = std::move(panels_);
  place_panels(turn);
  return turn;
}

void TurnSum::place_panels(TurnPolynomial& turn) const {
  turn.first_panel.assign(turn.ends.size() + 1, 0);
  if (supports_.empty()) {
    return;
  }
  double from = 0.0;
  for (std::size_t i = 0; i < turn.ends.size(); ++i) {
    const double middle = 0.5 * (from + turn.ends[i]);
    for (const Support& support : supports_) {
      if (support.from <= middle && middle < support.to) {
        turn.panel_places.push_back(support.panel);
      }
    }
    turn.first_panel[i + 1] = static_cast<int>(turn.panel_places.size());
    from = turn.ends[i];
  }
}

}  // namespace trochoid::force
