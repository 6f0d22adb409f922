#include <trochoid/base/error.h>
#include <trochoid/base/units.h>
#include <trochoid/run/commands.h>

#include <fmt/core.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace trochoid::run {

namespace {

decltype(surface::Trace::line) line_of(const cases::Case& given,
                                       const cases::SurfaceMeasurement& m) {
  if (!m.floor_y) return surface::WallTrace{m.source.height.value_or(0.0)};
  return surface::FloorTrace{{given.dish, given.wiper, given.spindle_lead}, *m.floor_y};
}

/// A file as a trace, in the order of x.
surface::Trace trace_of(const cases::Case& given, const cases::SurfaceMeasurement& m,
                        const files::SurfaceFile& file) {
  surface::Trace trace{
      .line = line_of(given, m),
      .cutoff = given.machine.surface.value_or(cases::Surface{}).cutoff};
  std::vector<std::pair<double, double>> points;
  for (const files::SurfaceReading& reading : file.readings) {
    if (!reading.x) {
      throw base::InputError({fmt::format(
          "{}:{}: a trace needs a column x: the place along the feed, with its unit",
          m.source.file.path, reading.line)});
    }
    points.emplace_back(*reading.x + reading.feed_offset.value_or(0.0), reading.error);
  }
  std::ranges::sort(points);
  for (const auto& [x, z] : points) {
    trace.x.push_back(x);
    trace.z.push_back(z);
  }
  return trace;
}

/// More of what is left than this repeats: it is no noise.
constexpr double much_repeats = 0.2;
/// More of the trace than this is left.
constexpr double much_left = 0.5;

/// Whether a poor fit is a good one with x the other way round.
bool fits_backwards(const cases::Case& given, const results::MeasuredTrace& t) {
  if (t.trace.x.empty() || (t.fit.ok && t.fit.rms < much_left * t.fit.Ra_measured)) {
    return false;
  }
  surface::Trace turned = t.trace;
  for (double& x : turned.x) x = -x;
  std::ranges::reverse(turned.x);
  std::ranges::reverse(turned.z);
  const surface::TraceFit fit = surface::fit_trace(given.setup, turned);
  return fit.ok && fit.rms < 0.5 * t.fit.rms;
}

/// What stands in the way of believing one trace.
void add_trace_warnings(const cases::Case& given, const results::MeasuredTrace& t,
                        results::CalibrateResult& r) {
  const auto add = [&](const char* code, const std::string& what) {
    r.heading.warnings.push_back({code, t.file + ": " + what});
  };
  if (fits_backwards(given, t)) {
    add("against_the_feed",
        "turned round the trace fits much better. Does x run against the feed? Then give "
        "x the other sign.");
    return;
  }
  if (!t.fit.ok) {  // of all traces it is the message
    if (r.heading.ok) add("trace_not_fitted", t.fit.message);
    return;
  }
  if (t.fit.waviness > 0.0) {
    add("waviness",
        fmt::format(
            "the trace waves by {:.2g} um over more than the feed of a turn. The mean "
            "over a turn was taken out; marks and Ra are without it.",
            t.fit.waviness / unit::um));
  }
  if (t.fit.repeating > much_repeats) {
    add("other_marks",
        fmt::format(
            "{:.0f} % of what the fit leaves repeats turn by turn: the marks have "
            "another shape than dish_deg, wiper_mm and the corner say, or the "
            "instrument filtered them (cutoff_mm of [surface]). The intervals do "
            "not count that.",
            100 * t.fit.repeating));
  }
  if (t.fit.rms > much_left * t.fit.Ra_measured) {
    add("poor_trace",
        fmt::format(
            "the fit leaves {:.2g} um rms of a trace with Ra {:.2g} um: other "
            "things than the marks of these teeth are on it. Are dish_deg, "
            "corner_radius_mm and the feed right for this cut, and is x along the "
            "feed?",
            t.fit.rms / unit::um, t.fit.Ra_measured / unit::um));
  }
}

/// What stands in the way of believing it.
void add_finish_warnings(const cases::Case& given, results::CalibrateResult& r) {
  const bool floor = std::ranges::any_of(r.traces, [](const auto& t) {
    return std::holds_alternative<surface::FloorTrace>(t.trace.line);
  });
  const surface::BottomEdge bottom{given.dish, given.wiper, given.spindle_lead};
  if (floor && surface::is_flat(given.setup.cutter.profile, bottom)) {
    r.heading.warnings.push_back(
        {"flat_floor",
         "The bottom edge is flat up to the axis: the deepest tooth wipes away all marks. "
         "Inserts rise towards the axis; give dish_deg of [tool], often 1 to 3 deg."});
  }
  if (!geometry::runs_true(given.setup.runout)) {
    r.heading.warnings.push_back(
        {"runout_not_used", "[runout] is not used: calibrate looks for it itself."});
  }
  for (const results::MeasuredTrace& t : r.traces) {
    add_trace_warnings(given, t, r);
  }
}

}  // namespace

results::CalibrateResult calibrate_finish(const cases::Case& given,
                                          const Progress& progress) {
  results::CalibrateResult r{.heading = heading_of(given)};
  r.teeth = given.setup.cutter.teeth();
  for (const cases::SurfaceMeasurement& m : given.machine.surface_measurements) {
    progress("Fitting the marks of the teeth");
    const files::SurfaceFile& file = m.surface.get();
    for (const base::Warning& note : file.notes) {
      r.heading.warnings.push_back(
          {note.code, m.source.file.path + ": " + note.message});
    }
    surface::Trace trace = trace_of(given, m, file);
    surface::TraceFit fit = surface::fit_trace(given.setup, trace);
    auto feeds = fit.ok ? surface::roughness_at_feeds(given.setup, trace, fit)
                        : std::vector<surface::FeedRoughness>{};
    r.traces.push_back(
        {m.source.file.path, std::move(trace), std::move(fit), std::move(feeds)});
  }
  r.heading.ok = std::ranges::any_of(r.traces, [](const auto& t) { return t.fit.ok; });
  r.heading.message = results::finish_sentence(r);
  add_finish_warnings(given, r);
  return r;
}

}  // namespace trochoid::run
