#pragma once

#include <trochoid/base/units.h>
#include <trochoid/engagement/steps.h>

#include <array>
#include <cmath>
#include <vector>

namespace trochoid::engagement {

/// Moves made by hand, in mm.
class MadeProgram {
 public:
  explicit MadeProgram(double rpm, double feed_mm_per_min)
      : rpm_(rpm), feed_(feed_mm_per_min) {
    program.tools = {"1"};
  }

  MadeProgram& rapid(double x, double y, double z) {
    return add(program::MoveKind::rapid, x, y, z);
  }
  MadeProgram& line(double x, double y, double z) {
    return add(program::MoveKind::line, x, y, z);
  }
  /// About a centre, by a turn in degrees.
  MadeProgram& arc(double cx, double cy, double turn_deg, double z) {
    const auto& at = program.moves.back().end;
    const double dx = at[0] / unit::mm - cx;
    const double dy = at[1] / unit::mm - cy;
    const double c = std::cos(turn_deg * unit::deg);
    const double s = std::sin(turn_deg * unit::deg);
    add(program::MoveKind::arc, cx + c * dx - s * dy, cy + s * dx + c * dy, z);
    program.moves.back().center = {cx * unit::mm, cy * unit::mm};
    program.moves.back().turn = turn_deg * unit::deg;
    return *this;
  }

  program::Program program;

 private:
  MadeProgram& add(program::MoveKind kind, double x, double y, double z) {
    const auto line = static_cast<std::uint32_t>(program.moves.size() + 1);
    const bool feeds = kind != program::MoveKind::rapid;
    program.moves.push_back({.end = {x * unit::mm, y * unit::mm, z * unit::mm},
                             .feed = feeds ? feed_ * unit::mm_per_min : 0.0,
                             .spindle = rpm_ * unit::rpm,
                             .line = line,
                             .tool = 0,
                             .kind = kind});
    return *this;
  }

  double rpm_;
  double feed_;
};

inline Tool end_mill(double D_mm, int teeth, double helix_deg,
                     std::vector<double> offsets_um = {}) {
  Tool tool{.cutter = geometry::end_mill(D_mm * unit::mm, teeth, helix_deg * unit::deg),
            .law = force::LinearEdge{2620e6, 1560e6, 331e6, 7e3, 3e3, 1e3}};
  for (const double offset : offsets_um) {
    tool.runout.radial_offsets.push_back(offset * unit::um);
  }
  return tool;
}

inline stock::Box box(std::array<double, 3> low_mm, std::array<double, 3> high_mm) {
  stock::Box out;
  for (std::size_t i = 0; i < 3; ++i) {
    out.low[i] = low_mm[i] * unit::mm;
    out.high[i] = high_mm[i] * unit::mm;
  }
  return out;
}

struct Course {
  std::vector<Step> rows;
  Summary summary;
};

inline Course run(const MadeProgram& made, const Tool& tool,
                  const stock::Initial& stock, Options options = {}) {
  Course out;
  const Job job{made.program, std::span(&tool, 1), stock, options};
  out.summary = compute_steps(job, [&](std::span<const Step> rows) {
    out.rows.insert(out.rows.end(), rows.begin(), rows.end());
  });
  return out;
}

inline Step at(const MadeProgram& made, const Tool& tool, const stock::Initial& stock,
               std::uint32_t line, double fraction,
               std::span<const double> heights = {}) {
  const Job job{made.program, std::span(&tool, 1), stock, {}};
  const PlaceRequest place{line, fraction};
  return steps_at(job, std::span(&place, 1), heights).front();
}

}  // namespace trochoid::engagement
