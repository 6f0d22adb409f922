#include <trochoid/base/units.h>
#include <trochoid/dynamics/motion.h>
#include <trochoid/dynamics/multiplier.h>
#include <trochoid/force/forces.h>
#include <trochoid/identification/identify.h>
#include <trochoid/surface/edge_moments.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

/// What the laws have to do with one another, in every room that knows them.
namespace trochoid {
namespace {

constexpr force::LinearEdge linear{800e6, 300e6, 100e6, 5e3, 3e3, 1e3};
/// The same law by another way: a power of one and edge forces.
constexpr force::PowerEdge same{800e6, 300e6, 100e6, 0, 0, 0, 5e3, 3e3, 1e3};
/// The same without its edges.
constexpr force::Power blunt{800e6, 300e6, 100e6, 0, 0, 0};

force::Setup cut(const geometry::Profile& profile, double helix_deg) {
  force::Setup setup;
  setup.cutter = {.profile = profile,
                  .pitch = geometry::equal_pitch(2),
                  .helix = helix_deg * unit::deg,
                  .lag_diameter = profile.D};
  setup.runout.radial_offsets = {4e-6, -4e-6};
  setup.cut = {geometry::Slot{}, 1e-3, 0.05e-3, 20 * unit::turn};
  return setup;
}

double largest_difference(const std::vector<force::Vector3>& a,
                          const std::vector<force::Vector3>& b) {
  double most = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t q = 0; q < 3; ++q) {
      most = std::max(most, std::abs(a[i][q] - b[i][q]));
    }
  }
  return most;
}

TEST(APowerOfOneWithEdges, IsTheLinearLawInForces) {  // [F-1] [F-9]
  std::vector<double> phi;
  for (int i = 0; i < 120; ++i) phi.push_back(0.01 + unit::turn * i / 120);
  for (const auto& profile : {geometry::cylinder(8e-3), geometry::ball(8e-3)}) {
    const force::Setup setup = cut(profile, 30);
    const auto a = force::forces(setup, linear, phi, 1e-10);
    const auto b = force::forces(setup, same, phi, 1e-10);
    EXPECT_LT(largest_difference(a, b), 1e-7);  // of 60 N
  }
}

TEST(APowerOfOneWithEdges, IsTheLinearLawInMotion) {  // [T-4]
  for (const double helix : {0.0, 30.0}) {
    dynamics::MotionProblem p;
    p.setup = cut(geometry::cylinder(8e-3), helix);
    p.setup.chip.model = chip::Model::radial;
    p.system.modes = {{0.0324, 25.5, 8e6, 1, 0}, {0.0324, 25.5, 8e6, 0, 1}};
    p.revolutions = 4;
    p.grid.steps_per_tooth = 500;
    p.law = linear;
    const dynamics::Motion a = dynamics::motion(p);
    p.law = same;
    const dynamics::Motion b = dynamics::motion(p);
    ASSERT_TRUE(a.finite && b.finite);
    EXPECT_LT(largest_difference(a.force, b.force), 1e-6 * a.peak);
  }
}

TEST(EdgeForces, LeaveStabilityAsItIs) {  // [D-5] [D-6]
  for (const double helix : {0.0, 30.0}) {
    force::Setup setup = cut(geometry::cylinder(10e-3), helix);
    setup.chip.model = chip::Model::radial;
    const dynamics::System system{{{0.03993, 5.1, 1.34e6, 1, 0}}};
    const auto growth = [&](const force::Law& law) {
      const dynamics::DirectionalModel model(setup, law, 1e-6, 1e-11);
      return dynamics::multiplier(model.at_depth(1e-3), system, setup.cut.Omega, 1e-9)
          .value;
    };
    EXPECT_NEAR(std::abs(growth(same) - growth(linear)), 0.0, 1e-9);
    EXPECT_NEAR(std::abs(growth(same) - growth(blunt)), 0.0, 1e-9);
  }
}

TEST(APowerOfOneWithEdges, IsTheLinearLawOnAWall) {  // [E-2]
  force::Setup setup = cut(geometry::cylinder(8e-3), 30);
  setup.cut.engagement = geometry::DownMilling{1e-3};
  const numerics::LagrangeBasis basis(0.0, setup.cut.a_p, 5);
  const surface::EdgeMoments a(setup, linear, basis);
  const surface::EdgeMoments b(setup, same, basis);
  std::vector<double> of_a(surface::columns * a.values());
  std::vector<double> of_b(of_a.size());
  EXPECT_EQ(surface::wall_coefficients(linear), surface::wall_coefficients(same));
  // The linear law has chips at fixed nodes, the power law a quadrature.
  constexpr double agree = 1e-8;
  std::vector<double> apart(surface::columns);
  std::vector<double> largest(surface::columns);
  for (double phi = 0.05; phi < unit::turn; phi += 0.1) {
    a.at(phi, nullptr, of_a);
    b.at(phi, nullptr, of_b);
    for (std::size_t i = 0; i < of_a.size(); ++i) {
      const std::size_t column = i / a.values();
      apart[column] = std::max(apart[column], std::abs(of_a[i] - of_b[i]));
      largest[column] = std::max(largest[column], std::abs(of_b[i]));
    }
  }
  for (std::size_t column = 0; column < surface::columns; ++column) {
    EXPECT_LE(apart[column], agree * largest[column]) << column;
  }
}

TEST(Identify, FindsAPowerLawWithItsEdges) {  // [F-9] [I-3] [I-4]
  const force::PowerEdge true_law{1500e6, 700e6, 300e6, 0.15, 0.25, 0.2, 7e3, 9e3, 2e3};
  const force::Setup setup = cut(geometry::cylinder(8e-3), 30);
  identification::Run run{.cut = setup.cut};
  for (int i = 0; i < 720; ++i) run.angle.push_back(unit::turn * i / 360);
  run.force = force::forces(setup, true_law, run.angle, 1e-9);
  std::mt19937_64 random(9);
  std::normal_distribution<double> noise(0.0, 0.2);
  for (auto& F : run.force) {
    for (double& f : F) f += noise(random);
  }
  const force::PowerEdge start{0, 0, 0, 0.25, 0.25, 0.25, 0, 0, 0};
  const auto fit = identification::identify(setup, start, std::span(&run, 1), {});
  ASSERT_TRUE(fit.ok) << fit.message;
  const std::vector<double> K = force::coefficients(true_law);
  ASSERT_EQ(fit.coefficients.size(), K.size());
  for (std::size_t q = 0; q < K.size(); ++q) {
    ASSERT_TRUE(fit.coefficients[q]);
    EXPECT_NEAR(fit.coefficients[q]->value, K[q], 4 * fit.coefficients[q]->se) << q;
    EXPECT_LT(fit.coefficients[q]->se, 0.3 * K[q]) << q;
  }
  const auto m = force::form(true_law).m;
  ASSERT_EQ(fit.exponents.size(), m.size());
  for (std::size_t q = 0; q < m.size(); ++q) {
    EXPECT_NEAR(fit.exponents[q]->value, m[q], 4 * fit.exponents[q]->se) << q;
  }
}

}  // namespace
}  // namespace trochoid
