#include <trochoid/signal/passes.h>

#include <trochoid/base/units.h>
#include <trochoid/numerics/median.h>
#include <trochoid/signal/turn_lines.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <stdexcept>

namespace trochoid::signal {

namespace {

using Channels = std::array<std::vector<double>, 3>;

constexpr std::size_t a_turn = quarters_of_turn;  ///< steps
/// Fewer steps in a row are no air: two turns.
constexpr std::size_t least_air = 8;
constexpr std::size_t least_samples = 12;  ///< of a turn
constexpr double quiet = 0.2;              ///< of the cut: at most this in air
constexpr double nothing = 1e-3;      ///< of the cut: what a program may leave in air
constexpr double twice_quietest = 2;  ///< of the quietest turn: at most this in air
constexpr double like_most_air =
    1.15;                           ///< of the median of air: at most this beside a cut
constexpr double like_most = 0.9;   ///< of the upper quartile: at least this if steady
constexpr double told_apart = 0.7;  ///< of the upper quartile: entry or exit below
constexpr double most_lines = 12;   ///< two for each tooth of most cutters
constexpr double samples_a_line = 3;

/// Sample at which each quarter of a turn begins, and the end of the last. Where samples
/// are missing, quarters are counted anew.
std::vector<std::size_t> quarters(std::span<const double> angle) {
  std::vector<std::size_t> begins = {0};
  const double step = unit::turn / a_turn;
  double next = angle[0] + step;
  for (std::size_t i = 1; i < angle.size(); ++i) {
    if (angle[i] < next - 1e-9) continue;
    begins.push_back(i);
    next = (angle[i] < next + step ? next : angle[i]) + step;
  }
  // Rounding must not take the last quarter from a record of whole turns.
  const double mean_step =
      (angle.back() - angle.front()) / static_cast<double>(angle.size() - 1);
  if (angle.back() + 1.5 * mean_step >= next) {
    begins.push_back(angle.size());
  }
  return begins;
}

/// How much the forces vary within a part, without a straight line through each.
double variation(const Channels& channels, const Part& part) {
  const auto n = static_cast<double>(part.size());
  const double middle = 0.5 * (n - 1.0);
  const double xx = n * (n * n - 1) / 12;
  double sum = 0.0;
  for (const auto& y : channels) {
    double mean = 0.0;
    for (std::size_t i = part.begin; i < part.end; ++i) mean += y[i] / n;
    double yy = 0.0;
    double xy = 0.0;
    for (std::size_t i = part.begin; i < part.end; ++i) {
      yy += (y[i] - mean) * (y[i] - mean);
      xy += (static_cast<double>(i - part.begin) - middle) * (y[i] - mean);
    }
    sum += (yy - (xx > 0.0 ? xy * xy / xx : 0.0)) / n;
  }
  return std::sqrt(std::max(0.0, sum));
}

double quantile(std::vector<double> values, double share) {
  const double place = share * static_cast<double>(values.size() - 1);
  return numerics::value_at_rank(values, static_cast<std::size_t>(place));
}

/// Steps, from the first quarter up to the end of the last.
struct Steps {
  std::size_t from = 0;
  std::size_t to = 0;
};

/// @brief A turn that begins at each quarter.
struct Turns {
  std::vector<std::size_t> begins;  ///< of the quarters
  std::vector<double> level;        ///< shape (begins - a_turn)

  [[nodiscard]] Part part(const Steps& s) const {
    return {begins[s.from], begins[s.to]};
  }
  [[nodiscard]] std::size_t quarters() const { return begins.size() - 1; }
};

Windows windows_of(const Steps& s) {
  return {s.from, s.to - a_turn + 1};
}

Steps steps_of(const Windows& w) {
  return {w.begin, w.end - 1 + a_turn};
}

/// Runs of turns for which `holds`, as steps.
template <class Holds>
std::vector<Steps> runs_where(std::size_t first, std::size_t last, const Holds& holds) {
  std::vector<Steps> runs;
  for (std::size_t k = first; k < last; ++k) {
    if (!holds(k)) continue;
    const std::size_t from = k;
    while (k < last && holds(k)) ++k;
    runs.push_back({from, k - 1 + a_turn});
  }
  return runs;
}

/// What the tool does for most of the time that it cuts, however short that is: the
/// median of the turns that vary a third as much as those of the strongest two turns.
double usual_cut(const std::vector<double>& level) {
  const auto count = static_cast<double>(level.size());
  const double top = quantile(level, 1.0 - std::min(2.0 * a_turn / count, 0.5));
  std::vector<double> cutting;
  std::ranges::copy_if(level, std::back_inserter(cutting),
                       [&](double v) { return v >= top / 3; });
  return quantile(std::move(cutting), 0.5);
}

std::vector<Steps> air_in(const Turns& turns) {
  const double cutting = usual_cut(turns.level);
  if (!(cutting > 0)) return {};
  const double least = *std::min_element(turns.level.begin(), turns.level.end());
  const double limit =
      std::min(quiet * cutting, std::max(twice_quietest * least, nothing * cutting));
  std::vector<Steps> runs = runs_where(
      0, turns.level.size(), [&](std::size_t k) { return turns.level[k] <= limit; });
  std::erase_if(runs, [](const Steps& s) { return s.to - s.from < least_air; });
  return runs;
}

/// Whether the quietest turn varies so much that noise alone may pass for a cut.
bool noise_hides_air(const Turns& turns) {
  const double least = *std::min_element(turns.level.begin(), turns.level.end());
  return twice_quietest * least > quiet * usual_cut(turns.level);
}

/// By how much turns vary, or else by their means.
std::vector<Steps> air_of(const Turns& turns, const TurnLines& lines) {
  std::vector<Steps> by_level = air_in(turns);
  if (!by_level.empty() && !noise_hides_air(turns)) return by_level;
  std::vector<Steps> by_means;
  std::ranges::transform(air_by_means(lines), std::back_inserter(by_means), steps_of);
  return by_means.empty() ? by_level : by_means;
}

/// Air without what is louder than most of it at its ends, half of it at most: there the
/// cutter cuts thin chips, whose mean is no offset. They begin before they are heard: if the
/// force grows in proportion, by half of the way from there to twice the noise.
Steps without_light_cut(const Turns& turns, Steps air) {
  const std::span<const double> level(&turns.level[air.from],
                                      air.to - a_turn + 1 - air.from);
  const double most =
      like_most_air * quantile(std::vector<double>(level.begin(), level.end()), 0.5);
  const auto loud = [most](double v) { return v > most; };
  const auto too_many = [](auto count) { return count + count / 2; };
  const auto before = std::ranges::find_if_not(level, loud) - level.begin();
  const auto after =
      std::ranges::find_if_not(level.rbegin(), level.rend(), loud) - level.rbegin();
  const std::size_t spare = (air.to - air.from) / 2;
  if (air.from > 0)
    air.from += std::min(spare / 2, static_cast<std::size_t>(too_many(before)));
  if (air.to < turns.quarters())
    air.to -= std::min(spare / 2, static_cast<std::size_t>(too_many(after)));
  return air;
}

/// Runs with less than two turns between them as one: with few samples a turn, or much
/// noise, single turns vary less than most.
std::vector<Steps> bridged(const std::vector<Steps>& runs) {
  std::vector<Steps> out;
  for (const Steps& s : runs) {
    if (!out.empty() && s.from < out.back().to + a_turn) {
      out.back().to = s.to;
    } else {
      out.push_back(s);
    }
  }
  return out;
}

/// Quarters of a pass that can spare nearly a turn at either end.
constexpr std::size_t long_pass = 6 * a_turn;

/// The steady part of a pass of a few turns, by how much they vary.
Steps steady_of_few(const Turns& turns, const Steps& pass) {
  const std::size_t last = pass.to - a_turn + 1;
  const std::vector<double> level(
      turns.level.begin() + static_cast<std::ptrdiff_t>(pass.from),
      turns.level.begin() + static_cast<std::ptrdiff_t>(last));
  const double usual = quantile(level, 0.75);
  if (*std::min_element(level.begin(), level.end()) >= told_apart * usual) return pass;
  const auto runs = bridged(runs_where(pass.from, last, [&](std::size_t k) {
    return turns.level[k] >= like_most * usual;
  }));
  return *std::max_element(
      runs.begin(), runs.end(),
      [](const Steps& a, const Steps& b) { return a.to - a.from < b.to - b.from; });
}

/// The steady part of a pass; a turn with a part of the entry in it may still be like
/// most, half a turn where the dynamometer rings on, so that as much as can be spared is left
/// out there.
std::vector<Part> steady_in(const Turns& turns, const TurnLines& lines,
                            const Steps& pass) {
  if (pass.to < pass.from + a_turn) {
    return {};
  }
  Steps best = pass;
  bool sure = true;  // that nothing of what is beside air is like most by chance
  if (pass.to - pass.from < long_pass) {
    best = steady_of_few(turns, pass);
    sure = best.from == pass.from && best.to == pass.to;
  } else {
    const Windows steady =
        steady_windows(lines, {.windows = windows_of(pass),
                               .air_before = pass.from > 0,
                               .air_after = pass.to < turns.quarters()});
    best = steps_of(steady);
  }
  const Steps ends = sure ? Steps{0, turns.quarters()} : pass;
  const bool is_long = best.to - best.from >= long_pass;
  const std::size_t margin = is_long ? 3 : (best.from == pass.from ? 0 : 1);
  const std::size_t margin_after = is_long ? 3 : (best.to == pass.to ? 0 : 1);
  best.from += best.from > ends.from ? margin : 0;
  best.to -= best.to < ends.to ? margin_after : 0;
  return {turns.part(best)};
}

/// What lies between air.
std::vector<Steps> between(const std::vector<Steps>& air, std::size_t quarters) {
  std::vector<Steps> passes;
  std::size_t from = 0;
  for (const Steps& s : air) {
    if (s.from > from) passes.push_back({from, s.from});
    from = s.to;
  }
  if (quarters > from) passes.push_back({from, quarters});
  return passes;
}

/// As many lines as the samples of a turn tell apart.
int lines_of(const Turns& turns) {
  const double per_turn = static_cast<double>(turns.begins.back() * a_turn) /
                          static_cast<double>(turns.quarters());
  return static_cast<int>(std::clamp(per_turn / samples_a_line, 1.0, most_lines));
}

void keep(const Part& part, std::vector<double>& values) {
  if (values.empty()) {
    return;
  }
  values.erase(values.begin() + static_cast<std::ptrdiff_t>(part.end), values.end());
  values.erase(values.begin(),
               values.begin() + static_cast<std::ptrdiff_t>(part.begin));
}

}  // namespace

Passes passes_of(const Channels& channels, std::span<const double> angle) {
  for (const auto& y : channels) {
    if (y.size() != angle.size()) {
      throw std::invalid_argument("passes_of: one angle a sample is needed");
    }
  }
  Passes whole{.air = {}, .steady = {{0, angle.size()}}};
  if (angle.size() < 2) return whole;
  Turns turns{.begins = quarters(angle), .level = {}};
  if (turns.quarters() < 3 * a_turn ||
      angle.size() < least_samples * turns.quarters() / a_turn) {
    return whole;
  }
  for (std::size_t k = 0; k + a_turn <= turns.quarters(); ++k) {
    turns.level.push_back(variation(channels, turns.part({k, k + a_turn})));
  }
  TurnLines lines = turn_lines(channels, angle, turns.begins, lines_of(turns));
  const std::vector<Steps> air = air_of(turns, lines);
  std::vector<Windows> idle;
  std::ranges::transform(air, std::back_inserter(idle), windows_of);
  take_idle_out(idle, lines);
  Passes found;
  for (const Steps& pass : between(air, turns.quarters())) {
    for (const Part& part : steady_in(turns, lines, pass)) found.steady.push_back(part);
  }
  if (found.steady.empty()) return whole;
  for (const Steps& all : air) {
    Steps s = without_light_cut(turns, all);  // the turn next to a cut still rings
    s.from += s.from > 0 ? a_turn : 0;
    s.to -= s.to < turns.quarters() ? a_turn : 0;
    if (s.to > s.from) found.air.push_back(turns.part(s));
  }
  // Samples after the last whole quarter belong to what they follow.
  for (std::vector<Part>* parts : {&found.air, &found.steady}) {
    if (!parts->empty() && parts->back().end == turns.begins.back()) {
      parts->back().end = angle.size();
    }
  }
  return found;
}

Part longest_steady(const Passes& passes) {
  return *std::ranges::max_element(passes.steady, {}, &Part::size);
}

Part part_between(std::span<const double> time, double from, double to) {
  const auto begin = std::lower_bound(time.begin(), time.end(), from);
  const auto end = std::upper_bound(time.begin(), time.end(), to);
  // Where `to` lies before `from` nothing is between them.
  return {static_cast<std::size_t>(begin - time.begin()),
          static_cast<std::size_t>(std::max(begin, end) - time.begin())};
}

void keep_part(const Part& part, Record& record) {
  keep(part, record.angle);
  keep(part, record.time);
  for (std::size_t c = 0; c < record.channels(); ++c) keep(part, record.values_of(c));
}

}  // namespace trochoid::signal
