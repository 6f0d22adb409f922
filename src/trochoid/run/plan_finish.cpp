#include <trochoid/run/commands.h>

#include <trochoid/base/units.h>

#include <fmt/core.h>

#include <variant>

namespace trochoid::run {

namespace {

/// Lines of the floor and heights of the wall; of a wall without heights its middle.
std::vector<surface::TraceLine> lines_of(const cases::Case& given) {
  const cases::Surface table = given.machine.surface.value_or(cases::Surface{});
  const surface::BottomEdge bottom{given.dish, given.wiper, given.spindle_lead};
  std::vector<surface::TraceLine> out;
  for (const double y : table.floor_y) out.emplace_back(surface::FloorTrace{bottom, y});
  const geometry::Engagement& cut = given.setup.cut.engagement;
  if (!std::holds_alternative<geometry::UpMilling>(cut) &&
      !std::holds_alternative<geometry::DownMilling>(cut)) {
    return out;
  }
  for (const double z : table.heights) out.emplace_back(surface::WallTrace{z});
  if (out.empty()) out.emplace_back(surface::WallTrace{given.setup.cut.a_p / 2});
  return out;
}

void warn(const cases::Case& given, results::PlanFinishResult& r) {
  const auto add = [&](const char* code, std::string message) {
    r.heading.warnings.push_back({code, std::move(message)});
  };
  const surface::BottomEdge bottom{given.dish, given.wiper, given.spindle_lead};
  const bool floor = std::holds_alternative<surface::FloorTrace>(r.asked.lines.front());
  if (floor && surface::is_flat(given.setup.cutter.profile, bottom)) {
    add("flat_floor",
        "The bottom edge is flat up to the axis: the deepest tooth wipes away all marks "
        "and the floor has no roughness unless the tool is tilted. Inserts rise "
        "towards the axis; give dish_deg of [tool], often 1 to 3 deg.");
  }
  if (!r.asked.limit) {
    add("no_Ra_limit", "[plan] has no largest_Ra_um: no feed is named.");
  } else if (r.plan.largest.as_is == r.asked.feeds.back()) {
    add("edge_of_plan",
        "The largest feed of the list keeps the limit: larger ones may "
        "keep it as well.");
  }
  if (given.machine.cutter_body || given.machine.wall) {
    add("nothing_bends",
        "Neither tool nor wall bends in this plan: deflection adds to the marks.");
  }
}

}  // namespace

results::PlanFinishResult plan_finish(const cases::Case& given,
                                      const Progress& progress) {
  progress("Marks at each feed");
  const cases::Plan& plan = given.plan;
  results::PlanFinishResult r{
      .heading = heading_of(given),
      .asked = {.lines = lines_of(given),
                .cutoff = given.machine.surface.value_or(cases::Surface{}).cutoff,
                .feeds = plan.feeds,
                .within = plan.finish.inserts_within,
                .limit = plan.finish.largest_Ra}};
  r.plan = surface::plan_finish(given.setup, r.asked);
  warn(given, r);
  r.heading.ok = true;
  r.heading.message = results::finish_plan_sentence(r);
  return r;
}

}  // namespace trochoid::run
