#include <trochoid/signal/overview.h>

#include <trochoid/base/units.h>

#include <algorithm>

namespace trochoid::signal {

Overview overview_of(const Record& record, std::span<const double> angle,
                     const Part& used) {
  constexpr std::size_t most = 600;
  const std::size_t n = record.size();
  const std::size_t pieces = std::min(most, n);
  Overview out;
  for (std::size_t k = 0; k < pieces; ++k) {
    const std::size_t begin = k * n / pieces;
    const std::size_t end = std::max(begin + 1, (k + 1) * n / pieces);
    const std::size_t middle = begin + (end - begin) / 2;
    out.turn.push_back((angle[middle] - angle[0]) / unit::turn);
    if (!record.time.empty()) out.time.push_back(record.time[middle]);
    out.used.push_back(middle >= used.begin && middle < used.end);
    for (std::size_t c = 0; c < 3; ++c) {
      const auto& values = record.channel[c];
      if (!record.measured[c]) continue;
      const auto [low, high] =
          std::ranges::minmax(std::span(values).subspan(begin, end - begin));
      out.low[c].push_back(low);
      out.high[c].push_back(high);
    }
  }
  return out;
}

}  // namespace trochoid::signal
