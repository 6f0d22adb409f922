#include <trochoid/files/channel_starts.h>

#include <trochoid/files/csv.h>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace trochoid::files {

namespace {

constexpr int reach = 8;                ///< samples to either side
constexpr double whole_step = 1e-3;     ///< of a step: less is rounding of the file
constexpr std::size_t least_left = 30;  ///< samples that all have

double sinc(double x) {
  const double y = std::numbers::pi * x;
  return std::abs(y) < 1e-12 ? 1.0 : std::sin(y) / y;
}

/// Weights of the samples around a place that is a part of a step after one of them.
std::vector<double> weights(double part) {
  std::vector<double> out;
  double sum = 0.0;
  for (int j = -reach + 1; j <= reach; ++j) {
    const double x = part - j;
    out.push_back(sinc(x) * sinc(x / reach));
    sum += out.back();
  }
  for (double& w : out) w /= sum;
  return out;
}

/// Where a column stands at the first common time.
struct Place {
  std::size_t sample = 0;
  double part = 0.0;  ///< of a step after it, 0 to 1

  [[nodiscard]] bool between() const noexcept { return part > 0.0; }
};

Place place_of(double steps) {
  const double nearest = std::round(steps);
  if (std::abs(steps - nearest) <= whole_step) {
    return {static_cast<std::size_t>(nearest), 0.0};
  }
  const double below = std::floor(steps);
  return {static_cast<std::size_t>(below), steps - below};
}

void move_column(const Place& place, std::size_t count, std::vector<double>& values) {
  std::vector<double> out(count);
  const auto from = values.begin() + static_cast<std::ptrdiff_t>(place.sample);
  if (place.between()) {
    const std::vector<double> w = weights(place.part);
    for (std::size_t n = 0; n < count; ++n) {
      const auto first = from + static_cast<std::ptrdiff_t>(n) - reach + 1;
      double sum = 0.0;  // S-9
      for (std::size_t j = 0; j < w.size(); ++j) {
        sum += w[j] * *(first + static_cast<std::ptrdiff_t>(j));
      }
      out[n] = sum;
    }
  } else {
    std::copy_n(from, count, out.begin());
  }
  values = std::move(out);
}

std::string late_text(std::span<const StartedColumn> columns, double first) {
  std::vector<std::string> parts;
  for (const StartedColumn& column : columns) {
    if (column.start == first) continue;
    parts.push_back(fmt::format("column {} starts {:.6g} ms after the first",
                                excerpt(column.name), 1e3 * (column.start - first)));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

}  // namespace

Starts align_starts(std::span<StartedColumn> columns, double rate) {
  const auto ends = std::ranges::minmax(columns, {}, &StartedColumn::start);
  const double earliest = ends.min.start;
  const double latest = ends.max.start;
  Starts out{.first = latest, .problem = {}, .note = {}};
  if ((latest - earliest) * rate <= whole_step) {
    out.first = columns.front().start;
    return out;
  }
  const std::string late = late_text(columns, earliest);
  std::vector<Place> places;
  const auto steps_late = [&](const StartedColumn& column) {
    return (latest - column.start) * rate;
  };
  const bool between = std::ranges::any_of(columns, [&](const StartedColumn& column) {
    return steps_late(column) < 1e15 && place_of(steps_late(column)).between();
  });
  const std::size_t margin = between ? reach : 0;
  std::size_t count = columns.front().values->size();
  for (const StartedColumn& column : columns) {
    const double late_by = steps_late(column);
    const std::size_t size = column.values->size();
    const double needed = late_by + static_cast<double>(2 * margin + least_left);
    if (!(needed < static_cast<double>(size))) {
      out.problem = late + ": the columns were not recorded at the same time";
      return out;
    }
    Place& place = places.emplace_back(place_of(late_by));
    place.sample += margin;
    count = std::min(count, size - place.sample - margin);
  }
  for (std::size_t i = 0; i < columns.size(); ++i) {
    move_column(places[i], count, *columns[i].values);
  }
  out.first += static_cast<double>(margin) / rate;
  out.note =
      fmt::format("{}: {} brought to common times{}.", late,
                  columns.size() > 2 ? "all columns were" : "both columns were",
                  between ? ", by interpolation where these lie between samples" : "");
  return out;
}

}  // namespace trochoid::files
