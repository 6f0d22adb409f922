#include <trochoid/structure/patches.h>

#include <algorithm>
#include <cmath>

namespace trochoid::structure {

namespace {

/// Length of the first patch beside a load, in reaches, and by how much they grow.
constexpr double first_patch = 2.0;
constexpr double growth = 3.0;
/// Loads nearer to each other than this, in reaches, share a cut.
constexpr double same_cut = 0.05;
/// Other cuts keep this distance from each other and from the sides, in patch lengths.
constexpr double apart = 0.5;

double reach_at(double length, double height, double x) {
  return std::min({x, length - x, height});
}

bool is_free(std::span<const double> cuts, double at, double distance) {
  return std::none_of(cuts.begin(), cuts.end(),
                      [&](double cut) { return std::abs(cut - at) < distance; });
}

/// Add cuts from `at` towards both ends, where none is near.
void grow(std::vector<double>& cuts, double at, double reach, double end) {
  for (const double direction : {-1.0, 1.0}) {
    double patch = first_patch * reach;
    double cut = at + direction * patch;
    while (cut > 0 && cut < end) {
      if (is_free(cuts, cut, apart * patch)) {
        cuts.push_back(cut);
      }
      patch *= growth;
      cut += direction * patch;
    }
  }
}

}  // namespace

Patches patches(double length, double height, std::span<const double> x) {
  Patches out{.x = {0.0, length}, .y = {0.0, height}, .depth = height};
  std::vector<double> loads;
  double least_reach = height;
  for (const double at : x) {
    const double reach = reach_at(length, height, at);
    if (reach > 0 && is_free(out.x, at, same_cut * reach)) {
      out.x.push_back(at);
      loads.push_back(at);
      least_reach = std::min(least_reach, reach);
    }
  }
  for (const double at : loads) {
    grow(out.x, at, reach_at(length, height, at), length);
  }
  if (!loads.empty()) {
    grow(out.y, height, least_reach, height);
  }
  out.depth = std::min(height, first_patch * least_reach);
  std::sort(out.x.begin(), out.x.end());
  std::sort(out.y.begin(), out.y.end());
  return out;
}

}  // namespace trochoid::structure
