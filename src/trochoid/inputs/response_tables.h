#pragma once

#include <trochoid/signal/tap_test.h>
#include <trochoid/structure/frequency_response.h>
#include <trochoid/structure/mode.h>

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// Tables about how tool, work and actuator answered when they were struck or driven, in SI.
namespace trochoid::inputs {

enum class ResidualTerms { choose, yes, no };

/// Names of files.
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

/// Names of files.
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
  std::string file;      ///< absolute, or relative to where we run; empty: the
                         ///< [[measured_frf]] together
  std::string location;  ///< file:line:col of its `file` key
  std::optional<structure::ResponseKind> kind;  ///< absent: the file says it
  int dataset = 0;           ///< of a universal file, from 1; 0: the only one
  int modes = 0;             ///< 0: their number is chosen
  std::vector<double> band;  ///< lowest and highest line [Hz]; empty: all
  ResidualTerms residual_terms = ResidualTerms::choose;
  Shapes shapes = Shapes::choose;
  signal::TapOptions tap;  ///< for hammer blows in time
  ModeBody body = ModeBody::tool;
  Axis axis = Axis::x;
  std::shared_ptr<const std::string> content = {};  ///< in memory; none: in the file
};

/// One [[measured_frf]]: how tool point or work answers, for stability without modes.
struct MeasuredFrf {
  std::string file;      ///< absolute, or relative to where we run
  std::string location;  ///< file:line:col of its `file` key
  std::optional<structure::ResponseKind> kind;  ///< absent: the file says it
  int dataset = 0;           ///< of a universal file, from 1; 0: the only one
  std::vector<double> band;  ///< lowest and highest line [Hz]; empty: all
  ModeBody body = ModeBody::tool;
  Axis axis = Axis::x;                              ///< of the motion
  std::optional<Axis> force_axis;                   ///< of the force; absent: the same
  std::shared_ptr<const std::string> content = {};  ///< in memory; none: in the file
};

/// [step]: a measured step of the actuator.
struct StepTables {
  std::string file;             ///< absolute, or relative to where we run
  std::string location;         ///< file:line:col of its `file` key
  std::optional<double> step;   ///< height of the commanded step [m]
  std::optional<double> start;  ///< when it was commanded [s]
  std::shared_ptr<const std::string> content = {};  ///< in memory; none: in the file
};

}  // namespace trochoid::inputs
