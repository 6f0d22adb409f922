#include "made_record.h"

#include <gtest/gtest.h>
#include <trochoid/identification/turn_force.h>

#include <cmath>

namespace trochoid::identification::turn_force_test {

TEST(TurnForce, MeetsTheForceBetweenItsNodes) {
  for (const double helix : {0.0, 30.0}) {
    force::Setup setup = slot_setup(3, helix, 2.0 * unit::mm);
    setup.runout.radial_offsets = {0.0, -8.0 * unit::um, 5.0 * unit::um};
    const auto force = [&](std::span<const double> phi) {
      return force::forces(setup, steel(), phi, 1e-9);
    };
    const TurnForce turn(force, 2e-7);
    double peak = 0.0;
    double off = 0.0;
    std::mt19937 random(5);
    std::uniform_real_distribution<double> angle(-20.0, 20.0);
    for (int i = 0; i < 4000; ++i) {
      const double phi = angle(random);
      const force::Vector3 exact = force({&phi, 1}).front();
      const force::Vector3 found = turn.at(phi);
      for (std::size_t q = 0; q < 3; ++q) {
        peak = std::max(peak, std::abs(exact[q]));
        off = std::max(off, std::abs(found[q] - exact[q]));
      }
    }
    EXPECT_LT(off, 1e-6 * peak) << helix;
    EXPECT_LT(turn.evaluations(), 4000U) << helix;
  }
}

TEST(TurnForce, OfNothingIsNothing) {
  const TurnForce turn(
      [](std::span<const double> phi) {
        return std::vector<force::Vector3>(phi.size(), force::Vector3{});
      },
      1e-7);
  EXPECT_EQ(turn.at(1.0), force::Vector3{});
}

}  // namespace trochoid::identification::turn_force_test
