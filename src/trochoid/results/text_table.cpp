#include <trochoid/results/text_table.h>

#include <fmt/core.h>

#include <algorithm>

namespace trochoid::results {

std::string aligned(std::span<const std::vector<std::string>> rows) {
  std::vector<std::size_t> width(rows.front().size(), 0);
  for (const auto& cells : rows) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
      width[i] = std::max(width[i], cells[i].size());
    }
  }
  std::string out;
  for (const auto& cells : rows) {
    out += fmt::format("{:<{}}", cells.front(), width.front());
    for (std::size_t i = 1; i < cells.size(); ++i) {
      out += fmt::format("  {:>{}}", cells[i], width[i]);
    }
    out += '\n';
  }
  return out;
}

}  // namespace trochoid::results
