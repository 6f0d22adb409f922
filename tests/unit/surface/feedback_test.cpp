#include "made_wall.h"

#include <trochoid/surface/feedback.h>

#include <gtest/gtest.h>

namespace trochoid::surface::feedback_test {

constexpr Coefficients K = {800e6, 300e6, 0.0, 0.0};
constexpr double tolerance = 1e-5;

/// A cut, its moments, and a compliance to give way with.
struct Bent {
  MadeCut cut;
  Compliance compliance;
  EdgeMoments edges;

  explicit Bent(const MadeCut& s, const Bodies& bodies = cutter_only()(0.0))
      : cut(s),
        compliance(bodies, s.cut.a_p, 30e-3, Load::distributed),
        edges(s, law(0, 0), compliance.basis()) {}

  [[nodiscard]] SteadyState turn(Feedback feedback, Coefficients with = K) const {
    return steady_state(edges, with, compliance, feedback, tolerance);
  }
  [[nodiscard]] numerics::PeriodicPieces straight(Coefficients with = K) const {
    return with_coefficients(unit_moments(edges, tolerance), with);
  }
  /// Deflections u at the points of the basis.
  [[nodiscard]] std::vector<double> u(const numerics::PeriodicPieces& moments,
                                      double phi) const {
    const std::size_t n = compliance.basis().size();
    std::vector<double> m(n + 2);
    moments.value(phi, m);
    const auto G = compliance.rows(compliance.basis().points());
    std::vector<double> out(n);
    for (std::size_t p = 0; p < n; ++p) {
      for (std::size_t q = 0; q < n; ++q) out[p] += G[p * n + q] * m[q];
    }
    return out;
  }
  [[nodiscard]] double u(const numerics::PeriodicPieces& moments, double phi,
                         double z) const {
    return compliance.basis().value(u(moments, phi), z);
  }
};

double F_y(const numerics::PeriodicPieces& moments, double phi) {
  return value_at(moments, phi, moments.functions() - 1);
}

double peak(const numerics::PeriodicPieces& moments) {
  double largest = 0.0;
  for (const double phi : angles(360)) {
    largest = std::max(largest, std::abs(F_y(moments, phi)));
  }
  return largest;
}

/// How much farther out on its ray a tooth stands than those before it did (E-10).
force::Bend bend_of(const Bent& it, const numerics::PeriodicPieces& moments, double phi,
                    Feedback feedback) {
  force::Bend bend;
  bend.shift = [&, phi](double z) { return it.u(moments, phi, z); };
  if (feedback != Feedback::entry) {
    bend.advance = [&, phi, feedback](double z, std::size_t tooth, double theta,
                                      std::span<double> out) {
      for (std::size_t m = 0; m < out.size(); ++m) {
        const double back = it.edges.back()[tooth * out.size() + m];
        const double then =
            feedback == Feedback::direct ? 0.0 : it.u(moments, phi - back, z);
        out[m] = std::cos(theta) * (it.u(moments, phi, z) - then);
      }
    };
  }
  return bend;
}

/// Largest part of the force that the found deflection does not give back.
double residual(const Bent& it, const SteadyState& turn, Feedback feedback,
                int samples) {
  const std::size_t n = it.edges.values();
  std::vector<double> unit(columns * n);
  double off = 0.0;
  for (const double phi : angles(samples)) {
    const force::Bend bend = bend_of(it, turn.moments, phi, feedback);
    it.edges.at(phi, &bend, unit);
    double F = 0.0;
    for (std::size_t c = 0; c < columns; ++c) F += K[c] * unit[c * n + n - 1];
    off = std::max(off, std::abs(F - F_y(turn.moments, phi)));
  }
  return off / peak(turn.moments);
}

MadeCut bent_cut(bool down, double rho) {
  return with_runout(made_cut(down), rho, 71 * unit::deg);
}

/// Runout and all feedback: takes many turns to repeat, so it is found once.
struct Regenerated {
  Bent it{bent_cut(true, 20e-6)};
  SteadyState turn = it.turn(Feedback::regenerative);
};

const Regenerated& regenerated() {
  static const Regenerated made;
  return made;
}

TEST(Feedback, TheDeflectionFoundGivesTheForcesThatMakeIt) {  // [E-10]
  for (const Feedback feedback : {Feedback::entry, Feedback::direct}) {
    for (const bool down : {true, false}) {
      const Bent it(bent_cut(down, 10e-6));
      const SteadyState turn = it.turn(feedback);
      ASSERT_TRUE(turn.converged);
      EXPECT_LT(residual(it, turn, feedback, 12), 20 * tolerance)
          << down << static_cast<int>(feedback);
    }
  }
}

TEST(Feedback, AlsoWhereItComesBackWithTheNextTooth) {  // [E-10]
  const auto& [it, turn] = regenerated();
  ASSERT_TRUE(turn.converged);
  EXPECT_GT(turn.turns, 2);
  EXPECT_LT(residual(it, turn, Feedback::regenerative, 12), 20 * tolerance);
}

TEST(Feedback, TheFirstGuessWouldNotDo) {  // [E-10]
  const Bent it(bent_cut(true, 0.0));
  const SteadyState straight{.moments = it.straight()};
  EXPECT_GT(residual(it, straight, Feedback::entry, 40), 1e-3);
}

TEST(Feedback, OfAThinWallHoldsAsWell) {  // [E-10]
  const Bent it(bent_cut(true, 5e-6), with_wall(2e-3)(30e-3));
  const SteadyState turn = it.turn(Feedback::entry);
  ASSERT_TRUE(turn.converged);
  EXPECT_LT(residual(it, turn, Feedback::entry, 12), 50 * tolerance);
}

TEST(Feedback, WithoutRunoutTheChipTermCancels) {  // [E-10]
  const Bent it(made_cut());
  const auto entry = it.turn(Feedback::entry).moments;
  const auto both = it.turn(Feedback::regenerative).moments;
  for (const double phi : angles(100)) {
    EXPECT_NEAR(F_y(both, phi), F_y(entry, phi), 2 * tolerance * 250);
  }
  // also where the code cannot know: one radial offset that moves nothing
  MadeCut s = made_cut();
  s.runout.radial_offsets = {0.0, 1e-13, 0.0};
  const SteadyState turn = Bent(s).turn(Feedback::regenerative);
  ASSERT_TRUE(turn.converged);
  EXPECT_GT(turn.turns, 1);
  for (const double phi : angles(100)) {
    EXPECT_NEAR(F_y(turn.moments, phi), F_y(entry, phi), 20 * tolerance * 250);
  }
}

TEST(Feedback, ForcesFallTheMoreIsFedBack) {  // [E-10]
  const Bent it(made_cut());
  const double none = peak(it.straight());
  const double entry = peak(it.turn(Feedback::entry).moments);
  const double direct = peak(it.turn(Feedback::direct).moments);
  EXPECT_LT(entry, 0.995 * none);
  EXPECT_LT(direct, 0.9 * entry);
}

/// Deflected or not, exact paths meet the stock where they are.
MadeCut exact_cut() {
  MadeCut s = bent_cut(true, 10e-6);
  s.chip.model = chip::Model::trochoidal;
  return s;
}

TEST(Feedback, AStiffCutterIsARigidOne) {  // [E-10]
  Bodies stiff = cutter_only()(0.0);
  stiff.cutter->youngs_modulus *= 1e9;
  const Bent it(exact_cut(), stiff);
  const auto straight = it.straight();
  for (const Feedback feedback :
       {Feedback::entry, Feedback::regenerative, Feedback::direct}) {
    const SteadyState turn = it.turn(feedback);
    ASSERT_TRUE(turn.converged);
    for (const double phi : angles(50)) {
      EXPECT_NEAR(F_y(turn.moments, phi), F_y(straight, phi), 10 * tolerance * 250);
    }
  }
}

TEST(Feedback, ARigidCutterStaysStraight) {  // [E-10]
  const Bent it(exact_cut(), Bodies{});
  const SteadyState turn = it.turn(Feedback::regenerative);
  EXPECT_TRUE(turn.converged);
  const auto straight = it.straight();
  for (const double phi : angles(50)) {
    EXPECT_NEAR(F_y(turn.moments, phi), F_y(straight, phi), 2 * tolerance * 250);
  }
}

TEST(Feedback, EachToothEntersByItsOwnRadius) {  // [E-10] [C-4]
  // Of the simple chips `radial` alone knows the tooth as it is; without feedback it
  // keeps to the nominal arc. A longer tooth enters earlier, a shorter one later.
  const MadeCut s = bent_cut(true, 10e-6);
  const Bent it(s, Bodies{});
  const auto met = it.turn(Feedback::entry).moments;
  const auto nominal = it.straight();
  const double entry = entry_angle(s);
  const double dR_dtheta = -(s.cutter.profile.D / 2) * std::tan(entry);
  MadeCut straight = s;
  straight.runout = {};
  const auto teeth = edge_places(s, 0.0);
  const auto nominal_teeth = edge_places(straight, 0.0);
  for (std::size_t i = 0; i < teeth.size(); ++i) {
    const double longer = teeth[i].R - s.cutter.profile.D / 2;
    ASSERT_GT(std::abs(longer), 1e-6);
    const double between = entry - 0.5 * longer / dR_dtheta + nominal_teeth[i].behind;
    const double with = F_y(met, between);
    const double without = F_y(nominal, between);
    if (longer > 0) {
      EXPECT_GT(std::abs(with), std::abs(without));
    } else {
      EXPECT_LT(std::abs(with), std::abs(without));
    }
  }
}

TEST(Feedback, SmallDeflectionsChangeTheForceInProportion) {  // [E-10]
  // entry only: F(u) - F(0) goes with u, so twice the compliance is twice the loss
  const auto loss = [](double softer) {
    Bodies bodies = cutter_only()(0.0);
    bodies.cutter->youngs_modulus /= softer;
    const Bent it(made_cut(), bodies);
    double sum = 0.0;
    const auto straight = it.straight();
    const auto bent = it.turn(Feedback::entry).moments;
    for (const double phi : angles(720)) sum += F_y(straight, phi) - F_y(bent, phi);
    return sum;
  };
  EXPECT_NEAR(loss(0.1) / loss(0.05), 2.0, 0.05);
}

TEST(Feedback, ForcesFallWithTheWall) {  // [E-10] 166 and 215 N
  const Coefficients paper = {1535e6, 1037e6, 0.0, 0.0};
  const auto of = [&](const Bodies& bodies, Feedback feedback) {
    return peak(Bent(made_cut(), bodies).turn(feedback, paper).moments);
  };
  const double thin = of(with_wall(2e-3)(30e-3), Feedback::entry);
  const double thick = of(with_wall(4e-3)(30e-3), Feedback::entry);
  EXPECT_NEAR(thin, 166.0, 3.0);
  EXPECT_NEAR(thick, 215.0, 3.0);
  EXPECT_GT(peak(Bent(made_cut(), Bodies{}).straight(paper)), 280.0);
}

TEST(Feedback, NoMaterialIsLostBetweenTheTeeth) {  // [E-10]
  // what one tooth leaves the next one takes: the chips of a turn at one angle add up
  // to the feed, whatever runout and bending do to each of them
  const auto& [it, turn] = regenerated();
  ASSERT_TRUE(turn.converged);
  const force::Edges edges(it.cut);
  double uneven = 0.0;
  for (const double theta : {2.75, 2.9, 3.05}) {
    for (const double z : {0.4e-3, 1.9e-3}) {
      double sum = 0.0;
      for (std::size_t tooth = 0; tooth < 3; ++tooth) {
        const double phi = theta + 2 * pi / 3 * static_cast<double>(tooth) + z / 6e-3;
        const force::Bend bend = bend_of(it, turn.moments, phi, Feedback::regenerative);
        force::EdgeCurve curve(edges, &bend);
        curve.stand_at(phi, tooth);
        const double h = curve.state(z).chip.h;
        uneven = std::max(uneven, std::abs(h / (0.2e-3 * std::sin(theta)) - 1));
        sum += h;
      }
      EXPECT_NEAR(sum, 0.6e-3 * std::sin(theta), 1e-8) << theta;
    }
  }
  EXPECT_GT(uneven, 0.1);
}

/// Before a wall that gives more than the chip is thick, cuts come and go and are short in
/// height: overlooked ones made the force jump, and no deflection agreed with it.
TEST(Feedback, IsFoundWhereCutsAreShort) {  // [E-10]
  for (const double K_te : {0.0, 5e3}) {
    MadeCut s = with_runout(made_cut(), 3.8e-6, 1.24);
    s.runout.order = geometry::EccentricityOrder::exact;
    s.cut.engagement = geometry::DownMilling{0.125e-3};
    s.cut.f_z = 25e-6;
    s.chip.model = chip::Model::trochoidal;
    const Bodies thin = with_wall()(30e-3);
    const Compliance compliance(thin, s.cut.a_p, 30e-3, Load::distributed);
    const EdgeMoments edges(s, law(0, 0, 1, 1), compliance.basis());
    const SteadyState state =
        steady_state(edges, {{750e6, 319e6, K_te, K_te}}, compliance,
                     Feedback::regenerative, tolerance);
    EXPECT_TRUE(state.found && state.converged) << K_te;
  }
}

TEST(Feedback, ATooSoftCutterIsToldAndEnds) {  // [E-10]
  // a thousand times too soft: the deflection would be many times the radial depth
  Bodies soft = cutter_only()(0.0);
  soft.cutter->youngs_modulus /= 1000;
  for (const double rho : {0.0, 20e-6}) {
    for (const Feedback feedback : {Feedback::entry, Feedback::regenerative}) {
      const SteadyState turn = Bent(bent_cut(true, rho), soft).turn(feedback);
      EXPECT_FALSE(turn.converged);
      EXPECT_TRUE(std::isfinite(peak(turn.moments)));
    }
  }
}

}  // namespace trochoid::surface::feedback_test
