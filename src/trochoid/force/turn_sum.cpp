#include "turn_sum.h"

#include <trochoid/base/units.h>

#include <algorithm>

namespace trochoid::force {

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
