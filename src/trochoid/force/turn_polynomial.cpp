#include <trochoid/force/turn_polynomial.h>

#include <trochoid/base/index.h>
#include <trochoid/base/units.h>
#include <trochoid/force/turn_waves.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace trochoid::force {
namespace {

/// @brief A stretch of theta on which the edge of the stock cuts the chip short, as a
/// polynomial of t in [-1, 1].
struct StockEdge {
  double from = 0.0;                                         ///< effective theta [rad]
  double to = 0.0;                                           ///< effective theta [rad]
  std::array<Triple, numerics::panel_nodes + 1> integral{};  ///< from `from` on

  [[nodiscard]] double half() const noexcept { return 0.5 * (to - from); }
};

/// Add as many as a piece of a tooth needs.
void add_stock_edges(const TurnTeeth& teeth, const TurnWeights& weights,
                     std::size_t tooth, const chip::HarmonicPiece& piece,
                     std::vector<StockEdge>& out);

/// The integral over all of it.
Triple total(const StockEdge& edge) noexcept;

/// The integrand as a polynomial of t.
std::array<Triple, numerics::panel_nodes + 1> integrand(const StockEdge& edge) noexcept;

using numerics::panel_nodes;
constexpr std::size_t wide = std::tuple_size_v<Triple>;
/// What the last terms of a panel may be, of the largest value.
constexpr double smallest_tail = 1e-10;
constexpr int most_halvings = 30;
/// Of a chip that is a difference of radii, of the radius.
constexpr double rounding = 1e-15;

struct Stretch {
  const TurnTeeth& teeth;
  const TurnWeights& weights;
  std::size_t tooth;

  [[nodiscard]] Triple at(double theta) const noexcept {
    const double nominal = theta - teeth.teeth[tooth].epsilon;
    const double h =
        chip::chip_at(teeth.passage, teeth.slice(), static_cast<int>(tooth), nominal).h;
    const double s = std::sin(theta);
    const double c = std::cos(theta);
    const TurnWeights& w = weights;
    Triple g{};
    for (std::size_t q = 0; q < wide; ++q) {
      g[q] = h * (w.h_cos[q] * c + w.h_sin[q] * s + w.h_one[q]) +
             teeth.edge_factor * (w.e_cos[q] * c + w.e_sin[q] * s + w.e_one[q]);
    }
    return g;
  }
};

using NodeValues = std::array<Triple, panel_nodes>;

/// What rounding makes of the values.
double noise_of(const Stretch& stretch) noexcept {
  const TurnWeights& w = stretch.weights;
  double most = 0.0;
  for (std::size_t q = 0; q < wide; ++q) {
    most = std::max(most,
                    std::abs(w.h_cos[q]) + std::abs(w.h_sin[q]) + std::abs(w.h_one[q]));
  }
  return rounding * stretch.teeth.r * most;
}

bool resolved(const NodeValues& y, double noise) noexcept {
  double largest = 0.0;
  double last = 0.0;
  for (std::size_t q = 0; q < wide; ++q) {
    for (const Triple& value : y) {
      largest = std::max(largest, std::abs(value[q]));
    }
    for (const auto& row : numerics::panel_rule().tail) {
      double c = 0.0;
      for (std::size_t i = 0; i < panel_nodes; ++i) {
        c += row[i] * y[i][q];
      }
      last = std::max(last, std::abs(c));
    }
  }
  return last <= std::max(smallest_tail * largest, noise);
}

void add(const Stretch& stretch, double from, double to, int halvings,
         std::vector<StockEdge>& out) {
  const numerics::PanelRule& rule = numerics::panel_rule();
  StockEdge edge{from, to};
  const double middle = 0.5 * (from + to);
  NodeValues y;
  for (std::size_t i = 0; i < panel_nodes; ++i) {
    y[i] = stretch.at(middle + edge.half() * rule.t[i]);
  }
  if (halvings < most_halvings && to - from > 1e-9 && !resolved(y, noise_of(stretch))) {
    add(stretch, from, middle, halvings + 1, out);
    add(stretch, middle, to, halvings + 1, out);
    return;
  }
  for (std::size_t k = 0; k <= panel_nodes; ++k) {
    for (std::size_t i = 0; i < panel_nodes; ++i) {
      for (std::size_t q = 0; q < wide; ++q) {
        edge.integral[k][q] += edge.half() * rule.antiderivative[k][i] * y[i][q];
      }
    }
  }
  out.push_back(edge);
}

void add_stock_edges(const TurnTeeth& teeth, const TurnWeights& weights,
                     std::size_t tooth, const chip::HarmonicPiece& piece,
                     std::vector<StockEdge>& out) {
  add({teeth, weights, tooth}, piece.from, piece.to, 0, out);
}

Triple total(const StockEdge& edge) noexcept {
  Triple sum{};
  for (const Triple& power : edge.integral) {
    for (std::size_t q = 0; q < wide; ++q) {
      sum[q] += power[q];
    }
  }
  return sum;
}

std::array<Triple, panel_nodes + 1> integrand(const StockEdge& edge) noexcept {
  std::array<Triple, panel_nodes + 1> out{};
  for (std::size_t k = 1; k <= panel_nodes; ++k) {
    for (std::size_t q = 0; q < wide; ++q) {
      out[k - 1][q] = static_cast<double>(k) * edge.integral[k][q] / edge.half();
    }
  }
  return out;
}

using base::index;
using chip::HarmonicPiece;

/// Below this lag F-11 would lose too many digits [rad].
constexpr double smallest_edge_lag = 1e-6;
/// A straight edge so close to where it starts or stops to cut does not cut [rad].
constexpr double tie = 1e-11;

/// Calls f with every multiple of a turn by which a stretch reaches into [0, 2 pi].
template <class Function>
void for_each_image(double from, double to, const Function& f) {
  for (double turns = -std::floor(to / unit::turn);
       from + turns * unit::turn < unit::turn; ++turns) {
    f(turns * unit::turn);
  }
}

/// Rows of a tooth over one mark.
struct MarkRows {
  int here = -1;  ///< of theta
  int tip = -1;   ///< of phi, as the tip meets it; for a short lag, the whole edge
  int top = -1;   ///< of phi, as the edge at a_p meets it
};

class Turn {
 public:
  Turn(const TurnTeeth& teeth, const TurnWeights& weights, int highest)
      : teeth_(teeth),
        given_(weights),
        weights_(weights),
        long_lag_(teeth.lag > smallest_edge_lag),
        factor_(long_lag_ ? teeth.a_p / teeth.lag : teeth.a_p),
        sum_(highest),
        highest_(highest),
        lag_turned_(long_lag_ ? teeth.lag : 0.5 * teeth.lag, highest) {}

  void add_tooth(std::size_t tooth) {
    tooth_ = tooth;
    behind_ = teeth_.behind[tooth];
    if (given_.arm_on_third) {
      weights_.h_one[2] = given_.h_one[2] * teeth_.teeth[tooth].R;
      weights_.e_one[2] = given_.e_one[2] * teeth_.teeth[tooth].R;
    }
    last_end_ = std::numeric_limits<double>::infinity();
    const chip::ToothHarmonics& harmonics = teeth_.harmonics_of(tooth);
    rows_.assign(harmonics.over_mark.size(), {});
    const Turned tip_turned(behind_, highest_);
    for (std::size_t i = 0; i < harmonics.pieces.size(); ++i) {
      const HarmonicPiece& piece = harmonics.pieces[i];
      if (piece.at_stock_edge) {
        add_at_stock_edge(piece);
        continue;
      }
      MarkRows& rows = rows_[index(piece.mark - 1)];
      if (rows.tip < 0) {
        make_rows(*harmonics.over_mark[index(piece.mark - 1)], tip_turned, rows);
      }
      if (long_lag_) {
        add_piece(piece, rows);
      } else {
        add_piece_of_short_lag(trimmed(harmonics.pieces, i), rows);
      }
    }
  }

  [[nodiscard]] TurnPolynomial finish() { return sum_.finish(); }

 private:
  void make_rows(const numerics::TrigPolynomial& h, const Turned& tip_turned,
                 MarkRows& rows) {
    const bool chip = highest_ > 1;
    std::array<Triple, waves_of(numerics::TrigPolynomial::most + 1)> space;
    std::array<Triple, space.size()> other_space;
    const WaveRow g = std::span(space).first(waves_of(highest_));
    const WaveRow other = std::span(other_space).first(waves_of(highest_));
    integrand(chip ? &h : nullptr, weights_, teeth_.edge_factor, g);
    if (long_lag_) {
      integrate(g, factor_, other);
      rows.here = sum_.keep(other);
      shift_back(other, tip_turned, 1.0, g);
    } else {
      rows.here = sum_.keep(g);
      shift_back(g, tip_turned, factor_, other);
      std::copy(other.begin(), other.end(), g.begin());
    }
    rows.tip = sum_.keep(g);
    shift_back(g, lag_turned_, 1.0, other);
    rows.top = sum_.keep(other);
  }

  void add_piece(const HarmonicPiece& piece, const MarkRows& rows) {
    if (piece.from != last_end_) {
      last_turned_ = Turned(piece.from, highest_);
    }
    const Triple at_from = scaled(waves_at(sum_.row(rows.here), last_turned_), -1.0);
    last_end_ = piece.to;
    last_turned_ = Turned(piece.to, highest_);
    const Triple at_to = scaled(waves_at(sum_.row(rows.here), last_turned_), -1.0);
    const double from = piece.from + behind_;
    const double to = piece.to + behind_;
    for_each_image(from, to + teeth_.lag, [&](double turned) {  // F-11
      sum_.step(from + turned, rows.tip, 1.0, at_from, TurnSum::Part::first);
      sum_.step(to + turned, rows.tip, -1.0, at_to, TurnSum::Part::middle);
      sum_.step(from + turned + teeth_.lag, rows.top, -1.0, at_from,
                TurnSum::Part::middle);
      sum_.step(to + turned + teeth_.lag, rows.top, 1.0, at_to, TurnSum::Part::last);
    });
  }

  void add_piece_of_short_lag(const HarmonicPiece& piece, const MarkRows& rows) {
    const double from = piece.from + behind_;
    const double to = piece.to + behind_;
    const double lag = teeth_.lag;
    if (!(to > from)) {
      return;
    }
    const TurnPanel begins = ramp(rows, piece.from, 1.0);
    const TurnPanel ends = ramp(rows, piece.to, -1.0);
    for_each_image(from, to + lag, [&](double turned) {  // F-13
      sum_.jump(from + turned + lag, rows.top, 1.0, TurnSum::Part::first);
      sum_.jump(to + turned + lag, rows.top, -1.0, TurnSum::Part::last);
      add_ramp(begins, from + turned);
      add_ramp(ends, to + turned);
    });
  }

  /// The share of the edge that is past b already: a_p (g x + g' lag x^2/2), x = (theta -
  /// b)/lag = (1 + t)/2.
  [[nodiscard]] TurnPanel ramp(const MarkRows& rows, double b, double sign) const {
    const ConstWaveRow g = sum_.row(rows.here);
    const Turned turned(b, highest_);
    const Triple value = waves_at(g, turned);
    const Triple slope = wave_slope_at(g, turned);
    TurnPanel panel{0.0, 2.0 / teeth_.lag};
    for (std::size_t q = 0; q < wide; ++q) {
      const double linear = sign * factor_ * (value[q] + g[0][q]) / 2;
      const double square = sign * factor_ * slope[q] * teeth_.lag / 8;
      panel.powers[0][q] = linear + square;
      panel.powers[1][q] = linear + 2 * square;
      panel.powers[2][q] = square;
    }
    return panel;
  }

  void add_ramp(TurnPanel panel, double from) {
    panel.from = from;
    sum_.panel(from, from + teeth_.lag, panel);
  }

  /// @brief Without lag the edge force jumps: a piece less a tie at each end in air.
  [[nodiscard]] HarmonicPiece trimmed(const std::vector<HarmonicPiece>& pieces,
                                      std::size_t i) const noexcept {
    HarmonicPiece piece = pieces[i];
    if (teeth_.lag > tie) {
      return piece;
    }
    const HarmonicPiece& before = pieces[i == 0 ? pieces.size() - 1 : i - 1];
    const HarmonicPiece& after = pieces[i + 1 == pieces.size() ? 0 : i + 1];
    const auto apart = [](double a, double b) {
      return std::abs(std::remainder(b - a, unit::turn)) > 1e-12;
    };
    if (apart(before.to, piece.from)) {
      piece.from += tie;
    }
    if (apart(piece.to, after.from)) {
      piece.to -= tie;
    }
    return piece;
  }

  void add_at_stock_edge(const HarmonicPiece& piece) {
    stock_edges_.clear();
    add_stock_edges(teeth_, weights_, tooth_, piece, stock_edges_);
    for (const StockEdge& edge : stock_edges_) {
      const double from = edge.from + behind_;
      const double to = edge.to + behind_;
      for_each_image(from, to + teeth_.lag, [&](double turned) {
        if (long_lag_) {
          add_stock_edge(edge, from + turned, 1.0);
          add_stock_edge(edge, from + turned + teeth_.lag, -1.0);
        } else {
          add_stock_edge_of_short_lag(edge, from + turned);
        }
      });
    }
  }

  void add_stock_edge(const StockEdge& edge, double from, double sign) {
    const double to = from + (edge.to - edge.from);
    TurnPanel panel{from, 1.0 / edge.half(), edge.integral};
    for (Triple& power : panel.powers) {
      power = scaled(power, sign * factor_);
    }
    sum_.panel(from, to, panel);
    sum_.constant(to, scaled(total(edge), sign * factor_),
                  sign > 0 ? TurnSum::Part::first : TurnSum::Part::last);
  }

  void add_stock_edge_of_short_lag(const StockEdge& edge, double from) {
    const double to = from + (edge.to - edge.from);
    TurnPanel panel{from + 0.5 * teeth_.lag, 1.0 / edge.half(), integrand(edge)};
    for (Triple& power : panel.powers) {
      power = scaled(power, factor_);
    }
    sum_.panel(from + teeth_.lag, to + teeth_.lag, panel);
    if (teeth_.lag > 0) {
      // The share past either end grows evenly.
      for (const double end : {-1.0, 1.0}) {
        TurnPanel share{0.0, 2.0 / teeth_.lag};
        for (std::size_t k = 0; k < panel.powers.size(); ++k) {
          const double at_end = k % 2 == 0 ? 1.0 : end;
          for (std::size_t q = 0; q < wide; ++q) {
            share.powers[0][q] -= 0.5 * end * at_end * panel.powers[k][q];
          }
        }
        share.powers[1] = share.powers[0];
        add_ramp(share, end < 0 ? from : to);
      }
    }
  }

  const TurnTeeth& teeth_;
  const TurnWeights& given_;
  TurnWeights weights_;  ///< of the tooth
  bool long_lag_;
  double factor_;  ///< lead, or a_p
  TurnSum sum_;
  int highest_;
  Turned lag_turned_;
  double last_end_ = 0.0;  ///< of the piece before, where the next one mostly begins
  Turned last_turned_{0.0, 0};
  std::size_t tooth_ = 0;
  double behind_ = 0.0;
  std::vector<MarkRows> rows_;
  std::vector<StockEdge> stock_edges_;
};

/// One more than the chips have, or 1 where only the edge counts.
int highest_harmonic(const TurnTeeth& teeth, const TurnWeights& weights) noexcept {
  int highest = 0;
  for (const auto* row : {&weights.h_cos, &weights.h_sin, &weights.h_one}) {
    if (*row == Triple{}) {
      continue;
    }
    for (const chip::ToothHarmonics& tooth : teeth.harmonics) {
      for (const HarmonicPiece& piece : tooth.pieces) {
        highest = std::max(highest, tooth.over_mark[index(piece.mark - 1)]->highest);
      }
    }
  }
  return highest + 1;
}

}  // namespace

TurnWeights force_weights(const Terms& law) noexcept {
  const auto& [K_t, K_r, K_a] = law.K;
  const auto& [K_te, K_re, K_ae] = law.K_e;
  return {.h_cos = {-K_t, -K_r, 0.0},
          .h_sin = {-K_r, K_t, 0.0},
          .h_one = {0.0, 0.0, -K_a},
          .e_cos = {-K_te, -K_re, 0.0},
          .e_sin = {-K_re, K_te, 0.0},
          .e_one = {0.0, 0.0, -K_ae}};
}

TurnWeights torque_weights(const Terms& law) noexcept {
  return {.h_one = {0.0, 0.0, law.K[0]},
          .e_one = {0.0, 0.0, law.K_e[0]},
          .arm_on_third = true};
}

TurnWeights chip_weights() noexcept {
  return {.h_cos = {0.0, 1.0, 0.0}, .h_sin = {1.0, 0.0, 0.0}, .h_one = {0.0, 0.0, 1.0}};
}

TurnWeights edge_weights() noexcept {
  return {.e_cos = {0.0, 1.0, 0.0}, .e_sin = {1.0, 0.0, 0.0}, .e_one = {0.0, 0.0, 1.0}};
}

TurnPolynomial turn_polynomial(const TurnTeeth& teeth, const TurnWeights& weights) {
  Turn turn(teeth, weights, highest_harmonic(teeth, weights));
  for (std::size_t j = 0; j < teeth.behind.size(); ++j) {
    turn.add_tooth(j);
  }
  return turn.finish();
}

}  // namespace trochoid::force
