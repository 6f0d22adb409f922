#include "from_bytes.h"
#include "hdf5_made.h"

#include <gtest/gtest.h>
#include <trochoid/base/error.h>
#include <trochoid/files/child_process.h>
#include <trochoid/files/record_source.h>

#include <array>
#include <csignal>
#include <cstdlib>

#include <fcntl.h>
#include <unistd.h>

namespace trochoid::files::record_hdf5_test {

constexpr RecordFrom read{"r.h5"};
constexpr RefusalFrom refusal{"r.h5"};

const std::vector<made::Hdf5Set> forces = {
    {.path = "run/Fx", .values = {1, 2, 3}, .unit = "kN", .rate = 1e4},
    {.path = "run/deep/Fy",
     .values = {10, 20, 30},
     .unit = "N",
     .rate = 1e4,
     .single = true},
    {.path = "Fz", .values = {.1, .2, .3}, .unit = "N", .rate = 1e4, .packed = true}};

TEST(RecordHdf5, FindsDataSetsAtAnyDepth) {
  const auto record = read(made::hdf5_file(forces));
  EXPECT_EQ(record.channel[0], (std::vector<double>{1e3, 2e3, 3e3}));
  EXPECT_EQ(record.channel[1], (std::vector<double>{10, 20, 30}));
  EXPECT_EQ(record.channel[2], (std::vector<double>{.1, .2, .3}));
  EXPECT_EQ(record.sample_rate, 1e4);
  EXPECT_TRUE(record.notes.empty());
}

TEST(RecordHdf5, TakesPathsAndWhatGroupsSay) {
  auto sets = forces;
  sets.push_back({.path = "other/Fx", .values = {7, 8, 9}});
  for (auto& set : sets) set.rate.reset();
  const auto bytes =
      made::hdf5_file(sets, [](hid_t file) { made::put_number(file, "dt", 0.5); });
  EXPECT_NE(refusal(bytes).find("\"other/Fx\", \"run/Fx\", \"Fy\""), std::string::npos)
      << refusal(bytes);
  RecordSource m;
  m.columns = {"other/Fx", "run/deep/Fy", "Fz"};
  const auto record = read(bytes, m);
  EXPECT_EQ(record.channel[0][2], 9.0);
  EXPECT_EQ(record.sample_rate, 2.0);
}

TEST(RecordHdf5, TakesTheOnlyMatrix) {
  RecordSource m;
  m.sample_rate = 10.0;
  const auto record =
      read(made::hdf5_file({{.path = "F",
                             .values = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12},
                             .size = {4, 3},
                             .unit = "N"}}),
           m);
  EXPECT_EQ(record.channel[0], (std::vector<double>{1, 4, 7, 10}));
  EXPECT_EQ(record.channel[2], (std::vector<double>{3, 6, 9, 12}));
  ASSERT_EQ(record.notes.size(), 1u);
  EXPECT_EQ(record.notes[0].code, "columns_assumed");
}

TEST(RecordHdf5, TakesMembersOfCompounds) {
  struct Row {
    double t, Fx;
    float Fy;
    int Fz;
  };
  const std::array rows = {Row{0, 1, 2, 3}, Row{.5, 4, 5, 6}};
  const auto bytes = made::hdf5_file({}, [&](hid_t file) {
    const hid_t type = H5Tcreate(H5T_COMPOUND, sizeof(Row));
    H5Tinsert(type, "time_s", HOFFSET(Row, t), H5T_NATIVE_DOUBLE);
    H5Tinsert(type, "Fx_N", HOFFSET(Row, Fx), H5T_NATIVE_DOUBLE);
    H5Tinsert(type, "Fy_N", HOFFSET(Row, Fy), H5T_NATIVE_FLOAT);
    H5Tinsert(type, "Fz_N", HOFFSET(Row, Fz), H5T_NATIVE_INT);
    const hsize_t count = rows.size();
    const hid_t space = H5Screate_simple(1, &count, nullptr);
    const hid_t set =
        H5Dcreate2(file, "table", type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, rows.data());
    H5Dclose(set);
    H5Sclose(space);
    H5Tclose(type);
  });
  const auto record = read(bytes);
  EXPECT_EQ(record.channel[1], (std::vector<double>{2, 5}));
  EXPECT_EQ(record.channel[2], (std::vector<double>{3, 6}));
  EXPECT_EQ(record.time, (std::vector<double>{0, .5}));
}

TEST(RecordHdf5, RefusesWhatWouldFillTheMemory) {
  // A data set of 10^15 numbers of which nothing was written takes no room in the file.
  const auto vast = [](hid_t file) {
    const std::array<hsize_t, 1> size{1000000000000000ULL};
    const std::array<hsize_t, 1> chunk{1000};
    for (const char* name : {"Fx", "Fy", "Fz"}) {
      const hid_t how = H5Pcreate(H5P_DATASET_CREATE);
      H5Pset_chunk(how, 1, chunk.data());
      const hid_t space = H5Screate_simple(1, size.data(), nullptr);
      H5Dclose(
          H5Dcreate2(file, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, how, H5P_DEFAULT));
      H5Sclose(space);
      H5Pclose(how);
    }
  };
  RecordSource m;
  m.sample_rate = 1e4;
  EXPECT_NE(refusal(made::hdf5_file({}, vast), m).find("at most 2e+09 bytes"),
            std::string::npos);
  // One that would fit into memory, but was never written.
  const auto empty = made::hdf5_file({}, [](hid_t file) {
    const std::array<hsize_t, 1> size{10000000};
    for (const char* name : {"Fx", "Fy", "Fz"}) {
      const hid_t space = H5Screate_simple(1, size.data(), nullptr);
      H5Dclose(H5Dcreate2(file, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT,
                          H5P_DEFAULT));
      H5Sclose(space);
    }
  });
  EXPECT_NE(refusal(empty, m).find("it was never written"), std::string::npos);
}

TEST(RecordHdf5, IsCutOffNowhereWithoutAWord) {
  const auto bytes = made::hdf5_file(forces);
  for (int tenth = 1; tenth < 10; ++tenth) {
    const auto part =
        bytes.substr(0, bytes.size() * static_cast<std::size_t>(tenth) / 10);
    EXPECT_NE(refusal(part).find("cut off"), std::string::npos) << tenth;
  }
}

TEST(RecordHdf5, IsRefusedUnderAnotherName) {
  RecordSource m;
  m.format = RecordFormat::mat;
  EXPECT_EQ(refusal(made::hdf5_file(forces), m),
            "r.h5:1:1: this is an HDF5 file, but the case file says format = \"mat\": "
            "\"hdf5\" is right\n");
}

TEST(RecordHdf5, NeverBreaksOnASingleWrongByte) {
  // Opening a file takes ten times longer under the sanitizers.
#ifdef __SANITIZE_ADDRESS__
  const std::size_t every = 19;
#else
  const std::size_t every = std::getenv("TROCHOID_SEEDS") != nullptr ? 5 : 19;
#endif
  const auto good = made::hdf5_file(forces);
  for (std::size_t at = 0; at < good.size(); at += every) {
    auto bytes = good;
    bytes[at] = static_cast<char>(bytes[at] ^ 0x81);
    try {
      EXPECT_GE(read(bytes).size(), 2u);
    } catch (const base::InputError& error) {
      EXPECT_FALSE(error.problems().empty());
    }
  }
}

int told_by[2] = {-1, -1};

void tell(int /*signal*/) {
  static_cast<void>(::write(told_by[1], "x", 1));
  _exit(1);
}

TEST(ReadApart, BreaksDownWithoutWhatTheProgramDoesThen) {
  ASSERT_EQ(pipe2(told_by, O_NONBLOCK), 0);
  const auto before = std::signal(SIGSEGV, tell);
  EXPECT_THROW(read_in_child_process("record",
                                     [] {
                                       std::raise(SIGSEGV);
                                       return signal::Record{};
                                     }),
               base::InputError);
  std::signal(SIGSEGV, before);
  char nothing = 0;
  EXPECT_LT(::read(told_by[0], &nothing, 1), 0);
  ::close(told_by[0]);
  ::close(told_by[1]);
}

}  // namespace trochoid::files::record_hdf5_test
