// The command of a piezo table that cancels the runout of an end mill: 28 um between its two
// flutes, which cut peaks that differ by more than a third.
#include <trochoid/base/units.h>
#include <trochoid/correction/correct.h>

#include <cstdio>

using namespace trochoid;

int main() {
  correction::CorrectionProblem problem;
  correction::MovingCut& cut = problem.cut;
  cut.setup.cutter = geometry::end_mill(8 * unit::mm, 2, 0);
  cut.setup.cut = {geometry::Slot{}, 1 * unit::mm, 0.05 * unit::mm, 1200 * unit::rpm};
  cut.setup.runout.radial_offsets = {14 * unit::um, -14 * unit::um};
  cut.setup.chip.model = chip::Model::radial;
  cut.law = force::Power{.K_t1 = 167e6, .K_r1 = 58e6, .m_t = 0.6, .m_r = 0.6};
  cut.tool = {{.mass = 0.032, .damping = 25, .stiffness = 8e6, .x = 1, .y = 0},
              {.mass = 0.032, .damping = 25, .stiffness = 8e6, .x = 0, .y = 1}};
  cut.plant = correction::held_by_actuator(
      structure::from_time_constants(1.0, 1.13e-3, 1.14e-3),
      {.mass = 0.194, .stiffness = 1.7e7, .damping = 77});
  problem.limits.stroke_high = 60 * unit::um;
  problem.options.strategy = correction::Method::lead;

  const correction::Correction c = correction::correct(problem);
  if (!c.ok) return std::printf("no answer: %s\n", c.reason.c_str()), 1;
  std::printf("the peaks differ by %.1f %%, with the command by %.1f %%\n",
              100 * dynamics::peak_difference(c.cuts.before.motion),
              100 * dynamics::peak_difference(c.cuts.after.motion));
  const std::vector<double> command = correction::command_over_turn(c.plan, 8);
  for (std::size_t i = 0; i < command.size(); ++i) {
    std::printf("%4zu deg %6.2f um\n", 45 * i, command[i] / unit::um);
  }
}
