#pragma once

#include <string_view>

namespace trochoid::chip {

enum class Model {
  none,        ///< f_j sin(theta): no runout
  feed,        ///< (f_m + R_j - R_k) sin(theta), [kline1983] as in [riviere2009]
  radial,      ///< f_m sin(theta) + R_j - R_k
  trochoidal,  ///< exact tooth paths
};

/// The names that files use.
constexpr std::string_view name_of(Model model) noexcept {
  switch (model) {
    case Model::none:
      return "none";
    case Model::feed:
      return "feed";
    case Model::radial:
      return "radial";
    case Model::trochoidal:
      return "trochoidal";
  }
  return {};
}

/// Whether runout changes the chip of a model.
constexpr bool feels_runout(Model model) noexcept {
  return model != Model::none;
}

/// Which earlier teeth may have left the surface that a tooth meets.
enum class Lookback {
  all,       ///< every tooth, including itself one turn before
  previous,  ///< the tooth before only: the literal form of [riviere2009]
};

/// The names that files use.
constexpr std::string_view name_of(Lookback lookback) noexcept {
  switch (lookback) {
    case Lookback::all:
      return "all";
    case Lookback::previous:
      return "previous";
  }
  return {};
}

struct ChipModel {
  Model model = Model::trochoidal;
  Lookback lookback = Lookback::all;
};

}  // namespace trochoid::chip
