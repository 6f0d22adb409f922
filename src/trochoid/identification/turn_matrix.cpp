#include <trochoid/identification/turn_matrix.h>

#include <trochoid/base/index.h>
#include <trochoid/base/units.h>
#include <trochoid/numerics/fourier.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

namespace trochoid::identification {
namespace {

using base::index;

/// A step in which an entry changes by more than this part of its range may hold a jump.
constexpr double large_change = 0.1;
/// A middle that is off the mean of its ends by more than this part does hold one.
constexpr double large_bend = 0.02;
/// Halvings of a step until a jump counts as found: a millionth of a step.
constexpr int halvings = 20;

/// An angle and the matrix there.
struct Node {
  double phi = 0.0;
  std::vector<double> C;
};

/// Steps of the turn with a jump in them, integrated anew.
class Jumps {
 public:
  Jumps(const force::ForceMatrix& matrix, std::span<const double> C, TurnMatrix& out)
      : matrix_(matrix), scale_(out.width, 0.0), out_(out) {
    for (std::size_t i = 0; i < C.size(); ++i) {
      double& scale = scale_[i % out.width];
      scale = std::max(scale, std::abs(C[i]));
    }
  }

  /// Replace what the sum over equal steps makes of this one.
  void add_step(const Node& a, const Node& b) {
    if (largest(a, b, nullptr) <= large_change) return;
    add_trapezoid(a, b, -1.0);
    halve(a, b, 0);
  }

 private:
  /// Change over a step, or bend at its middle, of the entry where it is largest.
  [[nodiscard]] double largest(const Node& a, const Node& b, const Node* middle) const {
    double out = 0.0;
    for (std::size_t c = 0; c < scale_.size(); ++c) {
      if (scale_[c] == 0.0) continue;
      const double d = middle == nullptr ? b.C[c] - a.C[c]
                                         : middle->C[c] - 0.5 * (a.C[c] + b.C[c]);
      out = std::max(out, std::abs(d) / scale_[c]);
    }
    return out;
  }

  void halve(const Node& a, const Node& b, int depth) {
    Node middle{0.5 * (a.phi + b.phi), std::vector<double>(scale_.size())};
    matrix_.evaluate({&middle.phi, 1}, middle.C);
    if (depth == halvings || largest(a, b, &middle) <= large_bend) {
      add_trapezoid(a, middle, 1.0);
      add_trapezoid(middle, b, 1.0);
      return;
    }
    halve(a, middle, depth + 1);
    halve(middle, b, depth + 1);
  }

  void add_trapezoid(const Node& a, const Node& b, double sign) {
    const double half = sign * 0.5 * (b.phi - a.phi) / std::numbers::pi;
    for (const Node* node : {&a, &b}) {
      for (std::size_t row = 0; row < out_.coefficients.size() / out_.width; ++row) {
        const double angle = static_cast<double>((row + 1) / 2) * node->phi;
        const double weight = row == 0       ? 0.5 * half
                              : row % 2 == 1 ? half * std::cos(angle)
                                             : half * std::sin(angle);
        for (std::size_t c = 0; c < out_.width; ++c) {
          out_.coefficients[row * out_.width + c] += weight * node->C[c];
        }
      }
    }
  }

  const force::ForceMatrix& matrix_;
  std::vector<double> scale_;
  TurnMatrix& out_;
};

}  // namespace

TurnMatrix turn_matrix(const force::ForceMatrix& matrix, const TurnGrid& grid) {
  TurnMatrix out{grid.highest, 3 * index(matrix.columns()), {}};
  const std::size_t n = index(grid.angles);
  std::vector<double> phi(n);
  for (std::size_t k = 0; k < n; ++k) {
    phi[k] = unit::turn * static_cast<double>(k) / static_cast<double>(n);
  }
  std::vector<double> C(n * out.width);
  matrix.evaluate(phi, C);
  out.coefficients = numerics::fourier_coefficients(C, out.width, grid.highest);
  if (!grid.sudden) return out;
  Jumps jumps(matrix, C, out);
  const auto node = [&](std::size_t k) {
    const auto at = C.begin() + static_cast<std::ptrdiff_t>(k % n * out.width);
    return Node{k < n ? phi[k] : unit::turn,
                {at, at + static_cast<std::ptrdiff_t>(out.width)}};
  };
  for (std::size_t k = 0; k < n; ++k) jumps.add_step(node(k), node(k + 1));
  return out;
}

std::vector<double> at_phase(const TurnMatrix& turn, double phase) {
  std::vector<double> out(turn.coefficients);
  const std::size_t w = turn.width;
  for (std::size_t m = 1; m <= index(turn.highest); ++m) {  // I-10
    const double c = std::cos(static_cast<double>(m) * phase);
    const double s = std::sin(static_cast<double>(m) * phase);
    double* const a = &out[(2 * m - 1) * w];
    double* const b = a + w;
    for (std::size_t i = 0; i < w; ++i) {
      const double a_m = a[i];
      a[i] = a_m * c + b[i] * s;
      b[i] = b[i] * c - a_m * s;
    }
  }
  return out;
}

std::vector<double> slope_at_phase(const TurnMatrix& turn, double phase) {
  std::vector<double> out = at_phase(turn, phase);
  const std::size_t w = turn.width;
  std::fill_n(out.begin(), w, 0.0);
  for (std::size_t m = 1; m <= index(turn.highest); ++m) {  // I-10
    double* const a = &out[(2 * m - 1) * w];
    double* const b = a + w;
    for (std::size_t i = 0; i < w; ++i) {
      const double a_m = a[i];
      a[i] = static_cast<double>(m) * b[i];
      b[i] = -static_cast<double>(m) * a_m;
    }
  }
  return out;
}

}  // namespace trochoid::identification
