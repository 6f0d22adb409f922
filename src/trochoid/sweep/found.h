#pragma once

#include <trochoid/base/warning.h>
#include <trochoid/cases/sweep.h>
#include <trochoid/sweep/distribution.h>

#include <string>
#include <vector>

namespace trochoid::sweep {

/// What one earlier command found, as keys of the case.
struct FoundSet {
  std::vector<std::string> names;  ///< keys, but for runout.e_x_mm and runout.e_y_mm
  Distribution distribution;
};

/// @brief All that is drawn, and the case that it is put into.
struct Found {
  std::vector<FoundSet> sets;
  std::vector<cases::SweptKey> keys;  ///< of all sets, in their order
  std::vector<cases::Node> values;    ///< as found, one for each key
  cases::Node root;                   ///< the case with the values as found
  std::vector<base::Warning> warnings;
  std::string meaning;  ///< all that draws depend on beside the seed
};

/// @brief Values of the keys of a set for a draw of its numbers.
///
/// @eq U-6 rho = sqrt(e_x^2 + e_y^2), lambda = atan2(e_y, e_x)
/// @src definition
/// @param numbers  in the order of names
std::vector<double> as_keys(const FoundSet& set, std::span<const double> numbers);

/// @brief Read what is to be drawn, and put it into the case.
///
/// Coefficients need the law of the case, offsets its number of teeth. A mode is the one
/// of the case with the same body and axis and nearest in frequency, within 5 %; a case
/// without modes takes all. What was looked for and not found stays as the case has it.
/// @param root  the case without its [sweep]
/// @throws base::InputError with every problem
Found find_all(const cases::Sweep& sweep, const cases::Node& root);

}  // namespace trochoid::sweep
