#include <trochoid/correction/ratio.h>

#include <fmt/core.h>

#include <cmath>

namespace trochoid::correction {

RatioEstimate ratio_estimate(std::span<const double> peaks, double h, double m) {
  RatioEstimate out;
  const std::size_t n = peaks.size();
  if (n < 2) {
    out.reason = "one tooth alone has no runout that its force could show";
    return out;
  }
  if (!(m < 1) || !(h > 0)) {
    out.reason = "the exponent must be below 1 and the chip positive";
    return out;
  }
  double sum = 0.0;
  std::vector<double> part;
  for (std::size_t j = 0; j < n; ++j) {
    const double F = peaks[j];
    out.cutting.push_back(F > 0);
    if (!(F > 0) && out.reason.empty()) {
      out.reason = fmt::format(
          "flute {} is not cutting: the tooth before it "
          "stands out by more than its chip",
          j + 1);
    }
    part.push_back(F > 0 ? std::pow(F, 1 / (1 - m)) : 0.0);
    sum += part.back();
  }
  if (!out.reason.empty()) {
    return out;
  }
  double rho = 0.0;
  double mean = 0.0;
  for (std::size_t j = 0; j < n; ++j) {
    out.h_ro.push_back(static_cast<double>(n) * h * part[j] / sum - h);
    rho += j > 0 ? out.h_ro[j] : 0.0;
    out.rho.push_back(rho);
    mean += rho / static_cast<double>(n);
  }
  for (double& r : out.rho) {
    r -= mean;
  }
  out.ok = true;
  return out;
}

}  // namespace trochoid::correction
