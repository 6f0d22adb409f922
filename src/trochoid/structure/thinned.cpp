#include <trochoid/structure/thinned.h>

#include <trochoid/numerics/median.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <span>
#include <utility>
#include <vector>

namespace trochoid::structure {

namespace {

using Complex = std::complex<double>;

/// Parts with fewer lines are not cut further.
constexpr std::size_t shortest_part = 7;
/// A part is no parabola where its residuals are above the scatter by this factor.
constexpr double above_scatter = 1.5;
/// Nor where its curvature is known, in standard errors of a mean.
constexpr double sure = 3.0;
/// Bias of a mean, of its standard error.
constexpr double most_bias = 0.2;
/// Fewer tell neither noise nor number of modes: then the tolerance is that of a fit, and
/// where that leaves as few, all stay.
constexpr std::size_t fewest_lines = 100;
/// Lines over which scatter is looked at.
constexpr std::size_t scatter_block = 32;

/// Scatter of the lines of each block.
std::vector<double> scatter_of_blocks(const std::vector<Complex>& H) {
  constexpr std::size_t beside = 2;  // that a fourth difference reaches out
  std::vector<double> out;
  for (std::size_t from = 0; from < H.size(); from += scatter_block) {
    const std::size_t first = from - std::min(from, beside);
    const std::size_t end = std::min(from + scatter_block + beside, H.size());
    const bool enough = end - first > 2 * beside;
    out.push_back(enough ? scatter_of_lines(std::span(H).subspan(first, end - first))
                  : out.empty() ? 0.0
                                : out.back());
  }
  return out;
}

/// A part of the band, the parabola through its lines, and what is left of them.
struct Part {
  std::size_t from = 0;
  std::size_t count = 0;
  double bend = 0.0;  ///< by how much its mean is above its middle
  double left = 0.0;  ///< root mean square
  double size = 0.0;  ///< of H
};

/// Legendre polynomials up to the second over its lines, as if these were even: they
/// are nearly, and the parabola only decides what is taken together.
Part part_of(const std::vector<Complex>& H, std::size_t from, std::size_t count) {
  std::array<Complex, 3> sum{};
  std::array<double, 3> squares{};
  double power = 0.0;
  for (std::size_t i = 0; i < count; ++i) {
    const double t = (2 * static_cast<double>(i) + 1) / static_cast<double>(count) - 1;
    const std::array<double, 3> P{1.0, t, 1.5 * t * t - 0.5};
    for (std::size_t k = 0; k < 3; ++k) {
      sum[k] += P[k] * H[from + i];
      squares[k] += P[k] * P[k];
    }
    power += std::norm(H[from + i]);
  }
  double left = power;
  for (std::size_t k = 0; k < 3; ++k) {
    left -= std::norm(sum[k]) / squares[k];
  }
  const auto n = static_cast<double>(count);
  return {.from = from,
          .count = count,
          .bend = 0.5 * std::abs(sum[2]) / squares[2],
          .left = std::sqrt(std::max(left, 0.0) / std::max(n - 3, 1.0)),
          .size = std::sqrt(power / n)};
}

bool is_parabola(const Part& part, double scatter, double tolerance) {
  const double off = std::hypot(above_scatter * scatter, tolerance * part.size);
  const double bend =
      std::max(sure * scatter / std::sqrt(static_cast<double>(part.count)),
               tolerance * part.size);
  return part.left <= off && part.bend <= bend;
}

/// The mean of some lines as one.
void add_mean(const FrequencyResponse& lines, std::size_t from, std::size_t count,
              FrequencyResponse& out) {
  double omega = 0.0;
  Complex H = 0.0;
  for (std::size_t i = from; i < from + count; ++i) {
    omega += lines.omega[i];
    H += lines.H[i];
  }
  const auto n = static_cast<double>(count);
  out.omega.push_back(omega / n);
  out.H.push_back(H / n);
  out.averaged.push_back(n);
}

/// Three means of a part, one of each third.
void add_thirds(const FrequencyResponse& lines, const Part& part, double scatter,
                FrequencyResponse& out) {
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t from = part.from + k * part.count / 3;
    const std::size_t third = part.from + (k + 1) * part.count / 3 - from;
    std::size_t taken = third;
    const auto biased = [&] {
      const double width = static_cast<double>(taken) / static_cast<double>(part.count);
      return part.bend * width * width >
             most_bias * scatter / std::sqrt(static_cast<double>(taken));
    };
    while (taken > 1 && biased()) taken = taken > 3 ? taken / 2 : taken - 1;
    add_mean(lines, from + (third - taken) / 2, taken, out);
  }
}

}  // namespace

double scatter_of_lines(std::span<const Complex> H) {
  constexpr double of_white_noise = 70.0;  // 1 + 16 + 36 + 16 + 1
  constexpr double median_of_rayleigh = 1.1774;
  std::vector<double> sizes;
  for (std::size_t i = 2; i + 2 < H.size(); ++i) {
    sizes.push_back(
        std::abs(H[i - 2] - 4.0 * H[i - 1] + 6.0 * H[i] - 4.0 * H[i + 1] + H[i + 2]));
  }
  if (sizes.empty()) return 0.0;
  return numerics::median(std::move(sizes)) / median_of_rayleigh /
         std::sqrt(of_white_noise);
}

FrequencyResponse thinned(const FrequencyResponse& response, double tolerance) {
  if (response.noise_bandwidth > 1 || !response.averaged.empty() ||
      response.omega.size() < shortest_part) {
    return response;
  }
  FrequencyResponse out{.kind = response.kind};
  const std::vector<double> scatter = scatter_of_blocks(response.H);
  // Parts that are not looked at yet, the slowest last.
  std::vector<Part> open{part_of(response.H, 0, response.omega.size())};
  while (!open.empty()) {
    const Part part = open.back();
    open.pop_back();
    if (part.count < shortest_part) {
      for (std::size_t i = 0; i < part.count; ++i) {
        add_mean(response, part.from + i, 1, out);
      }
      continue;
    }
    const std::size_t middle = (part.from + part.count / 2) / scatter_block;
    const double here = scatter[std::min(middle, scatter.size() - 1)];
    if (is_parabola(part, here, tolerance)) {
      add_thirds(response, part, here, out);
      continue;
    }
    const std::size_t half = part.count / 2;
    open.push_back(part_of(response.H, part.from + half, part.count - half));
    open.push_back(part_of(response.H, part.from, half));
  }
  return out;  // M-35
}

std::vector<DirectedResponse> thinned(std::span<const DirectedResponse> all,
                                      Thinning enough) {
  std::vector<DirectedResponse> out(all.begin(), all.end());
  for (DirectedResponse& one : out) {
    if (one.response.omega.size() <= enough.lines) continue;
    for (const double tolerance : {enough.tolerance, for_a_fit.tolerance}) {
      FrequencyResponse few = thinned(one.response, tolerance);
      if (few.omega.size() >= fewest_lines) {
        one.response = std::move(few);
        break;
      }
    }
  }
  return out;
}

bool is_thinned(std::span<const DirectedResponse> all) {
  return std::ranges::any_of(
      all, [](const DirectedResponse& one) { return !one.response.averaged.empty(); });
}

}  // namespace trochoid::structure
