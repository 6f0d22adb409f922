#include <trochoid/run/program.h>

#include <trochoid/base/units.h>
#include <trochoid/dynamics/tool_point.h>
#include <trochoid/run/problems.h>
#include <trochoid/run/vibration.h>

#include <fmt/core.h>

#include <algorithm>
#include <map>

namespace trochoid::run {

namespace {

/// Less of the time in cut than this is said.
constexpr double nearly_all = 0.999;

/// The worst cut of each line that chatters.
std::vector<results::ChatteringLine> chattering(
    std::span<const engagement::Step> steps, const results::ProgramChatter& chatter) {
  std::map<std::uint32_t, results::ChatteringLine> worst;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (chatter.cut_of[i] < 0) continue;
    const auto k = static_cast<std::size_t>(chatter.cut_of[i]);
    const engagement::SharedCut& cut = chatter.cuts[k];
    const engagement::ChatterLimit& limit = chatter.limits[k];
    if (!limit.known || !limit.depth || limit.margin >= 1) continue;
    const auto [at, is_new] = worst.try_emplace(steps[i].line);
    if (is_new || limit.margin < at->second.margin) {
      at->second = {steps[i].line,   limit.margin, *limit.depth,
                    limit.frequency, cut.spindle,  limit.better_spindle};
    }
  }
  std::vector<results::ChatteringLine> out;
  out.reserve(worst.size());
  for (const auto& [line, one] : worst) out.push_back(one);
  return out;
}

double part_looked_at(const results::ProgramChatter& chatter) {
  double known = 0.0;
  double all = 0.0;
  for (std::size_t k = 0; k < chatter.cuts.size(); ++k) {
    all += chatter.cuts[k].duration;
    known += chatter.limits[k].known ? chatter.cuts[k].duration : 0.0;
  }
  return all > 0 ? known / all : 0.0;
}

}  // namespace

engagement::Vibration vibration_of(const cases::Case& given,
                                   std::vector<base::Warning>& warnings) {
  engagement::Vibration out{chip_modes(given.machine.modes),
                            stability_options(given).chip_floor};
  warn_one_direction(given, warnings);
  if (!given.machine.modes.empty() || given.machine.measured_frfs.empty()) return out;
  const dynamics::ToolPoint point =
      dynamics::tool_point(tool_responses(given, warnings), true);
  if (!point.no_modes) {
    out.system = point.modes;
    return out;
  }
  const cases::MeasuredFrf& of = given.machine.measured_frfs[point.no_modes->response];
  warnings.push_back(
      {"no_modes",
       fmt::format("{}: {}. Without modes the answer names no line that chatters.",
                   of.source.file.name, point.no_modes->reason)});
  return out;
}

std::optional<results::ProgramChatter> chatter_of(
    std::span<const engagement::Step> steps, std::span<const engagement::Tool> tools,
    std::span<const engagement::Vibration> vibrations, const Progress& progress,
    const base::Stop& stop) {
  if (std::ranges::all_of(vibrations,
                          [](const auto& one) { return one.system.modes.empty(); })) {
    return std::nullopt;
  }
  results::ProgramChatter out;
  engagement::SharedCuts cuts(tools, vibrations);
  cuts.add(steps, out.cut_of);
  out.cuts = cuts.all();
  out.limits = engagement::chatter_limits(out.cuts, tools, vibrations,
                                          {.stop = stop, .progress = [&](double share) {
                                             progress({"Chatter", share});
                                           }});
  out.looked_at = part_looked_at(out);
  out.lines = chattering(steps, out);
  return out;
}

void warn_of_chatter(const results::ProgramChatter& chatter,
                     std::vector<base::Warning>& warnings) {
  if (!chatter.lines.empty()) {
    const results::ChatteringLine& first =
        *std::ranges::min_element(chatter.lines, {}, &results::ChatteringLine::margin);
    const std::string better =
        first.better_spindle
            ? fmt::format(" At {:.0f} rpm, with the same feed per tooth, it is stable.",
                          *first.better_spindle / unit::rpm)
            : std::string(" No speed within 30 % makes it stable.");
    warnings.push_back(
        {"chatter",
         fmt::format(
             "{} lines chatter, line {} most: there the cut is stable up to {:.3g} "
             "mm, and chatters at {:.4g} Hz.{}",
             chatter.lines.size(), first.line, first.limit_depth / unit::mm,
             first.frequency, better)});
  }
  const auto known =
      std::ranges::count(chatter.limits, true, &engagement::ChatterLimit::known);
  if (chatter.looked_at < nearly_all) {
    warnings.push_back(
        {"chatter_not_everywhere",
         fmt::format(
             "The program has {} different cuts. Whether they chatter was looked at "
             "for {} of them, {:.0f} % of the time in cut.",
             chatter.cuts.size(), known, 100 * chatter.looked_at)});
  }
}

}  // namespace trochoid::run
