#include <trochoid/inputs/hdf5_record.h>
#include <trochoid/inputs/numeric_table.h>

namespace trochoid::inputs {

signal::Record read_hdf5_record(std::istream& /*in*/, const std::string& name,
                                const Measurement& /*measurement*/) {
  refuse(
      name,
      "this program was built without HDF5: build it where libhdf5-dev is installed, "
      "or export the record as CSV");
}

}  // namespace trochoid::inputs
