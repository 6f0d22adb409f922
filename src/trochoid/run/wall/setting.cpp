#include <trochoid/run/wall/setting.h>

namespace trochoid::run {

std::optional<structure::Cantilever> wall_cutter(const inputs::MachineTables& machine) {
  if (!machine.cutter_body) {
    return std::nullopt;
  }
  const inputs::CutterBody& b = *machine.cutter_body;
  return structure::Cantilever{.overhang = b.overhang,
                               .flute_length = b.flute_length.value_or(b.overhang),
                               .shank_diameter = b.shank_diameter.value_or(0.0),
                               .flute_diameter = b.equivalent_diameter.value_or(0.0),
                               .youngs_modulus = b.youngs_modulus};
}

std::optional<structure::Plate> wall_plate(const inputs::MachineTables& machine) {
  if (!machine.wall) {
    return std::nullopt;
  }
  const inputs::Wall& w = *machine.wall;
  return structure::Plate{.length = w.length,
                          .height = w.height,
                          .thickness = w.thickness,
                          .youngs_modulus = w.youngs_modulus,
                          .poisson_ratio = w.poisson_ratio,
                          .ends = w.ends};
}

structure::WallLoads wall_loads(const inputs::Case& given) {
  const inputs::Wall w = given.machine.wall.value_or(inputs::Wall{});
  return {.pressure = w.pressure.value_or(0.0),
          .edge_load = w.edge_load.value_or(0.0),
          .line_load = w.line_load.value_or(0.0),
          .position = w.position,
          .depth = given.setup.cut.a_p,
          .x = w.loads_x,
          .y = w.loads_heights};
}

surface::Setting wall_setting(const inputs::Case& given) {
  const inputs::Surface table = given.machine.surface.value_or(inputs::Surface{});
  return {.setup = given.setup,
          .law = given.law,
          .bodies = surface::bodies_at(wall_cutter(given.machine),
                                       wall_plate(given.machine), given.setup.cut.a_p),
          .load = table.load,
          .model = table.model,
          .phase = table.phase,
          .probe_radius = table.probe_diameter / 2,
          .also_bends = table.also_bends};
}

std::vector<surface::PassCut> wall_passes(const inputs::Case& given) {
  const geometry::Cut& cut = given.setup.cut;
  std::vector<surface::PassCut> cuts;
  for (const inputs::WallPass& pass : given.machine.passes) {
    cuts.push_back({pass.radial_depth.value_or(surface::radial_depth(cut.engagement)),
                    pass.feed_per_tooth.value_or(cut.f_z),
                    pass.below_edge.value_or(0.0)});
  }
  return cuts;
}

surface::Feedback wall_feedback(const inputs::Case& given) {
  return given.machine.surface.value_or(inputs::Surface{})
      .feedback.value_or(surface::Feedback::none);
}

surface::FitOptions wall_fit(const inputs::Case& given) {
  const inputs::Surface table = given.machine.surface.value_or(inputs::Surface{});
  const bool pulse = table.model == surface::Model::quasi_static;
  surface::FitOptions fit{
      .feedback = table.feedback,
      .robust = table.outliers == inputs::Outliers::leave_out,
      .shared = !pulse && table.errors == identification::Errors::automatic};
  if (pulse && !fit.feedback) {
    fit.feedback = surface::Feedback::none;
  }
  return fit;
}

double wall_position(const inputs::Case& given) {
  return given.machine.wall ? given.machine.wall->position : 0.0;
}

surface::MapOptions map_options(const inputs::Case& given) {
  const inputs::Surface table = given.machine.surface.value_or(inputs::Surface{});
  return {.samples_per_turn = given.sampling.samples_per_rev,
          .turns = given.sampling.revolutions,
          .angles = given.sampling.angles,
          .heights = table.heights,
          .influence_heights = table.influence_heights,
          .position = wall_position(given),
          .feedback = wall_feedback(given),
          .tolerance = given.sampling.tolerance};
}

}  // namespace trochoid::run
