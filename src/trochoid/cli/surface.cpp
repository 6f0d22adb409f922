#include <trochoid/cli/deliver.h>
#include <trochoid/inputs/case.h>
#include <trochoid/run/wall/surface.h>

#include <functional>

namespace trochoid::cli {

int surface(const Options& options) {
  const inputs::Case given = inputs::read_case(options.file, inputs::Command::surface,
                                               result_folder(options, "surface"));
  ProgressLine progress(options.quiet);
  return deliver(results::answer_of(run::surface(given, std::ref(progress))), options);
}

}  // namespace trochoid::cli
