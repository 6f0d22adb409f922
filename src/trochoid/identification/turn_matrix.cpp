#include <trochoid/identification/turn_matrix.h>

#include <trochoid/base/index.h>
#include <trochoid/base/units.h>
#include <trochoid/identification/waves.h>
#include <trochoid/numerics/fourier.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <span>

namespace trochoid::identification {
namespace {

using base::index;

/// A step over which an entry changes by more than this part of its range may hold a
/// jump; one within a step is larger than that too.
constexpr double large_change = 0.1;
/// Halvings of a step until a jump counts as found: a millionth of a step.
constexpr int halvings = 20;

/// The sides of a known jump are this far from it [rad].
constexpr double beside = 1e-9;

/// An angle and the matrix there.
struct Node {
  double phi = 0.0;
  std::vector<double> C;
};

/// Steps of the turn with a jump in them, integrated anew.
class Jumps {
 public:
  Jumps(const force::ForceMatrix& matrix, std::span<const double> C, TurnMatrix& out)
      : matrix_(matrix), known_(matrix.jumps()), scale_(out.width, 0.0), out_(out) {
    for (std::size_t i = 0; i < C.size(); ++i) {
      double& scale = scale_[i % out.width];
      scale = std::max(scale, std::abs(C[i]));
    }
  }

  /// Whether there may be a jump in a step.
  [[nodiscard]] bool possible(double from, double to) const {
    return !known_ || !known_between(from, to).empty();
  }

  /// Both sides of each jump of a step, between its ends; nothing without a jump.
  [[nodiscard]] std::vector<Node> found(const Node& a, const Node& b) const {
    std::vector<Node> ends = {a};
    if (known_) {
      for (const double at : known_between(a.phi, b.phi)) {
        ends.push_back(node_at(at - beside));
        ends.push_back(node_at(at + beside));
      }
    } else if (changes(a, b)) {
      find(a, b, 0, ends);
    }
    if (ends.size() == 1) return {};
    ends.push_back(b);
    return ends;
  }

  /// Replace what the sum over equal steps makes of this one: between jumps, lines.
  void add_step(const Node& a, const Node& b) {
    const std::vector<Node> ends = found(a, b);
    if (ends.empty()) return;
    add_line(a, b, -1.0);
    for (std::size_t i = 0; i + 1 < ends.size(); i += 2) {
      add_line(ends[i], ends[i + 1], 1.0);
    }
  }

 private:
  [[nodiscard]] bool changes(const Node& a, const Node& b) const {
    for (std::size_t c = 0; c < scale_.size(); ++c) {
      if (std::abs(b.C[c] - a.C[c]) > large_change * scale_[c]) return true;
    }
    return false;
  }

  [[nodiscard]] Node node_at(double phi) const {
    Node out{phi, std::vector<double>(scale_.size())};
    matrix_.evaluate({&out.phi, 1}, out.C);
    return out;
  }

  /// Known jumps of a step; one at its end is one of it.
  [[nodiscard]] std::vector<double> known_between(double from, double to) const {
    constexpr double at_end = 2.0 * beside;
    std::vector<double> out;
    for (double at : *known_) {
      if (at <= at_end) at += unit::turn;
      if (at > from + at_end && at <= to + at_end) out.push_back(at);
    }
    return out;
  }

  /// Add both sides of each jump.
  void find(const Node& a, const Node& b, int depth, std::vector<Node>& ends) const {
    if (depth == halvings) {
      ends.push_back(a);
      ends.push_back(b);
      return;
    }
    const Node middle = node_at(0.5 * (a.phi + b.phi));
    if (changes(a, middle)) find(a, middle, depth + 1, ends);
    if (changes(middle, b)) find(middle, b, depth + 1, ends);
  }

  void add_line(const Node& a, const Node& b, double sign) {
    const double weight = sign * 0.5 * (b.phi - a.phi) / std::numbers::pi;
    add(a, weight);
    add(b, weight);
  }

  void add(const Node& node, double weight) {
    const double c = std::cos(node.phi);
    const double s = std::sin(node.phi);
    add_row(0, 0.5 * weight, node);
    double cosine = weight * c;
    double sine = weight * s;
    for (std::size_t m = 1; m <= index(out_.highest); ++m) {
      add_row(2 * m - 1, cosine, node);
      add_row(2 * m, sine, node);
      const double next = cosine * c - sine * s;
      sine = sine * c + cosine * s;
      cosine = next;
    }
  }

  void add_row(std::size_t row, double weight, const Node& node) {
    double* const to = &out_.coefficients[row * out_.width];
    for (std::size_t c = 0; c < out_.width; ++c) to[c] += weight * node.C[c];
  }

  const force::ForceMatrix& matrix_;
  std::optional<std::vector<double>> known_;
  std::vector<double> scale_;
  TurnMatrix& out_;
};

/// The matrix at equal steps over the turn.
struct Steps {
  std::vector<double> phi;
  std::vector<double> C;

  Steps(const force::ForceMatrix& matrix, int angles)
      : phi(index(angles)), C(phi.size() * 3 * index(matrix.columns())) {
    for (std::size_t k = 0; k < phi.size(); ++k) {
      phi[k] = unit::turn * static_cast<double>(k) / angles;
    }
    matrix.evaluate(phi, C);
  }

  [[nodiscard]] double at(std::size_t k) const {
    return k < phi.size() ? phi[k] : unit::turn;
  }

  [[nodiscard]] Node node(std::size_t k) const {
    const std::size_t n = phi.size();
    const std::size_t width = C.size() / n;
    const auto first = C.begin() + static_cast<std::ptrdiff_t>(k % n * width);
    return {at(k), {first, first + static_cast<std::ptrdiff_t>(width)}};
  }
};

}  // namespace

TurnMatrix turn_matrix(const force::ForceMatrix& matrix, const TurnGrid& grid) {
  TurnMatrix out{grid.highest, 3 * index(matrix.columns()), {}};
  const Steps steps(matrix, grid.angles);
  out.coefficients = numerics::fourier_coefficients(steps.C, out.width, grid.highest);
  if (!grid.sudden) return out;
  Jumps jumps(matrix, steps.C, out);
  for (std::size_t k = 0; k < steps.phi.size(); ++k) {
    if (!jumps.possible(steps.at(k), steps.at(k + 1))) continue;
    jumps.add_step(steps.node(k), steps.node(k + 1));
  }
  return out;
}

namespace {

/// Rows of 3 times the columns of [C], each times the coefficients of a law.
std::vector<double> products_with(std::span<const double> C,
                                  std::span<const double> K) {
  std::vector<double> out;
  out.reserve(C.size() / K.size());
  for (std::size_t i = 0; i < C.size(); i += K.size()) {
    double sum = 0.0;
    for (std::size_t c = 0; c < K.size(); ++c) sum += C[i + c] * K[c];
    out.push_back(sum);
  }
  return out;
}

}  // namespace

TurnMatrix times(const TurnMatrix& turn, std::span<const double> K) {
  return {turn.highest, 3, products_with(turn.coefficients, K)};
}

TurnMatrix turn_of_force(const force::ForceMatrix& matrix, const TurnGrid& grid,
                         std::span<const double> K) {
  if (grid.sudden) return times(turn_matrix(matrix, grid), K);
  const Steps steps(matrix, grid.angles);
  return {grid.highest, 3,
          numerics::fourier_coefficients(products_with(steps.C, K), 3, grid.highest)};
}

std::vector<double> jump_angles(const force::ForceMatrix& matrix, int angles) {
  const Steps steps(matrix, angles);
  TurnMatrix unused{0, 3 * index(matrix.columns()), {}};
  const Jumps jumps(matrix, steps.C, unused);
  std::vector<double> out;
  for (std::size_t k = 0; k < steps.phi.size(); ++k) {
    if (!jumps.possible(steps.at(k), steps.at(k + 1))) continue;
    const std::vector<Node> ends = jumps.found(steps.node(k), steps.node(k + 1));
    for (std::size_t i = 1; i + 1 < ends.size(); i += 2) out.push_back(ends[i].phi);
  }
  return out;
}

std::vector<double> at_phase(const TurnMatrix& turn, double phase) {
  std::vector<double> out(turn.coefficients);
  const std::size_t w = turn.width;
  std::vector<double> wave(2 * index(turn.highest) + 1);
  fill_waves(phase, wave);
  for (std::size_t m = 1; m <= index(turn.highest); ++m) {  // I-10
    const double c = wave[2 * m - 1];
    const double s = wave[2 * m];
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
