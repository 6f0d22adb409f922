// What a plan promises is what measuring then finds.
#include <trochoid/identification/plan.h>

#include "../unit/identification/made_record.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace trochoid::identification {
namespace {

constexpr int seeds = 100;
/// The scatter of 100 values is known to 7 %; three times that.
constexpr double sampling_error = 0.21;

struct Scatter {
  double sum = 0.0;
  double squares = 0.0;

  void add(double value) {
    sum += value;
    squares += value * value;
  }
  [[nodiscard]] double value() const {
    return std::sqrt((squares - sum * sum / seeds) / (seeds - 1));
  }
};

/// A short record of two flutes at one feed, and a cut that may be measured next.
class NextCut : public testing::Test {
 protected:
  void SetUp() override {
    setup = slot_setup(2, 30.0, 2.0 * unit::mm);
    setup.cut.engagement = geometry::DownMilling{2.0 * unit::mm};
    setup.runout.radial_offsets = {0.0, -8.0 * unit::um};
    next = setup;
    next.cut.engagement = geometry::UpMilling{4.0 * unit::mm};
    next.cut.f_z = 80e-6;
  }

  [[nodiscard]] Record record(const force::Setup& of, double turns, int seed) const {
    return made_record(of, steel(),
                       {.phase = 0.4,
                        .per_turn = 90,
                        .turns = turns,
                        .noise = noise,
                        .seed = static_cast<unsigned>(seed)});
  }

  [[nodiscard]] Trial trial(const force::Setup& of, double turns) const {
    return {.setup = of,
            .law = steel(),
            .options = {},
            .samples_per_turn = 90,
            .turns = turns,
            .noise = noise};
  }

  /// The scatter of the fits over the standard errors that the information promises.
  void expect_promised(const Information& known,
                       const std::function<std::vector<Record>(int)>& measured) const {
    std::vector<Scatter> scatter(known.size);
    for (int seed = 0; seed < seeds; ++seed) {
      const Fit fit =
          identify(without_runout(setup), steel(), measured(seed), Options{});
      ASSERT_TRUE(fit.ok) << fit.message;
      for (std::size_t c = 0; c < 6; ++c) scatter[c].add(fit.coefficients[c]->value);
      scatter[6].add(fit.runout.radial_offsets[1]);
    }
    for (std::size_t i = 0; i < known.size; ++i) {
      EXPECT_NEAR(scatter[i].value() / *standard_error(known, i), 1.0, sampling_error)
          << i;
    }
  }

  force::Setup setup;
  force::Setup next;
  double noise = 10.0;
};

TEST_F(NextCut, AloneKeepsItsPromise) {  // [I-20]
  expect_promised(information_of(trial(next, 4.0)), [&](int seed) {
    return std::vector<Record>{record(next, 4.0, 100 + seed)};
  });
}

TEST_F(NextCut, KeepsItsPromiseWithWhatWasMeasuredBefore) {  // [I-20]
  const std::vector<Record> before = {record(setup, 2.0, 7)};
  const Fit fit = identify(without_runout(setup), steel(), before, {});
  ASSERT_TRUE(fit.ok) << fit.message;
  Trial found = trial(next, 4.0);
  found.setup.runout = fit.runout;
  found.law = fit.law;
  found.noise = effective_noise(fit, before);
  const Information then =
      sum(information_of(without_runout(setup), steel(), before, fit, 0),
          information_of(found));
  // Both are scattered: the first record as well is one of many that might have been.
  expect_promised(then, [&](int seed) {
    return std::vector<Record>{record(setup, 2.0, 1000 + seed),
                               record(next, 4.0, 100 + seed)};
  });
}

}  // namespace
}  // namespace trochoid::identification
