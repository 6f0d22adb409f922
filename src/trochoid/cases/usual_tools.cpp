#include <trochoid/cases/usual_tools.h>

#include <trochoid/base/units.h>

#include <array>

namespace trochoid::cases {

namespace {

/// What all of them have: teeth, a diameter, depth and feed.
struct Usual {
  int teeth;
  double diameter_mm;
  double axial_depth_mm;
  double feed_mm;
  double rpm;
};

void put_usual(CaseTables& t, const Usual& usual) {
  t.tool = {.teeth = usual.teeth, .diameter = usual.diameter_mm * unit::mm};
  t.cut.axial_depth = usual.axial_depth_mm * unit::mm;
  t.cut.feed_per_tooth = usual.feed_mm * unit::mm;
  t.cut.spindle_speed = usual.rpm * unit::rpm;
  t.runout = {};
  t.runout.radial_offsets.assign(static_cast<std::size_t>(usual.teeth), 0.0);
}

/// Stock narrower than the cutter, in its middle.
void put_band(CaseTables& t, double width_mm) {
  t.cut.engagement = EngagementKind::band;
  t.cut.radial_depth.reset();
  t.cut.stock_y = {-0.5 * width_mm * unit::mm, 0.5 * width_mm * unit::mm};
}

/// Inserts that stand out by a few micrometres, as they are clamped.
void put_scatter(CaseTables& t) {
  constexpr std::array scatter_um{0.0, 12.0, -8.0, 5.0, -15.0, 9.0, -4.0, 3.0};
  for (std::size_t j = 0; j < t.runout.radial_offsets.size(); ++j) {
    t.runout.radial_offsets[j] = scatter_um[j % scatter_um.size()] * unit::um;
    const std::size_t other = (j + 3) % scatter_um.size();
    t.runout.axial_offsets.push_back(scatter_um[other] * unit::um);
  }
}

void put_face_mill(CaseTables& t) {
  put_usual(t, {7, 80, 3, 0.2, 800});
  t.tool.shape = Shape::taper;
  t.tool.taper = 45 * unit::deg;
  t.tool.helix = {{5 * unit::deg}};
  t.tool.dish = 1 * unit::deg;
  put_band(t, 60);
  put_scatter(t);
}

void put_high_feed(CaseTables& t) {
  put_usual(t, {3, 32, 0.8, 0.8, 1800});
  t.tool.shape = Shape::taper;
  t.tool.taper = 75 * unit::deg;
  put_band(t, 24);
  put_scatter(t);
}

void put_round_insert(CaseTables& t) {
  put_usual(t, {4, 50, 2, 0.25, 1500});
  t.tool.shape = Shape::bull_nose;
  t.tool.corner_radius = 6 * unit::mm;
  t.tool.dish = 90 * unit::deg;
  put_band(t, 35);
  put_scatter(t);
}

void put_shoulder_mill(CaseTables& t) {
  put_usual(t, {5, 50, 4, 0.12, 1600});
  t.tool.shape = Shape::bull_nose;
  t.tool.corner_radius = 0.8 * unit::mm;
  t.tool.helix = {{8 * unit::deg}};
  t.tool.dish = 2 * unit::deg;
  t.cut.engagement = EngagementKind::down;
  t.cut.radial_depth = 25 * unit::mm;
  put_scatter(t);
}

void put_serrated(CaseTables& t) {
  put_usual(t, {4, 20, 15, 0.08, 2400});
  t.tool.helix = {{30 * unit::deg}};
  t.tool.serration = geometry::Serration{
      .amplitude = 0.6 * unit::mm, .wavelength = 2.5 * unit::mm, .shift = {}};
  t.cut.engagement = EngagementKind::down;
  t.cut.radial_depth = 10 * unit::mm;
  if (t.identify) t.identify->chip_models = {chip::Model::trochoidal};
}

void put_variable_helix(CaseTables& t) {
  put_usual(t, {4, 12, 6, 0.06, 4000});
  t.tool.helix = {
      .values = {38 * unit::deg, 41 * unit::deg, 38 * unit::deg, 41 * unit::deg},
      .listed = true};
}

constexpr std::array tools{
    UsualTool{"face_mill", "a face mill of 45 deg with seven inserts", put_face_mill},
    UsualTool{"high_feed", "a high-feed mill, lead angle 15 deg", put_high_feed},
    UsualTool{"round_insert", "a mill with round inserts", put_round_insert},
    UsualTool{"shoulder_mill", "a square shoulder mill with five inserts",
              put_shoulder_mill},
    UsualTool{"serrated", "a serrated rougher", put_serrated},
    UsualTool{"variable_helix", "an end mill whose helix differs from tooth to tooth",
              put_variable_helix}};

}  // namespace

std::span<const UsualTool> usual_tools() {
  return tools;
}

}  // namespace trochoid::cases
