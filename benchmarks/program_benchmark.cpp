#include <trochoid/base/units.h>
#include <trochoid/engagement/steps.h>

#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>

/// Forces along a whole NC program, of one thread.
namespace {

using namespace trochoid;
using program::MoveKind;

/// Moves in mm, at 0.2 mm a turn.
class Path {
 public:
  void go(MoveKind kind, double x, double y, double z) {
    const auto line = static_cast<std::uint32_t>(program.moves.size() + 1);
    program.moves.push_back(
        {.end = {x * unit::mm, y * unit::mm, z * unit::mm},
         .feed = kind == MoveKind::rapid ? 0.0 : 2400 * unit::mm_per_min,
         .spindle = 12000 * unit::rpm,
         .line = line,
         .tool = 0,
         .kind = kind});
  }
  /// Rows along a wave, to and fro, in short blocks.
  void rows(int count, double step, double block, double z) {
    go(MoveKind::rapid, -8, 0, z);
    for (int row = 0; row < count; ++row) {
      const int blocks = static_cast<int>(100 / block);
      for (int i = 0; i <= blocks; ++i) {
        const double x = row % 2 == 0 ? i * block : 100 - i * block;
        const double wave = 2 * std::sin(x / 9) + 0.3 * std::sin(x / 2.3);
        go(MoveKind::line, x, row * step + wave, z);
      }
    }
  }
  program::Program program{.tools = {"1"}};
};

engagement::Tool tool(double corner) {
  engagement::Tool out{.cutter = geometry::end_mill(10 * unit::mm, 3, 35 * unit::deg),
                       .law = force::LinearEdge{800e6, 300e6, 100e6, 12e3, 12e3, 1e3}};
  out.cutter.profile.R = corner;
  if (corner > 0) out.cutter.profile.Rr = 5e-3 - corner;
  if (corner > 0) out.cutter.profile.Rz = corner;
  out.runout.radial_offsets = {0.0, 6 * unit::um, -4 * unit::um};
  return out;
}

void run(benchmark::State& state, const Path& path, const engagement::Tool& cutter) {
  const stock::Initial stock = stock::Box{{-2e-3, -10e-3, -30e-3}, {102e-3, 110e-3, 0}};
  const engagement::Job job{path.program, std::span(&cutter, 1), stock, {}};
  std::int64_t turns = 0;
  for (auto _ : state) {
    turns = engagement::compute_steps(job, {}).totals.steps;
  }
  state.counters["turns"] = static_cast<double>(turns);
}

/// Ten rows of a flat cutter, 2 mm deep; blocks of so many hundredths of a millimetre.
void program_blocks(benchmark::State& state) {
  Path path;
  path.rows(10, 1.5, static_cast<double>(state.range(0)) / 100, -2);
  run(state, path, tool(0));
}

/// Three rows of a ball, 0.5 mm deep, blocks of 0.5 mm.
void program_ball(benchmark::State& state) {
  Path path;
  path.rows(3, 0.5, 0.5, -0.5);
  run(state, path, tool(5e-3));
}

}  // namespace

BENCHMARK(program_blocks)->Arg(50)->Arg(10)->Unit(benchmark::kMillisecond);
BENCHMARK(program_ball)->Unit(benchmark::kMillisecond);
