#pragma once

#include <trochoid/base/estimate.h>

#include <cstddef>
#include <span>
#include <string_view>
#include <vector>

namespace trochoid::surface {

using base::Estimate;

/// Unknowns of fits are about one in these: errors and runout [m], coefficients [N/m^2].
inline constexpr double error_scale = 1e-6;
inline constexpr double coefficient_scale = 1e8;

/// What is estimated of a measurement beside the coefficients.
struct Datum {
  bool offset = false;     ///< a constant of the readings
  bool tilt = false;       ///< slopes along the feed and over the height
  bool lean = false;       ///< along the feed alone
  bool curvature = false;  ///< over the height
  bool decide = false;     ///< as the readings decide, at least these (E-24)
};

/// Form of a wall that is no work of this cut, each with those before it.
enum class Form { none, offset, tilt, curvature };

/// The names that files use.
constexpr std::string_view name_of(Form form) noexcept {
  switch (form) {
    case Form::none:
      return "none";
    case Form::offset:
      return "offset";
    case Form::tilt:
      return "tilt";
    case Form::curvature:
      return "curvature";
  }
  return {};
}

constexpr Datum datum_of(Form form) noexcept {
  return {.offset = form >= Form::offset,
          .tilt = form >= Form::tilt,
          .curvature = form >= Form::curvature};
}

/// A datum as it was decided: the form, and what was stated. How a wall leans along the
/// feed tells nothing of the cut, costs little, and is always left open.
constexpr Datum decided(const Datum& datum, Form form) noexcept {
  if (!datum.decide) {
    return datum;
  }
  Datum of = datum_of(form);
  of.offset = of.offset || datum.offset;
  of.tilt = of.tilt || datum.tilt;
  of.lean = true;
  return of;
}

/// Where a reading or a mean of readings lies.
struct Spot {
  double x = 0.0;
  double height = 0.0;
  std::size_t set = 0;
};

/// What a column of the datum is.
struct DatumPart {
  std::size_t set = 0;
  enum class Kind { offset, lean, tilt, curvature };
  Kind kind = Kind::offset;
  double largest = 0.0;  ///< value in the column
};

/// @brief Columns of the datum parameters: of each set an offset, its slopes, and how far
/// the middle of the heights lies below their ends.
struct DatumColumns {
  std::size_t count = 0;
  std::vector<double> values;    ///< row-major, shape (spots, count)
  std::vector<DatumPart> parts;  ///< shape (count)
};

DatumColumns datum_columns(std::span<const Spot> spots, std::span<const Datum> datum);

/// @brief Value, standard error and 95 % interval.
/// @param freedom  degrees of freedom of the variance
Estimate estimate(double value, double variance, int freedom);

}  // namespace trochoid::surface
