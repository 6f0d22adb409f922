#include "from_bytes.h"

#include <gtest/gtest.h>
#include <trochoid/files/record_source.h>

#include <bit>
#include <cstdint>

namespace trochoid::files::record_npy_test {

constexpr RecordFrom read{"r.npy"};
constexpr RefusalFrom refusal{"r.npy"};

template <class Bits>
void put(std::string& bytes, Bits bits, bool big) {
  for (std::size_t i = 0; i < sizeof(Bits); ++i) {
    const std::size_t at = big ? sizeof(Bits) - 1 - i : i;
    bytes += static_cast<char>(bits >> (8 * at) & 0xFFU);
  }
}

void put_number(std::string& bytes, const std::string& kind, double value) {
  const bool big = kind[0] == '>';
  if (kind.ends_with("f8")) put(bytes, std::bit_cast<std::uint64_t>(value), big);
  if (kind.ends_with("f4")) {
    put(bytes, std::bit_cast<std::uint32_t>(static_cast<float>(value)), big);
  }
  if (kind.ends_with("i4")) {
    put(bytes, static_cast<std::uint32_t>(static_cast<std::int32_t>(value)), big);
  }
  if (kind.ends_with("i2")) {
    put(bytes, static_cast<std::uint16_t>(static_cast<std::int16_t>(value)), big);
  }
}

std::string npy(const std::string& descr, bool fortran, const std::string& shape,
                const std::string& data, char version = 1) {
  std::string head = "{'descr': " + descr +
                     ", 'fortran_order': " + (fortran ? "True" : "False") +
                     ", 'shape': " + shape + ", }\n";
  std::string bytes = std::string("\x93NUMPY") + version + '\0';
  put(bytes, static_cast<std::uint16_t>(head.size()), false);
  if (version > 1) put(bytes, std::uint16_t{0}, false);
  return bytes + head + data;
}

std::string plain(const std::string& kind, bool fortran, const std::string& shape,
                  const std::vector<double>& values) {
  std::string data;
  for (const double value : values) put_number(data, kind, value);
  return npy("'" + kind + "'", fortran, shape, data);
}

TEST(RecordNpy, ReadsEveryKindAndOrder) {
  RecordSource m;
  m.sample_rate = 1e4;
  for (const std::string kind :
       {"<f8", ">f8", "<f4", ">f4", "<i4", ">i4", "<i2", ">i2"}) {
    SCOPED_TRACE(kind);
    const auto rows = read(plain(kind, false, "(4, 3)",
                                 {1, 10, -100, 2, 20, -200, 3, 30, -300, 4, 40, -400}),
                           m);
    EXPECT_EQ(rows.channel[0], (std::vector<double>{1, 2, 3, 4}));
    EXPECT_EQ(rows.channel[2], (std::vector<double>{-100, -200, -300, -400}));
    EXPECT_EQ(rows.sample_rate, 1e4);
    ASSERT_FALSE(rows.notes.empty());
    EXPECT_EQ(
        rows.notes[0].message,
        "The columns of \"array\" have no names; they were taken for Fx, Fy, Fz, in "
        "this order.");
    const auto columns =
        read(plain(kind, true, "(4, 3)",
                   {1, 2, 3, 4, 10, 20, 30, 40, -100, -200, -300, -400}),
             m);
    EXPECT_EQ(columns.channel, rows.channel);
    const auto lying = read(plain(kind, false, "(3, 4)",
                                  {1, 2, 3, 4, 10, 20, 30, 40, -100, -200, -300, -400}),
                            m);
    EXPECT_EQ(lying.channel, rows.channel);
  }
}

TEST(RecordNpy, TakesTheFirstOfFourColumnsForTimes) {
  const auto record =
      read(plain("<f8", false, "(5, 4)",
                 {0, 1, 2, 3, .1, 1, 2, 3, .2, 1, 2, 3, .3, 1, 2, 3, .4, 4, 5, 6}));
  EXPECT_EQ(record.time, (std::vector<double>{0, .1, .2, .3, .4}));
  EXPECT_EQ(record.channel[0], (std::vector<double>{1, 1, 1, 1, 4}));
  EXPECT_NE(refusal(plain("<f8", false, "(2, 3)", {1, 2, 3, 4, 5, 6})), "");
}

TEST(RecordNpy, TakesFieldsByTheirNames) {
  std::string data;
  for (int i = 0; i < 2; ++i) {
    put_number(data, "<f4", i * 0.5);
    data += "ab";
    put_number(data, ">i2", 3 + i);
    put_number(data, "<f8", 2.5 + i);
    put_number(data, "<f8", 1.5 + i);
  }
  for (const char version : {'\1', '\2', '\3'}) {
    const auto record = read(
        npy("[('time_s', '<f4'), ('note', '|S2'), ('Fz_N', '>i2'), ('Fy_kN', '<f8'), "
            "('Fx_N', '<f8')]",
            false, "(2,)", data, version));
    EXPECT_EQ(record.channel[0], (std::vector<double>{1.5, 2.5}));
    EXPECT_EQ(record.channel[1], (std::vector<double>{2500, 3500}));
    EXPECT_EQ(record.channel[2], (std::vector<double>{3, 4}));
    EXPECT_EQ(record.sample_rate, 2.0);
    EXPECT_TRUE(record.notes.empty());
  }
}

TEST(RecordNpy, ReadsMoreThanIsFetchedAtOnce) {
  RecordSource m;
  m.sample_rate = 1e4;
  std::vector<double> values;
  for (int i = 0; i < 100000; ++i) {
    for (const int axis : {1, 2, 3}) values.push_back(axis * 1e6 + i);
  }
  const auto record = read(plain("<f8", false, "(100000, 3)", values), m);
  for (std::size_t i = 0; i < record.size(); ++i) {
    ASSERT_EQ(record.channel[1][i], 2e6 + static_cast<double>(i));
  }
  // Items so long that their numbers are fetched one by one.
  std::string data;
  for (int i = 0; i < 3; ++i) {
    for (const double value : {1.0, 2.0, 3.0}) put_number(data, "<f8", value + i);
    data += std::string(70000, 'x');
  }
  const auto far = read(npy("[('Fx', '<f8'), ('Fy', '<f8'), ('Fz', '<f8'), "
                            "('rest', '|V70000')]",
                            false, "(3,)", data),
                        m);
  EXPECT_EQ(far.channel[2], (std::vector<double>{3, 4, 5}));
}

TEST(RecordNpy, IsCutOffNowhereWithoutAWord) {
  RecordSource m;
  m.sample_rate = 1e4;
  const auto bytes = plain("<f8", false, "(4, 3)", std::vector<double>(12, 1.0));
  EXPECT_EQ(refusal(bytes, m), "");
  for (int tenth = 1; tenth < 10; ++tenth) {
    const auto part =
        bytes.substr(0, bytes.size() * static_cast<std::size_t>(tenth) / 10);
    EXPECT_NE(refusal(part, m).find("cut off"), std::string::npos) << tenth;
  }
}

TEST(RecordNpy, PromisesNoMoreThanItHolds) {
  const std::vector<double> data(12, 1.0);
  for (const char* shape : {"(5, 3)", "(3, 3)", "(18446744073709551615, 3)",
                            "(4611686018427387904, 4)", "(0, 3)"}) {
    EXPECT_NE(refusal(plain("<f8", false, shape, data)).find("96 bytes follow"),
              std::string::npos)
        << shape;
  }
}

TEST(RecordNpy, IsRefusedUnderAnotherName) {
  RecordSource m;
  m.format = RecordFormat::csv;
  EXPECT_EQ(
      refusal(plain("<f8", false, "(4, 3)", std::vector<double>(12, 1.0)), m),
      "r.npy:1:1: this is a NumPy array, but the case file says format = \"csv\": "
      "\"npy\" is right\n");
}

}  // namespace trochoid::files::record_npy_test
