#include <trochoid/files/channel_starts.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace trochoid::files::channel_starts_test {

constexpr double rate = 1e4;

double signal_at(double t) {
  return 100.0 * std::sin(2.0 * std::numbers::pi * 300.0 * t) +
         20.0 * std::cos(2.0 * std::numbers::pi * 2500.0 * t) + 7.0;
}

/// Samples of one signal that begin at a time.
std::vector<double> samples(double start, std::size_t count) {
  std::vector<double> out;
  for (std::size_t i = 0; i < count; ++i) {
    out.push_back(signal_at(start + static_cast<double>(i) / rate));
  }
  return out;
}

/// What is left of three columns with these starts.
struct Three {
  std::array<std::vector<double>, 3> values;
  Starts starts;

  Three(const std::array<double, 3>& start, std::size_t count) {
    std::vector<StartedColumn> columns;
    const std::array names = {"Fx", "Fy", "Fz"};
    for (std::size_t i = 0; i < 3; ++i) {
      values[i] = samples(start[i], count);
      columns.push_back({names[i], start[i], &values[i]});
    }
    starts = align_starts(columns, rate);
  }

  /// Of any sample of any column from the signal.
  [[nodiscard]] double largest_error() const {
    double out = 0.0;
    for (const auto& column : values) {
      for (std::size_t n = 0; n < column.size(); ++n) {
        const double t = starts.first + static_cast<double>(n) / rate;
        out = std::max(out, std::abs(column[n] - signal_at(t)));
      }
    }
    return out;
  }
};

TEST(ChannelStarts, OfColumnsThatBeginTogetherChangeNothing) {
  const Three three({0.5, 0.5, 0.5}, 100);
  EXPECT_EQ(three.values[2], samples(0.5, 100));
  EXPECT_EQ(three.starts.first, 0.5);
  EXPECT_EQ(three.starts.note, "");
}

// [S-9]
TEST(ChannelStarts, AreBroughtTogether) {
  const Three whole({0.5, 0.5005, 0.501}, 200);
  EXPECT_EQ(whole.values[0].size(), 190u);
  EXPECT_EQ(whole.values[2].size(), 190u);
  EXPECT_DOUBLE_EQ(whole.starts.first, 0.501);
  EXPECT_LT(whole.largest_error(), 1e-9);
  EXPECT_EQ(
      whole.starts.note,
      "column \"Fy\" starts 0.5 ms after the first, column \"Fz\" starts 1 ms after the "
      "first: all columns were brought to common times.");
  const Three part({0.5, 0.50037, 0.5}, 200);
  EXPECT_EQ(part.values[0].size(), part.values[1].size());
  EXPECT_GE(part.values[0].size(), 175u);
  EXPECT_LT(part.largest_error(), 0.2) << "of 127";
}

TEST(ChannelStarts, ThatAreTooFarApartAreRefused) {
  const Three three({0.0, 0.0, 3.0}, 200);
  EXPECT_NE(three.starts.problem.find("3000 ms after the first"), std::string::npos)
      << three.starts.problem;
}

}  // namespace trochoid::files::channel_starts_test
