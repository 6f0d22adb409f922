#include <trochoid/results/calibrate_text.h>

#include <trochoid/base/units.h>
#include <trochoid/results/columns.h>
#include <trochoid/results/fields.h>
#include <trochoid/results/fit_value.h>
#include <trochoid/results/text_table.h>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <variant>

namespace trochoid::results {

namespace {

using surface::OffsetWave;
using surface::ToothDepth;

const surface::FloorTrace* floor_of(const MeasuredTrace& t) {
  return std::get_if<surface::FloorTrace>(&t.trace.line);
}

/// A tooth, and its number from 1.
struct Numbered {
  std::size_t number;
  const ToothDepth& tooth;
};

const Fields<Numbered>& tooth_fields() {
  using Of = const Numbered&;
  const auto writes = [](Of n) { return n.tooth.writes; };
  static const Fields<Numbered> all{
      {"tooth", "number, or place in the order of passage",
       [](Of n) { return n.number; }},
      {"writes", "whether the trace shows a mark of it", writes},
      {"share", "of the trace that it wrote", [](Of n) { return n.tooth.share; }},
      Field<Numbered>{
          "offset_mm",
          "against the deepest tooth, negative: shorter; along the axis on the "
          "floor, along the radius on the wall",
          [](Of n) { return estimate_value(n.tooth.offset, unit::mm); }, writes}
          .with(below_estimate()),
      {"at_most_mm", "of a tooth that writes nothing: its offset is no larger",
       [](Of n) { return n.tooth.at_most; }, [](Of n) { return !n.tooth.writes; }}};
  return all;
}

const Fields<OffsetWave>& wave_fields() {
  using Of = const OffsetWave&;
  static const Fields<OffsetWave> all{
      {"per_turn", "waves in a turn; 1 is what an eccentricity or a tilt does",
       &OffsetWave::k},
      Field<OffsetWave>{"amplitude_mm", "of the wave",
                        [](Of w) { return estimate_value(w.amplitude, unit::mm); }}
          .with(below_estimate()),
      Field<OffsetWave>{"phase_deg",
                        "of its crest, from the first tooth towards the next",
                        [](Of w) { return estimate_value(w.phase, unit::deg); }}
          .with(below_estimate())};
  return all;
}

const Fields<surface::FeedRoughness>& feed_fields() {
  static const Fields<surface::FeedRoughness> all{
      {"feed_per_tooth_mm", "from half the feed of the trace to one and a half",
       &surface::FeedRoughness::f_z},
      {"Ra_um", "of the marks of these teeth", &surface::FeedRoughness::Ra},
      {"Ra_alike_um", "with all teeth at one depth",
       &surface::FeedRoughness::Ra_alike}};
  return all;
}

const Fields<MeasuredTrace>& trace_fields() {
  using Of = const MeasuredTrace&;
  const auto ok = [](Of t) { return t.fit.ok; };
  static const Fields<MeasuredTrace> all{
      {"file", "as the case names it", [](Of t) { return t.file; }},
      {"floor_y_mm", "of a trace on the floor", [](Of t) { return floor_of(t)->y; },
       [](Of t) { return floor_of(t) != nullptr; }},
      {"height_mm", "of a trace on the wall",
       [](Of t) { return std::get<surface::WallTrace>(t.trace.line).height; },
       [](Of t) { return floor_of(t) == nullptr; }},
      {"message", "where it could not be fitted, why",
       [](Of t) { return t.fit.message; }, [](Of t) { return !t.fit.ok; }},
      {"numbered",
       "whether an unequal pitch tells which tooth is which; else they are in their order "
       "of passage, the deepest first",
       [](Of t) { return t.fit.numbered; }, ok},
      {"teeth", "in their order of passage", tooth_fields(),
       [](Of t) {
         std::vector<Numbered> all_teeth;
         for (std::size_t j = 0; j < t.fit.teeth.size(); ++j) {
           all_teeth.push_back({j + 1, t.fit.teeth[j]});
         }
         return all_teeth;
       },
       ok},
      {"waves", "of the offsets around the tool, where all teeth write", wave_fields(),
       [](Of t) { return t.fit.waves; }, [](Of t) { return !t.fit.waves.empty(); }},
      Field<MeasuredTrace>{"feed_mm", "of a turn, as the trace has it",
                           [](Of t) { return estimate_value(t.fit.feed, unit::mm); },
                           ok}
          .with(below_estimate()),
      {"feeds", "what the same teeth would leave at other feeds", feed_fields(),
       [](Of t) { return t.feeds; }, ok},
      {"turns", "of the spindle that the trace spans", [](Of t) { return t.fit.turns; },
       ok},
      {"readings", "of the trace", [](Of t) { return t.trace.x.size(); }},
      {"repeating", "share of what the fit leaves that repeats turn by turn",
       [](Of t) { return t.fit.repeating; }, ok},
      {"readings_as_one", "how many readings of what is left count as one",
       [](Of t) { return t.fit.correlated; }, ok},
      {"rms_um", "that the fit leaves", [](Of t) { return t.fit.rms; }, ok},
      {"waviness_um",
       "longer than the feed of a turn, from its lowest to its highest: taken out before the "
       "fit; 0: hardly any",
       [](Of t) { return t.fit.waviness; }, ok},
      {"Ra_measured_um", "of the trace less its line and its waviness, noise included",
       [](Of t) { return t.fit.Ra_measured; }, ok},
      {"Ra_um", "of the fitted profile, filtered as the trace",
       [](Of t) { return t.fit.Ra; }, ok},
      {"Ra_alike_um", "of the profile with all teeth at one depth",
       [](Of t) { return t.fit.Ra_alike; }, ok}};
  return all;
}

const Fields<CalibrateResult>& finish_fields() {
  static const Fields<CalibrateResult> all{
      {"finish", "`of = \"finish\"`: for each trace", trace_fields(),
       [](const CalibrateResult& r) { return r.traces; }}};
  return all;
}

/// All readings of all traces.
struct TracePoint {
  std::size_t trace;
  std::size_t reading;
};

TracePoint point_at(const CalibrateResult& r, std::size_t i) {
  std::size_t trace = 0;
  while (i >= r.traces[trace].fit.fitted.size()) {
    i -= r.traces[trace++].fit.fitted.size();
  }
  return {trace, i};
}

const Columns<CalibrateResult>& trace_columns() {
  using R = const CalibrateResult&;
  static const Columns<CalibrateResult> all{
      "trace.csv",
      [](R r) {
        std::size_t count = 0;
        for (const MeasuredTrace& t : r.traces) count += t.fit.fitted.size();
        return count;
      },
      {{"measurement", "of the case, from 1",
        [](R r, std::size_t i) { return point_at(r, i).trace + 1; }},
       {"x_mm", "along the feed",
        [](R r, std::size_t i) {
          const auto [t, k] = point_at(r, i);
          return r.traces[t].trace.x[k];
        }},
       {"measured_mm", "height of the surface",
        [](R r, std::size_t i) {
          const auto [t, k] = point_at(r, i);
          return r.traces[t].trace.z[k];
        }},
       {"fitted_mm", "the same by the fit",
        [](R r, std::size_t i) {
          const auto [t, k] = point_at(r, i);
          return r.traces[t].fit.fitted[k];
        }},
       {"residual_mm", "measured less fitted", [](R r, std::size_t i) {
          const auto [t, k] = point_at(r, i);
          return r.traces[t].trace.z[k] - r.traces[t].fit.fitted[k];
        }}}};
  return all;
}

std::string line_in_words(const MeasuredTrace& t) {
  const auto* const floor = floor_of(t);
  return floor != nullptr
             ? fmt::format("floor, y = {:g} mm", floor->y / unit::mm)
             : fmt::format(
                   "wall, {:g} mm above the tip",
                   std::get<surface::WallTrace>(t.trace.line).height / unit::mm);
}

std::string teeth_table(const MeasuredTrace& t) {
  std::vector<std::vector<std::string>> rows{
      {line_in_words(t), "offset [um]", "share"}};
  for (std::size_t j = 0; j < t.fit.teeth.size(); ++j) {
    const ToothDepth& tooth = t.fit.teeth[j];
    const double half = 0.5 * (tooth.offset.high - tooth.offset.low);
    const std::string what =
        !tooth.writes
            ? fmt::format("below {:.3g}, writes nothing", tooth.at_most / unit::um)
        : half > 0 ? fmt::format("{:.3f} +- {:.2g}", tooth.offset.value / unit::um,
                                 half / unit::um)
                   : fmt::format("{:.3f}", tooth.offset.value / unit::um);
    rows.push_back({t.fit.numbered ? fmt::format("tooth {}", j + 1)
                                   : fmt::format("tooth {} in order of passage", j + 1),
                    what, fmt::format("{:.0f} %", 100 * tooth.share)});
  }
  return aligned(rows);
}

/// runout.toml of the first trace on which all teeth write; empty where there is none.
std::string runout_text(const CalibrateResult& r) {
  for (const MeasuredTrace& t : r.traces) {
    if (!t.fit.ok || !std::ranges::all_of(t.fit.teeth, &ToothDepth::writes)) continue;
    std::vector<std::string> values;
    for (const ToothDepth& tooth : t.fit.teeth) {
      values.push_back(fmt::format("{:.6f}", tooth.offset.value / unit::mm));
    }
    return fmt::format(
        "# By trochoid calibrate, from {}.\n{}[runout]\n{} = [{}]\n", t.file,
        t.fit.numbered
            ? ""
            : "# Teeth in their order of passage: the deepest is called tooth "
              "1, as nothing tells which one it is.\n",
        floor_of(t) != nullptr ? "axial_offsets_mm" : "radial_offsets_mm",
        fmt::join(values, ", "));
  }
  return {};
}

}  // namespace

std::string finish_sentence(const CalibrateResult& r) {
  const auto fitted =
      std::ranges::find_if(r.traces, [](const MeasuredTrace& t) { return t.fit.ok; });
  if (fitted == r.traces.end()) return r.traces.front().fit.message;
  const surface::TraceFit& fit = fitted->fit;
  double least = 0.0;
  double half = 0.0;
  std::size_t silent = 0;
  for (const ToothDepth& tooth : fit.teeth) {
    silent += tooth.writes ? 0 : 1;
    if (!tooth.writes || tooth.offset.value >= least) continue;
    least = tooth.offset.value;
    half = tooth.offset.high - tooth.offset.value;
  }
  const std::size_t writing = fit.teeth.size() - silent;
  return fmt::format(
      "{} ({}){}. Ra is {:.3g} um; with all teeth at one depth it would be {:.3g} um.",
      writing > 1 ? fmt::format("The {} teeth that write differ by {:.3g} +- {:.2g} um",
                                writing, -least / unit::um, half / unit::um)
                  : "One tooth alone writes",
      line_in_words(*fitted),
      silent == 0 ? ""
                  : fmt::format("; {} of {} write{} nothing", silent, fit.teeth.size(),
                                silent == 1 ? "s" : ""),
      fit.Ra / unit::um, fit.Ra_alike / unit::um);
}

Answer answer_of_finish(const CalibrateResult& r) {
  Answer answer{.command = "calibrate",
                .heading = r.heading,
                .result = finish_fields().object(r)};
  if (!r.heading.ok) return answer;
  answer.short_table = r.heading.message + "\n";
  for (const MeasuredTrace& t : r.traces) {
    if (t.fit.ok) answer.short_table += "\n" + teeth_table(t);
  }
  answer.tables.push_back(trace_columns().table(r));
  if (const std::string runout = runout_text(r); !runout.empty()) {
    answer.texts = {{"runout.toml", runout}};
  }
  return answer;
}

void add_finish_description(Description& all) {
  for (const KeyText& text : finish_fields().texts()) all.keys.push_back(text);
  trace_columns().add_texts(all.columns);
}

}  // namespace trochoid::results
