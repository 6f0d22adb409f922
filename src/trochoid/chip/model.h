#pragma once

namespace trochoid::chip {

enum class Model {
  none,        ///< f_j sin(theta): no runout
  feed,        ///< (f_m + R_j - R_k) sin(theta), Kline and DeVor as the paper has it
  radial,      ///< f_m sin(theta) + R_j - R_k
  trochoidal,  ///< exact tooth paths
};

/// Which earlier teeth may have left the surface that a tooth meets.
enum class Lookback {
  all,       ///< every tooth, including itself one turn before
  previous,  ///< the tooth before only: the literal form of the paper
};

struct ChipModel {
  Model model = Model::trochoidal;
  Lookback lookback = Lookback::all;
};

}  // namespace trochoid::chip
