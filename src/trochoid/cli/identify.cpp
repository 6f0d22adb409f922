#include <trochoid/cli/deliver.h>
#include <trochoid/inputs/case.h>
#include <trochoid/run/identify.h>

namespace trochoid::cli {

int identify(const Options& options) {
  const inputs::Case given = inputs::read_case(options.file, inputs::Command::identify,
                                               result_folder(options, "identify"));
  results::Answer answer;
  {
    ProgressLine line(options.quiet);
    answer = run::identify(given, [&line](const std::string& what) { line(what); });
  }
  return deliver(answer, options);
}

}  // namespace trochoid::cli
