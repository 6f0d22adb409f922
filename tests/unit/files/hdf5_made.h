#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include <hdf5.h>

/// HDF5 files for tests, made by the library itself.
namespace trochoid::files::made {

struct Hdf5Set {
  std::string path;  ///< in groups, which are made
  std::vector<double> values;
  std::vector<hsize_t> size;  ///< empty: one dimension
  std::string unit;
  std::optional<double> rate;
  bool packed = false;
  bool single = false;
};

inline void put_text(hid_t object, const char* name, const std::string& text) {
  const hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, text.size() + 1);
  const hid_t space = H5Screate(H5S_SCALAR);
  const hid_t at = H5Acreate2(object, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
  H5Awrite(at, type, text.c_str());
  H5Aclose(at);
  H5Sclose(space);
  H5Tclose(type);
}

inline void put_number(hid_t object, const char* name, double value) {
  const hid_t space = H5Screate(H5S_SCALAR);
  const hid_t at =
      H5Acreate2(object, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, H5P_DEFAULT);
  H5Awrite(at, H5T_NATIVE_DOUBLE, &value);
  H5Aclose(at);
  H5Sclose(space);
}

inline void put_set(hid_t file, const Hdf5Set& set) {
  const std::vector<hsize_t> size =
      set.size.empty() ? std::vector<hsize_t>{set.values.size()} : set.size;
  const hid_t space =
      H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr);
  const hid_t groups = H5Pcreate(H5P_LINK_CREATE);
  H5Pset_create_intermediate_group(groups, 1);
  const hid_t how = H5Pcreate(H5P_DATASET_CREATE);
  H5Pset_obj_track_times(how, 0);  // the same bytes at any time
  if (set.packed) {
    H5Pset_chunk(how, static_cast<int>(size.size()), size.data());
    H5Pset_deflate(how, 9);
  }
  const hid_t type = set.single ? H5T_IEEE_F32BE : H5T_IEEE_F64LE;
  const hid_t made =
      H5Dcreate2(file, set.path.c_str(), type, space, groups, how, H5P_DEFAULT);
  H5Dwrite(made, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, set.values.data());
  if (!set.unit.empty()) put_text(made, "unit", set.unit);
  if (set.rate) put_number(made, "sample_rate_Hz", *set.rate);
  H5Dclose(made);
  H5Pclose(how);
  H5Pclose(groups);
  H5Sclose(space);
}

/// @param more  is called with the open file before it is closed
template <class More>
std::string hdf5_file(const std::vector<Hdf5Set>& sets, const More& more) {
  const auto path = std::filesystem::temp_directory_path() /
                    ("trochoid-hdf5-" + std::to_string(getpid()) + ".h5");
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  for (const auto& set : sets) put_set(file, set);
  more(file);
  H5Fclose(file);
  std::ifstream in(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  std::filesystem::remove(path);
  return bytes;
}

inline std::string hdf5_file(const std::vector<Hdf5Set>& sets) {
  return hdf5_file(sets, [](hid_t) {});
}

}  // namespace trochoid::files::made
