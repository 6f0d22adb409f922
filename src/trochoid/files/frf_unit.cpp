#include <trochoid/files/frf_file.h>

#include <array>
#include <string>
#include <utility>

namespace trochoid::files {

namespace {

using structure::ResponseKind;

/// Standard acceleration of free fall, in which sensors are calibrated [m/s^2].
constexpr double g = 9.80665;

struct Motion {
  std::string_view text;
  ResponseUnit unit;
};

constexpr double inch = 0.0254;

constexpr std::array<Motion, 16> motions = {{
    {"m", {ResponseKind::receptance, 1.0}},
    {"mm", {ResponseKind::receptance, 1e-3}},
    {"um", {ResponseKind::receptance, 1e-6}},
    {"m/s", {ResponseKind::mobility, 1.0}},
    {"mm/s", {ResponseKind::mobility, 1e-3}},
    {"m/s2", {ResponseKind::accelerance, 1.0}},
    {"m/s/s", {ResponseKind::accelerance, 1.0}},
    {"mm/s2", {ResponseKind::accelerance, 1e-3}},
    {"g", {ResponseKind::accelerance, g}},
    {"gn", {ResponseKind::accelerance, g}},
    {"in", {ResponseKind::receptance, inch}},
    {"inch", {ResponseKind::receptance, inch}},
    {"in/s", {ResponseKind::mobility, inch}},
    {"in/s2", {ResponseKind::accelerance, inch}},
    {"in/s/s", {ResponseKind::accelerance, inch}},
    {"in/sec2", {ResponseKind::accelerance, inch}},
}};

constexpr std::array<std::pair<std::string_view, double>, 4> forces = {
    {{"n", 1.0},
     {"kn", 1e-3},
     {"lbf", 1 / 4.4482216152605},
     {"lb", 1 / 4.4482216152605}}};

/// Small letters, without blanks, brackets, `^` and the like; a raised 2 is a 2.
std::string simplified(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const auto c = static_cast<unsigned char>(text[i]);
    if (c == ' ' || c == '(' || c == ')' || c == '[' || c == ']' || c == '^' ||
        c == '*') {
      continue;
    }
    if (c == 0xC2 && i + 1 < text.size()) continue;  // of a raised 2 or mu in UTF-8
    if (c == 0xB2) {
      out += '2';
    } else if (c == 0xB5) {
      out += 'u';
    } else {
      out += static_cast<char>(c >= 'A' && c <= 'Z' ? c - 'A' + 'a' : c);
    }
  }
  return out;
}

}  // namespace

std::optional<ResponseUnit> response_unit(std::string_view text) {
  std::string all = simplified(text);
  for (const auto& [name, factor] : forces) {  // (1/N)*(m/s^2)
    const std::string before = "1/" + std::string(name);
    if (all.starts_with(before)) {
      all = all.substr(before.size()) + '/' + std::string(name);
      break;
    }
  }
  const auto slash = all.rfind('/');
  if (slash == std::string::npos) {
    return std::nullopt;
  }
  for (const auto& [name, factor] : forces) {
    if (all.substr(slash + 1) != name) continue;
    for (const Motion& motion : motions) {
      if (all.substr(0, slash) == motion.text) {
        return ResponseUnit{motion.unit.kind, motion.unit.factor * factor};
      }
    }
  }
  return std::nullopt;
}

}  // namespace trochoid::files
