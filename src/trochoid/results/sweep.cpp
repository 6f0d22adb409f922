#include <trochoid/results/sweep.h>

#include <trochoid/results/descriptions.h>
#include <trochoid/results/hdf5_table.h>
#include <trochoid/results/spread.h>
#include <trochoid/results/text_table.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <utility>

namespace trochoid::results {

namespace {

/// Name of the column of a path: `result.peak_xy_N` is `peak_xy_N`.
std::string column_name(const std::string& path) {
  constexpr std::string_view common = "result.";
  return path.starts_with(common) ? path.substr(common.size()) : path;
}

/// Where what was taken stands in a row.
std::size_t place_of_take(const SweepResult& r, std::size_t i) {
  return r.keys.size() + r.drawn.size() + i;
}

base::Table table_of(const SweepResult& r) {
  base::Table table{"sweep.csv", {}};
  const auto add = [&](std::string name, std::size_t cell) {
    table.columns.push_back(r.rows.column(std::move(name), cell, 1));
  };
  for (std::size_t c = 0; c < r.keys.size(); ++c) add(r.keys[c], c);
  if (r.draws > 0) {
    base::add_column(table, "draw", r.rows.size(),
                     [&](std::size_t i) { return i % r.draws + 1; });
  }
  for (std::size_t c = 0; c < r.drawn.size(); ++c) {
    add(r.drawn[c], r.keys.size() + c);
  }
  for (std::size_t c = 0; c < r.take.size(); ++c) {
    add(column_name(r.take[c]), place_of_take(r, c));
  }
  table.columns.push_back({.name = "status", .values = {}, .texts = r.rows.statuses()});
  table.columns.push_back(
      {.name = "message", .values = {}, .texts = r.rows.messages()});
  return table;
}

/// Some rows.
struct Part {
  std::size_t first = 0;
  std::size_t count = 0;
};

Part all_of(const SweepResult& r) {
  return {0, r.rows.size()};
}

/// Numbers of some rows that answered; none: there are none.
std::optional<Spread> spread_in(const SweepResult& r, std::size_t take, Part part) {
  std::vector<double> values;
  const std::size_t cell = place_of_take(r, take);
  for (std::size_t i = part.first; i < part.first + part.count; ++i) {
    const double value = r.rows.number(i, cell);
    if (r.rows.status(i) == "ok" && !std::isnan(value)) values.push_back(value);
  }
  return values.empty() ? std::optional<Spread>() : spread_of(std::move(values));
}

/// What the rows say of one quantity.
struct Taken {
  const SweepResult& sweep;
  const std::string& path;
  std::optional<Spread> spread;  ///< none: no row has a number
};

std::vector<Taken> taken_of(const SweepResult& r) {
  std::vector<Taken> out;
  for (std::size_t i = 0; i < r.take.size(); ++i) {
    out.push_back({r, r.take[i], spread_in(r, i, all_of(r))});
  }
  return out;
}

const Fields<Taken>& taken_fields() {
  using Q = const Taken&;
  const auto known = [](Q q) { return q.spread.has_value(); };
  const auto by_chance = [](Q q) { return q.spread && q.sweep.by_chance; };
  const auto of = [](auto Spread::*member) {
    return [=](Q q) { return as_named(Value((*q.spread).*member)); };
  };
  static const Fields<Taken> all{
      {"take", "path of the quantity in the summary of a row",
       [](Q q) { return q.path; }},
      {"answers", "how many rows have a number of it",
       [](Q q) { return q.spread ? q.spread->count : 0; }},
      {"min", "the smallest of these numbers", of(&Spread::min), known},
      {"median", "half of these numbers are below it", of(&Spread::median), known},
      {"max", "the largest of these numbers", of(&Spread::max), known},
      {"mean", "of rows drawn by chance, or of draws of a single case",
       of(&Spread::mean), by_chance},
      {"sd", "standard deviation, likewise", of(&Spread::sd), by_chance},
      {"low", "lower end of the range in which 95 % of the rows lie, likewise",
       of(&Spread::low), by_chance},
      {"high", "upper end of this range", of(&Spread::high), by_chance},
      {"low_between",
       "range in which `low` lies with 95 % (U-7); `null` of fewer than 146 rows",
       of(&Spread::low_between), by_chance},
      {"high_between", "the same of `high`", of(&Spread::high_between), by_chance},
      {"without_answer", "fraction of rows without a number, likewise",
       [](Q q) {
         return 1 - static_cast<double>(q.spread->count) /
                        static_cast<double>(q.sweep.rows.size());
       },
       by_chance}};
  return all;
}

std::size_t answered(const SweepResult& r) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < r.rows.size(); ++i) {
    if (r.rows.status(i) == "ok") ++count;
  }
  return count;
}

const Fields<SweepResult>& sweep_fields() {
  using R = const SweepResult&;
  static const Fields<SweepResult> all{
      {"command", "that answered each row", &SweepResult::command},
      {"method", "`grid`, `list` or by chance, as in the case", &SweepResult::method},
      {"rows", "how many there are", [](R r) { return r.rows.size(); }},
      {"failed", "rows without an answer",
       [](R r) { return r.rows.size() - answered(r); }},
      {"keys", "that were swept", &SweepResult::keys},
      {"draws", "of each point; 0: none", &SweepResult::draws},
      {"drawn", "keys that were drawn", &SweepResult::drawn},
      {"quantities",
       "what was taken from each row. Of draws over a grid the intervals are in bands.csv",
       taken_fields(), taken_of}};
  return all;
}

/// Whether every point has an interval of its own.
bool has_bands(const SweepResult& r) {
  return r.draws > 0 && !r.by_chance;
}

/// The rows of each point, one after the other; the last may be cut short.
std::vector<Part> points_of(const SweepResult& r) {
  std::vector<Part> points;
  for (std::size_t i = 0; i < r.rows.size(); i += r.draws) {
    points.push_back({i, std::min(r.draws, r.rows.size() - i)});
  }
  return points;
}

/// bands.csv: of each point the interval of what was taken.
base::Table bands_table(const SweepResult& r) {
  base::Table table{"bands.csv", {}};
  const auto points = points_of(r);
  for (std::size_t c = 0; c < r.keys.size(); ++c) {
    table.columns.push_back(r.rows.column(r.keys[c], c, r.draws));
  }
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t t = 0; t < r.take.size(); ++t) {
    if (r.rows.has_texts(place_of_take(r, t))) continue;
    std::vector<std::optional<Spread>> spread;
    for (const auto& point : points) {
      spread.push_back(spread_in(r, t, point));
    }
    const auto add = [&](const char* what, double Spread::*member) {
      base::add_column(
          table, fmt::format("{}_{}", what, column_name(r.take[t])), points.size(),
          [&](std::size_t p) { return spread[p] ? (*spread[p]).*member : none; });
    };
    add("median", &Spread::median);
    add("low", &Spread::low);
    add("high", &Spread::high);
    add("sd", &Spread::sd);
    base::add_column(table, fmt::format("failed_{}", column_name(r.take[t])),
                     points.size(), [&](std::size_t p) {
                       return points[p].count - (spread[p] ? spread[p]->count : 0);
                     });
  }
  return table;
}

std::string cell_text(double value) {
  return fmt::format("{:.5g}", value);
}

/// A row for each point: the keys, then median and interval of what was taken.
std::string points_table(const SweepResult& r) {
  constexpr std::size_t most_shown = 24;
  std::vector<std::vector<std::string>> rows(1, r.keys);
  for (const std::string& take : r.take) {
    const std::string name = column_name(take);
    rows[0].insert(rows[0].end(), {name, "95 % from", "to"});
  }
  const auto points = points_of(r);
  for (const auto& point :
       std::span(points).first(std::min(points.size(), most_shown))) {
    auto& row = rows.emplace_back();
    for (std::size_t k = 0; k < r.keys.size(); ++k) {
      row.push_back(r.rows.text(point.first, k));
    }
    for (std::size_t t = 0; t < r.take.size(); ++t) {
      const auto spread = spread_in(r, t, point);
      const std::size_t place = row.size();
      row.resize(place + 3);
      row[place] = spread ? cell_text(spread->median) : "no number";
      row[place + 1] = spread ? cell_text(spread->low) : "";
      row[place + 2] = spread ? cell_text(spread->high) : "";
    }
  }
  return aligned(rows) +
         (points.size() > most_shown
              ? fmt::format("and {} more: bands.csv\n", points.size() - most_shown)
              : std::string());
}

/// How well the ends of the intervals are known, in words.
std::string ends_line(const SweepResult& r) {
  const std::size_t each = r.by_chance ? r.rows.size() : r.draws;
  if (r.draws == 0 || r.rows.empty()) {
    return {};
  }
  if (each < least_for_bounds) {
    return fmt::format(
        "(of {} draws the ends of the 95 % are hardly known; {} draws or more tell how "
        "well)\n",
        each, least_for_bounds);
  }
  const auto spread = r.by_chance ? spread_in(r, 0, all_of(r)) : std::nullopt;
  if (!spread || !spread->low_between) {
    return {};
  }
  return fmt::format(
      "(of {} draws; more of them would move the ends of the 95 % of {}: the lower one "
      "lies within {} to {}, the upper one within {} to {})\n",
      spread->count, column_name(r.take[0]), cell_text((*spread->low_between)[0]),
      cell_text((*spread->low_between)[1]), cell_text((*spread->high_between)[0]),
      cell_text((*spread->high_between)[1]));
}

std::string short_table(const SweepResult& r) {
  if (has_bands(r)) {
    return points_table(r) + ends_line(r);
  }
  std::vector<std::vector<std::string>> rows;
  rows.push_back(r.by_chance ? std::vector<std::string>{"", "median", "95 % from", "to"}
                             : std::vector<std::string>{"", "least", "median", "most"});
  for (std::size_t i = 0; i < r.take.size(); ++i) {
    const std::string name = column_name(r.take[i]);
    const auto spread = spread_in(r, i, all_of(r));
    if (!spread) {
      rows.push_back({name, "no number", "", ""});
    } else if (r.by_chance) {
      rows.push_back({name, cell_text(spread->median), cell_text(spread->low),
                      cell_text(spread->high)});
    } else {
      rows.push_back({name, cell_text(spread->min), cell_text(spread->median),
                      cell_text(spread->max)});
    }
  }
  return aligned(rows) + ends_line(r);
}

}  // namespace

std::string ranges_of(const SweepResult& r) {
  constexpr std::size_t most_named = 3;
  std::string text;
  std::size_t named = 0;
  for (std::size_t i = 0; i < r.take.size(); ++i) {
    const auto spread = spread_in(r, i, all_of(r));
    if (!spread) continue;
    if (++named > most_named) return text + "; and more.";
    const std::string name = column_name(r.take[i]);
    text += text.empty() ? " " : "; ";
    text += r.by_chance ? fmt::format("{} is {} (95 %: {} to {})", name,
                                      cell_text(spread->median), cell_text(spread->low),
                                      cell_text(spread->high))
                        : fmt::format("{} goes from {} to {}", name,
                                      cell_text(spread->min), cell_text(spread->max));
  }
  return text.empty() ? text : text + '.';
}

Answer answer_of(const SweepResult& r) {
  Answer answer{.command = "sweep",
                .heading = r.heading,
                .result = sweep_fields().object(r),
                .short_table = short_table(r),
                .tables = {table_of(r)}};
  if (r.hdf5) {
    answer.texts.push_back({"sweep.h5", hdf5_table(answer.tables.front())});
  }
  if (has_bands(r) && !r.rows.empty()) {
    answer.tables.push_back(bands_table(r));
  }
  return answer;
}

Description description_of_sweep() {
  return {.command = "sweep",
          .keys = sweep_fields().texts(),
          .columns = {
              {"sweep.csv", "*", "each swept key, under its own name"},
              {"sweep.csv", "draw", "with draws: number of the draw of a point"},
              {"sweep.csv", "*", "each drawn key, under its own name"},
              {"sweep.csv", "*", "what was taken, by its path without `result.`"},
              {"sweep.csv", "status", "`ok`, `failed` or `wrong_input`"},
              {"sweep.csv", "message", "of the row"},
              {"bands.csv", "*", "each swept key: a row for each point"},
              {"bands.csv", "median_*", "of the draws of the point, of what was taken"},
              {"bands.csv", "low_*",
               "lower end of the range in which 95 % of the draws lie"},
              {"bands.csv", "high_*", "upper end of this range"},
              {"bands.csv", "sd_*", "standard deviation of the draws"},
              {"bands.csv", "failed_*", "draws without a number"}}};
}

}  // namespace trochoid::results
