#include <trochoid/cli/deliver.h>
#include <trochoid/inputs/case.h>
#include <trochoid/run/simulate/simulate.h>

namespace trochoid::cli {

int simulate(const Options& options) {
  const inputs::Case given = inputs::read_case(options.file, inputs::Command::simulate,
                                               result_folder(options, "simulate"));
  return deliver(results::answer_of(run::simulate(given)), options);
}

}  // namespace trochoid::cli
