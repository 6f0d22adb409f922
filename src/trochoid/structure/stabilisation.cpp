#include <trochoid/structure/pole_search.h>
#include <trochoid/structure/stabilisation.h>
#include <trochoid/structure/thinned.h>

#include <algorithm>
#include <cmath>

namespace trochoid::structure {

namespace {

constexpr double same_omega = 0.01;
constexpr double same_zeta = 0.05;

/// The poles of one order that could be resonances.
std::vector<TriedPole> tried(const FrequencyResponse& lines, int order) {
  std::vector<TriedPole> out;
  for (const Pole& pole : find_poles(lines, order, true).pairs) {
    const double omega = std::abs(pole.p);
    const double zeta = std::abs(pole.p.real()) / omega;
    if (omega > lines.omega.front() && omega < lines.omega.back() &&
        zeta < most_damping) {
      out.push_back({.order = order, .omega = omega, .zeta = zeta});
    }
  }
  std::sort(out.begin(), out.end(),
            [](const TriedPole& a, const TriedPole& b) { return a.omega < b.omega; });
  return out;
}

PoleStanding standing_of(const TriedPole& pole, const std::vector<TriedPole>& before) {
  const auto nearest =
      std::min_element(before.begin(), before.end(), [&](const auto& a, const auto& b) {
        return std::abs(a.omega - pole.omega) < std::abs(b.omega - pole.omega);
      });
  if (nearest == before.end() ||
      std::abs(nearest->omega - pole.omega) >= same_omega * pole.omega) {
    return PoleStanding::fresh;
  }
  return std::abs(nearest->zeta - pole.zeta) < same_zeta * pole.zeta
             ? PoleStanding::stable
             : PoleStanding::same_frequency;  // M-18
}

}  // namespace

std::vector<TriedPole> stabilisation(const FrequencyResponse& response, int highest) {
  const FrequencyResponse lines = response.omega.size() > for_a_search.lines
                                      ? thinned(response, for_a_search.tolerance)
                                      : response;
  std::vector<TriedPole> out;
  std::vector<TriedPole> before;
  for (int order = 1; order <= highest; ++order) {
    if (lines.omega.size() < static_cast<std::size_t>(4 * order + 4)) {
      break;
    }
    std::vector<TriedPole> own = tried(lines, order);
    for (TriedPole& pole : own) {
      pole.standing = standing_of(pole, before);
    }
    out.insert(out.end(), own.begin(), own.end());
    before = std::move(own);
  }
  return out;
}

std::vector<double> mode_indicator(const FrequencyResponse& lines) {
  std::vector<double> out;
  for (std::size_t i = 0; i < lines.omega.size(); ++i) {
    const auto H = lines.H[i] / factor(lines.kind, lines.omega[i]);
    const double power = std::norm(H);
    out.push_back(power > 0 ? H.imag() * H.imag() / power : 0.0);  // M-19
  }
  return out;
}

}  // namespace trochoid::structure
