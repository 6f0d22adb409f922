#include <trochoid/results/estimate_value.h>

namespace trochoid::results {

Value estimate_value(const std::optional<base::Estimate>& estimate, double unit) {
  if (!estimate) {
    return nullptr;
  }
  return Object{{"value", estimate->value / unit},
                {"se", estimate->se / unit},
                {"low", estimate->low / unit},
                {"high", estimate->high / unit}};
}

}  // namespace trochoid::results
