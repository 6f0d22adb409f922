#include <trochoid/run/simulate/compare.h>

#include <trochoid/run/shared/records.h>

#include <algorithm>
#include <functional>

namespace trochoid::run {

std::vector<results::Comparison> compare(const inputs::Case& given,
                                         std::vector<base::Warning>& warnings) {
  const auto measured = measured_runs(given, warnings);
  if (given.dynamometer && given.dynamometer->automatic) {
    warnings.push_back(
        {"not_compared",
         "axes = \"auto\" needs an identification; name the axes to compare here."});
    return {};
  }
  for (const MeasuredRun& one : measured) {
    if (!std::ranges::all_of(one.run.measured, std::identity())) {
      warnings.push_back({"not_compared", one.file +
                                              ": not all three channels were measured; "
                                              "identify fits such a record."});
      return {};
    }
  }
  const auto runs = identification::on_tool(
      channels_of(measured), given.dynamometer.value_or(inputs::Dynamometer{}).matrix);
  std::vector<results::Comparison> all;
  for (std::size_t r = 0; r < runs.size(); ++r) {
    all.push_back(
        {measured[r].file, runs[r], measured[r].Omega,
         identification::match_phase(given.setup, given.law, runs[r],
                                     given.identify.phase, given.sampling.tolerance)});
  }
  return all;
}

}  // namespace trochoid::run
