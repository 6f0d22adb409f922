#include <trochoid/cli/deliver.h>
#include <trochoid/inputs/case.h>
#include <trochoid/run/calibrate.h>

#include <functional>

namespace trochoid::cli {

int calibrate(const Options& options) {
  const inputs::Case given = inputs::read_case(options.file, inputs::Command::calibrate,
                                               result_folder(options, "calibrate"));
  ProgressLine progress(options.quiet);
  const results::Answer answer = run::calibrate(given, std::ref(progress));
  return deliver(answer, options);
}

}  // namespace trochoid::cli
