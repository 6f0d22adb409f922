#include <trochoid/cases/schema.h>
#include <trochoid/cases/tables.h>

namespace trochoid::cases {

void describe(const Visitor& v, OrthogonalTable& t) {
  constexpr double most_stress = 1e5;  // MPa
  constexpr double most_angle = 1e4;   // deg, also for each mm of chip
  constexpr double most_ratio = 10;
  v({.name = "shear_stress_MPa",
     .meaning =
         "shear stress tau_s in the shear plane: at zero rake and chip, more with "
         "each degree of rake, more with each mm of chip",
     .range = between(-most_stress, most_stress),
     .need = Need::always,
     .example = "[600]"},
    &t.shear_stress);
  v({.name = "friction_angle_deg",
     .meaning = "friction angle beta_a on the rake face, as shear_stress_MPa",
     .range = between(-most_angle, most_angle),
     .need = Need::always,
     .example = "[20, 0.3]"},
    &t.friction_angle);
  v({.name = "shear_angle_deg",
     .meaning = "shear angle phi_c, as shear_stress_MPa",
     .range = between(-most_angle, most_angle),
     .need = Need::always,
     .rival = "chip_ratio",
     .example = "[25]"},
    &t.shear_angle);
  v({.name = "chip_ratio",
     .meaning =
         "thickness of the uncut chip over thickness of the chip, at an uncut chip of "
         "1 mm: at zero rake, more with each degree of rake",
     .range = between(-most_ratio, most_ratio),
     .rival = "shear_angle_deg",
     .example = "[1.8, -0.03]"},
    &t.chip_ratio);
  v({.name = "chip_ratio_exponent",
     .meaning = "power of the uncut chip by which that ratio grows, as chip_ratio",
     .range = between(-most_ratio, most_ratio),
     .standard = "0",
     .example = "[0.3, -0.01]"},
    &t.chip_ratio_exponent);
  v({.name = "rake_deg",
     .meaning = "normal rake angle alpha_n of the teeth",
     .range = between(-45, 45),
     .need = Need::always},
    &t.rake);
  v({.name = "inclination_deg",
     .meaning = "inclination i of the edge",
     .range = from_below(0, 90),
     .standard = "helix_deg"},
    &t.inclination);
  v({.name = "chip_mm",
     .meaning = "uncut chip at which all of this is taken",
     .range = above_up_to(0, 10),
     .standard = "the mean over the arc of cut (F-18)"},
    &t.chip);
}

}  // namespace trochoid::cases
