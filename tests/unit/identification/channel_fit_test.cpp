#include "made_record.h"

#include <gtest/gtest.h>
#include <trochoid/identification/channel_fit.h>

#include <cmath>

namespace trochoid::identification::channel_fit_test {

using force::ChannelAxis;

force::Sensor sensor_of(std::vector<ChannelAxis> axes) {
  force::Sensor out;
  for (const ChannelAxis axis : axes) out.channels.push_back({axis});
  return out;
}

/// What a sensor reads over some turns, with noise of a part of the largest of each channel.
ChannelData made_data(const force::Setup& setup, const force::Sensor& sensor,
                      const Sampling& sampling, double noise) {
  ChannelData out{.cut = setup.cut, .angle = {}, .value = {}, .sd = {}};
  std::vector<double> phi;
  const auto n = static_cast<int>(sampling.turns * sampling.per_turn);
  for (int i = 0; i < n; ++i) {
    out.angle.push_back(2.0 * pi * (i + 0.5) / sampling.per_turn);
    phi.push_back(out.angle.back() + sampling.phase);
  }
  const auto loads = force::six_loads(setup, steel(), phi, sensor.gauge_length, 1e-10);
  out.value = force::channel_values(sensor, loads, phi, setup.cut.Omega);
  const std::size_t channels = sensor.channels.size();
  out.sd.assign(channels, 0.0);
  for (std::size_t i = 0; i < out.value.size(); ++i) {
    double& sd = out.sd[i % channels];
    sd = std::max(sd, noise * std::abs(out.value[i]));
  }
  std::mt19937 random(sampling.seed);
  std::normal_distribution<double> normal;
  for (std::size_t i = 0; i < out.value.size(); ++i) {
    out.value[i] += out.sd[i % channels] * normal(random);
  }
  return out;
}

/// Means of a slot at several feeds, without noise.
std::vector<ChannelData> made_means(force::Setup setup, const force::Sensor& sensor,
                                    const std::vector<double>& feeds) {
  std::vector<ChannelData> out;
  const auto K = force::coefficients(force::Law{steel()});
  for (const double f_z : feeds) {
    setup.cut.f_z = f_z;
    const auto rows = force::channel_means(setup, steel(), sensor, 1e-10);
    ChannelData& one = out.emplace_back(ChannelData{setup.cut, {}, {}, {}});
    for (std::size_t c = 0; c < sensor.channels.size(); ++c) {
      double sum = 0.0;
      for (std::size_t q = 0; q < K.size(); ++q) sum += rows[c * K.size() + q] * K[q];
      one.value.push_back(sum);
      one.sd.push_back(1.0);
    }
  }
  return out;
}

double value_of(const Fit& fit, std::size_t c) {
  return fit.coefficients[c] ? fit.coefficients[c]->value : std::nan("");
}

/// By how many of its standard errors an estimate is off.
double off(const Fit& fit, std::size_t c) {
  const auto K = force::coefficients(force::Law{steel()});
  return (fit.coefficients[c]->value - K[c]) / fit.coefficients[c]->se;
}

TEST(ChannelFit, ReadsARotatingDynamometer) {  // [I-27] [I-28]
  force::Setup setup = slot_setup(3, 30.0, 3.0 * unit::mm);
  setup.runout.radial_offsets = {0.0, 9.0 * unit::um, -6.0 * unit::um};
  force::Sensor sensor =
      sensor_of({ChannelAxis::u, ChannelAxis::v, ChannelAxis::z, ChannelAxis::torque});
  sensor.angle = 25.0 * unit::deg;
  const std::vector<ChannelData> data{
      made_data(setup, sensor, {.phase = 2.1, .per_turn = 180, .turns = 2}, 0.01)};
  setup.runout = {};
  const Fit fit = fit_channels(setup, steel(), sensor, data,
                               {.runout = RunoutUnknowns::offsets, .absolute = true});
  ASSERT_TRUE(fit.ok);
  for (std::size_t c = 0; c < 6; ++c) EXPECT_LT(std::abs(off(fit, c)), 4.0) << c;
  EXPECT_NEAR(fit.phase[0], 2.1, 4 * *fit.phase_se[0]);
  EXPECT_NEAR(fit.runout.radial_offsets[1], 9e-6, 4 * *fit.radial_offsets_se[1]);
  EXPECT_NEAR(fit.runout.radial_offsets[2], -6e-6, 4 * *fit.radial_offsets_se[2]);
  EXPECT_NEAR(fit.channels->weighted_rss / (4.0 * 360), 1.0, 0.2);
  EXPECT_EQ(fit.rank, 6);
}

/// Of a sensor whose angle is not known the torque tells the tangential from the radial force.
TEST(ChannelFit, FindsTheAngleOfTheSensor) {  // [I-27]
  force::Setup setup = slot_setup(2, 30.0, 3.0 * unit::mm);
  setup.runout.radial_offsets = {0.0, -9.0 * unit::um};
  force::Sensor sensor =
      sensor_of({ChannelAxis::u, ChannelAxis::v, ChannelAxis::z, ChannelAxis::torque});
  sensor.angle = -65.0 * unit::deg;
  const std::vector<ChannelData> data{
      made_data(setup, sensor, {.phase = 0.4, .per_turn = 180}, 0.01)};
  sensor.angle = 0.0;
  const Fit fit = fit_channels(
      setup, steel(), sensor, data,
      {.runout = RunoutUnknowns::offsets, .sensor_free = true, .absolute = true});
  ASSERT_TRUE(fit.ok && fit.channels->sensor_se);
  EXPECT_NEAR(fit.channels->sensor_angle, -65.0 * unit::deg,
              4 * *fit.channels->sensor_se);
  for (std::size_t c = 0; c < 6; ++c) EXPECT_LT(std::abs(off(fit, c)), 4.0) << c;
}

/// What one standard error of an offset does to a coefficient is in its interval.
TEST(ChannelFit, CountsTheErrorOfOffsetsThatWereTakenOut) {  // [I-24] [I-28]
  force::Setup setup = slot_setup(3, 30.0, 3.0 * unit::mm);
  setup.runout.radial_offsets = {0.0, 9.0 * unit::um, -6.0 * unit::um};
  const force::Sensor sensor =
      sensor_of({ChannelAxis::u, ChannelAxis::v, ChannelAxis::z, ChannelAxis::torque});
  const ChannelData data =
      made_data(setup, sensor, {.phase = 2.1, .per_turn = 180}, 0.01);
  const auto fitted = [&](const ChannelData& one) {
    return fit_channels(setup, steel(), sensor, std::vector{one},
                        {.runout = RunoutUnknowns::offsets, .phase = 2.1});
  };
  const Fit exact = fitted(data);
  ChannelData read = data;
  read.offset_se = {0.0, 0.0, 1e-3 * data.sd[2], 0.0};
  const Fit known = fitted(read);
  for (double& se : read.offset_se) se *= 1e3;
  const Fit wide = fitted(read);
  ChannelData moved = data;
  for (std::size_t i = 2; i < moved.value.size(); i += 4) {
    moved.value[i] += read.offset_se[2];
  }
  const Fit off_by_one = fitted(moved);
  for (std::size_t c = 0; c < 6; ++c) {
    const double by = value_of(off_by_one, c) - value_of(exact, c);
    const double se = exact.coefficients[c]->se;
    EXPECT_NEAR(known.coefficients[c]->se, se, 1e-3 * se) << c;
    EXPECT_NEAR(wide.coefficients[c]->se, std::hypot(se, by),
                0.02 * std::hypot(se, by));
  }
  EXPECT_GT(wide.coefficients[2]->se, 2 * exact.coefficients[2]->se);
}

/// Four teeth half a turn later read the same with all coefficients turned: the spindle drives.
TEST(ChannelFit, TakesTheReadingThatTheSpindleDrives) {  // [I-27]
  force::Setup setup = slot_setup(4, 30.0, 3.0 * unit::mm);
  setup.chip.model = chip::Model::none;  // nothing but the signs tells them apart
  force::Sensor sensor = sensor_of({ChannelAxis::u, ChannelAxis::v, ChannelAxis::z});
  sensor.angle = 0.35;
  for (const double phase : {-2.0, -0.4, 0.9, 2.5}) {
    const std::vector<ChannelData> data{
        made_data(setup, sensor, {.phase = phase, .per_turn = 120}, 0.01)};
    const Fit fit =
        fit_channels(setup, steel(), sensor, data, {.chip_model = chip::Model::none});
    for (std::size_t c = 0; c < 3; ++c) EXPECT_LT(std::abs(off(fit, c)), 4.5) << phase;
  }
}

TEST(ChannelFit, TellsAxialOffsetsFromRadialOnesByACorner) {  // [I-27] [G-21]
  force::Setup setup = slot_setup(2, 30.0, 3.0 * unit::mm);
  setup.cutter.profile = geometry::bull_nose(8.0 * unit::mm, 2.0 * unit::mm);
  setup.runout.radial_offsets = {0.0, -6.0 * unit::um};
  setup.runout.axial_offsets = {0.0, 8.0 * unit::um};
  const auto sensor = sensor_of({ChannelAxis::x, ChannelAxis::y, ChannelAxis::z});
  const std::vector<ChannelData> data{
      made_data(setup, sensor, {.phase = 0.0, .per_turn = 72}, 0.003)};
  setup.runout = {};
  const Fit fit = fit_channels(setup, steel(), sensor, data,
                               {.runout = RunoutUnknowns::offsets,
                                .axial_offsets = true,
                                .phase = 0.0,
                                .absolute = true});
  ASSERT_TRUE(fit.ok && fit.radial_offsets_se[1] && fit.channels->axial_offsets_se[1]);
  EXPECT_NEAR(fit.runout.radial_offsets[1], -6e-6, 4 * *fit.radial_offsets_se[1]);
  EXPECT_NEAR(fit.runout.axial_offsets[1], 8e-6,
              4 * *fit.channels->axial_offsets_se[1]);
}

/// Smallest angle to the rest, and largest error, of the axial offsets of a cutter.
std::pair<double, double> told_of_axial(const geometry::Profile& profile) {
  force::Setup setup = slot_setup(3, 30.0, 3.0 * unit::mm);
  setup.cutter.profile = profile;
  setup.cutter.lag_diameter = profile.D;
  setup.runout.radial_offsets = {0.0, 3.0 * unit::um, -2.0 * unit::um};
  const auto sensor = sensor_of({ChannelAxis::x, ChannelAxis::y, ChannelAxis::z});
  const std::vector<ChannelData> data{
      made_data(setup, sensor, {.per_turn = 180}, 0.01)};
  const auto all = further_unknowns(setup, steel(), sensor, data,
                                    {.runout = RunoutUnknowns::offsets,
                                     .axial_offsets = true,
                                     .phase = 0.0,
                                     .absolute = true});
  std::pair<double, double> out{pi, 0.0};
  for (const FurtherUnknown& one : all) {
    if (one.unknown.kind != FoundKind::axial_offset) continue;
    out.first = std::min(out.first, one.angle);
    out.second = std::max(out.second, one.se);
  }
  return out;
}

/// A corner in cut with the flank tells axial offsets; a face mill's one lead angle does not,
/// and on a cylinder the lowest layer alone feels them.
TEST(ChannelFit, KnowsWhichCuttersTellAxialOffsets) {  // [I-29]
  const auto [corner, corner_se] =
      told_of_axial(geometry::bull_nose(8.0 * unit::mm, 2.0 * unit::mm));
  EXPECT_GT(corner, 10.0 * unit::deg);
  EXPECT_LT(corner_se, 4.0 * unit::um);
  geometry::Profile face = geometry::cylinder(8.0 * unit::mm);
  face.beta = 45.0 * unit::deg;
  EXPECT_LT(told_of_axial(face).first, 10.0 * unit::deg);
  EXPECT_GT(told_of_axial(geometry::cylinder(8.0 * unit::mm)).second, 4.0 * unit::um);
}

TEST(ChannelFit, OfMeansAtFiveFeedsTellsAll) {  // [I-27] [F-31]
  const force::Setup setup = slot_setup(4, 30.0, 2.0 * unit::mm);
  const auto sensor = sensor_of({ChannelAxis::x, ChannelAxis::y, ChannelAxis::z});
  const auto data = made_means(setup, sensor, {40e-6, 60e-6, 80e-6, 100e-6, 120e-6});
  const Fit fit = fit_channels(setup, steel(), sensor, data, {});
  ASSERT_TRUE(fit.ok);
  const auto K = force::coefficients(force::Law{steel()});
  for (std::size_t c = 0; c < 6; ++c) EXPECT_NEAR(value_of(fit, c), K[c], 1e-6 * K[c]);
  EXPECT_TRUE(fit.channels->combinations.empty());
}

/// Of a slot at one feed K_tc + c K_te is known, c = 4/(pi f_z cos(helix)).
TEST(ChannelFit, OfAMeanAtOneFeedTellsSums) {  // [I-26]
  force::Setup setup = slot_setup(4, 30.0, 2.0 * unit::mm);
  setup.chip.model = chip::Model::none;
  const auto sensor = sensor_of({ChannelAxis::x, ChannelAxis::y, ChannelAxis::z});
  const double f_z = 80e-6;
  const auto data = made_means(setup, sensor, {f_z});
  const Fit fit = fit_channels(setup, steel(), sensor, data,
                               {.chip_model = chip::Model::none, .absolute = true});
  EXPECT_FALSE(fit.ok);
  ASSERT_EQ(fit.channels->combinations.size(), 3U);
  const KnownSum& sum = fit.channels->combinations[0];
  const double c = 4.0 / (pi * f_z * std::cos(30.0 * unit::deg));
  EXPECT_DOUBLE_EQ(sum.weights[0], 1.0);
  EXPECT_NEAR(sum.weights[3], c, 1e-6 * c);
  EXPECT_NEAR(sum.value, steel().K_tc + c * steel().K_te, 1e-3 * steel().K_tc);
}

/// Torque tells nothing of radial and axial forces: they keep their prior.
TEST(ChannelFit, LeavesThePriorOfWhatIsNotTold) {  // [I-27]
  const force::Setup setup = slot_setup(2, 30.0, 3.0 * unit::mm);
  const auto sensor = sensor_of({ChannelAxis::torque});
  const std::vector<ChannelData> data{
      made_data(setup, sensor, {.per_turn = 180}, 0.02)};
  ChannelRequest request{.phase = 0.0, .absolute = true};
  const auto K = force::coefficients(force::Law{steel()});
  for (const double k : K) request.prior.push_back(Normal{0.9 * k, 0.2 * k});
  const Fit fit = fit_channels(setup, steel(), sensor, data, request);
  ASSERT_TRUE(fit.ok);
  EXPECT_EQ(fit.rank, 2);
  EXPECT_EQ(fit.channels->rank_with_prior, 6);
  for (const std::size_t c : {1U, 2U, 4U, 5U}) {
    EXPECT_NEAR(fit.coefficients[c]->value, 0.9 * K[c], 1e-9 * K[c]);
    EXPECT_NEAR(fit.coefficients[c]->se, 0.2 * K[c], 1e-9 * K[c]);
    EXPECT_FALSE(fit.channels->data_alone[c]);
  }
  EXPECT_LT(fit.coefficients[0]->se, fit.channels->data_alone[0]->se);
}

/// A constant and a slope of each channel change nothing where they are found.
TEST(ChannelFit, FindsOffsetsOfChannels) {  // [I-7]
  const force::Setup setup = slot_setup(2, 30.0, 3.0 * unit::mm);
  const auto sensor = sensor_of({ChannelAxis::u, ChannelAxis::v, ChannelAxis::torque});
  std::vector<ChannelData> data{
      made_data(setup, sensor, {.per_turn = 120, .turns = 6}, 0.01)};
  const ChannelRequest request{
      .phase = 0.0, .fit_channel_offsets = true, .absolute = true};
  const Fit before = fit_channels(setup, steel(), sensor, data, request);
  for (std::size_t i = 0; i < data[0].value.size(); ++i) {
    data[0].value[i] += 30.0 + 0.01 * static_cast<double>(i / 3);
  }
  const Fit after = fit_channels(setup, steel(), sensor, data, request);
  for (const std::size_t c : {0U, 1U, 3U, 4U}) {
    EXPECT_NEAR(value_of(after, c), value_of(before, c), 1e-8 * value_of(before, c));
    EXPECT_LT(std::abs(off(after, c)), 4.0) << c;
  }
}

/// Long records are folded onto a turn, and answer as they are.
TEST(ChannelFit, OfALongRecordIsAsExactAsItsSamples) {  // [I-28]
  force::Setup setup = slot_setup(2, 30.0, 3.0 * unit::mm);
  const auto sensor = sensor_of({ChannelAxis::u, ChannelAxis::v, ChannelAxis::torque});
  std::vector<ChannelData> data{
      made_data(setup, sensor, {.per_turn = 101, .turns = 60}, 0.05)};
  for (double& angle : data[0].angle) angle *= 1.0 + 1e-15;
  const Fit fit =
      fit_channels(setup, steel(), sensor, data, {.phase = 0.0, .absolute = true});
  for (const std::size_t c : {0U, 1U, 3U, 4U})
    EXPECT_LT(std::abs(off(fit, c)), 4.0) << c;
  EXPECT_NEAR(fit.channels->weighted_rss / static_cast<double>(data[0].value.size()),
              1.0, 0.05);
}

}  // namespace trochoid::identification::channel_fit_test
