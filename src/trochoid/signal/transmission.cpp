#include <trochoid/signal/transmission.h>

#include <algorithm>

namespace trochoid::signal {

Transmission::Matrix at(const Transmission& transmission, double omega) {
  const auto& lines = transmission.omega;
  const auto above = std::upper_bound(lines.begin(), lines.end(), omega);
  if (above == lines.begin()) {
    Transmission::Matrix out = transmission.H.front();
    for (auto& h : out) h = h.real();
    return out;
  }
  if (above == lines.end()) return transmission.H.back();
  const auto i = static_cast<std::size_t>(above - lines.begin());
  const double part = (omega - lines[i - 1]) / (lines[i] - lines[i - 1]);
  Transmission::Matrix out;
  for (std::size_t k = 0; k < out.size(); ++k) {
    out[k] = (1.0 - part) * transmission.H[i - 1][k] + part * transmission.H[i][k];
  }
  return out;
}

}  // namespace trochoid::signal
