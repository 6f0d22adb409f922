#include <trochoid/cli/work_on.h>

#include <trochoid/base/error.h>
#include <trochoid/cli/deliver.h>
#include <trochoid/cli/progress_line.h>
#include <trochoid/cli/time_limit.h>
#include <trochoid/run/shared/heading.h>

#include <fmt/core.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <functional>
#include <string>
#include <utility>

namespace trochoid::cli {

namespace {

/// What these have found before they are done is an answer.
bool ends_by_itself(base::Command name) {
  return name == base::Command::stability || name == base::Command::identify;
}

/// That there is none, for lack of time.
results::Answer no_answer_in_time(const inputs::Case& given, const Options& options,
                                  base::Command name, const std::string& doing) {
  results::Heading heading = run::heading_of(given);
  heading.ok = false;
  heading.message = fmt::format(
      "the time limit of {:g} s has passed and there is no answer yet (at last: {}); "
      "give it more time, or the command less to do",
      *options.time_limit, doing);
  return {.command = std::string(name_of(name)), .heading = std::move(heading)};
}

/// Of the program, from a thread beside the work.
[[noreturn]] void end_with(const results::Answer& answer,
                           const Options& options) noexcept {
  int code = our_bug;
  try {
    code = deliver(answer, options);
  } catch (const base::InputError& error) {
    complain(error.what());
    code = wrong_input;
  } catch (const std::exception& error) {
    complain(fmt::format("trochoid: {}\n", error.what()));
  }
  std::fflush(stdout);
  std::_Exit(code);
}

}  // namespace

int work_on(const inputs::Case& given, const Options& options, base::Command name,
            const CaseWork& work) {
  const auto answer = [&] {
    ProgressLine progress(talk_of(options));
    const TimeLimit limit(options.time_limit, ends_by_itself(name), [&] {
      end_with(no_answer_in_time(given, options, name, progress.doing()), options);
    });
    return work(std::ref(progress), limit.stop());
  };
  // What the run knows is let go of before it is written.
  return deliver(answer(), options);
}

}  // namespace trochoid::cli
