#pragma once

#include <trochoid/base/units.h>
#include <trochoid/program/complaints.h>
#include <trochoid/program/move.h>

#include <array>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace trochoid::program {

/// @brief What is known of a program beside its text.
struct ReadOptions {
  std::optional<Dialect> dialect;          ///< none: as the text shows
  std::string name;                        ///< of the file, for its ending
  std::vector<std::string> ignored_words;  ///< that may be unknown: M10
  std::array<double, 3> origin{};  ///< program zero in the frame of the stock [m]
  std::optional<std::array<double, 3>> start;  ///< place before the first block [m]
  /// Zero of each work offset from the origin [m]: G54, G54.1P3.
  std::map<std::string, std::array<double, 3>> offsets;
  bool wear_zero = false;     ///< G41 and G42 are accepted: the path is the center's
  bool block_delete = false;  ///< blocks with / are left out
  double rapid_feed = 10000 * unit::mm_per_min;  ///< [m/s]
};

/// What a text came to. With a problem the moves are not to be used.
struct ProgramText {
  Program program;
  std::vector<Problem> problems;  ///< in the order of the text, at most 50
  std::vector<Remark> remarks;    ///< likewise; one a code
};

/// @brief Read a program in G code: every word is executed, known to be without effect on
/// the load, or a problem.
///
/// Order within a block, drilling cycles and units are those of LinuxCNC (RS274/NGC);
/// docs/theory/program.md names what is different.
/// @param bytes  in UTF-8, or any other code of which ASCII is a part
ProgramText read_program(std::string_view bytes, const ReadOptions& options);

/// @brief The name of a work offset without blanks, in capitals: `G54.1P3`.
std::string offset_name(std::string_view text);

}  // namespace trochoid::program
