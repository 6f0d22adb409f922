#include <trochoid/engagement/record.h>
#include <trochoid/engagement/record_means.h>
#include <trochoid/numerics/parallel.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

// Where a record lies over its program.
namespace trochoid::engagement {

namespace {

using Vector = std::array<double, 3>;

/// Bins of the program in which a first place of the record is looked for.
constexpr std::size_t most_bins = 2048;
/// The same where many feeds are tried, from one to another by a factor.
constexpr std::size_t few_bins = 256;
constexpr double slowest = 2.5;
constexpr double fastest = 0.4;
constexpr double next_feed = 1.012;
/// Lines of fewer steps have the feed of the others; of more lines all have.
constexpr std::size_t least_steps = 20;
constexpr std::size_t most_lines = 60;
/// Rows that are compared when the place is found exactly.
constexpr std::size_t most_compared = 4000;
/// Parts of the program that are laid over the record each by itself.
constexpr int parts = 6;

/// A step at the time that it has where all feeds are slower by one factor.
struct Row {
  const Step* step;
  double time;      ///< of its middle [s]
  double duration;  ///< [s]

  [[nodiscard]] double from() const noexcept { return time - 0.5 * duration; }
  [[nodiscard]] double to() const noexcept { return time + 0.5 * duration; }
};

/// Rapids between the steps take as long as ever.
std::vector<Row> rows_of(std::span<const Step> steps, double slower) {
  std::vector<Row> out;
  out.reserve(steps.size());
  double feeding = 0.0;  // up to the step [s]
  for (const Step& step : steps) {
    const double middle = feeding + 0.5 * step.duration;
    out.push_back({&step, step.time + (slower - 1) * middle, slower * step.duration});
    feeding += step.duration;
  }
  return out;
}

/// Whose mean does not matter: power and torque have a part that depends on the speed of
/// the spindle alone.
std::size_t group_of(const Step& step, Reads reads, std::vector<double>& speeds) {
  if (reads == Reads::forces) return 0;
  const auto at = std::ranges::find_if(
      speeds, [&](double speed) { return is_same_speed(speed, step.spindle); });
  if (at != speeds.end()) return static_cast<std::size_t>(at - speeds.begin());
  speeds.push_back(step.spindle);
  return speeds.size() - 1;
}

/// Weighted correlation of vectors, each component about the mean of its group.
class Correlation {
 public:
  void add(std::size_t group, const Vector& a, const Vector& b, double weight) {
    if (group >= groups_.size()) groups_.resize(group + 1);
    Group& of = groups_[group];
    of.weight += weight;
    weight_ += weight;
    for (std::size_t c = 0; c < 3; ++c) {
      of.a[c] += weight * a[c];
      of.b[c] += weight * b[c];
      aa_ += weight * a[c] * a[c];
      bb_ += weight * b[c] * b[c];
      ab_ += weight * a[c] * b[c];
    }
  }
  [[nodiscard]] double weight() const noexcept { return weight_; }
  [[nodiscard]] double value() const noexcept {
    double aa = aa_;
    double bb = bb_;
    double ab = ab_;
    for (const Group& of : groups_) {
      for (std::size_t c = 0; c < 3 && of.weight > 0; ++c) {
        aa -= of.a[c] * of.a[c] / of.weight;
        bb -= of.b[c] * of.b[c] / of.weight;
        ab -= of.a[c] * of.b[c] / of.weight;
      }
    }
    return aa > 1e-12 * aa_ && bb > 1e-12 * bb_ ? ab / std::sqrt(aa * bb) : 0.0;
  }

 private:
  struct Group {
    double weight = 0.0;
    Vector a{}, b{};
  };
  std::vector<Group> groups_{1};
  double weight_ = 0.0;
  double aa_ = 0.0, bb_ = 0.0, ab_ = 0.0;
};

/// Means in a bin of time, and the group of its speed.
struct Bin {
  Vector mean{};
  std::size_t group = 0;
};

std::vector<Bin> computed_bins(std::span<const Row> rows, Reads reads, double bin,
                               std::size_t count) {
  std::vector<Bin> out(count);
  std::vector<double> speeds;
  std::size_t reached = 0;
  std::size_t group = 0;
  for (const Row& row : rows) {
    const Vector mean = mean_of(*row.step, reads);
    const auto first = static_cast<std::size_t>(std::max(0.0, row.from() / bin));
    for (; reached < std::min(first, count); ++reached) out[reached].group = group;
    group = group_of(*row.step, reads, speeds);
    for (std::size_t k = first; k < count && static_cast<double>(k) * bin < row.to();
         ++k) {
      const double share = std::min(row.to(), static_cast<double>(k + 1) * bin) -
                           std::max(row.from(), static_cast<double>(k) * bin);
      for (std::size_t c = 0; c < 3; ++c) {
        out[k].mean[c] += std::max(share, 0.0) / bin * mean[c];
      }
    }
  }
  for (; reached < count; ++reached) out[reached].group = group;
  return out;
}

std::vector<Vector> measured_bins(const Recorded& record, const Means& means,
                                  double bin) {
  const double zero = record.time.front();
  std::vector<Vector> out(static_cast<std::size_t>((record.time.back() - zero) / bin));
  for (std::size_t k = 0; k < out.size(); ++k) {
    const double from = zero + static_cast<double>(k) * bin;
    out[k] = means.mean(from, from + bin).value_or(Vector{});
  }
  return out;
}

double turn_time(std::span<const Step> steps) {
  double longest = 0.0;
  for (const Step& step : steps) {
    if (step.a_p > 0 && step.turns > 0) {
      longest = std::max(longest, step.duration / step.turns);
    }
  }
  return longest;
}

/// How many bins later the program starts, and how well it agrees there.
struct Lag {
  double bins = 0.0;
  double correlation = -1.0;
};

/// A first place: every bin of the record is tried as the start.
Lag best_lag(std::span<const Bin> computed, std::span<const Vector> measured) {
  const std::size_t count = computed.size();
  const std::size_t there = measured.size();
  const std::size_t least = std::max<std::size_t>(std::min(count, there) * 6 / 10, 8);
  std::vector<double> found(count + there, -1.0);
  numerics::for_each_index(
      found.size(),
      [&](std::size_t i) {
        const std::size_t from = i < count ? count - i : 0;
        Correlation sum;
        for (std::size_t k = from; k < count && k + i - count < there; ++k) {
          sum.add(computed[k].group, computed[k].mean, measured[k + i - count], 1.0);
        }
        if (sum.weight() >= static_cast<double>(least)) found[i] = sum.value();
      },
      16);
  const auto best = std::ranges::max_element(found);
  if (best == found.end()) return {};
  return {static_cast<double>(best - found.begin()) - static_cast<double>(count),
          *best};
}

/// How well rows agree with the record at a place.
double agreement(std::span<const Row> rows, const Means& means, double start,
                 double stretch) {
  Correlation sum;
  std::vector<double> speeds;
  for (const Row& row : rows) {
    // The computed mean is that of a whole turn.
    const double turns = std::min(row.step->turns, 1.0);
    const double middle = start + stretch * row.time;
    const double half = 0.5 * stretch * row.duration / (turns > 0 ? turns : 1.0);
    if (const auto mean = means.mean(middle - half, middle + half)) {
      sum.add(group_of(*row.step, means.reads(), speeds),
              mean_of(*row.step, means.reads()), *mean, row.duration);
    }
  }
  return sum.value();
}

/// The start at which rows agree best, looked for about a place and finer and finer.
double best_start(std::span<const Row> rows, const Means& means, double about,
                  double reach, double stretch) {
  constexpr int tries = 20;
  double best = about;
  for (int round = 0; round < 4; ++round) {
    double most = -2.0;
    const double center = best;
    for (int i = -tries; i <= tries; ++i) {
      const double start = center + reach * i / tries;
      const double value = agreement(rows, means, start, stretch);
      if (value > most) {
        most = value;
        best = start;
      }
    }
    reach *= 2.0 / tries;
  }
  return best;
}

/// By how much rows lie too early, at most so far.
double best_shift(std::span<const Row> rows, const Means& means, double reach) {
  constexpr int tries = 8;
  double best = 0.0;
  double most = -2.0;
  for (int i = -tries; i <= tries; ++i) {
    const double shift = reach * i / tries;
    const double value = agreement(rows, means, shift, 1.0);
    if (value > most) {
      most = value;
      best = shift;
    }
  }
  return best;
}

/// Rows evenly taken.
std::vector<Row> some_of(std::span<const Row> rows, std::size_t most) {
  std::vector<Row> out;
  const std::size_t every = std::max<std::size_t>(1, rows.size() / most);
  for (std::size_t i = 0; i < rows.size(); i += every) out.push_back(rows[i]);
  return out;
}

/// A line through the starts of the parts of the program.
void stretch_over_parts(std::span<const Row> rows, const Means& means, double reach,
                        Alignment& out) {
  std::vector<double> at;
  std::vector<double> start;
  for (int p = 0; p < parts; ++p) {
    const std::size_t n = rows.size();
    const auto part = rows.subspan(n * static_cast<std::size_t>(p) / parts,
                                   n * static_cast<std::size_t>(p + 1) / parts -
                                       n * static_cast<std::size_t>(p) / parts);
    if (part.size() < 10) continue;
    const double found = best_start(part, means, out.start, reach, 1.0);
    if (agreement(part, means, found, 1.0) < 0.7) continue;
    at.push_back(0.5 * (part.front().time + part.back().time));
    start.push_back(found);
  }
  if (at.size() < 3) return;
  const auto n = static_cast<double>(at.size());
  const double mean_t = std::accumulate(at.begin(), at.end(), 0.0) / n;
  const double mean_s = std::accumulate(start.begin(), start.end(), 0.0) / n;
  double tt = 0.0;
  double ts = 0.0;
  for (std::size_t i = 0; i < at.size(); ++i) {
    tt += (at[i] - mean_t) * (at[i] - mean_t);
    ts += (at[i] - mean_t) * (start[i] - mean_s);
  }
  if (!(tt > 0)) return;
  const double slope = ts / tt;
  const double from = mean_s - slope * mean_t;
  if (agreement(rows, means, from, 1 + slope) >
      agreement(rows, means, out.start, 1.0)) {
    out.start = from;
    out.stretch = 1 + slope;
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < at.size(); ++i) {
    const double off = start[i] - (out.start + (out.stretch - 1) * at[i]);
    sum += off * off;
  }
  out.scatter = std::sqrt(sum / n);
}

/// All feeds slower by a factor, where the program starts then, and how well that agrees.
struct Slower {
  double factor = 1.0;
  double start = 0.0;
  double correlation = -1.0;
};

/// The factor that agrees best of many.
Slower coarse_factor(std::span<const Step> steps, const Recorded& record,
                     const Means& means, double bin) {
  const std::vector<Vector> measured = measured_bins(record, means, bin);
  Slower best;
  for (double factor = fastest; factor < slowest; factor *= next_feed) {
    const std::vector<Row> rows = rows_of(steps, factor);
    const auto count = static_cast<std::size_t>(rows.back().to() / bin) + 1;
    const Lag lag = best_lag(computed_bins(rows, record.reads, bin, count), measured);
    if (lag.correlation > best.correlation) {
      best = {factor, record.time.front() + lag.bins * bin, lag.correlation};
    }
  }
  return best;
}

/// Factors about one are tried, closer and closer.
Slower fine_factor(std::span<const Step> steps, const Means& means, Slower about,
                   double reach) {
  constexpr int tries = 6;
  double apart = next_feed - 1;
  about.correlation = -1.0;
  for (int round = 0; round < 3; ++round, apart /= 4, reach /= 4) {
    Slower best = about;
    for (int i = -tries; i <= tries; ++i) {
      const double factor = about.factor * (1 + apart * i / tries);
      const std::vector<Row> rows = some_of(rows_of(steps, factor), most_compared / 8);
      const double start = best_start(rows, means, about.start, reach, 1.0);
      const double value = agreement(rows, means, start, 1.0);
      if (value > best.correlation) best = {factor, start, value};
    }
    about = best;
  }
  return about;
}

/// Rows laid over the record: their times are those of the record.
struct Laid {
  std::vector<Row> rows;
  std::vector<double> slower;  ///< how many times as long each took
};

Laid laid(std::span<const Step> steps, const Slower& slower) {
  Laid out{rows_of(steps, slower.factor),
           std::vector<double>(steps.size(), slower.factor)};
  for (Row& row : out.rows) row.time += slower.start;
  return out;
}

/// The record with the times of the program.
Recorded with_times_of(const Laid& over, const Recorded& record) {
  std::vector<double> there;    // times that steps begin and end in the record
  std::vector<double> program;  // and in the program
  for (const Row& row : over.rows) {
    there.insert(there.end(), {row.from(), row.to()});
    program.insert(program.end(), {row.step->time - 0.5 * row.step->duration,
                                   row.step->time + 0.5 * row.step->duration});
  }
  Recorded out{.value = record.value, .reads = record.reads, .clock = record.time};
  std::size_t next = 0;
  for (const double t : record.time) {
    while (next < there.size() && there[next] <= t) ++next;
    double time = 0.0;
    if (next == 0) {
      time = program.front() + t - there.front();
    } else if (next == there.size()) {
      time = program.back() + t - there.back();
    } else {
      const double part = (t - there[next - 1]) / (there[next] - there[next - 1]);
      time = program[next - 1] + part * (program[next] - program[next - 1]);
    }
    out.time.push_back(time);
    out.slower.push_back(over.slower[std::min(next / 2, over.slower.size() - 1)]);
  }
  return out;
}

/// The steps of one line of the text that follow one another.
struct OneLine {
  std::size_t first;
  std::size_t last;  ///< behind its last step
};

std::vector<OneLine> lines_of(std::span<const Step> steps) {
  std::vector<OneLine> out;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (out.empty() || steps[i].line != steps[i - 1].line) out.push_back({i, i});
    out.back().last = i + 1;
  }
  return out;
}

/// The steps of a line from a time on, slower by a factor.
std::vector<Row> line_from(std::span<const Step> steps, double start, double factor) {
  std::vector<Row> out = rows_of(steps, factor);
  const double shift = start - out.front().from();
  for (Row& row : out) row.time += shift;
  return out;
}

/// A line about a time, at the factor of all others or at its own where that leaves less
/// than half unexplained.
Slower factor_of_line(std::span<const Step> steps, const Means& means,
                      const Slower& about, double reach) {
  constexpr double clear = 0.5;
  const auto at = [&](double factor) {
    const std::vector<Row> rows =
        some_of(line_from(steps, about.start, factor), most_compared / 50);
    const double shift = best_shift(rows, means, reach);
    return Slower{factor, about.start + shift, agreement(rows, means, shift, 1.0)};
  };
  const Slower as_others = at(about.factor);
  Slower best = as_others;
  const auto look = [&](double from, double to, double next) {
    for (double factor = from; factor < to; factor *= next) {
      const Slower one = at(factor);
      if (one.correlation > best.correlation) best = one;
    }
  };
  constexpr double far = 1.03;
  constexpr double close = 1.004;
  look(fastest, slowest, far);
  look(best.factor / far, best.factor * far, close);
  const bool own = 1 - best.correlation < clear * (1 - as_others.correlation);
  return own && best.correlation > 0.9 ? best : as_others;
}

/// Each line at its own feed, one after the other.
Laid line_by_line(std::span<const Step> steps, const Means& means, const Slower& all,
                  double reach) {
  Laid out;
  double end = all.start;    // of the line before, in the record
  double program_end = 0.0;  // and in the program
  for (const OneLine& line : lines_of(steps)) {
    const auto own = steps.subspan(line.first, line.last - line.first);
    const double from = own.front().time - 0.5 * own.front().duration;
    Slower found{all.factor, end + from - program_end};
    if (own.size() >= least_steps) found = factor_of_line(own, means, found, reach);
    const std::vector<Row> rows = line_from(own, found.start, found.factor);
    out.rows.insert(out.rows.end(), rows.begin(), rows.end());
    out.slower.insert(out.slower.end(), rows.size(), found.factor);
    end = rows.back().to();
    program_end = own.back().time + 0.5 * own.back().duration;
  }
  return out;
}

/// The same from several starts: where feeds differ, one feed for all finds a wrong one.
Laid best_line_by_line(std::span<const Step> steps, const Means& means,
                       const Slower& about, double bin) {
  constexpr std::size_t few_lines = 12;
  const int starts = lines_of(steps).size() <= few_lines ? 4 : 1;
  const double apart = std::max(3 * bin, 0.04 * (steps.back().time - steps[0].time));
  std::vector<Laid> all(static_cast<std::size_t>(2 * (2 * starts + 1)));
  numerics::for_each_index(
      all.size(),
      [&](std::size_t i) {
        Slower seed = about;
        seed.factor = i % 2 == 0 ? about.factor : 1.0;
        seed.start += apart * (static_cast<double>(i / 2) - starts);
        all[i] = line_by_line(steps, means, seed, 0.7 * apart);
      },
      1);
  return *std::ranges::max_element(
      all, {}, [&](const Laid& one) { return agreement(one.rows, means, 0.0, 1.0); });
}

/// Whether a record can be laid over a program.
bool can_align(std::span<const Step> steps, const Recorded& record) {
  const double turn = turn_time(steps);
  return !steps.empty() && record.time.size() >= 2 && turn > 0 &&
         record.time.back() - record.time.front() >= 10 * turn;
}

double bin_of(std::span<const Step> steps, const Recorded& record, std::size_t most) {
  const double end = steps.back().time + 0.5 * steps.back().duration;
  return std::max(
      {turn_time(steps), end / static_cast<double>(most), 2 * sample_time(record)});
}

}  // namespace

std::optional<Alignment> align(std::span<const Step> steps, const Recorded& record) {
  if (!can_align(steps, record)) return std::nullopt;
  const Means means(record);
  const double bin = bin_of(steps, record, most_bins);
  const std::vector<Row> all = rows_of(steps, 1.0);
  const double end = all.back().to();
  const auto count = static_cast<std::size_t>(end / bin) + 1;
  const Lag lag = best_lag(computed_bins(all, record.reads, bin, count),
                           measured_bins(record, means, bin));
  if (!(lag.correlation > 0)) return std::nullopt;
  const std::vector<Row> rows = some_of(all, most_compared);
  Alignment out;
  out.start =
      best_start(rows, means, record.time.front() + lag.bins * bin, 1.5 * bin, 1.0);
  stretch_over_parts(rows, means, std::max(3 * bin, 0.02 * end), out);
  out.correlation = agreement(rows, means, out.start, out.stretch);
  return out;
}

std::optional<OtherFeed> at_other_feed(std::span<const Step> steps,
                                       const Recorded& record) {
  if (!can_align(steps, record)) return std::nullopt;
  const Means means(record);
  const double bin = bin_of(steps, record, few_bins);
  const Slower found =
      fine_factor(steps, means, coarse_factor(steps, record, means, bin), 1.5 * bin);
  if (!(found.correlation > 0)) return std::nullopt;
  Laid over = laid(steps, found);
  if (lines_of(steps).size() <= most_lines) {
    Laid own = best_line_by_line(steps, means, found, bin);
    const double all_alike = agreement(over.rows, means, 0.0, 1.0);
    if (1 - agreement(own.rows, means, 0.0, 1.0) < 0.7 * (1 - all_alike)) {
      over = std::move(own);
    }
  }
  const double took = over.rows.back().to() - over.rows.front().from();
  const double in_program = steps.back().time + 0.5 * steps.back().duration -
                            steps.front().time + 0.5 * steps.front().duration;
  return OtherFeed{
      with_times_of(over, record),
      over.rows.front().from() - steps.front().time + 0.5 * steps.front().duration,
      took / in_program};
}

}  // namespace trochoid::engagement
