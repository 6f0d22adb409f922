#pragma once

#include <array>
#include <variant>

namespace trochoid::force {

/// dF_q = K_qc h db + K_qe dS, q in {t, r, a}  (eq. 14 of the paper)
struct LinearEdge {
  double K_tc = 0.0;  ///< [N/m^2]
  double K_rc = 0.0;  ///< [N/m^2]
  double K_ac = 0.0;  ///< [N/m^2]
  double K_te = 0.0;  ///< [N/m]
  double K_re = 0.0;  ///< [N/m]
  double K_ae = 0.0;  ///< [N/m]
};

/// dF_q = K_q1 h_0 (h/h_0)^(1 - m_q) db with h_0 = 1 mm  (Kienzle)
struct Power {
  double K_t1 = 0.0;  ///< [N/m^2]
  double K_r1 = 0.0;  ///< [N/m^2]
  double K_a1 = 0.0;  ///< [N/m^2]
  double m_t = 0.0;   ///< in [-0.5, 1)
  double m_r = 0.0;   ///< in [-0.5, 1)
  double m_a = 0.0;   ///< in [-0.5, 1)
};

using Law = std::variant<LinearEdge, Power>;

/// Length on which edge coefficients act.
enum class EdgeLength {
  true_length,  ///< dS, the length of the edge in space
  axial,        ///< dz
};

}  // namespace trochoid::force
