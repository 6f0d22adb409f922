#include <trochoid/results/plan.h>

#include <trochoid/base/overloaded.h>
#include <trochoid/base/units.h>
#include <trochoid/results/descriptions.h>
#include <trochoid/results/text_table.h>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace trochoid::results {

namespace {

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

/// A cut of a plan.
struct CutOfPlan {
  const PlanResult& r;
  const PlannedCut& cut;
};

const Fields<CutOfPlan>& planned_cut_fields() {
  using Of = const CutOfPlan&;
  static const Fields<CutOfPlan> all{
      {"engagement", "`slot`, `up` or `down`",
       [](Of c) { return engagements[c.cut.cut.engagement.index()]; }},
      {"feed_per_tooth_mm", "of the cut", [](Of c) { return given(c.cut.cut.f_z); }},
      {"axial_depth_mm", "of the cut", [](Of c) { return given(c.cut.cut.a_p); }},
      {"radial_depth_mm", "of a slot the diameter",
       [](Of c) { return given(radial_depth(c.r, c.cut.cut)); }},
      {"turns", "to be measured", [](Of c) { return c.r.turns; }},
      {"peak_force_N", "in the plane of the table",
       [](Of c) { return c.cut.peak_force; }},
      {"narrows",
       "I-21: geometric mean of the factors by which the standard errors of the "
       "quantities, taken together, become smaller; `null` where they are not all known "
       "so far",
       [](Of c) { return narrows(c.r, c.cut); }},
      Field<CutOfPlan>{
          "predicted",
          "of each quantity once the cut has been measured, together with what is known: "
          "the value is the present one. `radial_offset_2_mm` is the offset of tooth 2",
          [](Of c) {
            Object predicted;
            for (std::size_t i = 0; i < c.r.quantities.size(); ++i) {
              set(predicted, c.r.quantities[i].key,
                  interval(c.r.quantities[i], c.cut.se[i], c.r.factor_after));
            }
            return predicted;
          }}
          .with(below_estimate(".*."))};
  return all;
}

const Fields<PlanResult>& plan_fields() {
  using R = const PlanResult&;
  static const Fields<LeftOut> left_out{{"reason", "in words", &LeftOut::reason},
                                        {"count", "of cuts", &LeftOut::count}};
  static const Fields<PlanResult> all{
      {"cuts", "the best hundred, best first", planned_cut_fields(),
       [](R r) {
         std::vector<CutOfPlan> cuts;
         for (std::size_t i = 0; i < std::min(r.cuts.size(), most_in_summary); ++i) {
           cuts.push_back({r, r.cuts[i]});
         }
         return cuts;
       }},
      Field<PlanResult>{"before",
                        "each quantity as known so far; `null` where it is not",
                        [](R r) {
                          Object before;
                          for (const PlannedQuantity& q : r.quantities) {
                            set(before, q.key, interval(q, q.se, r.factor_before));
                          }
                          return before;
                        }}
          .with(below_estimate(".*.")),
      {"looked_at", "how many cuts", &PlanResult::looked_at},
      {"left_out", "those that were not compared", left_out, &PlanResult::left_out},
      {"noise_N", "of a sample; `null` of means",
       [](R r) { return r.channels.empty() ? Value(r.noise) : Value(); }},
      {"channels", "of which a mean is to be measured; empty: a record of the forces",
       &PlanResult::channels},
      {"mean_sd", "of the mean of each, in N, Nm or W", &PlanResult::mean_sd},
      {"noise_from",
       "whether it is of the `records` (widening of I-13 included), `given`, or `assumed`",
       &PlanResult::noise_from},
      {"turns", "of each cut", &PlanResult::turns},
      {"samples_per_rev", "of each cut", &PlanResult::samples_per_rev},
      {"files", "what was measured so far", &PlanResult::files},
      {"group",
       "whose coefficients these are, where the records have groups: the last one; else "
       "`null`",
       [](R r) { return r.group.empty() ? Value() : Value(r.group); }}};
  return all;
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

/// Every cut that was compared, the best first.
const Columns<PlanResult>& plan_columns() {
  using R = const PlanResult&;
  static const Columns<PlanResult> all{
      "plan.csv",
      [](R r) { return r.cuts.size(); },
      {{"engagement", "0 slot, 1 up, 2 down; the best cut first",
        [](R r, std::size_t i) { return r.cuts[i].cut.engagement.index(); }},
       {"feed_per_tooth_mm", "of the cut",
        [](R r, std::size_t i) { return given(r.cuts[i].cut.f_z); }},
       {"axial_depth_mm", "of the cut",
        [](R r, std::size_t i) { return given(r.cuts[i].cut.a_p); }},
       {"radial_depth_mm", "of a slot the diameter",
        [](R r, std::size_t i) { return given(radial_depth(r, r.cuts[i].cut)); }},
       {"peak_force_N", "in the plane of the table",
        [](R r, std::size_t i) { return r.cuts[i].peak_force; }},
       {"narrows", "as above, where the quantities are known so far",
        [](R r, std::size_t i) { return *narrows(r, r.cuts[i]); },
        [](R r) { return r.log_determinant.has_value(); }},
       {"half_width_*", "of the 95 % interval of each quantity after the cut",
        [](R r) {
          std::vector<std::string> names;
          for (const PlannedQuantity& q : r.quantities) names.push_back(q.key);
          return names;
        },
        [](R r, std::size_t i, std::size_t q) {
          return as_named(r.factor_after * r.cuts[i].se[q] / r.quantities[q].unit);
        }}}};
  return all;
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
                .result = plan_fields().object(r),
                .short_table = short_table(r)};
  if (!r.cuts.empty()) {
    answer.tables = {plan_columns().table(r)};
  }
  return answer;
}

Description description_of_plan() {
  Description all{.command = "plan", .keys = plan_fields().texts()};
  plan_columns().add_texts(all.columns);
  return all;
}

}  // namespace trochoid::results
