#include <trochoid/dynamics/period_parts.h>

#include <trochoid/dynamics/nodes.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace trochoid::dynamics {

namespace {

using std::numbers::pi;
/// Angles closer than this are one [rad].
constexpr double same_part_angle = 1e-9;
/// No element holds more cycles of the fastest mode: more cost more to solve.
constexpr double most_cycles = 3.0;
/// In an element of more cycles a kink that comes back is an end.
constexpr double long_cycles = 2.0;
/// A kink closer to an end than this many cycles does no harm.
constexpr double near_end = 0.1;
/// Equal pitches may cost so much more: they need no interpolation, and no second
/// multiplier with more nodes to compare with.
constexpr double worth_equal_pitches = 2.0;

double longest_part(const Directional& directional) {
  return directional.delays.empty() ? directional.period : directional.delays.front();
}

/// Add parts of equal length, short enough for the fastest mode and the shortest delay.
void add_parts(double from, double to, double longest, std::vector<double>& ends) {
  const int count =
      std::max(1, static_cast<int>(std::ceil((to - from) / longest - 1e-9)));
  for (int k = 1; k <= count; ++k) {
    ends.push_back(k == count ? to : from + (to - from) * k / count);
  }
}

/// Angles where a kink of the motion comes back, ascending.
std::vector<double> returning_kinks(const Directional& directional) {
  std::vector<double> kinks;
  const double start = directional.elements.front().from;
  for (const double delay : directional.delays) {
    if (std::abs(delay - directional.period) < same_part_angle) {
      continue;  // back at a switch
    }
    for (const DirectionalElement& element : directional.elements) {
      const double at = element.from + delay - start;
      kinks.push_back(start + at -
                      directional.period * std::floor(at / directional.period));
    }
  }
  std::sort(kinks.begin(), kinks.end());
  return kinks;
}

/// Each directional element by itself, the long ones cut where kinks come back.
std::vector<double> ends_by_element(const Directional& directional, double cycle) {
  const double longest = std::min(most_cycles * cycle, longest_part(directional));
  const double apart = near_end * cycle;
  const std::vector<double> kinks = returning_kinks(directional);
  std::vector<double> ends = {directional.elements.front().from};
  for (const DirectionalElement& whole : directional.elements) {
    const bool is_long = whole.to - whole.from > long_cycles * cycle;
    double from = whole.from;
    for (const double kink : kinks) {
      if (is_long && kink > from + apart && kink < whole.to - apart) {
        add_parts(from, kink, longest, ends);
        from = kink;
      }
    }
    add_parts(from, whole.to, longest, ends);
  }
  return ends;
}

/// Of how many pitches, of which all delays are multiples, a period consists; 0: of none.
std::size_t equal_pitches(const Directional& directional) {
  const double pitch = longest_part(directional);
  const auto is_multiple = [pitch](double angle) {
    return std::abs(angle - pitch * std::round(angle / pitch)) < same_part_angle;
  };
  const bool all =
      is_multiple(directional.period) &&
      std::all_of(directional.delays.begin(), directional.delays.end(), is_multiple);
  return all ? static_cast<std::size_t>(std::lround(directional.period / pitch)) : 0;
}

/// Every pitch cut up where any of them has a switch.
std::vector<double> ends_by_pitch(const Directional& directional, double cycle,
                                  std::size_t pitches) {
  const double start = directional.elements.front().from;
  const double pitch = directional.period / static_cast<double>(pitches);
  std::vector<double> switches = {0.0};
  for (const DirectionalElement& element : directional.elements) {
    const double at = element.from - start;
    switches.push_back(at - pitch * std::floor(at / pitch + 1e-12));
  }
  std::sort(switches.begin(), switches.end());
  std::vector<double> ends = {0.0};
  const double longest = std::min(most_cycles * cycle, pitch);
  for (const double at : switches) {
    if (at - ends.back() > same_part_angle && pitch - at > same_part_angle) {
      add_parts(ends.back(), at, longest, ends);
    }
  }
  add_parts(ends.back(), pitch, longest, ends);
  std::vector<double> all = {start};
  for (std::size_t k = 0; k < pitches; ++k) {
    for (std::size_t i = 1; i < ends.size(); ++i) {
      all.push_back(start + static_cast<double>(k) * pitch + ends[i]);
    }
  }
  return all;
}

/// Of solving for the nodes of all parts, relative.
double cost_of(const std::vector<double>& ends, double cycle) {
  double sum = 0.0;
  for (std::size_t i = 1; i < ends.size(); ++i) {
    const double nodes = part_degree(ends[i] - ends[i - 1], cycle, 1.0) + 1;
    sum += nodes * nodes;
  }
  return sum;
}

}  // namespace

int part_degree(double length, double cycle, double factor) noexcept {
  const double n = 10 + 10 * length / pi + 3.5 * length / cycle;
  const int even = 2 * static_cast<int>(std::ceil(0.5 * n * factor));
  return std::clamp(even, 4, largest_degree);
}

PeriodParts period_parts(const Directional& directional, double cycle) {
  PeriodParts out;
  std::vector<double> ends = ends_by_element(directional, cycle);
  const std::size_t pitches = equal_pitches(directional);
  if (pitches > 0) {
    std::vector<double> alike = ends_by_pitch(directional, cycle, pitches);
    if (cost_of(alike, cycle) < worth_equal_pitches * cost_of(ends, cycle)) {
      ends = std::move(alike);
      out.pitches = pitches;
    }
  }
  std::size_t whole = 0;
  for (std::size_t i = 0; i + 1 < ends.size(); ++i) {
    const double middle = 0.5 * (ends[i] + ends[i + 1]);
    while (whole + 1 < directional.elements.size() &&
           directional.elements[whole].to < middle) {
      ++whole;
    }
    out.all.push_back({ends[i], ends[i + 1], whole});
  }
  return out;
}

}  // namespace trochoid::dynamics
