#include <trochoid/dynamics/force_harmonics.h>

#include <trochoid/base/units.h>
#include <trochoid/dynamics/nodes.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <mutex>
#include <span>

namespace trochoid::dynamics {
namespace {

using Coefficients = std::vector<ComplexMatrix2>;

/// Pieces of an element, of eight Gauss nodes each: for its polynomials, and one more
/// for each cycle of the fastest wave.
constexpr double pieces_of_element = 4.0;

/// Adds the integral of one matrix over one element to every coefficient.
void add_element(const DirectionalElement& element, const std::vector<Matrix2>& matrix,
                 double period, Coefficients& out) {
  const ElementNodes& nodes = element_nodes(directional_degree);
  const ElementNodes& gauss = element_nodes(1);  // one interval of Gauss nodes
  const double half = 0.5 * (element.to - element.from);
  const auto most = static_cast<double>(out.size() / 2);
  const double cycles = most * 2 * half / period;
  const auto pieces = static_cast<std::size_t>(pieces_of_element + cycles);
  const double width = 1 / static_cast<double>(pieces);
  std::array<double, directional_degree + 1> row{};
  for (std::size_t g = 0; g < pieces * gauss_count; ++g) {
    const std::size_t i = g % gauss_count;
    const auto piece = static_cast<double>(g / gauss_count);
    const double t = -1 + width * (2 * piece + 1 + gauss.gauss_t[i]);
    lagrange_row(nodes, t, row);
    Matrix2 value{};
    for (std::size_t k = 0; k < row.size(); ++k) {
      for (std::size_t q = 0; q < value.size(); ++q) {
        value[q] += row[k] * matrix[k][q];
      }
    }
    const double phi = element.from + half * (1 + t);
    const double weight = half * width * gauss.gauss_w[i] / period;
    const double angle = unit::turn * phi / period;
    std::complex<double> wave = std::polar(weight, most * angle);
    const std::complex<double> next = std::polar(1.0, -angle);
    for (ComplexMatrix2& coefficient : out) {
      for (std::size_t q = 0; q < value.size(); ++q) {
        coefficient[q] += wave * value[q];  // D-21
      }
      wave *= next;
    }
  }
}

}  // namespace

ForceHarmonics force_harmonics(const Directional& directional, int most) {
  ForceHarmonics out{
      .period = directional.period, .delays = directional.delays, .most = most};
  const auto waves = static_cast<std::size_t>(2 * most + 1);
  out.coefficients.assign(1 + directional.delays.size(), Coefficients(waves));
  for (const DirectionalElement& element : directional.elements) {
    for (std::size_t d = 0; d < element.matrices.size(); ++d) {
      if (!element.matrices[d].empty()) {
        add_element(element, element.matrices[d], directional.period,
                    out.coefficients[d]);
      }
    }
    if (!element.damping.empty()) {
      out.damping.resize(waves);
      add_element(element, element.damping, directional.period, out.damping);
    }
  }
  return out;
}

namespace {

/// How many teeth pass in a period of the cut.
int teeth_in(const Directional& cut) {
  const double pitch = cut.delays.empty() ? cut.period : cut.delays.front();
  return static_cast<int>(std::max(1L, std::lround(cut.period / pitch)));
}

using Coefficients = std::vector<ComplexMatrix2>;

/// a times one, plus b times the other.
Coefficients sum_of(double a, const Coefficients& one, double b,
                    const Coefficients& other) {
  Coefficients out = one;
  for (std::size_t n = 0; n < out.size(); ++n) {
    for (std::size_t q = 0; q < out[n].size(); ++q) {
      out[n][q] = a * one[n][q] + b * other[n][q];
    }
  }
  return out;
}

ForceHarmonics sum_of(double a, const ForceHarmonics& one, double b,
                      const ForceHarmonics& other) {
  ForceHarmonics out = one;
  for (std::size_t d = 0; d < out.coefficients.size(); ++d) {
    out.coefficients[d] = sum_of(a, one.coefficients[d], b, other.coefficients[d]);
  }
  out.damping = sum_of(a, one.damping, b, other.damping);
  return out;
}

}  // namespace

struct DepthHarmonics::Made {
  explicit Made(std::size_t depths) : once(depths), forces(depths) {}

  std::vector<std::once_flag> once;
  std::vector<ForceHarmonics> forces;
};

DepthHarmonics::DepthHarmonics(const DirectionalModel& model,
                               std::span<const double> depth, int harmonics)
    : model_(model), depth_(depth), made_(std::make_unique<Made>(depth.size())) {
  const Directional deepest = model.at_depth(depth.back());
  const int teeth = teeth_in(deepest);
  kept_ = teeth * harmonics;
  waves_ = kept_ == 0 ? 0 : teeth * most_mirrored + 4 * kept_;
  period_ = deepest.period;
}

DepthHarmonics::~DepthHarmonics() = default;

const ForceHarmonics& DepthHarmonics::made(std::size_t k) const {
  std::call_once(made_->once[k], [&] {
    made_->forces[k] = force_harmonics(model_.at_depth(depth_[k]), waves_);
  });
  return made_->forces[k];
}

ForceHarmonics DepthHarmonics::at(double depth) const {
  const auto above = std::lower_bound(depth_.begin(), depth_.end(), depth);
  const std::size_t last = depth_.size() - 1;
  const std::size_t k =
      std::min(static_cast<std::size_t>(above - depth_.begin()), last);
  const ForceHarmonics& deeper = made(k);
  if (depth_[k] == depth) {
    return deeper;
  }
  if (k == 0 || proportional()) {
    return sum_of(depth / depth_[k], deeper, 0.0, deeper);
  }
  const double t = (depth - depth_[k - 1]) / (depth_[k] - depth_[k - 1]);
  return sum_of(t * depth / depth_[k], deeper, (1 - t) * depth / depth_[k - 1],
                made(k - 1));
}

}  // namespace trochoid::dynamics
