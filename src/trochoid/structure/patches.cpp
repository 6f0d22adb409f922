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

/// Loads nearer to a clamped end, in shorter sides, are treated as if they were there:
/// they hardly bend the wall.
constexpr double nearest = 0.05;

/// Distance to the next clamped side; no more than the length.
double reach_at(const Plate& plate, double x) {
  const Clamps clamps = clamps_of(plate.ends);
  double reach = std::min(plate.height, plate.length);
  reach = clamps.start ? std::min(reach, x) : reach;
  return clamps.end ? std::min(reach, plate.length - x) : reach;
}

bool is_free(std::span<const double> cuts, double at, double distance) {
  return std::none_of(cuts.begin(), cuts.end(),
                      [&](double cut) { return std::abs(cut - at) < distance; });
}

/// Add cuts on one side of `at`: patches of equal
/// length as far as `even`, then growing.
void grow(std::vector<double>& cuts, double at, double patch, double even, double end) {
  double cut = at + patch;
  while (cut > 0 && cut < end) {
    if (is_free(cuts, cut, apart * std::abs(patch))) {
      cuts.push_back(cut);
    }
    patch *= std::abs(cut - at) < even ? 1 : growth;
    cut += patch;
  }
}

}  // namespace

Patches patches(const Plate& plate, std::span<const double> x, double depth) {
  const double length = plate.length;
  const double height = plate.height;
  const Clamps clamps = clamps_of(plate.ends);
  Patches out{.x = {0.0, length}, .y = {0.0, height}, .loads = {}, .depth = height};
  for (const Layer& layer : plate.layers) {
    out.y.push_back(layer.from);
  }
  const double near = nearest * std::min(length, height);
  const double first = clamps.start ? near : 0.0;
  const double last = clamps.end ? length - near : length;
  double least_reach = height;
  for (const double at : x) {
    const double load = std::clamp(at, first, last);
    const double reach = reach_at(plate, load);
    least_reach = std::min(least_reach, reach);
    out.loads.push_back(load);
    if (is_free(out.x, load, same_cut * reach)) {
      out.x.push_back(load);
    }
  }
  for (const double load : out.loads) {
    const double patch = first_patch * reach_at(plate, load);
    grow(out.x, load, patch, 0, length);
    grow(out.x, load, -patch, 0, length);
  }
  const double patch = first_patch * least_reach;
  out.depth = std::min(height, std::max(depth, patch));
  grow(out.y, height, -patch, out.depth - apart * patch, height);
  std::sort(out.x.begin(), out.x.end());
  std::sort(out.y.begin(), out.y.end());
  return out;
}

}  // namespace trochoid::structure
