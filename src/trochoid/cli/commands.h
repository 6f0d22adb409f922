#pragma once

#include <trochoid/base/command.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace trochoid::cli {

/// What all commands that answer a case have in common.
struct Options {
  std::filesystem::path file;    ///< the case, or the folder of `report`
  std::filesystem::path folder;  ///< -o; empty: beside the case
  std::vector<std::string> set;  ///< KEY=VALUE, beside the case file
  bool from_input = false;       ///< the case is read from the standard input
  bool json = false;
  bool quiet = false;
  bool verbose = false;  ///< say of every step how long it took
  int threads = 0;       ///< at most; 0: as many as there are
  bool no_report = false;
  bool anyway = false;               ///< more work than usual is meant
  std::optional<double> time_limit;  ///< of the work [s]

  bool simulate_controller = false;  ///< of correct
  bool moves = false;                ///< of program: however many
  bool curves = false;               ///< of identify: of every sample

  std::string command;            ///< of sweep, and that check is for
  std::vector<std::string> take;  ///< of sweep: paths in the answers

  std::filesystem::path tool;  ///< of new: a file of another program; empty: none
  std::optional<int> tool_number;
  bool tool_inches = false;
  std::filesystem::path other;     ///< of report: a second folder; empty: none
  std::filesystem::path material;  ///< of new: a file with a [force]; empty: none

  // Of a bare data file, which has no case to say them.
  std::string kind;               ///< of a frequency response; empty: the file says it
  int modes = 0;                  ///< 0: chosen
  int dataset = 0;                ///< 0: the only one
  std::vector<double> band;       ///< lowest and highest frequency [Hz]; empty: all
  std::optional<double> step_um;  ///< height of a step
  std::optional<double> start_s;  ///< time of a step
};

/// Exit codes of every command.
inline constexpr int answered = 0;
inline constexpr int no_answer = 1;
inline constexpr int wrong_input = 2;
inline constexpr int our_bug = 3;

/// @brief Answer the case, or the bare data file, of a command, and deliver the answer.
///
/// When the time is up, stability and identify are asked to end with what they have found;
/// else, or where they do not soon, the answer is that there is none.
/// @return exit code, as of all below
int answer(base::Command command, const Options& options);
int sweep(const Options& options);
int check(const Options& options);
/// @param command  whose case file is wanted
/// @param options  where to write it, empty: to the standard output; the tool it is for
int new_case(base::Command command, const Options& options);
int report(const Options& options);

}  // namespace trochoid::cli
