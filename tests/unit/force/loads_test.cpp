#include "made_cut.h"

#include <gtest/gtest.h>

namespace trochoid::force::loads_test {

double mean_torque(const MadeCut& setup, const Law& law, int count) {
  double sum = 0.0;
  for (const Loads& l : loads(setup, law, turn(count), 0.1, 1e-10)) sum += l.torque;
  return sum / count;
}

TEST(Loads, PowerIsTheCuttingEnergyOfWhatIsRemoved) {  // [F-6]
  // one turn: K_tc times the volume, K_te times the edge times its way in cut
  for (const int teeth : {1, 2, 3}) {
    MadeCut s = slot(geometry::cylinder(8e-3), teeth, 30);
    s.chip.model = chip::Model::none;
    const double D = s.cutter.profile.D;
    const double volume = teeth * s.cut.f_z * D * s.cut.a_p;
    const double edge = s.cut.a_p / std::cos(30 * unit::deg);
    const double way = teeth * pi * D / 2;
    const LinearEdge K = steel();
    const double energy = K.K_tc * volume + K.K_te * edge * way;
    EXPECT_NEAR(2 * pi * mean_torque(s, K, 1440), energy, 1e-5 * energy);
  }
}

TEST(Loads, PowerWithRunoutIsThatOfTheVolumeToo) {  // [F-6] [C-8]
  MadeCut s = slot(geometry::cylinder(8e-3), 3, 30);
  s.runout.radial_offsets = {0.0, 7e-6, -12e-6};
  s.cut.engagement = geometry::Band{-2e-3, 1e-3};
  const double volume = 3 * s.cut.f_z * 3e-3 * s.cut.a_p;
  const LinearEdge K{2600e6, 0, 0, 0, 0, 0};
  // R h stands for the mean radius of the chip: h/2 of R, and the motion of the axis
  EXPECT_NEAR(2 * pi * mean_torque(s, K, 1440), K.K_tc * volume,
              0.01 * K.K_tc * volume);
}

TEST(Loads, OnlyTangentialForcesTurnTheSpindle) {  // [F-6]
  MadeCut s = slot(geometry::ball(8e-3), 2, 30);
  const LinearEdge others{0, 1500e6, 330e6, 0, 3e3, 1e3};
  for (const Loads& l : loads(s, others, turn(30), 0.05, 1e-9)) {
    EXPECT_NEAR(l.torque, 0.0, 1e-12);
  }
  for (const Loads& l : loads(s, steel(), turn(30), 0.05, 1e-9)) {
    EXPECT_GE(l.torque, 0.0);
  }
}

TEST(Loads, TorqueIsTheSameWithoutAndWithBending) {  // [F-6]
  for (const double helix : {0.0, 30.0}) {
    MadeCut s = slot(geometry::cylinder(8e-3), 3, helix);
    s.runout.radial_offsets = {0.0, 7e-6, -12e-6};
    for (const geometry::Engagement& engagement :
         {geometry::Engagement{geometry::Slot{}},
          geometry::Engagement{geometry::Band{-2e-3, 1e-3}}}) {
      s.cut.engagement = engagement;
      const auto phi = turn(50);
      const auto with = loads(s, steel(), phi, 0.06, 1e-9);
      const auto without = loads(s, steel(), phi, std::nullopt, 1e-9);
      double largest = 0.0;
      for (const Loads& l : with) largest = std::max(largest, l.torque);
      for (std::size_t i = 0; i < phi.size(); ++i) {
        EXPECT_NEAR(without[i].torque, with[i].torque, 1e-8 * largest);
        EXPECT_EQ(without[i].force, with[i].force);
        EXPECT_EQ(without[i].bending, 0.0);
      }
    }
  }
}

TEST(Loads, AThinSliceBendsByItsForceTimesTheArm) {  // [F-7]
  MadeCut s = slot(geometry::cylinder(8e-3), 2, 30);
  s.cut.a_p = 1e-6;
  const LinearEdge K{2600e6, 1500e6, 0, 7e3, 3e3, 0};  // F_z would add its own arm
  const double gauge = 0.06;
  for (const Loads& l : loads(s, K, turn(50), gauge, 1e-9)) {
    const double F = std::hypot(l.force[0], l.force[1]);
    EXPECT_NEAR(l.bending, F * gauge, 2e-5 * F * gauge);
  }
}

TEST(Loads, ItsMomentIsTheCrossProductOfArmAndForce) {  // [F-7]
  MadeCut s = slot(geometry::cylinder(8e-3), 1, 0);
  s.cut.a_p = 1e-6;
  const LinearEdge K{2600e6, 1500e6, 9000e6, 7e3, 3e3, 9e3};
  const double gauge = 6e-3;  // short: axial forces weigh as much as the others
  const auto phi = turn(50);
  const auto all = loads(s, K, phi, gauge, 1e-9);
  for (std::size_t i = 0; i < phi.size(); ++i) {
    const Vector3& F = all[i].force;
    const double x = 4e-3 * std::sin(phi[i]);
    const double y = 4e-3 * std::cos(phi[i]);
    const double M = std::hypot(y * F[2] + gauge * F[1], -gauge * F[0] - x * F[2]);
    EXPECT_NEAR(all[i].bending, M, 2e-4 * M);  // half the depth against the gauge
  }
}

TEST(Loads, AxialForcesBendByTheRadius) {  // [F-7]
  const MadeCut s = slot(geometry::cylinder(8e-3), 1, 0);
  for (const Loads& l :
       loads(s, LinearEdge{0, 0, 330e6, 0, 0, 1e3}, turn(50), 0.06, 1e-10)) {
    EXPECT_NEAR(l.bending, 4e-3 * std::abs(l.force[2]), 1e-12);
  }
}

TEST(Loads, ForcesAreThoseWithoutMoments) {
  MadeCut s = slot(geometry::ball(8e-3), 2, 30);
  s.runout.eccentricity = 6e-6;
  const auto phi = turn(30);
  const auto F = forces(s, steel(), phi, 1e-9);
  std::vector<Vector3> other;
  for (const Loads& l : loads(s, steel(), phi, 0.06, 1e-9)) other.push_back(l.force);
  EXPECT_LE(difference(F, other), 1e-8 * peak(F));
}

}  // namespace trochoid::force::loads_test
