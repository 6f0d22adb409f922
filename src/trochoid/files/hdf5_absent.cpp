#include <trochoid/files/hdf5_record.h>
#include <trochoid/files/numeric_table.h>

namespace trochoid::files {

signal::Record read_hdf5_columns(std::istream& /*in*/, const std::string& name,
                                 const RecordSource& /*source*/, Hdf5Kind /*kind*/) {
  refuse(name,
         "this is an HDF5 file, as MATLAB writes them from version 7.3 on, and this "
         "program was built without HDF5: build it where libhdf5-dev is installed, or "
         "export the record as CSV");
}

}  // namespace trochoid::files
