#include "../unit/surface/made_readings.h"

#include <trochoid/surface/fit_nominal.h>

#include <gtest/gtest.h>

/// Laws of a machined wall and of its calibration, over cuts and runouts of all kinds.
namespace trochoid::surface {
namespace {

constexpr Coefficients K = {200e6, 130e6, 0.0, 0.0};  // the wall bends by 40 um
constexpr double h_mid = 0.5e-3;
constexpr double lambda = 71 * unit::deg;

/// Errors at one height from single values of the force, no tables between.
class Errors {
 public:
  Errors(const MadeCut& s, double height, Coefficients with, force::Law law = {})
      : cut_(s),
        compliance_(cutter_only()(0.0), s.cut.a_p, 0.0, Load::distributed),
        edges_(s, law, compliance_.basis()),
        row_(compliance_.rows(std::array{height})),
        tips_(edge_places(s, 0.0)),
        places_(edge_places(s, height)),
        K_(with) {}

  [[nodiscard]] double delta(double phi) const {
    std::vector<double> m(columns * edges_.values());
    edges_.at(phi, nullptr, m);
    double sum = 0.0;
    for (std::size_t c = 0; c < columns; ++c) {
      for (std::size_t q = 0; q < row_.size(); ++q) {
        sum += K_[c] * row_[q] * m[c * edges_.values() + q];
      }
    }
    return side_of(cut_.cut.engagement)->sigma * sum;
  }

  /// Error of [wang2015] eq. 10 at a place in the tooth feed [0, 1), mean over turns.
  [[nodiscard]] double quasi_static(double place) const {
    const int teeth = cut_.cutter.teeth();
    double sum = 0.0;
    for (int g = 0; g < teeth; ++g) {
      const double phi = 2 * pi * (g + place) / teeth;
      const std::size_t owner = last_entered(tips_, entry_angle(cut_), phi);
      sum += delta(phi) - (places_[owner].R - cut_.cutter.profile.D / 2);
    }
    return sum / teeth;
  }

  [[nodiscard]] double imprint() const {
    double sum = 0.0;
    for (const EdgePlace& tooth : places_) {
      sum += delta(side_of(cut_.cut.engagement)->theta + tooth.behind) -
             (tooth.R - cut_.cutter.profile.D / 2);
    }
    return sum / static_cast<double>(places_.size());
  }

 private:
  MadeCut cut_;
  Compliance compliance_;
  EdgeMoments edges_;
  std::vector<double> row_;
  std::vector<EdgePlace> tips_;
  std::vector<EdgePlace> places_;
  Coefficients K_;
};

MadeCut without_runout(MadeCut s) {
  s.runout = {};
  return s;
}

struct Change {
  double largest = 0.0;  ///< of the nominal error by runout [m]
  double peak = 0.0;     ///< of the nominal error [m]
};

/// What runout does to the mean over whole turns, anywhere in a tooth feed.
Change quasi_static_change(const MadeCut& s, force::Law law = {}) {
  Change change;
  for (const double h : {h_mid, 1.5e-3}) {
    const Errors with(s, h, K, law);
    const Errors without(without_runout(s), h, K, law);
    for (int k = 0; k < 12; ++k) {
      const double place = (k + 0.37) / 12;
      const double nominal = without.quasi_static(place);
      change.peak = std::max(change.peak, std::abs(nominal));
      change.largest =
          std::max(change.largest, std::abs(with.quasi_static(place) - nominal));
    }
  }
  return change;
}

std::vector<MadeCut> cuts_of_all_kinds() {
  std::vector<MadeCut> cuts = {made_cut(), made_cut(false), made_cut(true, 2),
                               made_cut(false, 4, 30.0), made_cut(true, 5, 20.0)};
  cuts.back().cut.engagement = geometry::DownMilling{7e-3};
  return cuts;
}

TEST(RunoutHasNoEffectOnTheAverage, OfPulses) {  // [E-11]
  for (const MadeCut& s : cuts_of_all_kinds()) {
    for (const double rho : {1e-6, 30e-6, 0.3e-3}) {  // at 0.3 mm some teeth miss
      const Change c = quasi_static_change(with_runout(s, rho, 1.2));
      ASSERT_GT(c.peak, 1e-6);
      EXPECT_LT(c.largest, 1e-12 * (c.peak + rho)) << rho;
    }
  }
}

TEST(RunoutHasNoEffectOnTheAverage, OfImprints) {  // [E-11]
  for (const MadeCut& s : cuts_of_all_kinds()) {
    for (const double rho : {1e-6, 30e-6, 0.3e-3}) {
      for (const double h : {0.2e-3, h_mid, 2.5e-3}) {
        const double with = Errors(with_runout(s, rho, 1.2), h, K).imprint();
        EXPECT_NEAR(with, Errors(s, h, K).imprint(), 1e-12 * (40e-6 + rho));
      }
    }
  }
}

TEST(RunoutHasNoEffectOnTheAverage, OfOffsetsThatAddUpToNothing) {  // [E-11]
  MadeCut s = made_cut();
  s.runout.radial_offsets = {9e-6, -13e-6, 4e-6};
  const Change c = quasi_static_change(s);
  EXPECT_LT(c.largest, 1e-12 * c.peak);
}

TEST(RunoutChangesTheAverage, OfOneTooth) {  // [E-11] by its radius
  const MadeCut s = with_runout(made_cut(true, 1), 5e-6, 0.3);
  const double lag = h_mid / 6e-3;
  const double bias =
      Errors(s, h_mid, K).imprint() - Errors(without_runout(s), h_mid, K).imprint();
  EXPECT_NEAR(bias, -5e-6 * std::cos(lag - 0.3), 1e-15);
}

TEST(RunoutChangesTheAverage, WhereTheToothBeforeAloneCounts) {  // [E-11] m = 1
  const std::array rho = {1e-6, 3e-6, 10e-6, 50e-6};
  const std::array um = {0.002, 0.017, 0.19, 4.7};
  for (std::size_t i = 0; i < rho.size(); ++i) {
    MadeCut s = with_runout(made_cut(), rho[i], lambda);
    s.chip.lookback = chip::Lookback::previous;
    EXPECT_NEAR(quasi_static_change(s).largest / unit::um, um[i], 0.25 * um[i]);
  }
}

TEST(RunoutChangesTheAverage, OfAPowerLaw) {  // [E-11]
  const force::Law power = force::Power{0, 0, 0, 0.3, 0.3, 0.0};
  const Change small =
      quasi_static_change(with_runout(made_cut(), 3e-6, lambda), power);
  const Change large =
      quasi_static_change(with_runout(made_cut(), 6e-6, lambda), power);
  EXPECT_GT(small.largest, 1e-5 * small.peak);
  EXPECT_NEAR(large.largest / small.largest, 4.0, 1.5);  // to second order
}

TEST(RunoutChangesTheAverage, OfTheExactChipByNextToNothing) {  // [E-11]
  // there the entry follows each tooth's radius
  MadeCut s = with_runout(made_cut(), 10e-6, lambda);
  s.chip.model = chip::Model::trochoidal;
  const Change c = quasi_static_change(s);
  EXPECT_GT(c.largest, 1e-9 * c.peak);
  EXPECT_LT(c.largest, 5e-3 * c.peak);
}

TEST(RunoutChangesTheAverage, WhereReadingsDoNotCoverWholeTurns) {  // [E-11]
  const MadeCut s = with_runout(made_cut(), 10e-6, lambda);
  const Errors with(s, h_mid, K);
  const Errors without(without_runout(s), h_mid, K);
  double two = 0.0;  // of three teeth
  for (const double phi : {2.9, 2.9 + 2 * pi / 3}) {
    two += 0.5 * (with.delta(phi) - without.delta(phi));
  }
  EXPECT_GT(std::abs(two), 0.1e-6);
}

double mean_of(const MadeCut& s, Coefficients with) {
  return mean_envelope(height_cut(made_setting(Model::envelope, s), with, h_mid), 720);
}

TEST(RunoutChangesTheAverage, OfARealSurface) {  // [E-9] [E-11]
  const std::array rho = {1e-6, 3e-6, 10e-6, 50e-6};
  const std::array rigid_um = {-0.11, -0.93, -4.5, -27.0};
  const std::array elastic_um = {-0.05, -0.45, -4.4, -32.0};
  const double straight = mean_of(made_cut(), {});
  const double bent = mean_of(made_cut(), K);
  for (std::size_t i = 0; i < rho.size(); ++i) {
    const MadeCut s = with_runout(made_cut(), rho[i], lambda);
    EXPECT_NEAR((mean_of(s, {}) - straight) / unit::um, rigid_um[i],
                0.005 - 0.03 * rigid_um[i]);
    EXPECT_NEAR((mean_of(s, K) - bent) / unit::um, elastic_um[i],
                0.005 - 0.03 * elastic_um[i]);
  }
}

TEST(RunoutChangesTheAverage, OfARigidSurfaceByTheFormula) {  // [E-9] [E-11]
  // -R_e rho^2 sin^2(pi/N)/f_z^2 while rho < f_z^2/(4 R_e sin^2(pi/N)), N >= 3
  for (const bool down : {true, false}) {
    for (const int teeth : {3, 4, 6}) {
      const MadeCut s = made_cut(down, teeth);
      const double f = s.cut.f_z;
      const double sigma = down ? 1.0 : -1.0;
      const double r = 6e-3 - sigma * teeth * f / (2 * pi);
      const double R_e = r * r / 6e-3;
      const double sine = std::sin(pi / teeth);
      const double limit = f * f / (4 * R_e * sine * sine);
      const double rho = 0.4 * limit;
      double bias = -mean_of(s, {});
      for (const double angle : {0.0, 0.35, 0.7, 1.05}) {
        bias += 0.25 * mean_of(with_runout(s, rho, angle), {});
      }
      const double formula = -R_e * rho * rho * sine * sine / (f * f);
      EXPECT_NEAR(bias / formula, 1.0, 0.03) << down << teeth;
    }
  }
}

TEST(RunoutChangesTheAverage, OfARealSurfaceInProportionWhereItIsLarge) {  // [E-9]
  const double straight = mean_of(made_cut(), {});
  const auto bias = [&](double rho) {
    return mean_of(with_runout(made_cut(), rho, lambda), {}) - straight;
  };
  const double slope = (bias(80e-6) - bias(60e-6)) / 20e-6;
  EXPECT_NEAR(slope, -std::cos(2 * pi / 3 - lambda + h_mid / 6e-3), 1e-3);
}

TEST(RunoutChangesTheAverage, SlightlyWhereTheDeflectionMovesTheEntry) {  // [E-10]
  // 0.002 um at 3 um, 0.2 um at 30 um
  const Compliance compliance(cutter_only()(0.0), 3e-3, 0.0, Load::distributed);
  const auto row = compliance.rows(std::array{h_mid});
  const auto nominal = [&](const MadeCut& s) {
    const EdgeMoments edges(s, law(0, 0), compliance.basis());
    const auto turn = steady_state(edges, K, compliance, Feedback::entry, 1e-7);
    EXPECT_TRUE(turn.converged);
    const auto delta = deflection(turn.moments, row, 1.0);
    std::vector<double> mean;
    for (int k = 0; k < 20; ++k) {
      mean.push_back(0.0);
      for (int g = 0; g < 3; ++g) {
        mean.back() += value_at(delta, 2 * pi / 3 * (g + (k + 0.37) / 20)) / 3;
      }
    }
    return mean;
  };
  const auto straight = nominal(made_cut());
  const auto change = [&](double rho) {
    const auto with = nominal(with_runout(made_cut(), rho, lambda));
    double largest = 0.0;
    for (std::size_t k = 0; k < with.size(); ++k) {
      largest = std::max(largest, std::abs(with[k] - straight[k]));
    }
    return largest / unit::um;
  };
  const double small = change(3e-6);
  const double large = change(30e-6);
  EXPECT_GT(small, 0.0005);
  EXPECT_LT(small, 0.004);
  EXPECT_NEAR(large / small, 100.0, 30.0);
}

struct Drawn {
  MadeCut cut;
  Coefficients K{};
  Setting setting(Model model) const { return made_setting(model, cut); }
};

/// A cut that is neither thin nor slotted, and a material.
Drawn draw(unsigned seed) {
  std::mt19937 random(seed);
  const auto between = [&](double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(random);
  };
  const int teeth = 1 + static_cast<int>(seed % 5);
  Drawn out{made_cut(seed % 2 == 0, teeth, between(25.0, 50.0))};
  out.cut.cut.a_p = between(2.5e-3, 5e-3);
  out.cut.cut.f_z = between(0.05e-3, 0.2e-3);
  const double a_e = between(0.5e-3, 3e-3);
  if (seed % 2 == 0) {
    out.cut.cut.engagement = geometry::DownMilling{a_e};
  } else {
    out.cut.cut.engagement = geometry::UpMilling{a_e};
  }
  out.K = {between(200e6, 900e6), between(80e6, 400e6), 0.0, 0.0};
  return out;
}

class RoundTrip : public testing::TestWithParam<unsigned> {};

TEST_P(RoundTrip, CalibrateInvertsSurface) {  // [E-15] [E-16] [E-17]
  const Drawn drawn = draw(GetParam());
  for (const Model model : {Model::quasi_static, Model::imprint, Model::envelope}) {
    const Setting s = drawn.setting(model);
    const Measured at{.heights = made_heights(5, s.setup.cut.a_p), .per_tooth = 12};
    const auto readings = model == Model::quasi_static ? pulses(s, drawn.K, at)
                          : model == Model::imprint    ? imprints(s, drawn.K, at)
                                                       : profiles(s, drawn.K, at);
    const CoefficientFit a = chosen_fit(fitted(s, readings));
    ASSERT_TRUE(a.ok) << a.message << GetParam() << static_cast<int>(model);
    // an envelope is averaged over other points than those measured
    const double allowed = model == Model::envelope ? 2e-2 : 1e-4;
    EXPECT_NEAR(a.K_tc.value, drawn.K[0], allowed * drawn.K[0]) << GetParam();
    EXPECT_NEAR(a.K_rc.value, drawn.K[1], allowed * drawn.K[1]) << GetParam();
  }
}

INSTANTIATE_TEST_SUITE_P(FixedSeeds, RoundTrip, testing::Range(0U, 10U));

TEST(Derivative, IsTheDifferenceQuotient) {  // [E-15] [E-16]
  for (const unsigned seed : {0U, 2U, 3U, 4U}) {
    const Drawn drawn = draw(seed);
    for (const Model model : {Model::quasi_static, Model::imprint, Model::envelope}) {
      std::vector<Nominal> rows;
      for (const double h : made_heights(3, drawn.cut.cut.a_p)) {
        rows.push_back({.travel = 0.03e-3, .height = h, .readings = {0}});
      }
      const NominalModel predicted(drawn.setting(model), rows);
      const Prediction at = predicted.rigid(drawn.K);
      for (std::size_t c = 0; c < columns; ++c) {
        Coefficients more = drawn.K;
        Coefficients less = drawn.K;
        const double step = c < 2 ? 1e6 : 100.0;
        more[c] += step;
        less[c] -= step;
        const auto above = predicted.rigid(more).error;
        const auto below = predicted.rigid(less).error;
        double size = 0.0;
        for (std::size_t i = 0; i < rows.size(); ++i) {
          size = std::max(size, std::abs(at.per_K[i * columns + c]));
        }
        for (std::size_t i = 0; i < rows.size(); ++i) {
          EXPECT_NEAR(at.per_K[i * columns + c], (above[i] - below[i]) / (2 * step),
                      2e-3 * size);
        }
      }
    }
  }
}

/// How often the intervals hold the truth, and the scatter over the standard error.
struct Coverage {
  std::array<int, 2> held{};
  std::array<double, 2> variance{};  ///< of the estimates
  std::array<double, 2> stated{};    ///< mean of se^2
  int runs = 0;

  void add(const CoefficientFit& a, Coefficients truth) {
    ASSERT_TRUE(a.ok) << a.message;
    const std::array estimates = {a.K_tc, a.K_rc};
    for (std::size_t c = 0; c < 2; ++c) {
      const Estimate& e = estimates[c];
      held[c] += e.low < truth[c] && truth[c] < e.high ? 1 : 0;
      variance[c] += (e.value - truth[c]) * (e.value - truth[c]);
      stated[c] += e.se * e.se;
    }
    ++runs;
  }

  /// @param bias  of the scatter by the curvature of a model, as a part of it
  void expect_good(double bias = 0.0) const {
    // three standard deviations of a binomial, and of a chi square
    const double n = runs;
    const double reach = 3 * std::sqrt(0.95 * 0.05 / n);
    for (std::size_t c = 0; c < 2; ++c) {
      EXPECT_NEAR(held[c] / n, 0.95, reach + bias) << c;
      EXPECT_NEAR(variance[c] / stated[c], 1.0, 3 * std::sqrt(2 / n) + bias) << c;
    }
  }
};

constexpr Coefficients truth = {800e6, 300e6, 0.0, 0.0};

TEST(Intervals, HoldTheTruthOfALinearFitAsOftenAsTheySay) {  // [E-15]
  // imprints of a thin wall at seven heights, uneven numbers of readings, an offset
  const Setting s = made_setting(Model::imprint, made_cut(), with_wall());
  std::vector<Nominal> rows;
  std::vector<std::size_t> count = {1, 3, 2, 6, 1, 2, 4};
  for (const double h : made_heights(7)) {
    rows.push_back({.x = 30e-3, .height = h});
    rows.back().readings.resize(count[rows.size() - 1]);
  }
  const Prediction unit = NominalModel(s, rows).rigid(truth);
  const auto predict = [&](std::span<const double, columns> at) {
    Prediction p = unit;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      p.error[i] = at[0] * p.per_K[i * columns] + at[1] * p.per_K[i * columns + 1];
    }
    return p;
  };
  std::mt19937 random(20240);
  std::normal_distribution<double> noise(0.0, 1e-6);
  Coverage coverage;
  for (int run = 0; run < 600; ++run) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      rows[i].error = unit.error[i] + 5e-6 +
                      noise(random) / std::sqrt(static_cast<double>(count[i]));
    }
    const std::array datum = {Datum{.offset = true}};
    coverage.add(fit_nominal({rows, datum, {}}, predict), truth);
  }
  coverage.expect_good();
}

TEST(Intervals, HoldTheTruthOfARealProfileAsOftenAsTheySay) {  // [E-16]
  Setting s = made_setting(Model::envelope, made_cut(), with_wall());
  s.tolerance = 1e-4;
  std::vector<Nominal> rows;
  for (const double h : made_heights(6)) {
    rows.push_back({.x = 30e-3, .height = h, .readings = {0}});
  }
  const NominalModel model(s, rows);
  const auto clean = model.rigid(truth).error;
  std::mt19937 random(20241);
  std::normal_distribution<double> noise(0.0, 0.5e-6);
  Coverage coverage;
  for (int run = 0; run < 300; ++run) {
    for (std::size_t i = 0; i < rows.size(); ++i) {
      rows[i].error = clean[i] + noise(random);
    }
    const auto predict = [&](std::span<const double, columns> at) {
      return model.rigid(at);
    };
    const std::array datum = {Datum{}};
    coverage.add(fit_nominal({rows, datum, truth}, predict), truth);
  }
  coverage.expect_good(0.02);
}

TEST(Intervals, OfRunoutHoldTheTruth) {  // [E-17]
  const double rho = 5e-6;
  const double angle = 3.5;
  const Setting s = made_setting(Model::imprint, with_runout(made_cut(), rho, angle));
  const Setting blind = made_setting(Model::imprint);
  const auto clean = imprints(s, truth, {.heights = made_heights(4)});
  const ModelFits begin = fitted(blind, clean);
  int held = 0;
  double off = 0.0;
  double stated = 0.0;
  constexpr int runs = 40;
  for (unsigned seed = 0; seed < runs; ++seed) {
    auto readings = clean;
    add_noise(readings, 1e-6, 100 + seed);
    const RunoutFit r =
        find_runout(blind, readings, std::array{Datum{}}, fitted(blind, readings));
    ASSERT_TRUE(r.ok) << r.message;
    held += r.eccentricity.low < rho && rho < r.eccentricity.high ? 1 : 0;
    held += r.angle.low < angle && angle < r.angle.high ? 1 : 0;
    off += std::pow(r.eccentricity.value - rho, 2);
    stated += std::pow(r.eccentricity.se, 2);
  }
  EXPECT_GE(held, 80 * 0.95 - 3 * std::sqrt(80 * 0.95 * 0.05));
  EXPECT_NEAR(off / stated, 1.0, 3 * std::sqrt(2.0 / runs));
}

TEST(Intervals, AreTooLongWhereRunoutPassesForNoise) {  // [E-11] [E-15]
  // single imprints in place of means: three teeth at each height are no chance
  const Setting s = made_setting(Model::imprint, with_runout(made_cut(), 3e-6, lambda));
  const auto readings = imprints(s, truth, {.heights = made_heights(7)});
  std::vector<Nominal> rows;
  for (const Reading& r : readings) {
    rows.push_back({.height = r.height, .error = r.error, .readings = {0}});
  }
  const NominalModel model(made_setting(Model::imprint), rows);
  const auto predict = [&](std::span<const double, columns> at) {
    return model.rigid(at);
  };
  const std::array datum = {Datum{}};
  const CoefficientFit single = fit_nominal({rows, datum, {}}, predict);
  const CoefficientFit means =
      chosen_fit(fitted(made_setting(Model::imprint), readings));
  ASSERT_TRUE(single.ok && means.ok);
  EXPECT_NEAR(single.K_tc.value, truth[0], 1e-3 * truth[0]);
  EXPECT_GT(single.K_tc.se, 1000 * means.K_tc.se);
}

}  // namespace
}  // namespace trochoid::surface
