#include "wall_samples.h"

#include <trochoid/base/units.h>
#include <trochoid/cases/case.h>
#include <trochoid/run/commands.h>

#include <fstream>
#include <string>

#include "sample_cut.h"

namespace sample {

namespace {

using trochoid::results::Answer;
namespace cases = trochoid::cases;

const std::string cut = R"(title = "Thin wall <made up>"

[tool]
shape = "cylinder"
teeth = 3
diameter_mm = 12
helix_deg = 45

[cut]
engagement = "down"
radial_depth_mm = 1
axial_depth_mm = 3
feed_per_tooth_mm = 0.2
spindle_rpm = 1000

[chip]
model = "radial"

[cutter_body]
overhang_mm = 83
flute_length_mm = 45
shank_diameter_mm = 12
equivalent_diameter_mm = 9.6
youngs_modulus_GPa = 206

[sampling]
samples_per_rev = 60
revolutions = 2

)";

const std::string wall_table = R"([wall]
length_mm = 60
height_mm = 30
thickness_mm = 2
youngs_modulus_GPa = 69
poisson_ratio = 0.33
)";

const std::string material = R"([runout]
eccentricity_mm = 0.003
angle_deg = 71

[force]
law = "linear_edge"
K_tc_MPa = 400
K_rc_MPa = 200
K_ac_MPa = 0
K_te_N_per_mm = 0
K_re_N_per_mm = 0
K_ae_N_per_mm = 0

)";

std::string surface_table(const std::string& model) {
  return "\n[surface]\nmodel = \"" + model +
         "\"\nheights_mm = [0.3, 0.6, 0.9, 1.2, 1.5, 1.8, 2.1, 2.4, 2.7]\n";
}

std::filesystem::path written(const std::filesystem::path& file,
                              const std::string& text) {
  std::filesystem::create_directories(file.parent_path());
  std::ofstream(file) << text;
  return file;
}

/// The computed wall as a probe would tell it.
void write_readings(const trochoid::surface::ErrorMap& map,
                    const std::filesystem::path& file, bool number_teeth,
                    double highest) {
  using trochoid::unit::mm;
  std::ofstream out(file);
  out << (number_teeth ? "x_mm,height_mm,error_mm,tooth\n"
                       : "x_mm,height_mm,error_mm\n");
  std::uint32_t state = 20261121;
  for (const trochoid::surface::ErrorRow& row : map.rows) {
    for (std::size_t i = 0; row.height <= highest && i < row.x.size(); ++i) {
      const double noise = 1e-3 * (scatter(state) + scatter(state) + scatter(state));
      out << row.x[i] / mm << ',' << row.height / mm << ','
          << row.error[i] / mm + noise + (number_teeth ? 0.0 : 0.0033);
      if (number_teeth) out << ',' << row.tooth[i] + 1;
      out << '\n';
    }
  }
}

/// The wall, with runout.
cases::Case cut_wall(const char* model, const std::filesystem::path& folder) {
  const auto file =
      written(folder / "surface.toml", cut + material + wall_table +
                                           "position_mm = 30\n" + surface_table(model));
  return cases::read_case(file, cases::Command::surface);
}

Answer calibrated(const std::string& model, bool number_teeth, double highest,
                  const std::filesystem::path& folder) {
  const auto made = trochoid::run::surface(cut_wall(model.c_str(), folder), {});
  write_readings(made.map, folder / "wall.csv", number_teeth, highest);
  const auto file =
      written(folder / "calibrate.toml",
              cut + wall_table + surface_table(model) +
                  "\n[[surface_measurement]]\nfile = \"wall.csv\"\ndatum_offset = " +
                  (number_teeth ? "false\n" : "true\n"));
  return answer_of(
      trochoid::run::calibrate(cases::read_case(file, cases::Command::calibrate), {}));
}

}  // namespace

Answer wall(const char* model, const std::filesystem::path& folder) {
  return answer_of(trochoid::run::surface(cut_wall(model, folder), {}));
}

Answer lobes(const std::filesystem::path& folder) {
  const auto file =
      written(folder / "stability.toml", cases::new_case(cases::Command::stability));
  return answer_of(
      trochoid::run::stability(cases::read_case(file, cases::Command::stability), {}));
}

Answer calibration(const char* model, bool number_teeth,
                   const std::filesystem::path& folder) {
  return calibrated(model, number_teeth, 3e-3, folder);
}

Answer along_program() {
  const std::filesystem::path file = TROCHOID_EXAMPLES "/pocket/case.toml";
  return answer_of(
      trochoid::run::program(cases::read_case(file, cases::Command::program)));
}

Answer wall_plan(const std::filesystem::path& folder) {
  const auto file = written(
      folder / "plan.toml",
      cut + material + wall_table + surface_table("envelope") +
          "[plan]\nlargest_error_um = 40\nheights = [3, 7, 13]\nreadings_per_height = "
          "[3, 12, 36]\n");
  return answer_of(
      trochoid::run::plan_wall(cases::read_case(file, cases::Command::plan), {}));
}

Answer one_height(const std::filesystem::path& folder) {
  return calibrated("imprint", true, 0.4e-3, folder);
}

}  // namespace sample
