#include <trochoid/base/units.h>
#include <trochoid/force/forces.h>
#include <trochoid/numerics/parallel.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <vector>

#include "paper_cut.h"

// Many cuts, on one thread and on two: how the time falls, and whether a bit changes.
namespace trochoid::benchmarks {

namespace {

constexpr std::size_t cuts = 20000;
constexpr int repetitions = 5;

/// The paper's slot with other feeds, depths and helices.
std::vector<force::Setup> many_cuts() {
  std::vector<force::Setup> setups(cuts, paper_cut());
  for (std::size_t i = 0; i < cuts; ++i) {
    const double share = static_cast<double>(i) / cuts;
    setups[i].cut.f_z *= 0.5 + share;
    setups[i].cut.a_p *= 0.5 + 5 * share;
    setups[i].cutter.helix = (10 + 40 * share) * unit::deg;
  }
  return setups;
}

struct Timed {
  double seconds = 0.0;
  std::vector<force::Vector3> F;
};

Timed timed(const std::vector<force::Setup>& setups, int threads) {
  const numerics::ThreadLimit limit(threads);
  const std::vector<double> phi = turns(360, 1);
  Timed result{.F = std::vector<force::Vector3>(setups.size() * phi.size())};
  std::vector<double> seconds;
  for (int i = 0; i < repetitions; ++i) {
    const auto start = std::chrono::steady_clock::now();
    force::forces_of_many(setups, paper_law(), phi, 1e-6, result.F);
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    seconds.push_back(took.count());
  }
  std::nth_element(seconds.begin(), seconds.begin() + repetitions / 2, seconds.end());
  result.seconds = seconds[repetitions / 2];
  return result;
}

}  // namespace

}  // namespace trochoid::benchmarks

int main() {
  using namespace trochoid::benchmarks;
  const auto setups = many_cuts();
  const Timed one = timed(setups, 1);
  const Timed two = timed(setups, 2);
  const bool same = std::memcmp(one.F.data(), two.F.data(),
                                one.F.size() * sizeof(trochoid::force::Vector3)) == 0;
  std::printf(
      "%zu cuts of 360 samples: one thread %.3g s, two %.3g s, %.2f times; %s\n", cuts,
      one.seconds, two.seconds, one.seconds / two.seconds,
      same ? "the same bits" : "OTHER BITS");
  return same ? 0 : 1;
}
