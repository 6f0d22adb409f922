#include "from_bytes.h"
#include "mat_made.h"

#include <gtest/gtest.h>
#include <trochoid/files/record_source.h>

namespace trochoid::files::record_mat_test {

constexpr RecordFrom read{"r.mat"};
constexpr RefusalFrom refusal{"r.mat"};

struct Kind {
  mat_ft version;
  matio_compression packed;
};
constexpr std::array kinds = {
    Kind{MAT_FT_MAT5, MAT_COMPRESSION_NONE}, Kind{MAT_FT_MAT5, MAT_COMPRESSION_ZLIB},
    Kind{MAT_FT_MAT73, MAT_COMPRESSION_NONE}, Kind{MAT_FT_MAT73, MAT_COMPRESSION_ZLIB}};

const std::vector<made::MatVariable> forces = {{"Fx", {1, 2, 3}},
                                               {"Fy", {10, 20, 30}},
                                               {"Fz_kN", {.1, .2, .3}},
                                               {"time", {0, .5, 1}}};

TEST(RecordMat, ReadsVariablesOfEveryVersion) {
  for (const auto& [version, packed] : kinds) {
    SCOPED_TRACE(version);
    const auto record = read(made::mat_file(forces, version, packed));
    EXPECT_EQ(record.channel[0], (std::vector<double>{1, 2, 3}));
    EXPECT_EQ(record.channel[1], (std::vector<double>{10, 20, 30}));
    EXPECT_DOUBLE_EQ(record.channel[2][2], 300.0);
    EXPECT_EQ(record.time, (std::vector<double>{0, .5, 1}));
    EXPECT_DOUBLE_EQ(record.sample_rate, 2.0);
  }
}

TEST(RecordMat, FindsAndNamesFieldsOfAStruct) {
  for (const auto& [version, packed] : kinds) {
    SCOPED_TRACE(version);
    const auto bytes = made::mat_file(forces, version, packed, "data");
    EXPECT_EQ(read(bytes).channel[1][2], 30.0);
    RecordSource m;
    m.columns = {"data.Fy", "data.Fx", "Fz_kN"};
    EXPECT_EQ(read(bytes, m).channel[0][2], 30.0);
    m.columns = {"data.Fq", "data.Fx", "Fz_kN"};
    EXPECT_EQ(refusal(bytes, m),
              "r.mat: there is no column \"data.Fq\": the columns are \"Fx\", \"Fy\", "
              "\"Fz_kN\", \"time\"\n");
  }
}

TEST(RecordMat, TakesTheOnlyMatrixAndSaysInWhichOrder) {
  RecordSource m;
  m.sample_rate = 10.0;
  for (const auto& [version, packed] : kinds) {
    SCOPED_TRACE(version);
    const made::MatVariable upright{
        "F", {1, 2, 3, 4, 5, 10, 20, 30, 40, 50, 6, 7, 8, 9, 0}, 5};
    const auto record = read(made::mat_file({upright}, version, packed), m);
    EXPECT_EQ(record.channel[0], (std::vector<double>{1, 2, 3, 4, 5}));
    EXPECT_EQ(record.channel[2], (std::vector<double>{6, 7, 8, 9, 0}));
    ASSERT_FALSE(record.notes.empty());
    EXPECT_EQ(record.notes[0].message,
              "The columns of \"F\" have no names; they were taken for Fx, Fy, Fz, in "
              "this order.");
    // Lying, with the time before the forces.
    const made::MatVariable lying{
        "F", {0, 1, 2, 3, .1, 1, 2, 3, .2, 1, 2, 3, .3, 1, 2, 3, .4, 4, 5, 6}, 4};
    const auto four = read(made::mat_file({lying}, version, packed));
    EXPECT_DOUBLE_EQ(four.time[4], 0.4);
    EXPECT_EQ(four.channel[1], (std::vector<double>{2, 2, 2, 2, 5}));
    RecordSource by_column = m;
    by_column.columns = {"F(:,3)", "F(:,1)", "F(:,2)"};
    EXPECT_EQ(read(made::mat_file({upright}, version, packed), by_column).channel[0][0],
              6.0);
  }
}

TEST(RecordMat, IsCutOffNowhereWithoutAWord) {
  for (const auto& [version, packed] : kinds) {
    const auto bytes = made::mat_file(forces, version, packed);
    for (int tenth = 1; tenth < 10; ++tenth) {
      const auto part =
          bytes.substr(0, bytes.size() * static_cast<std::size_t>(tenth) / 10);
      EXPECT_NE(refusal(part), "") << version << ' ' << tenth;
    }
  }
}

TEST(RecordMat, IsRefusedUnderAnotherName) {
  RecordSource m;
  m.format = RecordFormat::tdms;
  EXPECT_EQ(
      refusal(made::mat_file(forces, MAT_FT_MAT5), m),
      "r.mat:1:1: this is a MATLAB file, but the case file says format = \"tdms\": "
      "\"mat\" is right\n");
}

TEST(RecordMat, NeverBreaksOnASingleWrongByte) {
  for (const auto& [version, packed] : kinds) {
    const auto good = made::mat_file(forces, version, packed);
    // Of the long files of version 7.3 the first bytes of everything and a sample.
    const std::size_t step = good.size() > 2000 ? 61 : 1;
    for (std::size_t at = 0; at < good.size(); at += step) {
      auto bytes = good;
      bytes[at] = static_cast<char>(bytes[at] ^ 0x81);
      try {
        EXPECT_GE(read(bytes).size(), 2u);
      } catch (const base::InputError& error) {
        EXPECT_FALSE(error.problems().empty());
      }
    }
  }
}

}  // namespace trochoid::files::record_mat_test
