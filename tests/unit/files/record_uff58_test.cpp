#include "from_bytes.h"
#include "uff58_made.h"

#include <gtest/gtest.h>
#include <trochoid/files/record_source.h>

namespace trochoid::files::record_uff58_test {

constexpr RecordFrom read{"r.uff"};
constexpr RefusalFrom refusal{"r.uff"};

/// @param direction  of the response, 1 to 3 or negative
MadeSet force(int direction, const std::vector<double>& values, bool even = true) {
  MadeSet set;
  set.type = 4;
  set.function = 1;
  set.even = even;
  set.unit = "N";
  set.axis = 17;
  set.kind = 13;
  set.direction = direction;
  for (std::size_t i = 0; i < values.size(); ++i) {
    set.x.push_back(0.5 + 0.25 * static_cast<double>(i));
    set.y.emplace_back(values[i]);
  }
  return set;
}

TEST(RecordUff58, FindsForcesByTheirDirections) {
  for (const bool binary : {false, true}) {
    std::string bytes;
    for (const auto& set :
         {force(3, {7, 8, 9}), force(-1, {1, 2, 3}), force(2, {4, 5, 6})}) {
      bytes += binary ? as_binary(set, false) : as_text(set);
    }
    const auto record = read(bytes);
    EXPECT_EQ(record.channel[0], (std::vector<double>{-1, -2, -3}));
    EXPECT_EQ(record.channel[1], (std::vector<double>{4, 5, 6}));
    EXPECT_EQ(record.channel[2], (std::vector<double>{7, 8, 9}));
    EXPECT_DOUBLE_EQ(record.sample_rate, 4.0);
    EXPECT_EQ(record.time, (std::vector<double>{.5, .75, 1}));
    ASSERT_EQ(record.notes.size(), 1u);
    EXPECT_EQ(record.notes[0].message,
              "The direction of \"Fx at 7\" is against its axis; its sign was turned.");
  }
}

TEST(RecordUff58, TakesUnevenTimes) {
  std::vector<MadeSet> sets = {force(1, {1, 2, 3}, false), force(2, {4, 5, 6}, false),
                               force(3, {7, 8, 9}, false)};
  for (auto& set : sets) set.x[2] = 1.125;
  EXPECT_EQ(read(as_text(sets[0]) + as_text(sets[1]) + as_text(sets[2])).time,
            (std::vector<double>{.5, .75, 1.125}));
  sets[1].x[2] = 1.25;
  EXPECT_NE(refusal(as_text(sets[0]) + as_text(sets[1]) + as_text(sets[2]))
                .find("have different times"),
            std::string::npos);
}

TEST(RecordUff58, RefusesWhatIsNoRecord) {
  EXPECT_EQ(refusal(as_text(MadeSet{.x = {1, 2}, .y = {1, 2}})),
            "r.uff: the universal file has no time history (data set 58, function type "
            "1, real numbers); its functions are of type 4\n");
  auto acceleration = force(1, {1, 2, 3});
  acceleration.kind = 12;
  EXPECT_EQ(
      refusal(as_text(acceleration)),
      "r.uff: no column is named Fx, Fy or Fz: the columns are "
      "\"Acceleration\"; columns = [...] in [[measurement]] names the three forces, "
      "time_column the time\n");
  auto part = force(1, {1, 2, 3});
  part.promised = 500;
  EXPECT_NE(
      refusal(as_text(part)).find("is to have 500 points and has 3: the file is cut"),
      std::string::npos);
}

TEST(RecordUff58, IsCutOffNowhereWithoutAWord) {
  for (const bool binary : {false, true}) {
    std::string bytes;
    for (const int direction : {1, 2, 3}) {
      const auto set = force(direction, std::vector<double>(40, 1.5));
      bytes += binary ? as_binary(set, true) : as_text(set);
    }
    EXPECT_EQ(refusal(bytes), "");
    for (int tenth = 1; tenth < 10; ++tenth) {
      const auto part =
          bytes.substr(0, bytes.size() * static_cast<std::size_t>(tenth) / 10);
      EXPECT_NE(refusal(part), "") << tenth;
    }
  }
}

TEST(RecordUff58, IsRefusedUnderAnotherName) {
  RecordSource m;
  m.format = RecordFormat::csv;
  EXPECT_EQ(refusal(as_text(force(1, {1, 2})), m),
            "r.uff:1:1: this is a universal file, but the case file says format = "
            "\"csv\": \"uff58\" is right\n");
}

}  // namespace trochoid::files::record_uff58_test
