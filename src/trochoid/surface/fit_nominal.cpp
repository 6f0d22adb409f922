#include <trochoid/surface/fit_nominal.h>

#include <trochoid/numerics/least_squares.h>
#include <trochoid/surface/datum.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace trochoid::surface {

namespace {

using Values = std::vector<double>;

double weight_of(const Nominal& nominal) {
  return std::sqrt(static_cast<double>(nominal.readings.size()));
}

DatumColumns datum_of(const NominalFit& fit) {
  std::vector<Spot> spots;
  for (const Nominal& n : fit.nominal) {
    spots.push_back({n.x, n.height, n.set});
  }
  return datum_columns(spots, fit.datum);
}

Values weighted_errors(const NominalFit& fit, const Prediction& at) {
  Values b;
  for (std::size_t i = 0; i < fit.nominal.size(); ++i) {
    b.push_back(weight_of(fit.nominal[i]) * (fit.nominal[i].error - at.error[i]));
  }
  return b;
}

/// The weighted columns; zeros for a coefficient that nothing shows but rounding.
Values seen_columns(const NominalFit& fit, const Prediction& at, int n) {
  Values D = weighted_columns(fit, at);
  double weights = 0.0;
  for (const Nominal& row : fit.nominal) {
    weights += static_cast<double>(row.readings.size());
  }
  for (std::size_t c = 0; c < 2; ++c) {
    double sum = 0.0;
    for (std::size_t i = c; i < D.size(); i += static_cast<std::size_t>(n)) {
      sum += D[i] * D[i];
    }
    if (std::sqrt(sum / weights) <= at.blind) {
      for (std::size_t i = c; i < D.size(); i += static_cast<std::size_t>(n)) {
        D[i] = 0.0;
      }
    }
  }
  return D;
}

/// The one combination that is known where the two are not.
void find_known_combination(const Values& D, const Values& b,
                            const numerics::LeastSquares& solved,
                            std::array<double, columns> K, Answer& answer) {
  const std::size_t count = solved.x.size();
  const int n = static_cast<int>(count);
  if (solved.rank != n - 1) {
    return;
  }
  double datum_part = 0.0;
  for (std::size_t k = 2; k < count; ++k) {
    datum_part = std::max(datum_part, std::abs(solved.null_space[k]));
  }
  if (datum_part > 0.1) {
    return;
  }
  // A column of zeros is blind by itself.
  const auto step = [&](std::size_t c) {
    return solved.norms[c] > 0 ? solved.null_space[c] / solved.norms[c]
                               : solved.null_space[c];
  };
  const std::array<double, 2> blind = {step(0), step(1)};
  const double length = std::hypot(blind[0], blind[1]);
  answer.known = {std::abs(blind[1]) / length,
                  (blind[1] < 0 ? 1.0 : -1.0) * blind[0] / length};
  Values reduced;
  const std::size_t rows = D.size() / count;
  for (std::size_t i = 0; i < rows; ++i) {
    const double* row = D.data() + i * count;
    reduced.push_back(answer.known[0] * row[0] + answer.known[1] * row[1]);
    reduced.insert(reduced.end(), row + 2, row + count);
  }
  const auto once = numerics::least_squares(reduced, n - 1, b, 1e-12);
  const int freedom = static_cast<int>(rows) - (n - 1);
  const double variance = once.inverse_gram.empty() || freedom < 1
                              ? 0.0
                              : once.rss / freedom * once.inverse_gram[0];
  answer.combination = estimate(
      once.x[0] + answer.known[0] * K[0] + answer.known[1] * K[1], variance, freedom);
}

/// What the datum columns alone make of b, with the coefficients where they are.
numerics::LeastSquares datum_only(const Values& D, const Values& b, int n) {
  const auto count = static_cast<std::size_t>(n);
  numerics::LeastSquares all;
  all.x.resize(count);
  all.residual = b;
  if (n == 2) {
    for (const double x : b) {
      all.rss += x * x;
    }
    return all;
  }
  Values datum;
  for (std::size_t i = 0; i < b.size(); ++i) {
    datum.insert(datum.end(), D.begin() + static_cast<std::ptrdiff_t>(i * count + 2),
                 D.begin() + static_cast<std::ptrdiff_t>((i + 1) * count));
  }
  const auto part = numerics::least_squares(datum, n - 2, b, 1e-12);
  std::copy(part.x.begin(), part.x.end(), all.x.begin() + 2);
  all.residual = part.residual;
  all.rss = part.rss;
  return all;
}

/// Rows that nothing unknown moves say nothing, and do not count: their b becomes 0.
/// @return how many there are
int silence_rows(const Values& D, int n, Values& b) {
  constexpr double nothing = 1e-9;
  const auto count = static_cast<std::size_t>(n);
  Values largest(count);  // of each column: their units differ
  for (std::size_t i = 0; i < D.size(); ++i) {
    largest[i % count] = std::max(largest[i % count], std::abs(D[i]));
  }
  int silent = 0;
  for (std::size_t i = 0; i < b.size(); ++i) {
    bool moves = false;
    for (std::size_t k = 0; k < count; ++k) {
      moves = moves || std::abs(D[i * count + k]) > nothing * largest[k];
    }
    if (!moves) {
      b[i] = 0.0;
      ++silent;
    }
  }
  return silent;
}

void describe_solution(const numerics::LeastSquares& solved, int n, int silent,
                       const std::array<double, columns>& K, Answer& answer) {
  const auto count = static_cast<std::size_t>(n);
  const int freedom = static_cast<int>(answer.residual.size()) - n - silent;
  const double s2 = freedom > 0 ? solved.rss / freedom : 0.0;
  answer.noise = std::sqrt(s2);
  const auto& G = solved.inverse_gram;
  answer.K_tc = estimate(K[0], s2 * G[0], freedom);
  answer.K_rc = estimate(K[1], s2 * G[count + 1], freedom);
  answer.correlation = G[1] / std::sqrt(G[0] * G[count + 1]);
  answer.datum.clear();
  for (std::size_t k = 2; k < count; ++k) {
    answer.datum.push_back(estimate(solved.x[k], s2 * G[k * count + k], freedom));
  }
}

/// Residuals without weights, and their root mean square over the readings.
void set_residuals(const NominalFit& fit, std::span<const double> weighted,
                   Answer& answer) {
  double sum = 0.0;
  double count = 0.0;
  answer.residual.clear();
  answer.predicted.clear();
  for (std::size_t i = 0; i < weighted.size(); ++i) {
    const double r = weighted[i] / weight_of(fit.nominal[i]);
    answer.residual.push_back(r);
    answer.predicted.push_back(fit.nominal[i].error - r);
    sum += weighted[i] * weighted[i];
    count += static_cast<double>(fit.nominal[i].readings.size());
  }
  answer.rms = std::sqrt(sum / count);
}

/// @param all  errors of all rows, weighted
/// @param b    the same without the rows that say nothing
void accept(const NominalFit& fit, const numerics::LeastSquares& solved,
            const Values& all, const Values& b, Answer& answer) {
  Values left = solved.residual;
  for (std::size_t i = 0; i < b.size(); ++i) {
    left[i] += all[i] - b[i];
  }
  set_residuals(fit, left, answer);
  answer.ok = true;
  answer.message.clear();
}

/// Half of the last step back. @return whether that still makes a difference
bool step_back(std::array<double, 2>& step, std::array<double, columns>& K) {
  constexpr double no_step = 1e-6;
  for (std::size_t q = 0; q < 2; ++q) {
    step[q] *= 0.5;
    K[q] -= step[q];
  }
  return std::hypot(step[0], step[1]) > no_step * std::hypot(K[0], K[1]);
}

/// No step in the direction of an approximate derivative makes it better.
void stay_there(const numerics::LeastSquares& stay, numerics::LeastSquares& solved) {
  solved.x = stay.x;
  solved.residual = stay.residual;
  solved.rss = stay.rss;
}

}  // namespace

Values weighted_columns(const NominalFit& fit, const Prediction& at) {
  const DatumColumns datum = datum_of(fit);
  Values D;
  for (std::size_t i = 0; i < fit.nominal.size(); ++i) {
    const double w = weight_of(fit.nominal[i]);
    D.push_back(w * at.per_K[i * columns]);
    D.push_back(w * at.per_K[i * columns + 1]);
    for (std::size_t k = 0; k < datum.count; ++k) {
      D.push_back(w * datum.values[i * datum.count + k]);
    }
  }
  return D;
}

Answer fit_nominal(const NominalFit& fit, const NominalPrediction& predict) {
  constexpr int most_steps = 60;
  constexpr double enough = 1e-9;
  constexpr double negligible = 1e-3;  // of the variance: a step of 0.03 se
  Answer answer;
  std::array<double, columns> K = fit.K;
  const int n = 2 + static_cast<int>(datum_of(fit).count);
  answer.residual.assign(fit.nominal.size(), 0.0);
  if (fit.nominal.size() < static_cast<std::size_t>(n)) {
    answer.message =
        fmt::format("{} means of readings for {} unknowns", fit.nominal.size(), n);
    return answer;
  }
  std::array<double, 2> step{};
  double best = std::numeric_limits<double>::infinity();
  for (int k = 0; k < most_steps; ++k) {
    const Prediction at = predict(K);
    if (!at.good) {
      answer.message = "no state was found in which deflection and chip agree";
      return answer;
    }
    const Values D = seen_columns(fit, at, n);
    const Values all = weighted_errors(fit, at);
    Values b = all;
    const int silent = silence_rows(D, n, b);
    auto solved = numerics::least_squares(D, n, b, 1 / worst_condition);
    answer.rank = solved.rank;
    answer.condition = solved.condition;
    if (solved.rank < n) {
      answer.message = "the readings do not tell the coefficients apart";
      find_known_combination(D, b, solved, K, answer);
      return answer;
    }
    // What is left when only the datum may follow tells whether the step was good.
    const auto stay = datum_only(D, b, n);
    const bool stuck = stay.rss > best * (1 + 1e-9);
    if (stuck && step_back(step, K)) {
      continue;
    }
    if (stuck) {
      stay_there(stay, solved);
    }
    best = std::min(stay.rss, best);
    step = {solved.x[0], solved.x[1]};
    K = {K[0] + step[0], K[1] + step[1]};
    const double size = std::hypot(K[0], K[1]);
    const double move = std::hypot(step[0], step[1]);
    describe_solution(solved, n, silent, K, answer);
    const double s2 =
        solved.rss / std::max(1.0, static_cast<double>(b.size()) - n - silent);
    if (stuck || move <= enough * size || size == 0 ||
        stay.rss - solved.rss <= negligible * s2) {
      accept(fit, solved, all, b, answer);
      return answer;
    }
  }
  answer.message = "the coefficients did not settle";
  return answer;
}

}  // namespace trochoid::surface
