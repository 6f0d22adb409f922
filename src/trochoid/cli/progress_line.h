#pragma once

#include <trochoid/cli/commands.h>
#include <trochoid/run/progress.h>

#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>

namespace trochoid::cli {

/// What is told.
enum class Talk { nothing, slow_work, every_step };

inline Talk talk_of(const Options& options) {
  if (options.quiet) return Talk::nothing;
  return options.verbose ? Talk::every_step : Talk::slow_work;
}

/// @brief Tells a person what takes longer than two seconds, on the standard error.
///
/// Of every step, too, how long it took, where that is asked for. On a terminal one line that is written over every second; elsewhere, a file or a
/// pipe, a plain line every three.
class ProgressLine {
 public:
  /// @param first  what is done till something else is told
  explicit ProgressLine(Talk talk, run::Step first = "Reading");
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  /// @brief Tells what is done now where no thread will: before work that tells nothing.
  void tell_if_alone();
  /// From any thread.
  void operator()(const run::Step& step);
  /// What was told last, in a few words.
  [[nodiscard]] std::string doing();

 private:
  void tell_until_done();
  void tell();
  void tell_end_of_step();

  Talk talk_;
  bool terminal_;
  bool shown_ = false;
  bool done_ = false;
  double started_ = 0.0;       ///< [s]
  double step_started_ = 0.0;  ///< [s]
  double told_ = 0.0;          ///< when a line was shown last [s]
  run::Step step_;
  std::mutex mutex_;
  std::condition_variable ended_;
  std::thread teller_;  ///< speaks up while a step takes its time
};

}  // namespace trochoid::cli
