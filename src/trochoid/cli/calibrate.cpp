#include <trochoid/cli/deliver.h>
#include <trochoid/inputs/case.h>
#include <trochoid/run/wall/calibrate.h>

#include <functional>

namespace trochoid::cli {

int calibrate(const Options& options) {
  const inputs::Case given = inputs::read_case(options.file, inputs::Command::calibrate,
                                               result_folder(options, "calibrate"));
  ProgressLine progress(options.quiet);
  return deliver(results::answer_of(run::calibrate(given, std::ref(progress))),
                 options);
}

}  // namespace trochoid::cli
