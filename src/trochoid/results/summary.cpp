#include <trochoid/results/folder.h>
#include <trochoid/results/json.h>
#include <trochoid/results/provenance.h>

namespace trochoid::results {

std::string summary_json(const Answer& answer) {
  Array warnings;
  for (const base::Warning& warning : answer.heading.warnings) {
    warnings.push_back(Object{{"code", warning.code}, {"message", warning.message}});
  }
  const bool empty = std::holds_alternative<std::nullptr_t>(answer.result.data);
  return json_text(Object{{"trochoid", Object{{"version", version()},
                                              {"commit", commit()},
                                              {"schema", summary_version}}},
                          {"command", answer.command},
                          {"status", answer.heading.ok ? "ok" : "failed"},
                          {"message", answer.heading.message},
                          {"warnings", std::move(warnings)},
                          {"result", empty ? Value(Object{}) : answer.result}}) +
         '\n';
}

}  // namespace trochoid::results
