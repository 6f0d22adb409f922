#pragma once

#include <trochoid/cases/held.h>
#include <trochoid/files/frf_file.h>
#include <trochoid/signal/tap_test.h>
#include <trochoid/structure/frequency_response.h>
#include <trochoid/structure/mode.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Tables about how tool, work and actuator answered when they were struck or driven, in SI.
namespace trochoid::cases {

enum class ResidualTerms { choose, yes, no };

/// As files spell it.
constexpr std::string_view name_of(ResidualTerms terms) noexcept {
  switch (terms) {
    case ResidualTerms::choose:
      return "choose";
    case ResidualTerms::yes:
      return "yes";
    case ResidualTerms::no:
      return "no";
  }
  return {};
}

/// Whether modes may move all directions in step only.
enum class Shapes { choose, real, complex };

/// As files spell it.
constexpr std::string_view name_of(Shapes shapes) noexcept {
  switch (shapes) {
    case Shapes::choose:
      return "choose";
    case Shapes::real:
      return "real";
    case Shapes::complex:
      return "complex";
  }
  return {};
}

using structure::Axis;
using structure::ModeBody;

/// [frf]: a measured frequency response.
struct FrfTables {
  files::FrfSource source;  ///< no file: the [[measured_frf]] together
  Held<files::FrfFile> response;
  Held<std::vector<files::DirectedFrf>> directed;  ///< where the file says directions
  int modes = 0;                                   ///< 0: their number is chosen
  std::vector<double> band;  ///< lowest and highest line [Hz]; empty: all
  ResidualTerms residual_terms = ResidualTerms::choose;
  Shapes shapes = Shapes::choose;
  signal::TapOptions tap;  ///< for hammer blows in time
  ModeBody body = ModeBody::tool;
  Axis axis = Axis::x;
};

/// One [[measured_frf]]: how tool point or work answers, for stability without modes.
struct MeasuredFrf {
  files::FrfSource source;
  Held<files::FrfFile> response;
  std::vector<double> band;  ///< lowest and highest line [Hz]; empty: all
  ModeBody body = ModeBody::tool;
  Axis axis = Axis::x;             ///< of the motion
  std::optional<Axis> force_axis;  ///< of the force; absent: the same
};

}  // namespace trochoid::cases
