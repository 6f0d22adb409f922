#include <trochoid/cli/deliver.h>
#include <trochoid/inputs/case.h>
#include <trochoid/run/surface.h>

#include <functional>

namespace trochoid::cli {

int surface(const Options& options) {
  const inputs::Case given = inputs::read_case(options.file, inputs::Command::surface,
                                               result_folder(options, "surface"));
  ProgressLine progress(options.quiet);
  const results::Answer answer = run::surface(given, std::ref(progress));
  return deliver(answer, options);
}

}  // namespace trochoid::cli
