#include <stdexcept>

#include "hdf5_table.h"

namespace trochoid::results {

bool has_hdf5() noexcept {
  return false;
}

std::string hdf5_table(const base::Table& table) {
  throw std::runtime_error(
      table.file + " cannot be written as HDF5: this program was built without it");
}

}  // namespace trochoid::results
