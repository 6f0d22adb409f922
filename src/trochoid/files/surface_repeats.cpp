#include <trochoid/files/surface_repeats.h>

#include <trochoid/base/units.h>

#include <fmt/core.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

namespace trochoid::files {

namespace {

bool same_place(const SurfaceReading& a, const SurfaceReading& b) {
  return a.x == b.x && a.step == b.step && a.feed_offset == b.feed_offset &&
         a.height == b.height && a.tooth == b.tooth;
}

/// Equal for equal places.
std::uint64_t hash_of(const SurfaceReading& r) {
  std::uint64_t hash = 0;
  const auto mix = [&hash](std::uint64_t value) {
    hash = (std::rotl(hash, 23) ^ value) * 0x9E3779B97F4A7C15U;
    hash ^= hash >> 29U;
  };
  const auto number = [&](double value) {
    mix(std::bit_cast<std::uint64_t>(value + 0.0));  // -0 is 0
  };
  const auto perhaps = [&](const std::optional<double>& value) {
    mix(value ? 1 : 0);
    if (value) number(*value);
  };
  perhaps(r.x);
  perhaps(r.step);
  perhaps(r.feed_offset);
  number(r.height);
  mix(static_cast<std::uint64_t>(r.tooth));
  return hash;
}

struct ReadingPlace {
  std::uint64_t hash = 0;
  std::uint32_t reading = 0;
  friend auto operator<=>(const ReadingPlace&, const ReadingPlace&) = default;
};

/// One place: its readings, in the order of the file, become their mean in the first.
void average(std::vector<SurfaceReading>& readings,
             const std::vector<std::size_t>& same, SurfaceCounts& counts,
             std::vector<bool>& gone) {
  double mean = 0.0;
  for (std::size_t k = 0; k < same.size(); ++k) {
    mean += (readings[same[k]].error - mean) / static_cast<double>(k + 1);
  }
  for (const std::size_t i : same) {
    counts.squares += std::pow(readings[i].error - mean, 2);
    gone[i] = i != same.front();
  }
  counts.repeats += same.size() - 1;
  readings[same.front()].error = mean;
}

}  // namespace

void average_repeats(SurfaceFile& surface) {
  auto& readings = surface.readings;
  std::vector<ReadingPlace> places(readings.size());
  for (std::size_t i = 0; i < readings.size(); ++i) {
    places[i] = {hash_of(readings[i]), static_cast<std::uint32_t>(i)};
  }
  std::sort(places.begin(), places.end());
  std::vector<bool> gone(readings.size());
  std::vector<std::size_t> same;
  for (std::size_t begin = 0; begin < places.size();) {
    std::size_t end = begin + 1;
    while (end < places.size() && places[end].hash == places[begin].hash) ++end;
    for (std::size_t i = begin; i < end && end > begin + 1; ++i) {
      const std::size_t first = places[i].reading;
      if (gone[first]) continue;
      same.assign(1, first);
      for (std::size_t j = i + 1; j < end; ++j) {
        const std::size_t other = places[j].reading;
        if (!gone[other] && same_place(readings[first], readings[other])) {
          same.push_back(other);
        }
      }
      if (same.size() > 1) average(readings, same, surface.counts, gone);
    }
    begin = end;
  }
  if (surface.counts.repeats == 0) return;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < readings.size(); ++i) {
    if (!gone[i]) readings[kept++] = readings[i];
  }
  readings.resize(kept);
  surface.notes.push_back(
      {"repeats_averaged",
       fmt::format("{} of {} rows repeat a place: each place became one reading, the "
                   "mean. The standard deviation of a single one is {:.3g} um.",
                   surface.counts.repeats, gone.size(),
                   *surface.counts.repeatability() / unit::um)});
}

}  // namespace trochoid::files
