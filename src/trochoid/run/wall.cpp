#include <trochoid/run/wall.h>

#include <trochoid/base/error.h>

#include <string>

namespace trochoid::run {

namespace {

/// Where the reading lies along the wall, and how far the tool has fed since the phase.
void set_place(const cases::Case& given, const files::SurfaceReading& read,
               surface::Reading& reading) {
  const double step =
      given.setup.cutter.teeth() * given.setup.cut.f_z / given.sampling.samples_per_rev;
  const double along = read.x ? *read.x : read.step.value_or(0.0) * step;
  const bool pulse = given.machine.surface->model == surface::Model::quasi_static;
  reading.x = pulse || !read.x ? wall_position(given) : along;
  reading.travel = along + read.feed_offset.value_or(0.0);
}

/// What is estimated of a file beside the coefficients.
surface::Datum datum_of(const cases::Case& given, const cases::SurfaceMeasurement& m) {
  const bool pulse = given.machine.surface->model == surface::Model::quasi_static;
  surface::Datum datum{.decide = !m.form && !pulse};
  if (m.form) {
    datum = surface::datum_of(*m.form);
  }
  datum.offset = datum.offset || m.datum_offset;
  datum.tilt = datum.tilt || m.datum_tilt;
  return datum;
}

}  // namespace

std::optional<structure::Cantilever> wall_cutter(const cases::MachineTables& machine) {
  if (!machine.cutter_body) {
    return std::nullopt;
  }
  const cases::CutterBody& b = *machine.cutter_body;
  return structure::Cantilever{.overhang = b.overhang,
                               .flute_length = b.flute_length.value_or(b.overhang),
                               .shank_diameter = b.shank_diameter.value_or(0.0),
                               .flute_diameter = b.equivalent_diameter.value_or(0.0),
                               .youngs_modulus = b.youngs_modulus};
}

std::optional<structure::Plate> wall_plate(const cases::MachineTables& machine) {
  if (!machine.wall) {
    return std::nullopt;
  }
  const cases::Wall& w = *machine.wall;
  return structure::Plate{.length = w.length,
                          .height = w.height,
                          .thickness = w.thickness,
                          .youngs_modulus = w.youngs_modulus,
                          .poisson_ratio = w.poisson_ratio,
                          .ends = w.ends};
}

structure::WallLoads wall_loads(const cases::Case& given) {
  const cases::Wall w = given.machine.wall.value_or(cases::Wall{});
  return {.pressure = w.pressure.value_or(0.0),
          .edge_load = w.edge_load.value_or(0.0),
          .line_load = w.line_load.value_or(0.0),
          .position = w.position,
          .depth = given.setup.cut.a_p,
          .x = w.loads_x,
          .y = w.loads_heights};
}

surface::BodyDimensions wall_dimensions(const cases::Case& given) {
  return {wall_cutter(given.machine), wall_plate(given.machine), wall_position(given)};
}

surface::Setting wall_setting(const cases::Case& given) {
  const cases::Surface table = given.machine.surface.value_or(cases::Surface{});
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

std::vector<surface::PassCut> wall_passes(const cases::Case& given) {
  const geometry::Cut& cut = given.setup.cut;
  std::vector<surface::PassCut> cuts;
  for (const cases::WallPass& pass : given.machine.passes) {
    cuts.push_back({pass.radial_depth.value_or(surface::radial_depth(cut.engagement)),
                    pass.feed_per_tooth.value_or(cut.f_z),
                    pass.below_edge.value_or(0.0)});
  }
  return cuts;
}

surface::Feedback wall_feedback(const cases::Case& given) {
  return given.machine.surface.value_or(cases::Surface{})
      .feedback.value_or(surface::Feedback::none);
}

surface::FitOptions wall_fit(const cases::Case& given) {
  const cases::Surface table = given.machine.surface.value_or(cases::Surface{});
  const bool pulse = table.model == surface::Model::quasi_static;
  surface::FitOptions fit{
      .feedback = table.feedback,
      .robust = table.outliers == cases::Outliers::leave_out,
      .shared = !pulse && table.errors == identification::Errors::automatic};
  if (pulse && !fit.feedback) {
    fit.feedback = surface::Feedback::none;
  }
  return fit;
}

double wall_position(const cases::Case& given) {
  return given.machine.wall ? given.machine.wall->position : 0.0;
}

surface::MapOptions map_options(const cases::Case& given) {
  const cases::Surface table = given.machine.surface.value_or(cases::Surface{});
  return {.samples_per_turn = given.sampling.samples_per_rev,
          .turns = given.sampling.revolutions,
          .angles = given.sampling.angles,
          .heights = table.heights,
          .influence_heights = table.influence_heights,
          .position = wall_position(given),
          .feedback = wall_feedback(given),
          .tolerance = given.sampling.tolerance};
}

MeasuredWall measured_wall(const cases::Case& given) {
  MeasuredWall wall;
  std::vector<std::string> problems;
  for (const cases::SurfaceMeasurement& m : given.machine.surface_measurements) {
    const files::SurfaceFile* read_file = nullptr;
    try {
      read_file = &m.surface.get();
    } catch (const base::InputError& error) {
      problems.insert(problems.end(), error.problems().begin(), error.problems().end());
      continue;
    }
    const files::SurfaceFile& file = *read_file;
    for (const base::Warning& note : file.notes) {
      wall.notes.push_back({note.code, m.source.file.path + ": " + note.message});
    }
    wall.counts.add(file.counts);
    for (const files::SurfaceReading& read : file.readings) {
      surface::Reading reading{.height = read.height,
                               .error = read.error,
                               .tooth = read.tooth - 1,
                               .set = wall.datum.size()};
      set_place(given, read, reading);
      wall.readings.push_back(reading);
    }
    wall.datum.push_back(datum_of(given, m));
  }
  if (!problems.empty()) {
    throw base::InputError(problems);
  }
  return wall;
}

}  // namespace trochoid::run
