#include <trochoid/run/program.h>

#include <trochoid/base/units.h>

#include <fmt/core.h>

#include <algorithm>
#include <limits>
#include <map>
#include <utility>

namespace trochoid::run {

namespace {

/// Adds up the walls of a line, its steps weighed by their turns.
struct WallSum {
  engagement::WallError error{.least = std::numeric_limits<double>::infinity(),
                              .most = -std::numeric_limits<double>::infinity()};
  double turns = 0.0;

  void add(const engagement::WallError& one, double weight) {
    error.least = std::min(error.least, one.least);
    error.most = std::max(error.most, one.most);
    error.mean += weight * one.mean;
    turns += weight;
  }
};

void raise(std::optional<results::WallExtreme>& extreme, double error, bool farther,
           const engagement::Step& step, bool left) {
  if (!extreme || farther) extreme = {error, step.line, left, step.place};
}

}  // namespace

std::optional<results::ProgramWalls> walls_of(const engagement::Job& job,
                                              std::span<const engagement::Step> steps,
                                              const Progress& progress) {
  if (std::ranges::none_of(job.tools, [](const engagement::Tool& tool) {
        return tool.cuts && tool.body.has_value();
      })) {
    return std::nullopt;
  }
  results::ProgramWalls out;
  out.of_steps = engagement::wall_errors(
      job, steps, {.stop = job.options.stop, .progress = [&](double share) {
                     progress({"Walls", share});
                   }});
  std::map<std::pair<std::uint32_t, int>, WallSum> lines;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const auto add = [&](const std::optional<engagement::WallError>& wall, bool left) {
      if (!wall) return;
      lines[{steps[i].line, left ? 0 : 1}].add(*wall, steps[i].turns);
      raise(out.most, wall->most, out.most && wall->most > out.most->error, steps[i],
            left);
      raise(out.least, wall->least, out.least && wall->least < out.least->error,
            steps[i], left);
    };
    add(out.of_steps[i].left, true);
    add(out.of_steps[i].right, false);
  }
  for (const auto& [key, sum] : lines) {
    engagement::WallError error = sum.error;
    error.mean = sum.turns > 0 ? error.mean / sum.turns : 0.0;
    out.lines.push_back({key.first, key.second == 0, error});
  }
  return out;
}

}  // namespace trochoid::run
