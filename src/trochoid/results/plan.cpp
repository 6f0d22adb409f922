#include <trochoid/results/plan.h>

#include <trochoid/base/overloaded.h>
#include <trochoid/base/units.h>
#include <trochoid/results/text_table.h>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace trochoid::results {

namespace {

using base::add_column;

/// So many of the cuts are in the summary; all are in plan.csv.
constexpr std::size_t most_in_summary = 100;
/// So many are printed.
constexpr std::size_t most_printed = 5;
/// So many quantities are named in a sentence.
constexpr std::size_t most_in_sentence = 4;

constexpr std::array<std::string_view, 4> engagements{"slot", "up", "down", "band"};

double radial_depth(const PlanResult& r, const geometry::Cut& cut) {
  return std::visit(
      base::Overloaded{[](const geometry::UpMilling& up) { return up.a_e; },
                       [](const geometry::DownMilling& down) { return down.a_e; },
                       [&](const auto&) { return r.diameter; }},
      cut.engagement);
}

/// Geometric mean by which the joint region of the quantities becomes narrower.
std::optional<double> narrows(const PlanResult& r, const PlannedCut& cut) {
  if (!r.log_determinant || r.parameters == 0) {
    return std::nullopt;
  }
  return std::exp((*r.log_determinant - cut.log_determinant) /
                  (2.0 * static_cast<double>(r.parameters)));
}

Value interval(const PlannedQuantity& q, const std::optional<double>& se,
               double factor) {
  if (!se) {
    return nullptr;
  }
  return Object{{"value", q.value / q.unit},
                {"se", *se / q.unit},
                {"low", (q.value - factor * *se) / q.unit},
                {"high", (q.value + factor * *se) / q.unit}};
}

Object cut_value(const PlanResult& r, const PlannedCut& cut) {
  Object predicted;
  for (std::size_t i = 0; i < r.quantities.size(); ++i) {
    set(predicted, r.quantities[i].key,
        interval(r.quantities[i], cut.se[i], r.factor_after));
  }
  return {{"engagement", engagements[cut.cut.engagement.index()]},
          {"feed_per_tooth_mm", unit::in(cut.cut.f_z, unit::mm)},
          {"axial_depth_mm", unit::in(cut.cut.a_p, unit::mm)},
          {"radial_depth_mm", unit::in(radial_depth(r, cut.cut), unit::mm)},
          {"turns", r.turns},
          {"peak_force_N", cut.peak_force},
          {"narrows", narrows(r, cut)},
          {"predicted", std::move(predicted)}};
}

Object result_of(const PlanResult& r) {
  Array cuts;
  for (std::size_t i = 0; i < std::min(r.cuts.size(), most_in_summary); ++i) {
    cuts.emplace_back(cut_value(r, r.cuts[i]));
  }
  Object before;
  for (const PlannedQuantity& q : r.quantities) {
    set(before, q.key, interval(q, q.se, r.factor_before));
  }
  Array left_out;
  for (const LeftOut& one : r.left_out) {
    left_out.emplace_back(Object{{"reason", one.reason}, {"count", one.count}});
  }
  return {{"cuts", std::move(cuts)},
          {"before", std::move(before)},
          {"looked_at", r.looked_at},
          {"left_out", std::move(left_out)},
          {"noise_N", r.noise},
          {"noise_from", r.noise_from},
          {"turns", r.turns},
          {"samples_per_rev", r.samples_per_rev},
          {"files", r.files},
          {"group", r.group.empty() ? Value() : Value(r.group)}};
}

/// `+- 4.2 %`, or `+- 0.8 um` of what may be zero.
std::string spread(const PlannedQuantity& q, double half) {
  return q.relative ? fmt::format("+- {:.2g} %", 100.0 * half / std::abs(q.value))
                    : fmt::format("+- {:.2g} um", half / unit::um);
}

std::string short_table(const PlanResult& r) {
  if (r.cuts.empty()) {
    return "No answer: " + r.heading.message + "\n";
  }
  std::vector<std::vector<std::string>> rows{{"cut (95 %: +-)", "peak_N"}};
  std::vector<std::string> before{"so far", "-"};
  for (const PlannedQuantity& q : r.quantities) {
    rows[0].push_back(q.words);
    before.push_back(q.se ? spread(q, r.factor_before * *q.se) : "not known");
  }
  rows.push_back(std::move(before));
  for (std::size_t i = 0; i < std::min(r.cuts.size(), most_printed); ++i) {
    const PlannedCut& cut = r.cuts[i];
    std::vector<std::string> cells{cut_words(cut.cut),
                                   fmt::format("{:.0f}", cut.peak_force)};
    for (std::size_t q = 0; q < r.quantities.size(); ++q) {
      cells.push_back(spread(r.quantities[q], r.factor_after * cut.se[q]));
    }
    rows.push_back(std::move(cells));
  }
  std::string text = r.heading.message + "\n\n" + aligned(rows);
  text += fmt::format("{} of {} cuts compared", r.cuts.size(), r.looked_at);
  for (const LeftOut& one : r.left_out) {
    text += fmt::format("; {} left out: {}", one.count, one.reason);
  }
  text += '\n';
  return r.group.empty() ? text : text + fmt::format("coefficients of {}\n", r.group);
}

/// plan.csv: every cut that was compared, the best first.
base::Table table_of(const PlanResult& r) {
  base::Table table{"plan.csv", {}};
  const std::size_t n = r.cuts.size();
  const auto add = [&](std::string name, const auto& value) {
    add_column(table, std::move(name), n,
               [&](std::size_t i) { return value(r.cuts[i]); });
  };
  add("engagement", [](const PlannedCut& c) { return c.cut.engagement.index(); });
  add("feed_per_tooth_mm",
      [](const PlannedCut& c) { return unit::in(c.cut.f_z, unit::mm); });
  add("axial_depth_mm",
      [](const PlannedCut& c) { return unit::in(c.cut.a_p, unit::mm); });
  add("radial_depth_mm",
      [&](const PlannedCut& c) { return unit::in(radial_depth(r, c.cut), unit::mm); });
  add("peak_force_N", [](const PlannedCut& c) { return c.peak_force; });
  if (r.log_determinant) {
    add("narrows", [&](const PlannedCut& c) { return *narrows(r, c); });
  }
  for (std::size_t q = 0; q < r.quantities.size(); ++q) {
    add("half_width_" + r.quantities[q].key, [&](const PlannedCut& c) {
      return r.factor_after * c.se[q] / r.quantities[q].unit;
    });
  }
  return table;
}

}  // namespace

std::string cut_words(const geometry::Cut& cut) {
  const std::string depths =
      fmt::format("axial depth {:g} mm, feed {:g} mm per tooth",
                  unit::in(cut.a_p, unit::mm), unit::in(cut.f_z, unit::mm));
  const auto side = [&](std::string_view way, double a_e) {
    return fmt::format("{} milling, radial depth {:g} mm, {}", way,
                       unit::in(a_e, unit::mm), depths);
  };
  return std::visit(
      base::Overloaded{
          [&](const geometry::UpMilling& up) { return side("up", up.a_e); },
          [&](const geometry::DownMilling& down) { return side("down", down.a_e); },
          [&](const auto&) { return "slot, " + depths; }},
      cut.engagement);
}

std::string next_cut_sentence(const PlanResult& r) {
  const PlannedCut& best = r.cuts.front();
  std::string text = fmt::format("Cut next: {}, {} turn{}. It ", cut_words(best.cut),
                                 r.turns, r.turns == 1 ? "" : "s");
  std::vector<std::string> narrowed;
  std::vector<std::string> told;
  for (std::size_t i = 0; i < std::min(r.quantities.size(), most_in_sentence); ++i) {
    const PlannedQuantity& q = r.quantities[i];
    const std::string after = spread(q, r.factor_after * best.se[i]);
    if (q.se) {
      narrowed.push_back(fmt::format("{} from {} to {}", q.words,
                                     spread(q, r.factor_before * *q.se), after));
    } else {
      told.push_back(fmt::format("{} to {}", q.words, after));
    }
  }
  if (!narrowed.empty()) {
    text += fmt::format("narrows {}", fmt::join(narrowed, ", "));
  }
  if (!told.empty()) {
    text += fmt::format("{}tells {}", narrowed.empty() ? "" : ", and ",
                        fmt::join(told, ", "));
  }
  return text + " (95 %).";
}

Answer answer_of(const PlanResult& r) {
  Answer answer{.command = "plan",
                .heading = r.heading,
                .result = result_of(r),
                .short_table = short_table(r)};
  if (!r.cuts.empty()) {
    answer.tables = {table_of(r)};
  }
  return answer;
}

}  // namespace trochoid::results
