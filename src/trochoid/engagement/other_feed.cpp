#include <trochoid/engagement/record_rows.h>

#include <trochoid/numerics/parallel.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

// A record of a program that the machine ran with other feeds.
namespace trochoid::engagement {

namespace {

/// Bins of the program and of the record in which one factor for all feeds is looked for.
constexpr std::size_t few_bins = 256;
constexpr double few_record_bins = 4096;
/// Factors that are tried.
constexpr double slowest = 2.5;
constexpr double fastest = 0.4;
constexpr double next_feed = 1.012;
/// Lines of fewer steps have the feed of the others; of more lines all have.
constexpr std::size_t least_steps = 20;
constexpr std::size_t most_lines = 60;
/// Rows of a program, and of a line, that are compared.
constexpr std::size_t rows_of_program = 500;
constexpr std::size_t rows_of_line = 80;

/// Factors up to one, each by a ratio more than the one before.
std::vector<double> factors(double from, double to, double ratio) {
  std::vector<double> out;
  const double count = std::ceil(std::log(to / from) / std::log(ratio));
  out.reserve(static_cast<std::size_t>(count));
  for (int i = 0; i < static_cast<int>(count); ++i) {
    out.push_back(from * std::pow(ratio, i));
  }
  return out;
}

/// All feeds slower by a factor, where the program starts then, and how well that agrees.
struct Slower {
  double factor = 1.0;
  double start = 0.0;
  double correlation = -1.0;
};

/// The factor with which the whole record agrees best.
Slower coarse_factor(std::span<const Row> rows, const Bins& record,
                     const base::Stop& stop) {
  const std::vector<Row> few = merged(rows, 0.5 * record.width());
  Slower best;
  for (const double factor : factors(fastest, slowest, next_feed)) {
    if (stop.late()) break;
    const Lag lag = best_lag(laid(few, 0.0, factor), record);
    if (lag.whole > best.correlation) best = {factor, lag.start, lag.whole};
  }
  return best;
}

/// Factors about one are tried, closer and closer.
Slower fine_factor(std::span<const Row> rows, const Means& means, Slower about,
                   double reach) {
  constexpr int tries = 6;
  const std::vector<Row> some = some_of(rows, rows_of_program);
  double apart = next_feed - 1;
  about.correlation = -1.0;
  for (int round = 0; round < 3; ++round, apart /= 4, reach /= 4) {
    Slower best = about;
    for (int i = -tries; i <= tries; ++i) {
      const double factor = about.factor * (1 + apart * i / tries);
      const std::vector<Row> there = laid(some, 0.0, factor);
      const double start = best_start(there, means, {about.start}, reach);
      const double value = agreement(there, means, {start}).correlation;
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
  double whole = -1.0;         ///< correlation of the whole record
};

Laid all_slower(std::span<const Row> rows, const Slower& by, const Bins& bins) {
  Laid out{laid(rows, by.start, by.factor),
           std::vector<double>(rows.size(), by.factor)};
  out.whole = whole_agreement(out.rows, bins);
  return out;
}

/// Times that steps begin and end in the record, and in the program.
struct Marks {
  std::vector<double> there;
  std::vector<double> program;

  Marks(std::span<const Row> laid, std::span<const Row> rows) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      there.insert(there.end(), {laid[i].from(), laid[i].to()});
      program.insert(program.end(), {rows[i].from(), rows[i].to()});
    }
  }
  /// The machine stood still before this mark, where the program goes on.
  [[nodiscard]] bool pause_before(std::size_t next) const noexcept {
    constexpr double same = 0.1;
    return next % 2 == 0 &&
           program[next] - program[next - 1] < same * (there[next] - there[next - 1]);
  }
  [[nodiscard]] double time_at(std::size_t next, double t) const noexcept {
    if (next == 0) return program.front() + t - there.front();
    if (next == there.size()) return program.back() + t - there.back();
    const double part = (t - there[next - 1]) / (there[next] - there[next - 1]);
    return program[next - 1] + part * (program[next] - program[next - 1]);
  }
};

/// The record with the times of the program, without what it has of pauses.
Recorded with_times_of(const Laid& over, std::span<const Row> rows,
                       const Recorded& record) {
  const Marks marks(over.rows, rows);
  Recorded out{.reads = record.reads};
  std::size_t next = 0;
  for (std::size_t i = 0; i < record.time.size(); ++i) {
    const double t = record.time[i];
    const std::size_t count = marks.there.size();
    while (next < count && marks.there[next] <= t) ++next;
    if (next > 0 && next < count && marks.pause_before(next)) continue;
    const double time = marks.time_at(next, t);
    if (!out.time.empty() && !(time > out.time.back())) continue;
    out.time.push_back(time);
    out.value.push_back(record.value[i]);
    out.clock.push_back(t);
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
std::vector<Row> line_from(std::span<const Row> rows, double start, double factor) {
  std::vector<Row> out = laid(rows, 0.0, factor);
  const double shift = start - out.front().from();
  for (Row& row : out) row.time += shift;
  return out;
}

/// By how much rows lie too early, at most so far; and how they agree there.
Slower best_shift(std::span<const Row> rows, const Means& means, double reach) {
  constexpr int tries = 8;
  constexpr double least_covered = 0.8;
  Slower best;
  for (int i = -tries; i <= tries; ++i) {
    const double shift = reach * i / tries;
    const Agreement there = agreement(rows, means, {shift});
    if (there.covered >= least_covered && there.correlation > best.correlation) {
      best = {1.0, shift, there.correlation};
    }
  }
  return best;
}

/// A line about a time, at the factor of all others or at its own where that leaves less
/// than half unexplained.
Slower factor_of_line(std::span<const Row> rows, const Means& means,
                      const Slower& about, double reach) {
  constexpr double clear = 0.5;
  const std::vector<Row> some = some_of(rows, rows_of_line);
  const auto at = [&](double factor) {
    const Slower shift = best_shift(line_from(some, about.start, factor), means, reach);
    return Slower{factor, about.start + shift.start, shift.correlation};
  };
  const Slower as_others = at(about.factor);
  Slower best = as_others;
  const auto look = [&](double from, double to, double next) {
    for (const double factor : factors(from, to, next)) {
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
Laid line_by_line(std::span<const Row> rows, std::span<const OneLine> lines,
                  const Means& means, const Slower& all, double reach) {
  Laid out;
  double end = all.start;    // of the line before, in the record
  double program_end = 0.0;  // and in the program
  for (const OneLine& line : lines) {
    const auto own = rows.subspan(line.first, line.last - line.first);
    const double earliest = end;
    Slower found{all.factor, end + own.front().from() - program_end};
    if (own.size() >= least_steps) {
      const double length = own.back().to() - own.front().from();
      found = factor_of_line(own, means, found, std::min(reach, length));
      if (!out.rows.empty()) found.start = std::max(found.start, earliest);
    }
    const std::vector<Row> there = line_from(own, found.start, found.factor);
    out.rows.insert(out.rows.end(), there.begin(), there.end());
    out.slower.insert(out.slower.end(), there.size(), found.factor);
    end = there.back().to();
    program_end = own.back().to();
  }
  return out;
}

/// The same from several starts about some: where feeds differ, one feed for all finds a
/// wrong one.
Laid best_line_by_line(std::span<const Row> rows, std::span<const OneLine> lines,
                       const Means& means, std::span<const Slower> abouts,
                       const Bins& bins) {
  constexpr std::size_t few_lines = 12;
  const std::size_t starts = lines.size() <= few_lines ? 4 : 1;
  const double apart =
      std::max(3 * bins.width(), 0.04 * (rows.back().time - rows.front().time));
  const std::size_t of_each = 2 * starts + 1;
  std::vector<Laid> all(abouts.size() * of_each);
  numerics::for_each_index(
      all.size(),
      [&](std::size_t i) {
        Slower seed = abouts[i / of_each];
        seed.start +=
            apart * (static_cast<double>(i % of_each) - static_cast<double>(starts));
        all[i] = line_by_line(rows, lines, means, seed, 0.7 * apart);
        all[i].whole = whole_agreement(all[i].rows, bins);
      },
      1);
  return *std::ranges::max_element(all, {}, &Laid::whole);
}

double feed_time(std::span<const Row> rows) noexcept {
  double sum = 0.0;
  for (const Row& row : rows) sum += row.duration;
  return sum;
}

}  // namespace

std::optional<OtherFeed> at_other_feed(std::span<const Step> steps,
                                       const Recorded& record, const base::Stop& stop) {
  if (!can_align(steps, record)) return std::nullopt;
  const Means means(record);
  const auto bins_of = [&](std::size_t most, double most_of_record) {
    const double length = record.time.back() - record.time.front();
    return Bins(record, means,
                std::max(bin_of(steps, record, most), length / most_of_record));
  };
  const Bins few = bins_of(few_bins, few_record_bins);
  const std::vector<Row> rows = rows_of(steps, record.reads);
  const Slower found =
      fine_factor(rows, means, coarse_factor(rows, few, stop), 1.5 * few.width());
  if (!(found.correlation > 0) || stop.late()) return std::nullopt;
  const Bins many = bins_of(8 * few_bins, 8 * few_record_bins);
  Laid over = all_slower(rows, found, many);
  OtherFeed out;
  if (const std::vector<OneLine> lines = lines_of(steps); lines.size() <= most_lines) {
    const Lag programmed = best_lag(merged(rows, 0.5 * few.width()), few);
    const std::array about{found, Slower{1.0, found.start},
                           Slower{1.0, programmed.start}};
    Laid own = best_line_by_line(rows, lines, means, about, many);
    constexpr double clear = 0.7;
    out.line_by_line = 1 - own.whole < clear * (1 - over.whole);
    if (out.line_by_line) over = std::move(own);
  }
  out.record = with_times_of(over, rows, record);
  out.start = over.rows.front().from() - rows.front().from();
  out.slower = feed_time(over.rows) / feed_time(rows);
  return out;
}

}  // namespace trochoid::engagement
