#include <trochoid/identification/reliability.h>

#include <trochoid/base/rounded.h>
#include <trochoid/base/units.h>
#include <trochoid/identification/fit.h>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace trochoid::identification {
namespace {

constexpr double too_much_unexplained = 0.5;
/// Of a coefficient, half of its interval: more is no knowledge, and more asks for care.
constexpr double unknown = 2.0 / 3.0;
constexpr double uncertain = 0.1;
/// A coefficient that is small beside the tangential one need not be known better than a
/// part of that.
constexpr double small_coefficient = 0.3;
/// Intervals so many times as wide as noise would make them stand on what is left, which then
/// is no noise at all; of coefficients that are known better than this it does not matter.
constexpr double much_wider = 10.0;
constexpr double well_known = 0.01;

double half_interval(const Estimate& K) {
  return 0.5 * (K.high - K.low);
}

/// What speaks against the coefficients of one group.
/// @param whose  ends the name of a coefficient
void add_reasons(const Group& group, const std::string& whose,
                 std::vector<std::string>& reasons) {
  const auto names = force::coefficient_quantities(group.law);
  const auto& K_t = group.coefficients[0];
  if (K_t && K_t->low <= 0 && K_t->high >= 0) {
    reasons.push_back(fmt::format("{}{} may be zero", names[0].key, whose));
  } else if (K_t && half_interval(*K_t) > unknown * std::abs(K_t->value)) {
    reasons.push_back(
        fmt::format("{}{} is known to {} only", names[0].key, whose,
                    base::percent(half_interval(*K_t) / std::abs(K_t->value))));
  }
  for (std::size_t q = 0; q < 2; ++q) {  // tangential and radial, cutting
    const auto& K = group.coefficients[q];
    if (K && K->high < 0) {
      reasons.push_back(
          fmt::format("{}{} is negative, which no cut does", names[q].key, whose));
    }
  }
}

}  // namespace

double correlation_factor(double r) noexcept {
  const double counted = std::clamp(r, 0.0, 0.999);
  return std::sqrt((1.0 + counted) / (1.0 - counted));
}

std::vector<std::string> reasons_against(const Fit& fit) {
  std::vector<std::string> reasons;
  const bool banded = fit.options.band_harmonics > 0;
  const bool noise = !banded && fit.residual_correlation <= noise_correlation;
  const double part = fit.unexplained.in_band;
  if (part > too_much_unexplained && !noise) {
    reasons.push_back(
        fmt::format("{} of the force (rms{}) is not explained", base::percent(part),
                    banded ? ", within the harmonics that were fitted" : ""));
  }
  for (const Group& group : groups_of(fit)) {
    add_reasons(group, of_group(fit, group), reasons);
  }
  return reasons;
}

std::vector<std::string> poorly_known(const Fit& fit) {
  std::vector<std::string> out;
  double worst = 0.0;
  for (const Group& group : groups_of(fit)) {
    const auto names = force::coefficient_quantities(group.law);
    const auto& K_t = group.coefficients[0];
    for (std::size_t q = 0; q < 3 && q < group.coefficients.size(); ++q) {
      const auto& K = group.coefficients[q];
      if (!K) continue;
      const double least = K_t ? small_coefficient * std::abs(K_t->value) : 0.0;
      const double half = half_interval(*K);
      const double part = half / std::max(std::abs(K->value), least);
      worst = std::max(worst, part);
      if (!(part > uncertain)) continue;
      const std::string name = fmt::format("{}{}", names[q].key, of_group(fit, group));
      out.push_back(K->low <= 0.0 && K->high >= 0.0
                        ? name + " may be zero"
                        : fmt::format("{} is known to {} only", name,
                                      base::percent(half / std::abs(K->value))));
    }
  }
  if (out.empty() && fit.widening > much_wider && worst > well_known) {
    out.push_back(fmt::format("the intervals are {:.0f} times wider than by noise",
                              fit.widening));
  }
  return out;
}

std::string do_not_use(const std::vector<std::string>& reasons) {
  return fmt::format("Do not use these numbers: {}.", fmt::join(reasons, "; "));
}

namespace {

using Force = std::array<double, 3>;

constexpr std::size_t most_turn_bins = 720;

/// What is left of a run, and in which bin of the turn each sample lies.
struct Left {
  std::vector<Force> force;  ///< [N], shape (n)
  std::vector<std::size_t> bin;
  std::size_t bins = 1;
};

/// A bin is as wide as a sample: turns fall into the same ones.
Left left_of(const Run& run, std::span<const Force> fitted) {
  Left left;
  const std::size_t n = run.angle.size();
  const double span = std::abs(run.angle.back() - run.angle.front());
  const double per_turn = span > 0 ? static_cast<double>(n - 1) * unit::turn / span : 1;
  left.bins = static_cast<std::size_t>(
      std::clamp(std::round(per_turn), 1.0, static_cast<double>(most_turn_bins)));
  for (std::size_t i = 0; i < n; ++i) {
    const double turns = run.angle[i] / unit::turn;
    const double at = (turns - std::floor(turns)) * static_cast<double>(left.bins);
    left.bin.push_back(static_cast<std::size_t>(at + 1e-6) % left.bins);
    left.force.push_back({run.force[i][0] - fitted[i][0],
                          run.force[i][1] - fitted[i][1],
                          run.force[i][2] - fitted[i][2]});
  }
  return left;
}

struct MeanTurn {
  std::vector<Force> mean;    ///< shape (bins)
  std::vector<double> count;  ///< samples of a bin
};

MeanTurn mean_turn(const Left& left) {
  MeanTurn turn{std::vector<Force>(left.bins), std::vector<double>(left.bins, 0.0)};
  for (std::size_t i = 0; i < left.force.size(); ++i) {
    turn.count[left.bin[i]] += 1;
    for (std::size_t q = 0; q < 3; ++q) turn.mean[left.bin[i]][q] += left.force[i][q];
  }
  for (std::size_t b = 0; b < left.bins; ++b) {
    for (double& m : turn.mean[b]) m /= std::max(1.0, turn.count[b]);
  }
  return turn;
}

/// Sum of squares and of products of neighbours.
struct Neighbours {
  double squares = 0.0;
  double products = 0.0;

  void add(const Force& at, const Force& next) {
    for (std::size_t q = 0; q < 3; ++q) {
      squares += at[q] * at[q];
      products += at[q] * next[q];
    }
  }
  /// c(r)^2
  [[nodiscard]] double count_less() const {
    const double c = correlation_factor(squares > 0 ? products / squares : 0.0);
    return c * c;
  }
};

/// Variance times the number of samples [N^2], as it counts and as it is.
struct Shares {
  double counted = 0.0;
  double white = 0.0;
};

Shares shares_of(const Left& left) {
  const MeanTurn turn = mean_turn(left);
  const auto n = static_cast<double>(left.force.size());
  const auto used = static_cast<double>(
      std::ranges::count_if(turn.count, [](double c) { return c > 0; }));
  Neighbours about;  // the mean turn
  Neighbours all;
  for (std::size_t i = 0; i < left.force.size(); ++i) {
    const std::size_t next = i + 1 < left.force.size() ? i + 1 : i;
    const auto rest = [&](std::size_t k) {
      Force f = left.force[k];
      for (std::size_t q = 0; q < 3; ++q) f[q] -= turn.mean[left.bin[k]][q];
      return f;
    };
    about.add(rest(i), next == i ? Force{} : rest(next));
    all.add(left.force[i], next == i ? Force{} : left.force[next]);
  }
  if (n < 2 * used) {  // too few turns to tell what repeats
    return {all.count_less() * all.squares, all.squares};
  }
  Neighbours mean;
  double of_means = 0.0;
  for (std::size_t b = 0; b < left.bins; ++b) {
    mean.add(turn.mean[b], turn.mean[(b + 1) % left.bins]);
    for (const double m : turn.mean[b]) of_means += turn.count[b] * m * m;
  }
  const double scatter = about.squares / (n - used);  // of one sample, three channels
  const double repeats = std::max(0.0, of_means - used * scatter);
  const double scatters = all.squares - repeats;
  return {about.count_less() * scatters + n / used * mean.count_less() * repeats,
          all.squares};
}

}  // namespace

double interval_widening(std::span<const Run> runs,
                         std::span<const std::vector<Force>> fitted, int unknowns) {
  Shares sum;
  double samples = 0.0;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    const Shares own = shares_of(left_of(runs[r], fitted[r]));
    sum.counted += own.counted;
    sum.white += own.white;
    samples += static_cast<double>(runs[r].angle.size());
  }
  if (!(sum.white > 0)) return 1.0;
  const double most = std::max(1.0, samples / (unknowns + 1));
  return std::sqrt(std::clamp(sum.counted / sum.white, 1.0, most));
}

}  // namespace trochoid::identification
