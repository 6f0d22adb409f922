#pragma once

#include <fmt/core.h>

#include <bit>
#include <complex>
#include <cstdint>
#include <string>
#include <vector>

/// Universal files made by hand, for the tests of their reader.
namespace trochoid::files {

struct MadeSet {
  int type = 5;  ///< 2, 4 real; 5, 6 complex; 4, 6 double
  bool even = true;
  std::vector<double> x;
  std::vector<std::complex<double>> y;
  int function = 4;
  std::string unit = "m/s2";
  std::string denominator = "N";
  int promised = -1;   ///< points in the head; below 0: as many as there are
  int axis = 18;       ///< kind of the abscissa
  int kind = 12;       ///< of the ordinate
  int direction = -1;  ///< of the response
  int reference = 1;   ///< direction of the force
  int node = 7;        ///< of the response
};

inline std::string head_of(const MadeSet& set) {
  const auto points = set.promised < 0 ? static_cast<int>(set.y.size()) : set.promised;
  const double step = set.even && set.x.size() > 1 ? set.x[1] - set.x[0] : 0.0;
  std::string text = "tip of the tool\nNONE\n01-Jan-20 10:00:00\nNONE\nNONE\n";
  text +=
      fmt::format("{:5}{:10}{:5}{:10} {:<10}{:10}{:4} {:<10}{:10}{:4}\n", set.function,
                  1, 0, 0, "tip", set.node, set.direction, "tip", 7, set.reference);
  text += fmt::format("{:10}{:10}{:10}{:13.5E}{:13.5E}{:13.5E}\n", set.type, points,
                      set.even ? 1 : 0, set.x.empty() ? 0.0 : set.x[0], step, 0.0);
  const auto axis = [&](int type, const char* label, const std::string& unit) {
    text +=
        fmt::format("{:10}{:5}{:5}{:5} {:<20} {:<20}\n", type, 0, 0, 0, label, unit);
  };
  axis(set.axis, set.axis == 18 ? "Frequency" : "Time", set.axis == 18 ? "Hz" : "s");
  axis(set.kind, set.kind == 12 ? "Acceleration" : "Force", set.unit);
  axis(13, "Force", set.denominator);
  axis(0, "NONE", "NONE");
  return text;
}

/// The numbers of a set in their order.
inline std::vector<double> numbers_of(const MadeSet& set) {
  std::vector<double> out;
  for (std::size_t i = 0; i < set.y.size(); ++i) {
    if (!set.even) out.push_back(set.x[i]);
    out.push_back(set.y[i].real());
    if (set.type >= 5) out.push_back(set.y[i].imag());
  }
  return out;
}

inline std::string as_text(const MadeSet& set) {
  std::string text = "    -1\n    58\n" + head_of(set);
  const auto numbers = numbers_of(set);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    text += fmt::format("{:20.11E}", numbers[i]);
    if (i % 4 == 3 || i + 1 == numbers.size()) text += '\n';
  }
  return text + "    -1\n";
}

template <class Bits>
void append(std::string& out, Bits bits, bool big) {
  for (std::size_t i = 0; i < sizeof bits; ++i) {
    const auto byte = big ? sizeof bits - 1 - i : i;
    out += static_cast<char>((bits >> (8 * byte)) & 0xFF);
  }
}

inline std::string as_binary(const MadeSet& set, bool big) {
  std::string data;
  for (const double value : numbers_of(set)) {
    if (set.type == 4 || set.type == 6) {
      append(data, std::bit_cast<std::uint64_t>(value), big);
    } else {
      append(data, std::bit_cast<std::uint32_t>(static_cast<float>(value)), big);
    }
  }
  return fmt::format("    -1\n    58b{:6}{:6}{:12}{:12}{:6}{:6}{:12}{:12}\n",
                     big ? 2 : 1, 2, 11, data.size(), 0, 0, 0, 0) +
         head_of(set) + data + "\n    -1\n";
}

}  // namespace trochoid::files
