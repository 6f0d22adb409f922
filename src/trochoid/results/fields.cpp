#include <trochoid/results/columns.h>

#include <trochoid/base/unit_of_key.h>
#include <trochoid/base/units.h>

#include <algorithm>
#include <utility>

namespace trochoid::results {

namespace {

void scale(Value& value, double unit, bool given) {
  if (auto* number = std::get_if<double>(&value.data)) {
    *number = given ? unit::in(*number, unit) : *number / unit;
  } else if (auto* list = std::get_if<Array>(&value.data)) {
    for (Value& one : *list) scale(one, unit, given);
  }
}

}  // namespace

Value in_unit_of(std::string_view key, Content content) {
  if (content.numbers != Content::Numbers::as_named) {
    scale(content.value, unit::of_key(key).factor,
          content.numbers == Content::Numbers::given);
  }
  return std::move(content.value);
}

double unit_of_column(std::string_view name) {
  return unit::of_key(name).factor;
}

double cell_in_unit(double unit, ColumnValue cell) {
  if (cell.kind == Content::Numbers::as_named) return cell.value;
  return cell.kind == Content::Numbers::given ? unit::in(cell.value, unit)
                                              : cell.value / unit;
}

Value estimate_value(const std::optional<base::Estimate>& estimate, double unit) {
  if (!estimate) return nullptr;
  return Object{{"value", estimate->value / unit},
                {"se", estimate->se / unit},
                {"low", estimate->low / unit},
                {"high", estimate->high / unit}};
}

void add_text(std::vector<KeyText>& out, std::string path, std::string_view meaning) {
  const auto same = [&](const KeyText& text) { return text.path == path; };
  if (std::ranges::none_of(out, same)) out.push_back({std::move(path), meaning});
}

std::vector<KeyText> below_estimate(std::string_view before) {
  const std::string path(before);
  std::vector<KeyText> out;
  if (path.ends_with("*.")) {
    out.push_back({path.substr(0, path.size() - 1), "each by its key"});
  }
  for (const auto& [key, what] :
       {std::pair("value", "as found, in the unit of its key"),
        std::pair("se", "one standard error"),
        std::pair("low", "of the 95 % confidence interval"),
        std::pair("high", "of the 95 % confidence interval")}) {
    out.push_back({path + key, what});
  }
  return out;
}

}  // namespace trochoid::results
