#include <trochoid/surface/tooth_profiles.h>

#include <trochoid/base/units.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace trochoid::surface {
namespace {

constexpr std::size_t places = 2048;

}  // namespace

double WrittenTurn::at(std::span<const double> values, double u) noexcept {
  const auto n = static_cast<double>(values.size());
  const double place = u * n;
  const auto i = std::min(static_cast<std::size_t>(place), values.size() - 1);
  const double part = place - static_cast<double>(i);
  return values[i] + part * (values[i + 1 == values.size() ? 0 : i + 1] - values[i]);
}

ToothProfiles::ToothProfiles(std::span<const PeriodicProfile> alone,
                             std::optional<double> cutoff) {
  for (const PeriodicProfile& profile : alone) {
    std::vector<double>& z = heights_.emplace_back();
    for (std::size_t k = 0; k < places; ++k) {
      const double u = static_cast<double>(k) / places;
      z.push_back(profile_at(profile, profile.period * u).height);
      everywhere_ = everywhere_ && std::isfinite(z.back());
    }
    const auto lowest = std::ranges::min_element(z);
    lowest_.push_back({static_cast<double>(lowest - z.begin()) / places, *lowest});
  }
  const double alpha = std::sqrt(std::numbers::ln2 / std::numbers::pi);
  constexpr double nothing = 1e-12;
  for (int k = 0; cutoff && k < static_cast<int>(places / 2); ++k) {  // W-2
    const double part = alpha * *cutoff * k / alone.front().period;
    const double left = std::exp(-std::numbers::pi * part * part);
    if (left < nothing) break;
    removed_.push_back(left);
  }
}

WrittenTurn ToothProfiles::written(std::span<const double> depth, bool parts) const {
  WrittenTurn out;
  out.height.assign(places, std::numeric_limits<double>::infinity());
  out.share.assign(teeth(), 0.0);
  std::vector<std::size_t> who(places, 0);
  for (std::size_t j = 0; j < teeth(); ++j) {
    for (std::size_t k = 0; k < places; ++k) {
      const double z = heights_[j][k] - depth[j];
      if (z < out.height[k]) {
        out.height[k] = z;
        who[k] = j;
      }
    }
  }
  for (const std::size_t j : who) out.share[j] += 1.0 / places;
  if (parts) {
    out.of_tooth.assign(teeth(), std::vector<double>(places, 0.0));
    for (std::size_t k = 0; k < places; ++k) out.of_tooth[who[k]][k] = 1.0;
    for (std::vector<double>& part : out.of_tooth) filter(part);
  }
  filter(out.height);
  for (std::size_t k = 0; parts && k < places; ++k) {
    const double after = out.height[(k + 1) % places];
    const double before = out.height[(k + places - 1) % places];
    out.slope.push_back(0.5 * places * (after - before));
  }
  return out;
}

double ToothProfiles::missing(std::span<const double> depth, std::size_t tooth) const {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < places; ++k) {
    double others = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < teeth(); ++j) {
      if (j != tooth) others = std::min(others, heights_[j][k] - depth[j]);
    }
    least = std::min(least, heights_[tooth][k] - depth[tooth] - others);
  }
  return least;
}

void ToothProfiles::filter(std::vector<double>& values) const {
  std::vector<double> smooth(removed_.empty() ? 0 : places, 0.0);
  for (std::size_t k = 0; k < removed_.size(); ++k) {
    double c = 0.0;
    double s = 0.0;
    const double step = unit::turn * static_cast<double>(k) / places;
    for (std::size_t i = 0; i < places; ++i) {
      c += values[i] * std::cos(step * static_cast<double>(i));
      s += values[i] * std::sin(step * static_cast<double>(i));
    }
    const double by = removed_[k] * (k == 0 ? 1.0 : 2.0) / places;
    for (std::size_t i = 0; i < places; ++i) {
      const double angle = step * static_cast<double>(i);
      smooth[i] += by * (c * std::cos(angle) + s * std::sin(angle));
    }
  }
  for (std::size_t i = 0; i < smooth.size(); ++i) values[i] -= smooth[i];
}

}  // namespace trochoid::surface
