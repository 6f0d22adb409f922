#include "made_cut.h"

#include <gtest/gtest.h>
#include <trochoid/force/sensor.h>

#include <complex>

namespace trochoid::force::sensor_test {

constexpr double tolerance = 1e-9;

Sensor sensor_of(std::vector<ChannelAxis> axes) {
  Sensor out;
  for (const ChannelAxis axis : axes) out.channels.push_back({axis});
  return out;
}

MadeCut uneven(const geometry::Profile& profile, double helix_deg) {
  MadeCut setup = slot(profile, 4, helix_deg);
  setup.runout.radial_offsets = {0.0, 8e-6, -5e-6, 3e-6};
  return setup;
}

/// One straight tooth: u is against its radial force, v along its tangential one.
TEST(Sensor, TurnsWithOneStraightTooth) {  // [F-32] [F-6]
  MadeCut setup = slot(geometry::cylinder(10e-3), 1, 0);
  LinearEdge law = steel();
  const auto phi = turn(12);
  const auto sensor = sensor_of(
      {ChannelAxis::u, ChannelAxis::v, ChannelAxis::torque, ChannelAxis::power});
  const auto rows = channel_columns(setup, Law{law}, sensor, phi, tolerance);
  const auto F = forces(setup, Law{law}, phi, tolerance);
  for (std::size_t i = 0; i < phi.size(); ++i) {
    if (F[i][2] == 0.0) continue;  // not in cut
    const double* u = &rows[i * 24];
    const double* v = u + 6;
    const double* torque = u + 12;
    const double* power = u + 18;
    EXPECT_NEAR(u[0], 0.0, 1e-18);
    EXPECT_LT(u[1], 0.0);
    EXPECT_NEAR(v[0], -u[1], 1e-15);
    EXPECT_NEAR(torque[0], 5e-3 * v[0], 1e-17);
    EXPECT_DOUBLE_EQ(power[0], torque[0] * setup.cut.Omega);
    EXPECT_EQ(torque[1], 0.0);
    EXPECT_EQ(torque[2], 0.0);
  }
}

/// A section far above the tool feels its forces as moments: M_u = l F_v, M_v = -l F_u.
TEST(Sensor, FarAwayFeelsForcesAsMoments) {  // [F-32] [F-7]
  const MadeCut setup = uneven(geometry::cylinder(10e-3), 30);
  const auto phi = turn(24);
  Sensor sensor = sensor_of(
      {ChannelAxis::u, ChannelAxis::v, ChannelAxis::moment_u, ChannelAxis::moment_v});
  sensor.angle = 0.4;
  sensor.gauge_length = 1e4;
  const auto rows = channel_columns(setup, Law{steel()}, sensor, phi, tolerance);
  for (std::size_t i = 0; i < phi.size(); ++i) {
    for (std::size_t q : {0U, 1U, 3U, 4U}) {
      const double* r = &rows[i * 24 + q];
      const double size = 1e-6 * (std::abs(r[0]) + std::abs(r[6]) + 1e-9);
      EXPECT_NEAR(r[12] / 1e4, r[6], size);
      EXPECT_NEAR(r[18] / 1e4, -r[0], size);
    }
  }
}

/// Columns times coefficients are what is computed with these coefficients.
TEST(Sensor, ColumnsAddUpToTheLoads) {  // [F-32]
  Sensor sensor =
      sensor_of({ChannelAxis::moment_x, ChannelAxis::z, ChannelAxis::moment_v,
                 ChannelAxis::torque, ChannelAxis::y});
  sensor.channels[1].sign = -1;
  sensor.angle = -0.7;
  sensor.gauge_length = 0.1;
  for (const MadeCut& setup : {uneven(geometry::cylinder(10e-3), 35),
                               uneven(geometry::bull_nose(10e-3, 2e-3), 20)}) {
    const auto phi = turn(16);
    const Law law{steel()};
    const auto K = coefficients(law);
    const auto rows = channel_columns(setup, law, sensor, phi, tolerance);
    const auto want = channel_values(
        sensor, six_loads(setup, law, phi, sensor.gauge_length, tolerance), phi, 90.0);
    for (std::size_t i = 0; i < want.size(); ++i) {
      double sum = 0.0;
      for (std::size_t q = 0; q < 6; ++q) sum += rows[6 * i + q] * K[q];
      EXPECT_NEAR(sum, want[i], 1e-5 * (1.0 + std::abs(want[i])));
    }
  }
}

/// Means over a turn are those of many samples, in the turning frame as well.
TEST(Sensor, HasTheMeanOfManySamples) {  // [F-31] [F-32]
  Sensor sensor =
      sensor_of({ChannelAxis::u, ChannelAxis::v, ChannelAxis::moment_u,
                 ChannelAxis::moment_y, ChannelAxis::torque, ChannelAxis::x});
  sensor.angle = 0.9;
  sensor.gauge_length = 0.08;
  const MadeCut setup = uneven(geometry::cylinder(10e-3), 35);
  const auto phi = turn(2880);
  const auto rows = channel_columns(setup, Law{steel()}, sensor, phi, tolerance);
  const auto means = channel_means(setup, Law{steel()}, sensor, tolerance);
  for (std::size_t k = 0; k < means.size(); ++k) {
    double sum = 0.0;
    double size = 0.0;
    for (std::size_t i = k; i < rows.size(); i += means.size()) {
      sum += rows[i] / 2880;
      size = std::max(size, std::abs(rows[i]));
    }
    EXPECT_NEAR(means[k], sum, 2e-5 * size + 1e-18) << k;
  }
}

/// All teeth in cut, radial chip, equal pitch: the mean of u and v tells the first harmonic of
/// the radii times -K_rc + i K_tc, and the lag of the helix cancels.
TEST(Sensor, MeansInTheTurningFrameTellTheEccentricity) {  // [F-31] [F-32]
  using namespace std::complex_literals;
  const LinearEdge law{2600e6, 1500e6, 330e6, 0, 0, 0};
  for (const int N : {3, 4, 5}) {
    MadeCut setup = slot(geometry::cylinder(10e-3), N, 30);
    setup.chip.model = chip::Model::radial;
    setup.cut.engagement = geometry::Band{-2.5e-3, 2.5e-3};
    setup.runout.eccentricity = 6e-6;
    setup.runout.angle = 0.8;
    setup.runout.order = geometry::EccentricityOrder::first;
    const Sensor sensor = sensor_of({ChannelAxis::u, ChannelAxis::v});
    const auto means = channel_means(setup, Law{law}, sensor, tolerance);
    const auto K = coefficients(Law{law});
    std::array<double, 2> mean{};
    for (std::size_t c = 0; c < 2; ++c) {
      for (std::size_t q = 0; q < K.size(); ++q)
        mean[c] += means[c * K.size() + q] * K[q];
    }
    const double share = 1.0 / 6;  // of the turn, from 60 to 120 deg
    const auto tooth = std::polar(1.0, 2 * pi / N);
    const auto want = share * (-law.K_rc + 1i * law.K_tc) * setup.cut.a_p * (0.5 * N) *
                      std::polar(6e-6, 0.8) * (1.0 - tooth);
    EXPECT_NEAR(mean[0], want.real(), 1e-3 * std::abs(want)) << N;
    EXPECT_NEAR(mean[1], want.imag(), 1e-3 * std::abs(want)) << N;
  }
}

}  // namespace trochoid::force::sensor_test
