#pragma once

#include <trochoid/surface/choices.h>
#include <trochoid/surface/feedback.h>
#include <trochoid/surface/readings.h>
#include <trochoid/surface/setting.h>

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace trochoid::surface {

/// A wall that may be measured, with what is expected of it: the coefficients of the
/// law, the eccentricity of the setup.
struct WallTrial {
  Setting setting;
  Feedback feedback = Feedback::none;
  PlannedForm form = PlannedForm::offset;  ///< of the readings, found with the rest
  double noise = 1e-6;                     ///< standard deviation of a reading [m]
  double start = 0.0;  ///< envelope: where a turn begins along the wall [m]
};

/// @brief How readings change with what is to be found.
struct ReadingDerivatives {
  /// Of the mean that a reading belongs to, by K_tc and K_rc: row-major, shape
  /// (readings, 2) [m per N/m^2]. Runout drops out, or is taken to.
  std::vector<double> means;
  /// Of the reading itself, by rho cos(lambda), rho sin(lambda), where a turn begins (an
  /// envelope with runout only), then K_tc and K_rc: shape (readings, 2 + of_runout)
  /// [m per m, m per N/m^2].
  std::vector<double> single;
  std::size_t of_runout = 0;  ///< 0: the readings cannot show it
  std::string why_no_runout;  ///< empty: they can
};

/// @brief Derivatives of readings about what is expected.
///
/// Those of single readings are of a wall without feedback; with feedback, those by the
/// coefficients are of the means.
ReadingDerivatives derivatives_of(const WallTrial& trial,
                                  std::span<const Reading> readings);

/// Readings by the rows of the derivatives that they have.
struct PlannedReadings {
  std::vector<Reading> readings;  ///< x and height make the columns of the form
  std::vector<std::size_t> row;   ///< shape (readings)
};

/// @brief What a fit of readings will tell.
struct WallPrediction {
  bool told = false;  ///< can the coefficients be told apart at all?
  double condition = 0.0;
  double se_K_tc = 0.0;      ///< standard error [N/m^2]
  double se_K_rc = 0.0;      ///< [N/m^2]
  double correlation = 0.0;  ///< of the two
  double factor = 0.0;       ///< half of a 95 % interval over its standard error
  std::optional<double> se_eccentricity;  ///< [m]; nothing: it cannot be seen
  std::optional<double> se_angle;         ///< [rad]; nothing: nor without any
};

/// @brief Standard errors of coefficients and runout before anything is measured.
///
/// @eq E-60 C = s^2 (J^T J)^-1; J: the derivatives (E-17) beside the columns of E-61, s
///          the noise of a reading
/// @eq E-61 columns of an unknown form: 1 (offset), x and h (tilt), h^2 (curvature), all
///          about their means
/// @src derived from E-17; Fisher information of white noise, standard
WallPrediction prediction_of(const WallTrial& trial, const ReadingDerivatives& all,
                             const PlannedReadings& planned);

/// @brief A way to measure a wall: heights spread over the middle of the axial depth,
/// the same places at each.
struct WallDesign {
  int heights = 9;
  int per_height = 36;  ///< a multiple of the teeth
  double spread = 0.8;  ///< lowest to highest, as a part of the axial depth
};

/// @brief The next whole number of places: as many in each tooth feed, over whole turns.
int whole_places(int per_height, int teeth) noexcept;

/// Heights above the tip of a design [m].
std::vector<double> heights_of(const WallDesign& design, double a_p);

/// @brief One turn of readings at each of some heights; what designs choose from.
class WallCatalogue {
 public:
  /// @param heights   above the tip, any order [m]
  /// @param position  of the cutter along the wall [m]
  WallCatalogue(const WallTrial& trial, std::span<const double> heights,
                double position);

  /// @brief Readings of a design, more turns laid one after the other.
  /// @throws std::invalid_argument for a height that is not in the catalogue
  [[nodiscard]] PlannedReadings readings_of(const WallDesign& design) const;
  /// @brief So many readings at one of its heights.
  [[nodiscard]] PlannedReadings readings_at(double height, int count) const;
  [[nodiscard]] WallPrediction predict(const PlannedReadings& planned) const;
  [[nodiscard]] const ReadingDerivatives& derivatives() const noexcept {
    return derivatives_;
  }
  [[nodiscard]] const std::vector<Reading>& rows() const noexcept { return rows_; }

 private:
  [[nodiscard]] std::size_t place_of(double height) const;
  void add(std::size_t height, int per_tooth, int turn, PlannedReadings& out) const;

  WallTrial trial_;
  std::vector<double> heights_;
  std::vector<Reading> rows_;  ///< shape (heights, places in a turn)
  ReadingDerivatives derivatives_;
};

}  // namespace trochoid::surface
