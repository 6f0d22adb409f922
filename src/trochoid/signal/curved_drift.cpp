#include <trochoid/signal/curved_drift.h>

#include <trochoid/base/units.h>
#include <trochoid/numerics/least_squares.h>
#include <trochoid/signal/drift.h>
#include <trochoid/signal/wander.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

namespace trochoid::signal {

namespace {

using Channels = std::array<std::vector<double>, 3>;

/// Fewer turns of the cut tell no curve.
constexpr std::size_t least_turns_of_cut = 12;
/// The first and last of a cut may have a part of entry or exit in them.
constexpr std::size_t turns_beside_entry = 2;
constexpr int highest_order = 6;
/// Of a drift that is known on one side of the cut only.
constexpr int highest_order_one_sided = 3;
/// What another order has to gain in the sum of weighted squares.
constexpr double gain_of_order = 2.0;
/// What a curve has to gain over a straight line.
constexpr double gain_of_curve = 25.0;
/// Means that leave more than this a degree of freedom follow no curve.
constexpr double most_left = 4.0;
/// The scatter of a mean is no less than this part of the force.
constexpr double least_scatter = 1e-3;
/// So many triples of neighbouring turns tell a scatter. That of the cut, which is no less,
/// stands for the air where it has fewer.
constexpr double least_triples = 8.0;
/// A force that grows by more, and by so many standard errors, is not steady.
constexpr double much_growth = 0.02;
constexpr double sure_growth = 4.0;

/// The mean of a turn.
struct TurnMean {
  double x = 0.0;  ///< -1 to 1 over the record
  double mean = 0.0;
  double variance =
      0.0;  ///< of the mean, were all that varies within the turn white noise
  bool cuts = false;
};

/// Whole turns of a part.
void add_turns(std::span<const double> y, std::span<const double> angle,
               const Part& part, bool cuts, std::vector<TurnMean>& out) {
  std::size_t begin = part.begin;
  for (std::size_t i = part.begin; i < part.end; ++i) {
    if (angle[i] < angle[begin] + unit::turn - 1e-9) continue;
    const auto turn = y.subspan(begin, i - begin);
    const auto n = static_cast<double>(turn.size());
    const double mean = std::accumulate(turn.begin(), turn.end(), 0.0) / n;
    double squares = 0.0;
    for (const double v : turn) squares += (v - mean) * (v - mean);
    const double middle = 0.5 * static_cast<double>(begin + i - 1);
    out.push_back({2 * middle / static_cast<double>(y.size() - 1) - 1, mean,
                   squares / (n * n), cuts});
    begin = i;
  }
}

/// How means of turns scatter about what changes slowly: by what three neighbours leave of a
/// straight line.
class Scatter {
 public:
  /// @param turns  one after the other
  void add(std::span<const TurnMean> turns) {
    for (std::size_t b = 2; b < turns.size(); ++b) {
      const double left = turns[b - 2].mean - 2 * turns[b - 1].mean + turns[b].mean;
      squares_ += left * left / 6;
      count_ += 1;
    }
  }
  /// @return standard deviation; nothing: too few turns tell it
  [[nodiscard]] std::optional<double> value() const {
    return count_ >= least_triples ? std::optional(std::sqrt(squares_ / count_))
                                   : std::nullopt;
  }

 private:
  double squares_ = 0.0;
  double count_ = 0.0;
};

/// Legendre polynomials one after the other, each from the two before it.
class Legendre {
 public:
  explicit Legendre(double x) : x_(x) {}
  [[nodiscard]] double value() const noexcept { return now_; }
  void next() noexcept {
    const double higher = ((2 * n_ + 1) * x_ * now_ - n_ * before_) / (n_ + 1);
    before_ = now_;
    now_ = higher;
    n_ += 1;
  }

 private:
  double x_;
  double n_ = 0.0;
  double before_ = 0.0;
  double now_ = 1.0;
};

/// @param from  order of the first term that counts
double sum_of(std::span<const double> terms, double x, std::size_t from = 0) {
  double sum = 0.0;
  Legendre P(x);
  for (std::size_t n = 0; n < terms.size(); ++n) {
    if (n >= from) sum += terms[n] * P.value();
    P.next();
  }
  return sum;
}

struct Curve {
  std::vector<double> terms;
  double squares = 0.0;  ///< left, in squares of the scatter
  double F_se = 0.0;     ///< of the mean force in the cut, from the scatter [N]
};

/// The means of the turns of one channel, and how far each scatters.
struct Means {
  std::vector<TurnMean> turns;
  double in_air = 0.0;
  double in_cut = 0.0;
  std::size_t of_air = 0;  ///< turns, which come first
};

/// @return nothing: the turns do not tell so many terms
std::optional<Curve> curve_of(const Means& means, int order) {
  const std::size_t first = means.of_air > 0 ? 0 : 1;  // without air a_0 is in F
  const std::size_t n = static_cast<std::size_t>(order) + 2 - first;
  std::vector<double> A;
  std::vector<double> b;
  for (const TurnMean& turn : means.turns) {
    const double weight = 1 / (turn.cuts ? means.in_cut : means.in_air);
    Legendre P(turn.x);
    for (std::size_t k = 0; k <= static_cast<std::size_t>(order); ++k) {
      if (k >= first) A.push_back(weight * P.value());
      P.next();
    }
    A.push_back(turn.cuts ? weight : 0.0);
    b.push_back(weight * turn.mean);
  }
  if (b.size() < n + 4) return std::nullopt;
  const auto fit = numerics::least_squares(A, static_cast<int>(n), b, 1e-9);
  if (fit.rank < static_cast<int>(n)) return std::nullopt;
  Curve curve{.terms = std::vector<double>(first, 0.0),
              .squares = fit.rss,
              .F_se = std::sqrt(fit.inverse_gram.back())};
  curve.terms.insert(curve.terms.end(), fit.x.begin(), fit.x.end() - 1);
  return curve;
}

/// @return nothing where a straight line does as well
std::optional<Curve> curve_through(const Means& means, int highest) {
  std::optional<Curve> best;
  double least = 0.0;
  double straight = 0.0;
  for (int order = 1; order <= highest; ++order) {
    const std::optional<Curve> curve = curve_of(means, order);
    if (!curve) break;
    const double score = curve->squares + gain_of_order * order;
    straight = order == 1 ? score : straight;
    if (best && score >= least) continue;
    best = curve;
    least = score;
  }
  if (!best || best->terms.size() < 3 || straight - least < gain_of_curve) {
    return std::nullopt;
  }
  const auto free = static_cast<double>(means.turns.size() - best->terms.size() - 1);
  best->F_se *= std::sqrt(std::max(1.0, best->squares / free));
  return best->squares < most_left * free ? best : std::nullopt;
}

/// How far means of turns in air scatter at least: a few of them may agree by chance.
double white_noise_of(std::span<const TurnMean> air) {
  if (air.empty()) return 0.0;
  double sum = 0.0;
  for (const TurnMean& turn : air) sum += turn.variance;
  return std::sqrt(sum / static_cast<double>(air.size()));
}

/// Means of the turns of a channel, and how far they scatter.
/// @return nothing: the cut is too short, or there is no force
std::optional<Means> means_of(std::span<const double> y, std::span<const double> angle,
                              std::span<const Part> idle, const Part& cut) {
  Means means;
  Scatter in_air;
  for (const Part& part : idle) {
    const std::size_t first = means.turns.size();
    add_turns(y, angle, part, false, means.turns);
    in_air.add(std::span(means.turns).subspan(first));
  }
  means.of_air = means.turns.size();
  add_turns(y, angle, cut, true, means.turns);
  const std::size_t of_cut = means.turns.size() - means.of_air;
  if (of_cut < least_turns_of_cut + 2 * turns_beside_entry) return std::nullopt;
  const auto first = means.turns.begin() + static_cast<std::ptrdiff_t>(means.of_air);
  means.turns.erase(first, first + turns_beside_entry);
  means.turns.resize(means.turns.size() - turns_beside_entry);
  const auto forces = y.subspan(cut.begin, cut.size());
  const double squares =
      std::inner_product(forces.begin(), forces.end(), forces.begin(), 0.0);
  const double least =
      least_scatter * std::sqrt(squares / static_cast<double>(cut.size()));
  if (!(least > 0)) return std::nullopt;
  Scatter in_cut;
  in_cut.add(std::span(means.turns).subspan(means.of_air));
  const double white = white_noise_of(std::span(means.turns).first(means.of_air));
  means.in_cut = std::max({in_cut.value().value_or(0.0), white, least});
  means.in_air = std::max({in_air.value().value_or(means.in_cut), white, least});
  return means;
}

bool grows(const Channels& channels, std::span<const double> angle, const Part& cut) {
  Channels of_cut;
  for (std::size_t c = 0; c < 3; ++c) {
    const std::span<const double> all(channels[c]);
    const auto part = all.subspan(cut.begin, cut.size());
    of_cut[c].assign(part.begin(), part.end());
  }
  const Growth found = growth_of_force(of_cut, angle.subspan(cut.begin, cut.size()));
  return std::abs(found.growth) > std::max(much_growth, sure_growth * found.se);
}

}  // namespace

CurvedDrift curved_drift(const Channels& channels, std::span<const double> angle,
                         std::span<const Part> idle, const Part& cut) {
  CurvedDrift out;
  if (grows(channels, angle, cut)) return out;
  const auto before = [&](const Part& part) { return part.end <= cut.begin; };
  const bool around =
      std::ranges::any_of(idle, before) && !std::ranges::all_of(idle, before);
  for (std::size_t c = 0; c < 3; ++c) {
    const std::optional<Means> means = means_of(channels[c], angle, idle, cut);
    if (!means) continue;
    const bool air = means->of_air > 0;
    auto curve =
        curve_through(*means, air && !around ? highest_order_one_sided : highest_order);
    if (!curve) continue;
    for (const TurnMean& turn : std::span(means->turns).subspan(means->of_air)) {
      const double bend = sum_of(curve->terms, turn.x, 2);
      out.bend[c] = std::max(out.bend[c], std::abs(bend));
    }
    out.offset_se[c] = air ? curve->F_se : 0.0;
    out.terms[c] = std::move(curve->terms);
  }
  return out;
}

RemovedDrift remove_drift(Channels& channels, std::span<const double> angle,
                          std::span<const Part> idle, const Part& cut) {
  RemovedDrift out;
  if (const auto line = idle_drift(channels, angle, idle, cut)) {
    remove_drift(channels, *line);
    out.offset = true;
    out.offset_se = line->se_in_cut;
  }
  const CurvedDrift curve = curved_drift(channels, angle, idle, cut);
  out.bend = curve.bend;
  for (std::size_t c = 0; c < 3; ++c) {
    if (curve.terms[c].empty()) continue;
    const double last = static_cast<double>(channels[c].size()) - 1;
    for (std::size_t i = 0; i < channels[c].size(); ++i) {
      channels[c][i] -= sum_of(curve.terms[c], 2 * static_cast<double>(i) / last - 1);
    }
    out.offset_se[c] = curve.offset_se[c];
  }
  return out;
}

std::vector<double> remove_drift(std::vector<std::vector<double>>& channels,
                                 std::span<const double> angle,
                                 std::span<const Part> idle, const Part& cut) {
  std::vector<double> offset_se;
  for (std::size_t first = 0; first < channels.size(); first += 3) {
    Channels three;
    const std::size_t count = std::min<std::size_t>(3, channels.size() - first);
    for (std::size_t c = 0; c < 3; ++c) {
      three[c] = c < count ? std::move(channels[first + c])
                           : std::vector<double>(angle.size(), 0.0);
    }
    const RemovedDrift removed = remove_drift(three, angle, idle, cut);
    for (std::size_t c = 0; c < count; ++c) {
      channels[first + c] = std::move(three[c]);
      offset_se.push_back(removed.offset_se[c]);
    }
  }
  return offset_se;
}

}  // namespace trochoid::signal
