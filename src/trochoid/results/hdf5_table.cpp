#include "hdf5_table.h"

#include <algorithm>
#include <cstddef>
#include <stdexcept>
#include <vector>

#include <hdf5.h>

namespace trochoid::results {

namespace {

/// What a file in memory grows by [bytes].
constexpr std::size_t growth = 1 << 20;

void succeeds(hid_t code) {
  if (code < 0) throw std::runtime_error("the HDF5 library gave up");
}

/// An open object, which closes itself.
class Opened {
 public:
  Opened(hid_t id, herr_t (*close)(hid_t)) : id_(id), close_(close) { succeeds(id); }
  ~Opened() { close_(id_); }
  Opened(const Opened&) = delete;
  Opened& operator=(const Opened&) = delete;

  [[nodiscard]] hid_t id() const noexcept { return id_; }

 private:
  hid_t id_;
  herr_t (*close_)(hid_t);
};

/// Keeps the library from printing its errors.
class Silence {
 public:
  Silence() {
    H5Eget_auto2(H5E_DEFAULT, &print_, &where_);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~Silence() { H5Eset_auto2(H5E_DEFAULT, print_, where_); }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  H5E_auto2_t print_ = nullptr;
  void* where_ = nullptr;
};

/// A file that lives in memory alone.
Opened file_in_memory() {
  const Opened access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  succeeds(H5Pset_fapl_core(access.id(), growth, false));
  return {H5Fcreate("table", H5F_ACC_TRUNC, H5P_DEFAULT, access.id()), H5Fclose};
}

/// Of columns with the same name the second is `name (2)`.
std::string free_name(hid_t file, const std::string& name) {
  std::string other = name;
  for (int k = 2; H5Lexists(file, other.c_str(), H5P_DEFAULT) > 0; ++k) {
    other = name + " (" + std::to_string(k) + ")";
  }
  return other;
}

void add_dataset(hid_t file, const std::string& column, std::size_t rows, hid_t type,
                 const void* values) {
  const std::string name = free_name(file, column);
  const hsize_t size = rows;
  const Opened space(H5Screate_simple(1, &size, nullptr), H5Sclose);
  const Opened options(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  succeeds(H5Pset_obj_track_times(options.id(), false));
  const Opened set(H5Dcreate2(file, name.c_str(), type, space.id(), H5P_DEFAULT,
                              options.id(), H5P_DEFAULT),
                   H5Dclose);
  if (rows > 0) {
    succeeds(H5Dwrite(set.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values));
  }
}

void add_texts(hid_t file, const base::Table::Column& column) {
  std::size_t longest = 1;
  for (const std::string& text : column.texts.words())
    longest = std::max(longest, text.size());
  std::vector<char> padded(longest * column.texts.size());
  for (std::size_t i = 0; i < column.texts.size(); ++i) {
    std::ranges::copy(column.texts[i],
                      padded.begin() + static_cast<std::ptrdiff_t>(i * longest));
  }
  const Opened type(H5Tcopy(H5T_C_S1), H5Tclose);
  succeeds(H5Tset_size(type.id(), longest));
  succeeds(H5Tset_strpad(type.id(), H5T_STR_NULLPAD));
  succeeds(H5Tset_cset(type.id(), H5T_CSET_UTF8));
  add_dataset(file, column.name, column.texts.size(), type.id(), padded.data());
}

}  // namespace

bool has_hdf5() noexcept {
  return true;
}

std::string hdf5_table(const base::Table& table) {
  const Silence silence;
  const Opened file = file_in_memory();
  for (const base::Table::Column& column : table.columns) {
    if (column.texts.empty()) {
      add_dataset(file.id(), column.name, column.values.size(), H5T_IEEE_F64LE,
                  column.values.data());
    } else {
      add_texts(file.id(), column);
    }
  }
  succeeds(H5Fflush(file.id(), H5F_SCOPE_GLOBAL));
  const ssize_t size = H5Fget_file_image(file.id(), nullptr, 0);
  succeeds(size);
  std::string bytes(static_cast<std::size_t>(size), '\0');
  succeeds(H5Fget_file_image(file.id(), bytes.data(), bytes.size()));
  return bytes;
}

}  // namespace trochoid::results
