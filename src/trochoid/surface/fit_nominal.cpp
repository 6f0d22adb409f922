#include <trochoid/surface/fit_nominal.h>

#include <trochoid/numerics/least_squares.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace trochoid::surface {

namespace {

using Values = std::vector<double>;

/// With fewer readings to spare standard errors mean nothing: three readings fit any
/// three unknowns.
constexpr int spare_readings = 3;

double weight_of(const Nominal& nominal) {
  return std::sqrt(static_cast<double>(nominal.readings.size()));
}

DatumColumns datum_of(const NominalProblem& problem) {
  std::vector<Spot> spots;
  for (const Nominal& n : problem.nominal) {
    spots.push_back({n.x, n.height, n.set});
  }
  return datum_columns(spots, problem.datum);
}

Values weighted_errors(const NominalProblem& problem, const Prediction& at) {
  Values b;
  for (std::size_t i = 0; i < problem.nominal.size(); ++i) {
    b.push_back(weight_of(problem.nominal[i]) *
                (problem.nominal[i].error - at.error[i]));
  }
  return b;
}

/// The weighted columns; zeros for a coefficient that nothing shows but rounding.
Values seen_columns(const NominalProblem& problem, const Prediction& at, int n) {
  Values D = weighted_columns(problem, at);
  double weights = 0.0;
  for (const Nominal& row : problem.nominal) {
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
                            std::array<double, columns> K, CoefficientFit& fit) {
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
  fit.known = {std::abs(blind[1]) / length,
               (blind[1] < 0 ? 1.0 : -1.0) * blind[0] / length};
  Values reduced;
  const std::size_t rows = D.size() / count;
  for (std::size_t i = 0; i < rows; ++i) {
    const double* row = D.data() + i * count;
    reduced.push_back(fit.known[0] * row[0] + fit.known[1] * row[1]);
    reduced.insert(reduced.end(), row + 2, row + count);
  }
  const auto once = numerics::least_squares(reduced, n - 1, b, 1e-12);
  const int freedom = static_cast<int>(rows) - (n - 1);
  const double variance = once.inverse_gram.empty() || freedom < 1
                              ? 0.0
                              : once.rss / freedom * once.inverse_gram[0];
  fit.combination = estimate(once.x[0] + fit.known[0] * K[0] + fit.known[1] * K[1],
                             variance, freedom);
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
                       const std::array<double, columns>& K, CoefficientFit& fit) {
  const auto count = static_cast<std::size_t>(n);
  const int freedom = static_cast<int>(fit.residual.size()) - n - silent;
  const double s2 = freedom > 0 ? solved.rss / freedom : 0.0;
  fit.noise = std::sqrt(s2);
  const auto& G = solved.inverse_gram;
  fit.K_tc = estimate(K[0], s2 * G[0], freedom);
  fit.K_rc = estimate(K[1], s2 * G[count + 1], freedom);
  fit.correlation = G[1] / std::sqrt(G[0] * G[count + 1]);
  fit.datum.clear();
  for (std::size_t k = 2; k < count; ++k) {
    fit.datum.push_back(estimate(solved.x[k], s2 * G[k * count + k], freedom));
  }
}

/// Residuals without weights, and their root mean square over the readings.
void set_residuals(const NominalProblem& problem, std::span<const double> weighted,
                   CoefficientFit& fit) {
  double sum = 0.0;
  double count = 0.0;
  fit.residual.clear();
  fit.predicted.clear();
  for (std::size_t i = 0; i < weighted.size(); ++i) {
    const double r = weighted[i] / weight_of(problem.nominal[i]);
    fit.residual.push_back(r);
    fit.predicted.push_back(problem.nominal[i].error - r);
    sum += weighted[i] * weighted[i];
    count += static_cast<double>(problem.nominal[i].readings.size());
  }
  fit.rms = std::sqrt(sum / count);
}

/// @param all  errors of all rows, weighted
/// @param b    the same without the rows that say nothing
void accept(const NominalProblem& problem, const numerics::LeastSquares& solved,
            const Values& all, const Values& b, CoefficientFit& fit) {
  Values left = solved.residual;
  for (std::size_t i = 0; i < b.size(); ++i) {
    left[i] += all[i] - b[i];
  }
  set_residuals(problem, left, fit);
  fit.ok = true;
  fit.message.clear();
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

/// Too few means of readings, or readings, for the unknowns: the sentence that says so,
/// else empty.
std::string too_few(const NominalProblem& problem, int unknowns) {
  const std::size_t means = problem.nominal.size();
  if (means < static_cast<std::size_t>(unknowns)) {
    return fmt::format("{} means of readings for {} unknowns", means, unknowns);
  }
  std::size_t readings = 0;
  for (const Nominal& mean : problem.nominal) {
    readings += mean.readings.size();
  }
  const auto needed = static_cast<std::size_t>(unknowns + spare_readings);
  return readings < needed
             ? fmt::format("{} readings for {} unknowns: at least {} are needed",
                           readings, unknowns, needed)
             : "";
}

/// No step in the direction of an approximate derivative makes it better.
void stay_there(const numerics::LeastSquares& stay, numerics::LeastSquares& solved) {
  solved.x = stay.x;
  solved.residual = stay.residual;
  solved.rss = stay.rss;
}

}  // namespace

Values weighted_columns(const NominalProblem& problem, const Prediction& at) {
  const DatumColumns datum = datum_of(problem);
  Values D;
  for (std::size_t i = 0; i < problem.nominal.size(); ++i) {
    const double w = weight_of(problem.nominal[i]);
    D.push_back(w * at.per_K[i * columns]);
    D.push_back(w * at.per_K[i * columns + 1]);
    for (std::size_t k = 0; k < datum.count; ++k) {
      D.push_back(w * datum.values[i * datum.count + k]);
    }
  }
  return D;
}

CoefficientFit fit_nominal(const NominalProblem& problem,
                           const NominalPrediction& predict) {
  constexpr int most_steps = 60;
  constexpr double enough = 1e-9;
  constexpr double negligible = 1e-3;  // of the variance: a step of 0.03 se
  CoefficientFit fit;
  std::array<double, columns> K = problem.K;
  const int n = 2 + static_cast<int>(datum_of(problem).count);
  fit.residual.assign(problem.nominal.size(), 0.0);
  fit.message = too_few(problem, n);
  if (!fit.message.empty()) {
    return fit;
  }
  std::array<double, 2> step{};
  double best = std::numeric_limits<double>::infinity();
  for (int k = 0; k < most_steps; ++k) {
    const Prediction at = predict(K);
    if (!at.good) {
      fit.message = "no state was found in which deflection and chip agree";
      return fit;
    }
    const Values D = seen_columns(problem, at, n);
    const Values all = weighted_errors(problem, at);
    Values b = all;
    const int silent = silence_rows(D, n, b);
    auto solved = numerics::least_squares(D, n, b, 1 / worst_condition);
    fit.rank = solved.rank;
    fit.condition = solved.condition;
    if (solved.rank < n) {
      fit.message = "the readings do not tell the coefficients apart";
      find_known_combination(D, b, solved, K, fit);
      return fit;
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
    K[0] += step[0];
    K[1] += step[1];
    const double size = std::hypot(K[0], K[1]);
    describe_solution(solved, n, silent, K, fit);
    const double s2 =
        solved.rss / std::max(1.0, static_cast<double>(b.size()) - n - silent);
    if (stuck || std::hypot(step[0], step[1]) <= enough * size || size == 0 ||
        stay.rss - solved.rss <= negligible * s2) {
      accept(problem, solved, all, b, fit);
      return fit;
    }
  }
  fit.message = "the coefficients did not settle";
  return fit;
}

}  // namespace trochoid::surface
