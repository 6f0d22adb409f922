#include <trochoid/dynamics/vibration.h>

#include <trochoid/base/units.h>
#include <trochoid/numerics/fourier.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numbers>

namespace trochoid::dynamics {

namespace {

/// Cycles of the slowest mode that tell its frequency.
constexpr double enough_cycles = 400;
/// Samples in a cycle of the fastest mode: what is faster is not in the motion.
constexpr double samples_a_cycle = 8;
constexpr int least_samples = 256;
/// Turns that tell a harmonic of the spindle from what lies between two.
constexpr double least_turns = 4;
constexpr int most_samples = 1 << 19;
/// Lines weaker than this part of the strongest are not listed, and how many are.
constexpr double least_vibration_line = 0.05;
constexpr std::size_t most_lines = 10;
/// A line this near to a harmonic of the spindle is that, in steps of the spectrum.
constexpr double same_line = 0.5;

int power_of_two(double at_least) {
  return static_cast<int>(std::bit_ceil(static_cast<unsigned>(std::ceil(at_least))));
}

double length_of(const std::array<double, 2>& a) {
  return std::hypot(a[0], a[1]);
}

/// Where between the steps the peak of a line is.
double shift_of(double before, double here, double after) {
  const double r = std::max(before, after) / here;
  const double d = std::clamp((2 * r - 1) / (r + 1), 0.0, 0.5);  // T-14
  return after > before ? d : -d;
}

double whole_amplitude(double a, double d) {
  using std::numbers::pi;
  return std::abs(d) < 1e-9 ? a : a * pi * d * (1 - d * d) / std::sin(pi * d);
}

}  // namespace

SpectrumSamples spectrum_samples(const MotionProblem& problem, int turns_done) {
  const double T = unit::turn / problem.setup.cut.Omega;
  double fastest = 0.0;
  double slowest = 1e300;
  for (const ChipMode& mode : problem.system.modes) {
    const double cycles = T * std::sqrt(mode.stiffness / mode.mass) / unit::turn;
    fastest = std::max(fastest, cycles);
    slowest = std::min(slowest, cycles);
  }
  const int most_turns = static_cast<int>(
      std::bit_floor(static_cast<unsigned>(std::max(1, turns_done / 2))));
  SpectrumSamples samples;
  samples.turns =
      std::min(most_turns, power_of_two(std::clamp(enough_cycles / slowest, least_turns,
                                                   double{most_samples})));
  samples.per_turn = std::clamp(
      power_of_two(std::min(samples_a_cycle * fastest, double{most_samples})),
      least_samples, std::max(least_samples, most_samples / samples.turns));
  return samples;
}

Spectrum spectrum_of(const System& system, const Motion& motion) {
  const std::size_t n = motion.time.size();
  std::vector<double> q(2 * n);
  for (std::size_t r = 0; r < system.modes.size(); ++r) {
    for (std::size_t i = 0; i < n; ++i) {
      q[2 * i] += system.modes[r].x * motion.mode[r][i];
      q[2 * i + 1] += system.modes[r].y * motion.mode[r][i];
    }
  }
  std::array<double, 2> mean{};
  std::array<bool, 2> moves{};
  for (std::size_t i = 0; i < 2 * n; ++i) {
    mean[i % 2] += q[i] / static_cast<double>(n);
    moves[i % 2] = moves[i % 2] || q[i] != 0;
  }
  for (std::size_t i = 0; i < n; ++i) {
    const double part = static_cast<double>(i) / static_cast<double>(n);
    const double window = 0.5 * (1 - std::cos(unit::turn * part));
    for (std::size_t c = 0; c < 2; ++c) {
      q[2 * i + c] = window * (q[2 * i + c] - mean[c]);
    }
  }
  const int highest = static_cast<int>(n / 2) - 1;
  const auto coefficients = numerics::fourier_coefficients(q, 2, highest);
  const double T = motion.time[1] - motion.time[0];
  Spectrum out{.step = 1 / (T * static_cast<double>(n))};
  out.amplitude.push_back({0.0, 0.0});
  for (int k = 1; k <= highest; ++k) {
    const auto row = static_cast<std::size_t>(4 * k - 2);
    out.amplitude.push_back({});
    for (std::size_t c = 0; c < 2; ++c) {
      const double a = moves[c] ? coefficients[row + c] : 0.0;
      const double b = moves[c] ? coefficients[row + 2 + c] : 0.0;
      out.amplitude.back()[c] = 2 * std::hypot(a, b);  // T-13
    }
  }
  return out;
}

std::vector<VibrationLine> lines_of(const Spectrum& spectrum,
                                    double spindle_frequency) {
  const auto& a = spectrum.amplitude;
  std::vector<VibrationLine> lines;
  for (std::size_t k = 1; k + 1 < a.size(); ++k) {
    const double here = length_of(a[k]);
    const double before = length_of(a[k - 1]);
    const double after = length_of(a[k + 1]);
    if (!(here > before && here >= after)) {
      continue;
    }
    const double d = shift_of(before, here, after);
    VibrationLine line{.frequency = (static_cast<double>(k) + d) * spectrum.step};
    for (std::size_t c = 0; c < 2; ++c) {
      line.amplitude[c] = whole_amplitude(a[k][c], d);
    }
    const double order = std::round(line.frequency / spindle_frequency);
    if (std::abs(line.frequency - order * spindle_frequency) <=
        same_line * spectrum.step) {
      line.harmonic = static_cast<int>(order);
    }
    lines.push_back(line);
  }
  std::sort(lines.begin(), lines.end(),
            [](const VibrationLine& one, const VibrationLine& other) {
              return length_of(one.amplitude) > length_of(other.amplitude);
            });
  const double strongest = lines.empty() ? 0.0 : length_of(lines.front().amplitude);
  std::erase_if(lines, [&](const VibrationLine& line) {
    return length_of(line.amplitude) < least_vibration_line * strongest;
  });
  lines.resize(std::min(lines.size(), most_lines));
  return lines;
}

}  // namespace trochoid::dynamics
