#include <trochoid/run/correct/work.h>

#include <trochoid/correction/moving_cut.h>

namespace trochoid::run {

std::vector<Work> correct_work(const inputs::Case& given) {
  // Measured: of the command itself, and of every speed of the map.
  constexpr double command = 7e6;
  constexpr double speed = 8e4;
  constexpr double slice = 0.4;  // that a slice costs more
  const double slices = correction::slices_for(given.setup);
  const double speeds = given.machine.correct->spindle_speed->count;
  return {{.what = "speeds, and the command itself",
           .count = speeds,
           .evaluations = (command + speeds * speed) * (1 + slice * (slices - 1)),
           .key = {.name = "correct.spindle_rpm", .value = speeds, .of = " values"}}};
}

}  // namespace trochoid::run
