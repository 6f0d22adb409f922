#include <trochoid/dynamics/depth_harmonics.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <mutex>

namespace trochoid::dynamics {

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
