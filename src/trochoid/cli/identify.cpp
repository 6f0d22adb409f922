#include <trochoid/cli/deliver.h>
#include <trochoid/inputs/case.h>
#include <trochoid/run/identify/identify.h>

#include <functional>

namespace trochoid::cli {

int identify(const Options& options) {
  const inputs::Case given = inputs::read_case(options.file, inputs::Command::identify,
                                               result_folder(options, "identify"));
  ProgressLine progress(options.quiet);
  return deliver(results::answer_of(run::identify(given, std::ref(progress))), options);
}

}  // namespace trochoid::cli
