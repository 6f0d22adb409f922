#include <trochoid/results/plan_finish.h>

#include <trochoid/base/units.h>
#include <trochoid/results/columns.h>
#include <trochoid/results/descriptions.h>
#include <trochoid/results/fields.h>
#include <trochoid/results/text_table.h>

#include <fmt/core.h>

#include <limits>
#include <variant>
#include <vector>

namespace trochoid::results {

namespace {

using surface::FinishOfFeed;
using surface::OfSets;

constexpr double no_Ra = std::numeric_limits<double>::quiet_NaN();

/// A line of the floor or the wall.
const Fields<surface::TraceLine>& finish_line_fields() {
  using Of = const surface::TraceLine&;
  const auto floor = [](Of l) { return std::get_if<surface::FloorTrace>(&l); };
  static const Fields<surface::TraceLine> all{
      {"floor_y_mm", "of a line on the floor", [floor](Of l) { return floor(l)->y; },
       [floor](Of l) { return floor(l) != nullptr; }},
      {"height_mm", "of a line on the wall",
       [](Of l) { return std::get<surface::WallTrace>(l).height; },
       [floor](Of l) { return floor(l) == nullptr; }}};
  return all;
}

const Fields<FinishOfFeed>& finish_feed_fields() {
  using Of = const FinishOfFeed&;
  static const Fields<FinishOfFeed> all{
      {"feed_per_tooth_mm", "of the cut", [](Of f) { return f.f_z; }},
      {"Ra_um", "of the teeth as they are, on the roughest of the lines",
       [](Of f) { return f.Ra.as_is; }},
      {"Ra_within_um",
       "that 95 of 100 sets of inserts within the tolerance keep, in a spindle that runs "
       "true; `null` where single teeth would leave material between their marks",
       [](Of f) { return f.Ra.within; }},
      {"Ra_alike_um", "of teeth at one depth; `null` likewise",
       [](Of f) { return f.Ra.alike; }}};
  return all;
}

const Fields<OfSets>& largest_feed_fields() {
  using Of = const OfSets&;
  static const Fields<OfSets> all{
      {"as_is_mm", "of the teeth as they are", [](Of o) { return o.as_is; }},
      {"within_mm", "of 95 of 100 sets of inserts within the tolerance",
       [](Of o) { return o.within; }},
      {"alike_mm", "of teeth at one depth", [](Of o) { return o.alike; }}};
  return all;
}

const Fields<PlanFinishResult>& finish_plan_fields() {
  using R = const PlanFinishResult&;
  static const Fields<PlanFinishResult> all{
      {"of", "`finish`: what is planned", [](R) { return "finish"; }},
      {"largest_Ra_um", "the limit, or `null`",
       [](R r) { return all_given(r.asked.limit); }},
      {"inserts_within_um", "tolerance of the sets of inserts",
       [](R r) { return given(r.asked.within); }},
      {"lines", "on which Ra counts", finish_line_fields(),
       [](R r) { return r.asked.lines; }},
      {"cutoff_mm", "of the roughness filter, or `null`: none",
       [](R r) { return r.asked.cutoff; }},
      {"largest_feed",
       "per tooth, up to which Ra keeps the limit; `null` where none does",
       largest_feed_fields(), [](R r) { return &r.plan.largest; }},
      {"feeds", "Ra at each feed", finish_feed_fields(),
       [](R r) { return r.plan.feeds; }}};
  return all;
}

const Columns<PlanFinishResult>& finish_feed_columns() {
  using R = const PlanFinishResult&;
  const auto um = [](const std::optional<double>& Ra) { return Ra ? *Ra : no_Ra; };
  static const Columns<PlanFinishResult> all{
      "plan.csv",
      [](R r) { return r.plan.feeds.size(); },
      {{"feed_per_tooth_mm", "of the cut",
        [](R r, std::size_t i) { return r.plan.feeds[i].f_z; }},
       {"Ra_um", "of the teeth as they are",
        [um](R r, std::size_t i) { return um(r.plan.feeds[i].Ra.as_is); }},
       {"Ra_within_um", "that 95 of 100 sets of inserts keep; empty: none",
        [um](R r, std::size_t i) { return um(r.plan.feeds[i].Ra.within); }},
       {"Ra_alike_um", "of teeth at one depth; empty: none",
        [um](R r, std::size_t i) { return um(r.plan.feeds[i].Ra.alike); }}}};
  return all;
}

std::string largest_feed_text(const PlanFinishResult& r,
                              const std::optional<double>& feed) {
  if (!feed) return "no feed looked at";
  const bool last = *feed == r.asked.feeds.back();
  return fmt::format("{}{:.3g} mm", last ? "at least " : "", *feed / unit::mm);
}

std::string finish_plan_table(const PlanFinishResult& r) {
  std::vector<std::vector<std::string>> rows{
      {"feed per tooth [mm]", "Ra [um]",
       fmt::format("set within {:.3g} um", r.asked.within / unit::um), "one depth"}};
  const auto um = [](const std::optional<double>& Ra) {
    return Ra ? fmt::format("{:.3g}", *Ra / unit::um) : "-";
  };
  for (const FinishOfFeed& f : r.plan.feeds) {
    rows.push_back({fmt::format("{:.4g}", f.f_z / unit::mm), um(f.Ra.as_is),
                    um(f.Ra.within), um(f.Ra.alike)});
  }
  return aligned(rows);
}

}  // namespace

std::string finish_plan_sentence(const PlanFinishResult& r) {
  if (!r.asked.limit) {
    return "Ra of each feed is in the table. [plan] largest_Ra_um names the largest feed "
           "that keeps a limit.";
  }
  const OfSets& largest = r.plan.largest;
  return fmt::format(
      "Ra stays within {:.3g} um up to these feeds per tooth: {} with the teeth as they "
      "are, {} with a set of inserts within {:.3g} um, {} with all teeth at one depth.",
      *r.asked.limit / unit::um, largest_feed_text(r, largest.as_is),
      largest_feed_text(r, largest.within), r.asked.within / unit::um,
      largest_feed_text(r, largest.alike));
}

Answer answer_of(const PlanFinishResult& r) {
  Answer answer{.command = "plan",
                .heading = r.heading,
                .result = finish_plan_fields().object(r)};
  if (r.heading.ok) {
    answer.short_table = r.heading.message + "\n\n" + finish_plan_table(r);
    answer.tables.push_back(finish_feed_columns().table(r));
  }
  return answer;
}

Description description_of_finish_plan() {
  Description all{.command = "plan of a finish", .keys = finish_plan_fields().texts()};
  finish_feed_columns().add_texts(all.columns);
  return all;
}

}  // namespace trochoid::results
