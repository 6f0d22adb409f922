// Does a cut chatter? Its Floquet multiplier, the depth from which on it is unstable, and the
// motion in time at two depths; the benchmark of one mode at 922 Hz.
#include <trochoid/base/units.h>
#include <trochoid/dynamics/stability.h>
#include <trochoid/dynamics/steady_state.h>
#include <trochoid/structure/mode.h>

#include <cstdio>

using namespace trochoid;

int main() {
  force::Setup setup{.cutter = geometry::end_mill(10 * unit::mm, 2, 0)};
  setup.cut = {geometry::Slot{}, 0.2 * unit::mm, 0.05 * unit::mm, 5000 * unit::rpm};
  setup.chip.model = chip::Model::none;
  const force::LinearEdge law{.K_tc = 600e6, .K_rc = 200e6};
  const structure::Mode mode =
      structure::completed({.mass = 0.03993, .frequency = 922, .damping_ratio = 0.011});
  const dynamics::System system{{{mode.mass, mode.damping, mode.stiffness, 1, 0}}};

  for (const double depth : {0.2 * unit::mm, 0.5 * unit::mm}) {
    setup.cut.a_p = depth;
    const auto stability = dynamics::stability({.setup = setup, .law = law, .system = system});
    const auto steady =
        dynamics::steady_state({.setup = setup, .law = law, .system = system});
    std::printf("%.1f mm: multiplier %.4f, %s; the motion is %s, peaks up to %.1f N\n",
                depth / unit::mm, std::abs(stability.multiplier.value),
                dynamics::name_of(stability.verdict).data(),
                dynamics::name_of(steady.verdict).data(), steady.motion.peak);
    if (const auto& limit = stability.limit) {
      std::printf("unstable from %.2f mm on\n", limit->limit.depth / unit::mm);
    }
  }
}
