#include <trochoid/correction/transition.h>

#include <trochoid/correction/equal_flutes.h>
#include <trochoid/numerics/parallel.h>

#include <algorithm>
#include <tuple>

namespace trochoid::correction {

namespace {

/// Differences of the peaks that are as good as the same.
constexpr double as_good = 1e-3;
/// Differences of the areas that are the same but for rounding, which is not the same
/// everywhere and must not choose: the narrowest is taken then.
constexpr double same_area = 1e-9;
/// A harmonic that is none, over the largest.
constexpr double negligible_step = 1e-9;

bool by_harmonics(Method method) {
  return method == Method::inverse || method == Method::learning;
}

bool has_harmonic(const Harmonics& x, int n) {
  double largest = 0.0;
  for (const auto& c : x.c) {
    largest = std::max(largest, std::abs(c));
  }
  return std::abs(x.c[static_cast<std::size_t>(n) - 1]) > negligible_step * largest;
}

/// As large as the target asks, or as it is where no size makes the flutes alike.
void size(const RigidCut& cut, Target target, TransitionCandidate& one) {
  const Amplitude found = amplitude_for(target, cut, one.motion);
  if (found.ok) {
    one.motion = found.motion;
  }
  const std::vector<Flute> flutes = cut.flutes(one.motion);
  one.peak_difference = peak_difference(flutes);
  one.area_difference = area_difference(flutes);
}

/// What a candidate leaves at a speed, and whether its command is a good one.
struct Judged {
  bool broken = false;
  double peaks = 0.0;
};

Judged judge(const RigidCut& cut, const TransitionCandidate& one, Method method,
             const MapSetting& setting, double Omega) {
  if (by_harmonics(method)) {
    const Followed part =
        followed(cut, one.motion, setting.model, Omega, setting.limits);
    if (part.n_max >= one.harmonics) {
      const Range range =
          range_of(command_for(one.motion, Method::inverse, setting.model, Omega,
                               {.n_max = one.harmonics})
                       .wave);
      return {
          range.peak_to_peak() > setting.limits.stroke_high - setting.limits.stroke_low,
          one.peak_difference};
    }
    // Never less broken than the same motion with fewer harmonics.
    return {true,
            residual_at(cut, {one.motion, method}, setting, Omega).peak_difference};
  }
  const MapPoint point = residual_at(cut, {one.motion, method}, setting, Omega);
  return {point.clipped || !(point.peak_difference >= 0), point.peak_difference};
}

}  // namespace

std::vector<TransitionCandidate> transition_candidates(const RigidCut& cut,
                                                       const TransitionRange& range) {
  std::vector<std::vector<TransitionCandidate>> of_width(transition_widths.size());
  numerics::for_each_index(of_width.size(), [&](std::size_t i) {
    const double width = transition_widths[i];
    const ShapeOptions shape{.transition = width, .harmonics = range.most_harmonics};
    const Amplitude whole =
        equal_flutes(range.target, cut, range.shape, shape, {.starts = 1});
    const PeriodicMotion motion =
        whole.ok ? whole.motion : table_motion(cut, range.shape, shape);
    if (!by_harmonics(range.method)) {
      of_width[i].push_back({.width = width, .motion = motion});
      size(cut, range.target, of_width[i].back());
      return;
    }
    const Harmonics all = harmonics_of(motion, range.most_harmonics);
    for (int n = 1; n <= range.most_harmonics; ++n) {
      if (has_harmonic(all, n)) {
        of_width[i].push_back({width, n, limited(cut, motion, n)});
        size(cut, range.target, of_width[i].back());
      }
    }
  });
  std::vector<TransitionCandidate> candidates;
  for (const auto& some : of_width) {
    candidates.insert(candidates.end(), some.begin(), some.end());
  }
  return candidates;
}

const TransitionCandidate& chosen_transition(
    const RigidCut& cut, std::span<const TransitionCandidate> candidates, Method method,
    const MapSetting& setting, double Omega) {
  std::vector<Judged> judged;
  for (const TransitionCandidate& one : candidates) {
    judged.push_back(judge(cut, one, method, setting, Omega));
  }
  const auto order = [&](std::size_t i) {
    return std::tuple(judged[i].broken, judged[i].peaks);
  };
  std::size_t least = 0;
  for (std::size_t i = 1; i < judged.size(); ++i) {
    least = order(i) < order(least) ? i : least;
  }
  const TransitionCandidate* best = nullptr;
  for (std::size_t i = 0; i < judged.size(); ++i) {
    if (judged[i].broken == judged[least].broken &&
        judged[i].peaks <= judged[least].peaks + as_good &&
        (best == nullptr ||
         candidates[i].area_difference < best->area_difference - same_area)) {
      best = &candidates[i];
    }
  }
  return best != nullptr ? *best : candidates[least];
}

}  // namespace trochoid::correction
