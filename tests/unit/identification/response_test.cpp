#include <trochoid/identification/resonance.h>
#include <trochoid/identification/response.h>
#include <trochoid/identification/spectrum.h>
#include <trochoid/identification/views.h>

#include "made_record.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

/// A dynamometer that reads forces through its own vibration.
namespace trochoid::identification::response_test {

TEST(Response, TurnsAmplitudesByAMatrixForEachHarmonic) {  // [I-16]
  // Force x: 2 + 3 cos phi + 4 sin phi; y: 5 cos phi. H_1 delays x by a quarter and reads
  // half of x in y.
  const std::complex<double> quarter(0.0, -1.0);
  Response response;
  response.harmonic.push_back({1, 0, 0, 0, 1, 0, 0, 0, 1});
  response.harmonic.push_back({quarter, 0, 0, 0.5, 1, 0, 0, 0, 1});
  std::vector<double> c = {2, 0, 0, 3, 5, 0, 4, 0, 0, 7, 7, 7, 7, 7, 7};
  respond(response, 1, c);
  // 3 cos(phi - 90 deg) + 4 sin(phi - 90 deg) = 3 sin phi - 4 cos phi
  const std::vector<double> want = {2, 0, 0, -4, 6.5, 0, 3, 2, 0, 0, 0, 0, 0, 0, 0};
  for (std::size_t i = 0; i < c.size(); ++i) EXPECT_NEAR(c[i], want[i], 1e-12) << i;
}

force::Setup two_flutes() {
  force::Setup setup = slot_setup(2, 30.0, 2.0 * unit::mm);
  setup.runout.radial_offsets = {0.0, -8.0 * unit::um};
  return setup;
}

force::Setup without_runout(force::Setup setup) {
  setup.runout = {};
  return setup;
}

/// What a dynamometer with these resonances reads, by sums over the turn.
Record read_through(const Resonances& resonances, Record run) {
  constexpr std::size_t per_turn = 120;
  const Response response =
      response_of(resonances, run.cut.Omega, static_cast<int>(per_turn / 2 - 1));
  const std::vector<std::array<double, 3>> force = run.force;
  for (std::size_t q = 0; q < 3; ++q) {
    std::vector<double> turn(per_turn, 0.0);
    for (std::size_t k = 0; k < per_turn / 2; ++k) {
      std::complex<double> F = 0.0;
      for (std::size_t i = 0; i < per_turn; ++i) {
        F += force[i][q] * std::polar(1.0, -static_cast<double>(k) * run.angle[i]);
      }
      F *= (k == 0 ? 1.0 : 2.0) / per_turn * response.harmonic[k][4 * q];
      for (std::size_t i = 0; i < per_turn; ++i) {
        turn[i] += (F * std::polar(1.0, static_cast<double>(k) * run.angle[i])).real();
      }
    }
    for (std::size_t i = 0; i < run.force.size(); ++i) {
      run.force[i][q] = turn[i % per_turn];
    }
  }
  return run;
}

struct Ringing {
  force::Setup setup = two_flutes();
  Resonances truth;
  std::vector<Record> runs;

  Ringing() {
    const double Omega = setup.cut.Omega;
    truth = {Resonance{14.3 * Omega, 0.05, 0.0}, Resonance{17.6 * Omega, 0.04, 0.0},
             std::nullopt};
    for (const double f_z : {30e-6, 60e-6}) {
      setup.cut.f_z = f_z;
      runs.push_back(read_through(
          truth, made_record(setup, steel(), {.per_turn = 120, .turns = 8})));
    }
  }

  [[nodiscard]] Options options() const {
    Options out;
    out.phase = 0.0;
    return out;
  }
};

TEST(Response, KnownMakesTheFitExact) {  // [I-16]
  const Ringing ringing;
  Options options = ringing.options();
  for (const Record& run : ringing.runs) {
    options.response.push_back(
        response_of(ringing.truth, run.cut.Omega, resolved_harmonics(run)));
  }
  const Fit fit =
      identify(without_runout(ringing.setup), steel(), ringing.runs, options);
  const auto truth = force::coefficients(steel());
  for (std::size_t c = 0; c < truth.size(); ++c) {
    // What was read holds 59 harmonics, and those beyond as aliases.
    EXPECT_NEAR(fit.coefficients[c]->value / truth[c], 1.0, 2e-3) << c;
  }
  EXPECT_NEAR(fit.runout.radial_offsets[1], -8.0 * unit::um, 0.01 * unit::um);
  EXPECT_LT(fit.unexplained.in_band, 1e-3);
}

/// What the rows of a turn leave of K_a in x and y is rounding and tells nothing.
TEST(Response, TellsNothingOfTheAxialForceWithoutZ) {  // [I-16]
  Ringing ringing;
  Options options = ringing.options();
  for (Record& run : ringing.runs) {
    run.measured[2] = false;
    options.response.push_back(
        response_of(ringing.truth, run.cut.Omega, resolved_harmonics(run)));
  }
  for (const bool drift : {false, true}) {
    options.fit_channel_offsets = drift;
    const Fit fit =
        identify(without_runout(ringing.setup), steel(), ringing.runs, options);
    ASSERT_TRUE(fit.ok) << fit.message;
    EXPECT_FALSE(fit.coefficients[2]);
    EXPECT_FALSE(fit.coefficients[5]);
    EXPECT_NEAR(fit.coefficients[0]->value / 2600e6, 1.0, 2e-3);
    EXPECT_NEAR(fit.runout.radial_offsets[1], -8.0 * unit::um, 0.01 * unit::um);
    EXPECT_EQ(fit.rank, drift ? 4 + 2 * 4 : 4);
    EXPECT_LT(fit.condition, 20.0);
  }
}

TEST(Resonance, IsFoundWithTheForces) {  // [I-17]
  const Ringing ringing;
  const Viewed seen = fit_as_seen(without_runout(ringing.setup), steel(), ringing.runs,
                                  ringing.options());
  ASSERT_TRUE(seen.fit.ok);
  for (std::size_t q = 0; q < 2; ++q) {
    ASSERT_TRUE(seen.fit.resonances[q]) << q;
    EXPECT_NEAR(seen.fit.resonances[q]->omega / ringing.truth[q]->omega, 1.0, 0.01);
    EXPECT_NEAR(seen.fit.resonances[q]->zeta, ringing.truth[q]->zeta, 0.01);
  }
  EXPECT_FALSE(seen.fit.resonances[2]) << "this axis is rigid";
  EXPECT_NEAR(seen.fit.coefficients[0]->value / steel().K_tc, 1.0, 0.01);
  ASSERT_GE(seen.views.size(), 3U);
  EXPECT_TRUE(seen.views.front().resonant);
  EXPECT_FALSE(seen.views[1].resonant);
}

TEST(Resonance, MayBeTheLowPassOfAnAmplifier) {  // [I-17]
  Ringing ringing;
  const Resonance filter{4.0 * ringing.setup.cut.Omega, std::sqrt(0.5)};
  const Resonances truth{filter, filter, filter};
  std::vector<Record> runs;
  for (const double f_z : {30e-6, 60e-6}) {
    ringing.setup.cut.f_z = f_z;
    runs.push_back(read_through(
        truth, made_record(ringing.setup, steel(), {.per_turn = 120, .turns = 8})));
  }
  const Fit fit = fit_as_seen(without_runout(ringing.setup), steel(), runs, {}).fit;
  ASSERT_TRUE(fit.ok);
  for (std::size_t q = 0; q < 3; ++q) {
    ASSERT_TRUE(fit.resonances[q]) << q;
    EXPECT_NEAR(fit.resonances[q]->omega / filter.omega, 1.0, 0.05) << q;
  }
  const auto K = force::coefficients(steel());
  for (std::size_t c = 0; c < K.size(); ++c) {
    EXPECT_NEAR(fit.coefficients[c]->value / K[c], 1.0, 0.05) << c;
  }
  EXPECT_NEAR(fit.phase[0], 0.0, 0.01);
}

TEST(Resonance, OfAGivenResponseIsScaled) {  // [I-25]
  const Ringing ringing;
  Resonances given = ringing.truth;
  for (std::size_t q = 0; q < 2; ++q) given[q]->omega *= 1.01;
  Options options = ringing.options();
  for (const Record& run : ringing.runs) {
    options.response.push_back(
        response_of(given, run.cut.Omega, resolved_harmonics(run)));
  }
  const auto scaled = with_scaled_response(ringing.runs, options);
  ASSERT_TRUE(scaled);
  for (std::size_t q = 0; q < 2; ++q) {
    ASSERT_TRUE(scaled->resonances[q]);
    EXPECT_NEAR(scaled->resonances[q]->omega / given[q]->omega, 1.0, 1e-6);
    EXPECT_NEAR(scaled->resonances[q]->zeta, given[q]->zeta, 1e-6);
  }
  EXPECT_FALSE(scaled->resonances[2]) << "this axis is rigid";
  const Fit fit =
      identify(without_runout(ringing.setup), steel(), ringing.runs, *scaled);
  ASSERT_TRUE(fit.ok) << fit.message;
  EXPECT_NEAR(fit.resonances[0]->omega / ringing.truth[0]->omega, 1.0, 1e-3);
  EXPECT_NEAR(fit.coefficients[0]->value / steel().K_tc, 1.0, 3e-3);
}

TEST(Resonance, IsNotLookedForInNoise) {
  force::Setup setup = two_flutes();
  const std::vector<Record> runs = {made_record(
      setup, steel(), {.per_turn = 120, .turns = 8, .noise = 10.0, .seed = 3})};
  Options options;
  options.phase = 0.0;
  const Viewed seen = fit_as_seen(without_runout(setup), steel(), runs, options);
  EXPECT_TRUE(seen.fit.options.response.empty());
  EXPECT_TRUE(seen.views.empty());
}

/// Rates at which a sample stands elsewhere in the turn every time.
constexpr std::array odd_rates{131.0, 200.0, 10000.0 / 2800.0 * 60.0, 300.0};

/// Forty turns of 100 N cos(k phi) in y.
Record wave_record(double per_turn, int k) {
  Record out;
  for (int i = 0; i < static_cast<int>(40 * per_turn); ++i) {
    out.angle.push_back(2 * pi * i / per_turn);
    out.force.push_back({0.0, 100.0 * std::cos(k * out.angle.back()), 0.0});
  }
  return out;
}

TEST(Spectrum, HasNoLinesThatAreNotThere) {  // [I-14]
  for (const double per_turn : odd_rates) {
    const Record run = wave_record(per_turn, 2);
    const std::vector<std::array<double, 3>> nothing(run.force.size());
    const Spectrum all = spectrum_of(run, nothing, 0);
    ASSERT_GT(all.highest, 40);
    const double there = all.left[all.lines() + 3];
    for (std::size_t line = 0; line < all.lines(); ++line) {
      if (line == 3) continue;
      EXPECT_LT(std::abs(all.left[all.lines() + line]), 0.005 * there)
          << per_turn << " samples a turn, line " << line;
    }
  }
}

TEST(Spectrum, RowsOfABandAreSortedByHarmonics) {  // [I-14]
  for (const double per_turn : odd_rates) {
    const Record run = wave_record(per_turn, 5);
    Options options;
    options.band_harmonics = 8;
    const FoldedRun folded = fold(run, options);
    Spectrum shape;
    shape.highest = 8;
    const std::vector<double> lines =
        harmonic_rows(folded, shape, numerics::Columns(folded.b, folded.b.size()));
    const double there = lines[shape.lines() + 9];
    EXPECT_NEAR(there, 100.0 * std::sqrt(static_cast<double>(run.force.size()) / 2),
                0.01 * std::abs(there));
    for (std::size_t line = 0; line < shape.lines(); ++line) {
      if (line == 9) continue;
      EXPECT_LT(std::abs(lines[shape.lines() + line]), 0.01 * std::abs(there))
          << per_turn << " samples a turn, line " << line;
    }
  }
}

TEST(Resonance, SlopesAreDerivatives) {  // [I-17]
  const double Omega = 300.0;
  const Resonances at{std::nullopt, Resonance{4000.0, 0.06}, std::nullopt};
  constexpr double step = 1e-6;
  for (const auto unknown : {ResonanceUnknown::ln_omega, ResonanceUnknown::ln_zeta}) {
    Resonances moved = at;
    double& number =
        unknown == ResonanceUnknown::ln_omega ? moved[1]->omega : moved[1]->zeta;
    number *= std::exp(step);
    const Response here = response_of(at, Omega, 20);
    const Response there = response_of(moved, Omega, 20);
    const Response slope =
        slope_of_resonance(response_of({}, Omega, 20), at, Omega, 1, unknown);
    for (std::size_t k = 0; k <= 20; ++k) {
      for (std::size_t i = 0; i < 9; ++i) {
        const auto want = (there.harmonic[k][i] - here.harmonic[k][i]) / step;
        EXPECT_LT(std::abs(slope.harmonic[k][i] - want), 1e-3 * (1 + std::abs(want)));
      }
    }
  }
}

TEST(Phase, HoldsTheErrorOfTheSpeed) {  // [I-23]
  force::Setup setup = two_flutes();
  Record run = made_record(setup, steel(),
                           {.per_turn = 120, .turns = 8, .noise = 10.0, .seed = 3});
  const auto se = [&](double Omega_se) {
    run.Omega_se = Omega_se;
    const std::vector<Record> runs{run};
    return *identify(without_runout(setup), steel(), runs, {}).phase_se[0];
  };
  const double span = run.angle.back() - run.angle.front();
  const double lever = 1e-3 * 0.5 * span;
  EXPECT_NEAR(se(1e-3 * setup.cut.Omega), std::hypot(se(0.0), lever), 1e-9);
}

}  // namespace trochoid::identification::response_test
