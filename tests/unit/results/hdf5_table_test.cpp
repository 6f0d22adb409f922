#include <trochoid/results/hdf5_table.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include <hdf5.h>

namespace trochoid::results::hdf5_table_test {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

base::Table rows() {
  return {"sweep.csv",
          {{"cut.spindle_rpm", {900, 1000.5, none}},
           {"status", {}, {"ok", "failed: 2 µm", ""}},
           {"cut.spindle_rpm", {1, 2, 3}}}};
}

/// The bytes of a file, opened.
class Opened {
 public:
  explicit Opened(std::string bytes) {
    const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
    H5Pset_fapl_core(access, 1 << 16, false);
    H5Pset_file_image(access, bytes.data(), bytes.size());
    file_ = H5Fopen("table", H5F_ACC_RDONLY, access);
    H5Pclose(access);
  }
  ~Opened() { H5Fclose(file_); }
  Opened(const Opened&) = delete;
  Opened& operator=(const Opened&) = delete;

  [[nodiscard]] std::vector<double> numbers(const char* name) const {
    const hid_t set = H5Dopen2(file_, name, H5P_DEFAULT);
    const hid_t space = H5Dget_space(set);
    std::vector<double> values(
        static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
    H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    H5Sclose(space);
    H5Dclose(set);
    return values;
  }

  /// Texts one after the other, as they are padded.
  [[nodiscard]] std::string texts(const char* name, std::size_t size) const {
    const hid_t set = H5Dopen2(file_, name, H5P_DEFAULT);
    const hid_t type = H5Dget_type(set);
    EXPECT_EQ(H5Tget_cset(type), H5T_CSET_UTF8);
    std::string padded(size, '?');
    H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, padded.data());
    H5Tclose(type);
    H5Dclose(set);
    return padded;
  }

 private:
  hid_t file_ = -1;
};

TEST(Hdf5Table, HoldsEveryColumn) {
  const Opened file(hdf5_table(rows()));
  const std::vector<double> rpm = file.numbers("cut.spindle_rpm");
  ASSERT_EQ(rpm.size(), 3U);
  EXPECT_EQ(rpm[1], 1000.5);
  EXPECT_TRUE(std::isnan(rpm[2]));
  EXPECT_EQ(file.numbers("cut.spindle_rpm (2)"), (std::vector<double>{1, 2, 3}));
  const std::string longest = "failed: 2 µm";
  const std::size_t n = longest.size();
  EXPECT_EQ(file.texts("status", 3 * n),
            "ok" + std::string(n - 2, '\0') + longest + std::string(n, '\0'));
}

TEST(Hdf5Table, OfTheSameTableIsTheSame) {
  EXPECT_EQ(hdf5_table(rows()), hdf5_table(rows()));
}

TEST(Hdf5Table, MayHaveNoRows) {
  const Opened file(hdf5_table({"sweep.csv", {{"a", {}}}}));
  EXPECT_TRUE(file.numbers("a").empty());
}

}  // namespace trochoid::results::hdf5_table_test
