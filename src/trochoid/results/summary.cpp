#include <trochoid/results/folder.h>
#include <trochoid/results/json.h>
#include <trochoid/results/provenance.h>

namespace trochoid::results {

std::string summary_json(const Answer& answer) {
  Array warnings;
  for (const base::Warning& warning : answer.heading.warnings) {
    warnings.push_back(Object{{"code", warning.code}, {"message", warning.message}});
  }
  // One by one: a braced list of all of them is destroyed twice by g++ 12 where there is
  // no memory for the last.
  Object summary;
  const auto add = [&](const char* key, Value value) {
    Member member;
    member.key = key;
    member.value = std::move(value);
    summary.push_back(std::move(member));
  };
  add("trochoid", Object{{"version", version()}, {"commit", commit()}});
  add("command", answer.command);
  add("status", answer.heading.ok ? "ok" : "failed");
  add("message", answer.heading.message);
  add("warnings", std::move(warnings));
  if (std::holds_alternative<std::nullptr_t>(answer.result.data)) {
    add("result", Object{});
  } else {
    add("result", answer.result);
  }
  return json_text(summary) + '\n';
}

}  // namespace trochoid::results
