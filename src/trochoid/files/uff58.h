#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

/// Universal file format, data set 58: one function of one variable, as text (58) or
/// binary (58b).
namespace trochoid::files {

/// What an axis of a data set says of itself.
struct UffAxis {
  int type =
      0;  ///< 8 displacement, 11 velocity, 12 acceleration, 13 force, 18 frequency
  std::string label;
  std::string unit;
};

struct Uff58 {
  std::size_t line = 0;  ///< of the number of the data set
  bool binary = false;
  std::array<std::string, 5> id;
  int function_type = 0;  ///< 1 time, 4 frequency response
  int response_node = 0;
  int response_direction = 0;
  int reference_node = 0;
  int reference_direction = 0;
  int ordinate_type = 0;  ///< 2, 4 real; 5, 6 complex; 4, 6 double
  bool even = true;
  std::size_t promised = 0;  ///< points that the header speaks of
  double abscissa_min = 0.0;
  double abscissa_increment = 0.0;
  UffAxis abscissa;
  UffAxis ordinate;
  UffAxis denominator;
  std::vector<double> x;                ///< as in the file
  std::vector<std::complex<double>> y;  ///< as in the file

  [[nodiscard]] bool complex_valued() const noexcept { return ordinate_type >= 5; }
};

struct UffFile {
  std::vector<Uff58> sets;
  std::vector<int> others;  ///< numbers of the data sets that were passed over
};

/// @brief Whether a file begins like a universal file: a line that holds only -1.
bool is_uff(std::string_view begin);

/// @brief Every data set 58 of a universal file.
///
/// A set may hold fewer points than its header promises; the caller compares.
/// @param text  the whole file
/// @param name  of the file, for messages
/// @throws base::InputError with every problem
UffFile read_uff(std::string_view text, const std::string& name);

}  // namespace trochoid::files
