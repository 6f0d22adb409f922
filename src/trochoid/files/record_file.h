#pragma once

#include <trochoid/files/record_source.h>
#include <trochoid/signal/record.h>

#include <istream>
#include <string>

namespace trochoid::files {

/// @brief Read a measured force record (CSV or DynoWare) into SI.
///
/// The separator is `,` `;` or a tab, decimals have a point or, where nothing else can
/// be meant, a comma. Lines with `#` are comments. With a sampling rate (of the case
/// file, or of a DynoWare header) the times are rebuilt from it; a time column then
/// gives the first time and must agree. Without one, the times must increase.
/// @throws base::InputError with every problem of the file; reading stops after 1000
signal::Record read_record(const RecordSource& source);

/// @brief The same from an open stream.
/// @param in    stands at its beginning and can be set back to it
/// @param name  of the file, for messages
signal::Record read_record(std::istream& in, const std::string& name,
                           const RecordSource& source);

}  // namespace trochoid::files
