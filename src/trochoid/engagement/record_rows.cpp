#include <trochoid/engagement/record_rows.h>

#include <trochoid/numerics/parallel.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace trochoid::engagement {

namespace {

using Vector = std::array<double, 3>;

/// Power and torque have a part that depends on the speed of the spindle alone.
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
    Group& of = group_at(group);
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
  /// Bins of the record where nothing is computed.
  void add_air(std::size_t group, const Bins& record, std::size_t from,
               std::size_t to) {
    if (to <= from) return;
    Group& of = group_at(group);
    of.weight += static_cast<double>(to - from);
    for (std::size_t c = 0; c < 3; ++c) {
      of.b[c] += record.up_to(to).value[c] - record.up_to(from).value[c];
    }
    bb_ += record.up_to(to).square - record.up_to(from).square;
  }
  /// Of pairs.
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
  Group& group_at(std::size_t group) {
    if (group >= groups_.size()) groups_.resize(group + 1);
    return groups_[group];
  }

  std::vector<Group> groups_{1};
  double weight_ = 0.0;
  double aa_ = 0.0, bb_ = 0.0, ab_ = 0.0;
};

/// Means of rows in bins of time from 0 on, and the group of each.
struct Computed {
  std::vector<Vector> mean;
  std::vector<std::size_t> group;
};

Computed computed_bins(std::span<const Row> rows, double bin, std::size_t count) {
  Computed out{std::vector<Vector>(count), std::vector<std::size_t>(count)};
  std::size_t reached = 0;
  std::size_t group = rows.front().group;
  for (const Row& row : rows) {
    const auto first = static_cast<std::size_t>(std::max(0.0, row.from() / bin));
    for (; reached < std::min(first, count); ++reached) out.group[reached] = group;
    group = row.group;
    for (std::size_t k = first; k < count && static_cast<double>(k) * bin < row.to();
         ++k) {
      const double share = std::min(row.to(), static_cast<double>(k + 1) * bin) -
                           std::max(row.from(), static_cast<double>(k) * bin);
      for (std::size_t c = 0; c < 3; ++c) {
        out.mean[k][c] += std::max(share, 0.0) / bin * row.mean[c];
      }
    }
  }
  for (; reached < count; ++reached) out.group[reached] = group;
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

/// Whether two rows are as one: of one group, the one right after the other.
bool goes_on(const Row& row, const Row& next) noexcept {
  return next.group == row.group && next.from() - row.to() < 1e-6 * next.duration;
}

/// A start nearly as good as the best one and far from it, in bins; negative: none.
std::ptrdiff_t other_top(std::span<const double> found, std::ptrdiff_t best,
                         std::ptrdiff_t far) {
  constexpr double nearly = 1.1;
  const auto unexplained = [&](std::ptrdiff_t i) {
    const double r = found[static_cast<std::size_t>(i)];
    return r > 0 ? 1 - r * r : 1.0;
  };
  std::ptrdiff_t other = -1;
  const auto last = static_cast<std::ptrdiff_t>(found.size()) - 1;
  for (std::ptrdiff_t i = 1; i < last; ++i) {
    if (std::abs(i - best) <= far || unexplained(i) > unexplained(i - 1) ||
        unexplained(i) > unexplained(i + 1) ||
        unexplained(i) > nearly * unexplained(best)) {
      continue;
    }
    if (other < 0 || unexplained(i) < unexplained(other)) other = i;
  }
  return other;
}

}  // namespace

std::vector<Row> rows_of(std::span<const Step> steps, Reads reads) {
  std::vector<Row> out;
  out.reserve(steps.size());
  std::vector<double> speeds;
  double feeding = 0.0;  // up to the step [s]
  for (const Step& step : steps) {
    out.push_back({.time = step.time,
                   .duration = step.duration,
                   .feeding = feeding + 0.5 * step.duration,
                   .turns = step.turns > 0 ? std::min(step.turns, 1.0) : 1.0,
                   .group = group_of(step, reads, speeds),
                   .mean = mean_of(step, reads)});
    feeding += step.duration;
  }
  return out;
}

std::vector<Row> laid(std::span<const Row> rows, double start, double slower) {
  std::vector<Row> out(rows.begin(), rows.end());
  for (Row& row : out) {
    row.time += start + (slower - 1) * row.feeding;
    row.duration *= slower;
  }
  return out;
}

std::vector<Row> some_of(std::span<const Row> rows, std::size_t most) {
  std::vector<Row> out;
  const std::size_t every = std::max<std::size_t>(1, rows.size() / most);
  for (std::size_t i = 0; i < rows.size(); i += every) out.push_back(rows[i]);
  return out;
}

std::vector<Row> merged(std::span<const Row> rows, double longest) {
  std::vector<Row> out;
  for (const Row& row : rows) {
    if (out.empty() || !goes_on(out.back(), row) ||
        out.back().duration + row.duration > longest) {
      out.push_back(row);
      continue;
    }
    Row& all = out.back();
    const double both = all.duration + row.duration;
    const double part = both > 0 ? row.duration / both : 0.0;
    for (std::size_t c = 0; c < 3; ++c) {
      all.mean[c] += part * (row.mean[c] - all.mean[c]);
    }
    all.time += 0.5 * row.duration;
    all.feeding += 0.5 * row.duration;
    all.duration = both;
    all.turns = 1.0;
  }
  return out;
}

Agreement agreement(std::span<const Row> rows, const Means& means, const Place& at) {
  Correlation sum;
  double all = 0.0;
  for (const Row& row : rows) {
    // The computed mean is that of a whole turn.
    const double middle = at.start + at.stretch * row.time;
    const double half = 0.5 * at.stretch * row.duration / row.turns;
    all += row.duration;
    if (const auto mean = means.mean(middle - half, middle + half)) {
      sum.add(row.group, row.mean, *mean, row.duration);
    }
  }
  return {sum.value(), all > 0 ? sum.weight() / all : 0.0};
}

double best_start(std::span<const Row> rows, const Means& means, const Place& about,
                  double reach) {
  constexpr int tries = 20;
  Place best = about;
  for (int round = 0; round < 4; ++round) {
    double most = -2.0;
    const double center = best.start;
    for (int i = -tries; i <= tries; ++i) {
      const Place at{center + reach * i / tries, about.stretch};
      const double value = agreement(rows, means, at).correlation;
      if (value > most) {
        most = value;
        best = at;
      }
    }
    reach *= 2.0 / tries;
  }
  return best.start;
}

Bins::Bins(const Recorded& record, const Means& means, double bin)
    : bin_(bin), start_(record.time.front()), sum_(1) {
  mean_.resize(static_cast<std::size_t>((record.time.back() - start_) / bin));
  Sum sum;
  for (std::size_t k = 0; k < mean_.size(); ++k) {
    const double from = start_ + static_cast<double>(k) * bin;
    mean_[k] = means.mean(from, from + bin).value_or(Vector{});
    for (std::size_t c = 0; c < 3; ++c) {
      sum.value[c] += mean_[k][c];
      sum.square += mean_[k][c] * mean_[k][c];
    }
    sum_.push_back(sum);
  }
}

Lag best_lag(std::span<const Row> rows, const Bins& record) {
  constexpr double least_common = 0.6;  // of the shorter one
  const std::size_t count =
      static_cast<std::size_t>(rows.back().to() / record.width()) + 1;
  const std::size_t there = record.size();
  const Computed computed = computed_bins(rows, record.width(), count);
  const double least =
      std::max(least_common * static_cast<double>(std::min(count, there)), 8.0);
  std::vector<double> found(count + there, -1.0);
  numerics::for_each_index(
      found.size(),
      [&](std::size_t i) {
        const std::size_t from = i < count ? count - i : 0;   // of the program
        const std::size_t begin = i < count ? 0 : i - count;  // in the record
        const std::size_t end = std::min(there, i);
        if (end < begin || static_cast<double>(end - begin) < least) return;
        Correlation sum;
        for (std::size_t k = begin; k < end; ++k) {
          const std::size_t at = from + k - begin;
          sum.add(computed.group[at], computed.mean[at], record[k], 1.0);
        }
        sum.add_air(computed.group.front(), record, 0, begin);
        sum.add_air(computed.group.back(), record, end, there);
        found[i] = sum.value();
      },
      16);
  const auto best = std::ranges::max_element(found) - found.begin();
  const auto start_of = [&](std::ptrdiff_t i) {
    return record.start() + record.width() * static_cast<double>(i) -
           record.width() * static_cast<double>(count);
  };
  Lag out{start_of(best), found[static_cast<std::size_t>(best)]};
  const auto far =
      std::max<std::ptrdiff_t>(10, static_cast<std::ptrdiff_t>(count / 50));
  if (const auto other = other_top(found, best, far); other >= 0) {
    out.other = start_of(other);
  }
  return out;
}

double whole_agreement(std::span<const Row> rows, const Bins& record) {
  const Computed computed =
      computed_bins(laid(rows, -record.start(), 1.0), record.width(), record.size());
  Correlation sum;
  for (std::size_t k = 0; k < record.size(); ++k) {
    sum.add(computed.group[k], computed.mean[k], record[k], 1.0);
  }
  return sum.value();
}

double bin_of(std::span<const Step> steps, const Recorded& record, std::size_t most) {
  const double end = steps.back().time + 0.5 * steps.back().duration;
  return std::max(
      {turn_time(steps), end / static_cast<double>(most), 2 * sample_time(record)});
}

bool can_align(std::span<const Step> steps, const Recorded& record) {
  const double turn = turn_time(steps);
  return !steps.empty() && record.time.size() >= 2 && turn > 0 &&
         record.time.back() - record.time.front() >= 10 * turn;
}

}  // namespace trochoid::engagement
