#include <trochoid/chip/harmonic_pieces.h>

#include <trochoid/chip/harmonics.h>

#include "made_slice.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace trochoid::chip::harmonics_test {

using numerics::evaluate;

constexpr double tolerance = 1e-15;  // [m]

/// Whether the feed is so small that the series must end within its 20 harmonics.
bool small_feed(const MadeSlice& made) {
  double R = made.cutter.profile.D;
  for (const geometry::EdgePosition& tooth : made.teeth) R = std::min(R, tooth.R);
  return made.passage().feed < 0.02 * R;
}

double value(const numerics::TrigPolynomial& p, double x) {
  return evaluate(p, std::sin(x), std::cos(x)).value;
}

/// Slots, up and down milling of any width, and bands that lie anywhere.
geometry::Engagement random_engagement(std::mt19937& random, double D) {
  const auto between = [&](double a, double b) {
    return std::uniform_real_distribution<double>(a, b)(random);
  };
  switch (std::uniform_int_distribution<int>(0, 3)(random)) {
    case 0:
      return geometry::Slot{};
    case 1:
      return geometry::UpMilling{D * std::pow(10.0, between(-3, 0))};
    case 2:
      return geometry::DownMilling{D * std::pow(10.0, between(-3, 0))};
    default: {
      const double y = between(-0.6, 0.5) * D;
      return geometry::Band{y, y + between(0.01, 0.8) * D};
    }
  }
}

/// [C-9] [C-10]
TEST(Harmonics, AreTheChipOverAMark) {
  std::mt19937 random(7);
  for (int i = 0; i < 300; ++i) {
    MadeSlice made = random_slice(random, 20e-6 + 1e-6 * i);
    for (const Model model :
         {Model::none, Model::feed, Model::radial, Model::trochoidal}) {
      made.model.model = model;
      const Passage passage = made.passage();
      for (int mark = 1; mark <= passage.marks; ++mark) {
        const int tooth = i % passage.teeth;
        const auto p =
            harmonics_over_mark(passage, made.slice(), tooth, mark, tolerance);
        if (!p && !small_feed(made)) {
          continue;
        }
        ASSERT_TRUE(p.has_value());
        const double epsilon = made.teeth[static_cast<std::size_t>(tooth)].epsilon;
        for (const double theta : steps(0.01, pi, 0.3)) {
          EXPECT_NEAR(value(*p, theta + epsilon),
                      chip_over_mark(passage, made.slice(), tooth, theta, mark), 1e-14);
        }
      }
    }
  }
}

TEST(Harmonics, LieWithinTheirEstimates) {  // [C-10]
  std::mt19937 random(8);
  for (int i = 0; i < 600; ++i) {
    MadeSlice made = random_slice(random, 1e-6 * (1 + i));
    const Passage passage = made.passage();
    for (int mark = 1; mark <= passage.marks; ++mark) {
      const int tooth = i % passage.teeth;
      const auto p = harmonics_over_mark(passage, made.slice(), tooth, mark, 1e-12);
      if (!p) continue;
      const MarkEstimate e = estimate_over_mark(passage, made.slice(), tooth, mark);
      for (const double theta : steps(-3.1, pi, 0.07)) {
        const double u = std::sin(theta);
        const double middle = e.mean + e.sine * u + e.square * (1 - u * u);
        EXPECT_LE(std::abs(value(*p, theta) - middle),
                  e.skew * std::abs(u) + e.rest + 2e-12);
      }
    }
  }
}

TEST(Harmonics, AreRefusedWhereTheFeedIsNotSmall) {
  const MadeSlice made = made_slice(1e-3, 2, 0.4e-3);
  EXPECT_FALSE(harmonics_over_mark(made.passage(), made.slice(), 0, 1, 1e-15));
}

struct Found {
  double h = 0.0;
  bool cuts = false;
};

/// What the pieces say of an angle that is no closer than 1e-8 to any of their ends.
Found found(const ToothHarmonics& tooth, double theta) {
  for (const HarmonicPiece& piece : tooth.pieces) {
    const double turns = std::floor((theta - piece.from) / unit::turn);
    const double x = theta - turns * unit::turn;
    if (x < piece.to) {
      const auto& p = *tooth.over_mark[static_cast<std::size_t>(piece.mark - 1)];
      return {piece.at_stock_edge ? NAN : value(p, x), true};
    }
  }
  return {};
}

/// Every chip model, engagement, runout of several feeds, unequal pitch.
TEST(HarmonicPieces, AreWhereTheChipSaysSo) {
  std::mt19937 random(3);
  int at_stock_edge = 0;
  int compared = 0;
  for (int i = 0; i < 1500; ++i) {
    MadeSlice made = random_slice(random, 5e-6 * (1 + i % 40));
    made.cut.engagement = random_engagement(random, made.cutter.profile.D);
    made.model.model = static_cast<Model>(i % 4);
    made.model.lookback = i % 3 == 0 ? Lookback::previous : Lookback::all;
    const Passage passage = made.passage();
    const Slice slice = made.slice();
    const int tooth = i % passage.teeth;
    const auto harmonics = tooth_harmonics(passage, slice, tooth, tolerance);
    if (!harmonics && !small_feed(made)) {
      continue;
    }
    ASSERT_TRUE(harmonics.has_value());
    const double epsilon = made.teeth[static_cast<std::size_t>(tooth)].epsilon;
    std::vector<double> angles = steps(-pi / 2 + 1e-3, 3 * pi / 2, 0.02);
    for (const HarmonicPiece& piece : harmonics->pieces) {
      EXPECT_LT(piece.from, piece.to);
      for (const double end : {piece.from, piece.to}) {
        angles.push_back(end - 1e-7);
        angles.push_back(end + 1e-7);
      }
    }
    for (const double theta : angles) {
      const Chip chip = chip_at(passage, slice, tooth, theta - epsilon);
      const Found f = found(*harmonics, theta);
      if (f.cuts != chip.in_cut) {
        // Stretches in which hardly anything is cut may be missed.
        EXPECT_LT(chip.h, 2e-13) << i << " at " << theta;
        EXPECT_GT(chip.margin, -2e-13) << i << " at " << theta;
        continue;
      }
      ++compared;
      if (std::isnan(f.h)) {
        ++at_stock_edge;
      } else {
        EXPECT_NEAR(f.h, chip.h, 1e-13) << i << " at " << theta;
      }
    }
  }
  EXPECT_GT(compared, 100000);
  EXPECT_GT(at_stock_edge, 100);
}

}  // namespace trochoid::chip::harmonics_test
