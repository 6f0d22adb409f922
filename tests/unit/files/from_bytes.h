#pragma once

#include <trochoid/base/error.h>
#include <trochoid/files/record_file.h>

#include <sstream>
#include <string>

/// Records read from bytes in memory, as if they stood in a file of some name.
namespace trochoid::files {

struct RecordFrom {
  const char* name;

  signal::Record operator()(const std::string& bytes,
                            const RecordSource& source = {}) const {
    std::istringstream in(bytes);
    return read_record(in, name, source);
  }
};

/// What is said of such a file that is refused; empty: it is read.
struct RefusalFrom {
  const char* name;

  std::string operator()(const std::string& bytes,
                         const RecordSource& source = {}) const {
    try {
      RecordFrom{name}(bytes, source);
    } catch (const base::InputError& error) {
      return error.what();
    }
    return "";
  }
};

}  // namespace trochoid::files
