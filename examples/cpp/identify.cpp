// Cutting coefficients and runout of an end mill from the forces over one turn, here made
// up: 2000 and 900 MPa, the second tooth 8 um short, half a newton of noise.
#include <trochoid/base/units.h>
#include <trochoid/force/forces.h>
#include <trochoid/identification/identify.h>

#include <cstdio>
#include <random>

using namespace trochoid;

int main() {
  force::Setup setup{.cutter = geometry::end_mill(8 * unit::mm, 2, 30 * unit::deg)};
  setup.cut = {geometry::Slot{}, 2 * unit::mm, 0.04 * unit::mm, 875 * unit::rpm};
  const force::LinearEdge steel{.K_tc = 2000e6, .K_rc = 900e6, .K_ac = 300e6, .K_te = 7e3};
  identification::Run run{.cut = setup.cut};  // your angles [rad] and forces [N]
  for (int i = 0; i < 360; ++i) run.angle.push_back(i * unit::deg);
  setup.runout.radial_offsets = {0.0, -8 * unit::um};
  run.force = force::forces(setup, steel, run.angle, 1e-9);
  std::mt19937 random;
  std::normal_distribution<double> noise(0.0, 0.5);
  for (auto& F : run.force) F[1] += noise(random);

  setup.runout = {};  // nothing is known of it
  const auto fit = identification::identify(setup, force::LinearEdge{}, {&run, 1}, {});
  if (!fit.ok) return std::printf("no answer: %s\n", fit.message.c_str()), 1;
  const auto names = force::coefficient_quantities(fit.law);
  for (std::size_t q = 0; q < names.size(); ++q) {
    if (const auto& K = fit.coefficients[q]) {
      std::printf("%-14s %8.1f +- %.1f\n", names[q].key.data(), K->value / names[q].unit,
                  (K->high - K->low) / 2 / names[q].unit);
    }
  }
  std::printf("tooth 2 stands out by %.2f um\n", fit.runout.radial_offsets[1] / unit::um);
}
