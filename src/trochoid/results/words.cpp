#include <trochoid/results/answer.h>

#include <trochoid/results/correct.h>
#include <trochoid/surface/calibrate.h>

#include <initializer_list>
#include <optional>
#include <string_view>

namespace trochoid::results {

namespace {

/// What stands at the end of a path of keys, or null.
const Value* at(const Value& value, std::initializer_list<std::string_view> path) {
  const Value* below = &value;
  for (const std::string_view key : path) {
    below = below == nullptr ? nullptr : find(*below, key);
  }
  return below;
}

double number_or_zero(const Value* value) {
  if (value == nullptr) return 0.0;
  if (const auto* real = std::get_if<double>(&value->data)) return *real;
  const auto* whole = std::get_if<std::int64_t>(&value->data);
  return whole == nullptr ? 0.0 : static_cast<double>(*whole);
}

std::optional<correction::Optimum> optimum_of(const Value* value) {
  using correction::Optimality;
  const Value* kind = value == nullptr ? nullptr : at(*value, {"kind"});
  const auto* name = kind == nullptr ? nullptr : std::get_if<std::string>(&kind->data);
  if (name == nullptr) return std::nullopt;
  correction::Optimum optimum;
  for (const Optimality one :
       {Optimality::equal, Optimality::limit_of_one_axis, Optimality::local_minimum}) {
    if (*name == name_of(one)) optimum.optimality = one;
  }
  const Value* proven = at(*value, {"proven"});
  optimum.proven = proven != nullptr && std::get_if<bool>(&proven->data) != nullptr &&
                   std::get<bool>(proven->data);
  optimum.starts = static_cast<int>(number_or_zero(at(*value, {"starts"})));
  optimum.agreeing = static_cast<int>(number_or_zero(at(*value, {"agreeing"})));
  return optimum;
}

}  // namespace

Object words_of(const Answer& answer) {
  Object words;
  if (answer.command == "correct") {
    if (const auto optimum = optimum_of(at(answer.result, {"command", "optimum"}))) {
      set(words, "optimum", optimum_words(*optimum));
    }
  } else if (answer.command == "calibrate") {
    surface::RunoutFit runout{.ok = true};
    runout.eccentricity.value =
        number_or_zero(at(answer.result, {"runout", "eccentricity_mm"}));
    runout.eccentricity.se =
        number_or_zero(at(answer.result, {"runout", "eccentricity_se_mm"}));
    set(words, "runout_seen", surface::is_seen(runout));
  }
  return words;
}

}  // namespace trochoid::results
