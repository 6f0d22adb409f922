#pragma once

#include <trochoid/files/record_source.h>
#include <trochoid/signal/record.h>

#include <istream>
#include <string>

namespace trochoid::files {

/// @brief Read the time histories of a universal file (data sets 58 and 58b, function type
/// 1); as read_record.
///
/// A set of a force is Fx, Fy or Fz by the direction of its response, else of its
/// reference; of a direction against its axis the sign is turned, with a note.
signal::Record read_uff58_record(std::istream& in, const std::string& name,
                                 const RecordSource& source);

}  // namespace trochoid::files
