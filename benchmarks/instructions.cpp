// One kernel, so many times: `instructions.py` counts the instructions that one costs.
// Usage: trochoid_instructions KERNEL TIMES; without arguments the kernels are listed.
#include <trochoid/base/units.h>
#include <trochoid/dynamics/motion.h>
#include <trochoid/dynamics/multiplier.h>
#include <trochoid/engagement/turn.h>
#include <trochoid/force/forces.h>
#include <trochoid/identification/identify.h>

#include <array>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <string_view>

#include "paper_cut.h"

namespace trochoid::benchmarks {

namespace {

/// Runs once, and gives a number that depends on all of it.
using Kernel = std::function<double()>;

Kernel turn_of_forces(chip::Model model) {
  return [setup = paper_cut(model), phi = turns(720, 1)] {
    return force::forces(setup, paper_law(), phi, 1e-6)[100][0];
  };
}

Kernel turn_of_matrices() {
  return [setup = paper_cut(), phi = turns(720, 1)] {
    std::vector<double> C(phi.size() * 18);
    force::ForceMatrix(setup, paper_law(), 1e-6).evaluate(phi, C);
    return C[100];
  };
}

Kernel eccentric_samples() {
  force::Setup setup = paper_cut();
  setup.cutter.pitch = geometry::equal_pitch(4);
  setup.runout = {.eccentricity = 10 * unit::um, .angle = 0.3};
  return [setup, phi = turns(8, 1)] {
    return force::forces(setup, paper_law(), phi, 1e-6)[1][0];
  };
}

/// Along edges whose chip changes with the height, under a power of it.
Kernel power_samples() {
  force::Setup setup = paper_cut();
  setup.cutter.pitch = geometry::equal_pitch(4);
  setup.runout = {.eccentricity = 10 * unit::um, .angle = 0.3};
  const force::PowerEdge law{900e6, 400e6, 150e6, 0.25, 0.4, 0.1, 7e3, 3e3, 1e3};
  return [=, phi = turns(8, 1)] { return force::forces(setup, law, phi, 1e-6)[1][0]; };
}

/// The tip of a ball among them.
Kernel ball_samples() {
  force::Setup setup = paper_cut();
  setup.cutter.profile = geometry::ball(setup.cutter.profile.D);
  return [setup, phi = turns(180, 1)] {
    return force::forces(setup, paper_law(), phi, 1e-6)[30][0];
  };
}

/// Six layers, each with arcs of its own.
Kernel turn_of_layers() {
  engagement::Tool tool;
  tool.cutter = geometry::end_mill(8 * unit::mm, 3, 35 * unit::deg);
  tool.runout.radial_offsets = {0.0, 6 * unit::um, -4 * unit::um};
  tool.law = paper_law();
  tool.gauge_length = 32 * unit::mm;
  engagement::Turn turn{.f_z = 50 * unit::um};
  for (int i = 0; i < 6; ++i) {
    turn.layers.push_back({i * unit::mm, (i + 1) * unit::mm, {{{0.3 + 0.1 * i, 3.0}}}});
  }
  return [=] { return engagement::loads_of(turn, tool).forces.peak_xy; };
}

Kernel fit_from_nothing() {
  force::Setup setup = paper_cut();
  identification::Run run{.cut = setup.cut, .angle = turns(90, 1)};
  run.force = force::forces(setup, paper_law(), run.angle, 1e-9);
  setup.runout = {};
  return [setup, runs = std::vector{run}] {
    return identification::identify(setup, paper_law(), runs, {}).rms;
  };
}

Kernel slot_multiplier() {
  force::Setup setup{.cutter = geometry::end_mill(10 * unit::mm, 2, 0)};
  setup.cut = {geometry::Slot{}, 1 * unit::mm, 0.05 * unit::mm, 5000 * unit::rpm};
  setup.chip = {chip::Model::none, chip::Lookback::previous};
  const force::LinearEdge law{.K_tc = 600e6, .K_rc = 200e6};
  const dynamics::System system{{{0.03993, 5.09, 1.34e6, 1, 0}}};
  return [=, model = dynamics::DirectionalModel(setup, law, 1e-6, 1e-10)] {
    return std::abs(dynamics::multiplier(model.at_depth(setup.cut.a_p), system,
                                         setup.cut.Omega, 1e-6)
                        .value);
  };
}

Kernel turn_of_motion() {
  dynamics::MotionProblem p;
  p.setup.cutter = geometry::end_mill(8 * unit::mm, 2, 0);
  p.setup.runout.radial_offsets = {13 * unit::um, -13 * unit::um};
  p.setup.cut = {geometry::Slot{}, 1 * unit::mm, 0.05 * unit::mm, 1200 * unit::rpm};
  p.setup.chip.model = chip::Model::radial;
  p.law = force::Power{.K_t1 = 166.7e6, .K_r1 = 58.35e6, .m_t = 0.598, .m_r = 0.598};
  p.system.modes = {{0.0324, 25.5, 8e6, 1, 0}, {0.0324, 25.5, 8e6, 0, 1}};
  p.revolutions = 1;
  return [p] { return dynamics::motion(p).last_change; };
}

struct Named {
  std::string_view name;
  Kernel (*kernel)();
};

constexpr std::array kernels{
    Named{"turn of 720 forces, trochoidal",
          [] { return turn_of_forces(chip::Model::trochoidal); }},
    Named{"turn of 720 forces, feed", [] { return turn_of_forces(chip::Model::feed); }},
    Named{"turn of 720 matrices", turn_of_matrices},
    Named{"8 forces of an eccentric cutter of four teeth", eccentric_samples},
    Named{"8 forces of the same under a power law", power_samples},
    Named{"180 forces of a ball", ball_samples},
    Named{"turn of a program in six layers", turn_of_layers},
    Named{"fit of 90 samples from nothing known", fit_from_nothing},
    Named{"multiplier of a slot", slot_multiplier},
    Named{"turn of 2000 steps of motion, power law", turn_of_motion}};

}  // namespace

}  // namespace trochoid::benchmarks

int main(int count, char** arguments) {
  namespace ours = trochoid::benchmarks;
  for (const auto& [name, kernel] : ours::kernels) {
    if (count < 3) {
      std::printf("%s\n", name.data());
    } else if (name == arguments[1]) {
      const auto run = kernel();
      double sum = 0.0;
      for (int i = 0; i < std::atoi(arguments[2]); ++i) {
        sum += run();
      }
      std::printf("%g\n", sum);
    }
  }
}
