#include <trochoid/engagement/record_fit.h>

#include <trochoid/engagement/look.h>
#include <trochoid/engagement/turn.h>
#include <trochoid/numerics/least_squares.h>
#include <trochoid/numerics/parallel.h>
#include <trochoid/numerics/student.h>

#include <algorithm>
#include <cmath>

namespace trochoid::engagement {

namespace {

using Vector = std::array<double, 3>;

/// Steps that a fit takes at most, and needs at least for each unknown.
constexpr std::size_t most_fitted = 2000;
constexpr std::size_t fitted_each = 6;
constexpr std::size_t most_blocks = 30;
/// A step is steady if its neighbours have the same means but for this part.
constexpr double steady = 0.02;
constexpr double rank_tolerance = 3e-3;

/// Means over a turn for a unit of each coefficient, as Recorded::value, at the feed that the
/// machine made.
std::vector<Vector> unit_means(const Found& found, const Tool& tool, double stretch,
                               Reads reads) {
  const std::size_t n = force::coefficients(tool.law).size();
  Turn turn = found.turn;
  turn.f_z /= stretch;
  turn.fall /= stretch;
  std::vector<Vector> out;
  for (std::size_t k = 0; k < n; ++k) {
    std::vector<double> unit(n);
    unit[k] = 1.0;
    Tool one = tool;
    one.law = force::with_coefficients(tool.law, unit);
    one.body.reset();
    one.gauge_length = 0.0;
    Step step = found.step;
    step.forces = in_program(loads_of(turn, one), step.direction, step.spindle);
    out.push_back(mean_of(step, reads));
  }
  return out;
}

bool is_alike(const Step& a, const Step& b, Reads reads) noexcept {
  const Vector at_a = mean_of(a, reads);
  const Vector at_b = mean_of(b, reads);
  double difference = 0.0;
  double size = 0.0;
  for (std::size_t c = 0; c < 3; ++c) {
    difference = std::max(difference, std::abs(at_a[c] - at_b[c]));
    size = std::max(size, std::abs(at_a[c]));
  }
  return difference <= steady * size;
}

/// Whether all steps within a time of a step are like it.
bool is_steady(std::span<const Step> steps, std::size_t i, double within, Reads reads) {
  const auto near = [&](std::size_t k) {
    return std::abs(steps[k].time - steps[i].time) <= within;
  };
  const auto alike = [&](std::size_t k) { return is_alike(steps[i], steps[k], reads); };
  if (i == 0 || i + 1 >= steps.size() || !alike(i - 1) || !alike(i + 1)) return false;
  for (std::size_t k = i; k > 0 && near(k - 1); --k) {
    if (!alike(k - 1)) return false;
  }
  for (std::size_t k = i + 1; k < steps.size() && near(k); ++k) {
    if (!alike(k)) return false;
  }
  return true;
}

/// Places of steady steps of a tool that the record has.
std::vector<std::size_t> steady_steps(std::span<const Step> steps,
                                      const Recorded& record,
                                      const RecordedSteps& recorded, std::size_t tool) {
  const double within = settling_time(record);
  std::vector<std::size_t> all;
  for (std::size_t i = 1; i + 1 < steps.size(); ++i) {
    const Step& step = steps[i];
    const bool bottom = step.cause == Cause::plunge || step.cause == Cause::ramp;
    const std::size_t own = step.tool < 0 ? 0 : static_cast<std::size_t>(step.tool);
    if (own == tool && step.a_p > 0 && !bottom && step.flags == 0 &&
        recorded.steps[i].there && is_steady(steps, i, within, record.reads)) {
      all.push_back(i);
    }
  }
  std::vector<std::size_t> out;
  const std::size_t every = std::max<std::size_t>(1, all.size() / most_fitted);
  for (std::size_t k = 0; k < all.size(); k += every) out.push_back(all[k]);
  return out;
}

/// A linear fit of means, a row for each step and channel.
struct Linear {
  std::vector<double> A;  ///< row-major
  std::vector<double> b;
  std::size_t columns = 0;
  std::size_t channels = 3;
};

/// Cov of N-24, from blocks of rows.
std::vector<double> block_variances(const Linear& fit,
                                    const numerics::LeastSquares& found,
                                    std::size_t blocks) {
  const std::size_t n = fit.columns;
  const std::size_t steps = fit.b.size() / fit.channels;
  std::vector<double> meat(n * n);
  for (std::size_t k = 0; k < blocks; ++k) {
    std::vector<double> s(n);
    const std::size_t end = steps * (k + 1) / blocks * fit.channels;
    for (std::size_t i = steps * k / blocks * fit.channels; i < end; ++i) {
      for (std::size_t c = 0; c < n; ++c) s[c] += fit.A[i * n + c] * found.residual[i];
    }
    for (std::size_t a = 0; a < n; ++a) {
      for (std::size_t c = 0; c < n; ++c) meat[a * n + c] += s[a] * s[c];
    }
  }
  const double more = static_cast<double>(blocks) / static_cast<double>(blocks - n);
  std::vector<double> out(n);
  for (std::size_t a = 0; a < n; ++a) {
    for (std::size_t c = 0; c < n; ++c) {
      for (std::size_t d = 0; d < n; ++d) {
        out[a] += more * found.inverse_gram[a * n + c] * meat[c * n + d] *
                  found.inverse_gram[d * n + a];
      }
    }
  }
  return out;
}

/// What a linear fit is of.
struct MeanRows {
  const std::vector<std::vector<Vector>>& unit;  ///< of each place
  std::span<const std::size_t> places;
  const RecordedSteps& recorded;
  std::size_t channels = 3;
};

/// Columns of the unknowns of a fit: coefficients that are free, then offsets.
Linear linear_of(const MeanRows& rows, std::span<const double> K,
                 const std::vector<char>& free) {
  Linear out;
  const std::size_t offsets = rows.recorded.idle.found ? 0 : rows.channels;
  out.channels = rows.channels;
  out.columns = static_cast<std::size_t>(std::ranges::count(free, 1)) + offsets;
  for (std::size_t i = 0; i < rows.places.size(); ++i) {
    for (std::size_t c = 0; c < rows.channels; ++c) {
      double known = 0.0;
      for (std::size_t k = 0; k < K.size(); ++k) {
        if (free[k] != 0) {
          out.A.push_back(rows.unit[i][k][c]);
        } else {
          known += K[k] * rows.unit[i][k][c];
        }
      }
      for (std::size_t o = 0; o < offsets; ++o) out.A.push_back(o == c ? 1.0 : 0.0);
      out.b.push_back(rows.recorded.steps[rows.places[i]].mean[c] - known);
    }
  }
  return out;
}

/// Coefficients that a record tells anything of: all that change its means, or of these the
/// ones of the chip alone.
std::vector<std::vector<char>> free_coefficients(const MeanRows& rows, std::size_t n) {
  constexpr std::size_t of_the_chip = 3;
  std::vector<char> any(n);
  for (const auto& unit : rows.unit) {
    for (std::size_t k = 0; k < n; ++k) {
      if (std::ranges::any_of(unit[k], [](double x) { return x != 0; })) any[k] = 1;
    }
  }
  std::vector<char> chip = any;
  for (std::size_t k = of_the_chip; k < n; ++k) chip[k] = 0;
  return {any, chip};
}

/// Looks at steps again for the stock around them, ascending.
std::vector<Found> looked_at(const Job& job, std::span<const Step> steps,
                             std::span<const std::size_t> places) {
  Look look(job);
  StepFinder finder(look.path(), job.options.step_turns);
  std::vector<Found> out;
  for (const std::size_t i : places) {
    const Ask ask = finder.find(steps[i].step);
    look.sweep_to(look.turns_of(ask) - 1);
    out.push_back(look.at(ask));
  }
  return out;
}

}  // namespace

std::optional<MeanFit> fit_means(const Job& job, std::span<const Step> steps,
                                 const LaidOver& over, const RecordedSteps& recorded,
                                 std::size_t tool) {
  const Reads reads = over.record.reads;
  const std::vector<std::size_t> places =
      steady_steps(steps, over.record, recorded, tool);
  const Tool& own = job.tools[tool];
  const std::vector<double> K = force::coefficients(own.law);
  // What the spindle takes in air is much of its power.
  if (places.empty() || (reads != Reads::forces && !recorded.idle.found)) {
    return std::nullopt;
  }
  const std::vector<Found> found = looked_at(job, steps, places);
  std::vector<std::vector<Vector>> unit(found.size());
  numerics::for_each_index(
      found.size(),
      [&](std::size_t i) {
        const double stretch = recorded.steps[places[i]].stretch;
        unit[i] = unit_means(found[i], own, stretch, reads);
      },
      4);
  const std::size_t blocks = std::min(most_blocks, places.size() / 3);
  const MeanRows rows{unit, places, recorded, reads == Reads::forces ? 3U : 1U};
  for (const std::vector<char>& free : free_coefficients(rows, K.size())) {
    const Linear fit = linear_of(rows, K, free);
    if (places.size() < fitted_each * fit.columns) continue;
    const numerics::LeastSquares least = numerics::least_squares(
        fit.A, static_cast<int>(fit.columns), fit.b, rank_tolerance);
    if (least.rank < static_cast<int>(fit.columns) || blocks < fit.columns + 3)
      continue;
    const std::vector<double> variance = block_variances(fit, least, blocks);
    MeanFit out{.K = K, .se = std::vector<std::optional<double>>(K.size())};
    for (std::size_t k = 0, column = 0; k < K.size(); ++k) {
      if (free[k] == 0) continue;
      out.K[k] = least.x[column];
      out.se[k] = std::sqrt(std::max(variance[column], 0.0));
      ++column;
    }
    out.steps = places.size();
    out.factor = numerics::student_t(0.975, static_cast<double>(blocks - fit.columns));
    out.rms = std::sqrt(least.rss / static_cast<double>(fit.b.size()));
    return out;
  }
  return std::nullopt;
}

}  // namespace trochoid::engagement
