#include <trochoid/surface/datum.h>

#include <trochoid/numerics/student.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace trochoid::surface {

namespace {

/// Means of readings at one place differ by rounding only [m].
constexpr double same_spot = 1e-9;

}  // namespace

DatumColumns datum_columns(std::span<const Spot> spots, std::span<const Datum> datum) {
  std::vector<std::vector<double>> parts;
  std::vector<DatumPart> described;
  for (std::size_t set = 0; set < datum.size(); ++set) {
    double x_mean = 0.0;
    double height_mean = 0.0;
    double low = std::numeric_limits<double>::infinity();
    double high = -low;
    double count = 0.0;
    bool moves = false;
    const Spot* first = nullptr;
    for (const Spot& spot : spots) {
      if (spot.set == set) {
        first = first == nullptr ? &spot : first;
        moves = moves || std::abs(spot.x - first->x) > same_spot;
        x_mean += spot.x;
        height_mean += spot.height;
        low = std::min(low, spot.height);
        high = std::max(high, spot.height);
        count += 1.0;
      }
    }
    const auto add = [&](const auto& value) {
      parts.emplace_back();
      double largest = 0.0;
      for (const Spot& spot : spots) {
        parts.back().push_back(spot.set == set ? value(spot) : 0.0);
        largest = std::max(largest, std::abs(parts.back().back()));
      }
      described.push_back({.set = set, .largest = largest});
    };
    if (datum[set].offset) {
      add([](const Spot&) { return 1.0; });
    }
    if ((datum[set].tilt || datum[set].lean) && moves) {
      add([&](const Spot& spot) { return spot.x - x_mean / count; });
      described.back().kind = DatumPart::Kind::lean;
    }
    if (datum[set].tilt) {
      add([&](const Spot& spot) { return spot.height - height_mean / count; });
      described.back().kind = DatumPart::Kind::tilt;
    }
    if (datum[set].curvature && high > low) {
      add([&](const Spot& spot) {
        const double u = (2 * spot.height - low - high) / (high - low);
        return u * u;  // E-22
      });
      described.back().kind = DatumPart::Kind::curvature;
    }
  }
  DatumColumns result{.count = parts.size(), .parts = std::move(described)};
  for (std::size_t i = 0; i < spots.size(); ++i) {
    for (const auto& column : parts) {
      result.values.push_back(column[i]);
    }
  }
  return result;
}

Estimate estimate(double value, double variance, int freedom) {
  if (freedom < 1) {
    constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
    return {value, unknown, unknown, unknown};
  }
  const double se = std::sqrt(std::max(variance, 0.0));
  const double reach = numerics::student_t(0.975, freedom) * se;
  return {value, se, value - reach, value + reach};
}

}  // namespace trochoid::surface
