#pragma once

#include <trochoid/chip/chip.h>
#include <trochoid/numerics/trig_polynomial.h>

#include <optional>

namespace trochoid::chip {

/// @brief R_j - L_k, the chip over the mark of one earlier tooth in a wide stock, as a
/// trigonometric polynomial of the effective theta of the tooth.
///
/// The root of C-5 is a power series in c = cos(theta), whose coefficients follow from
/// one another; so are its cosine and with it C-6.
///
/// @eq C-9  sin(delta) = -a c (theta_p + delta), a = f/(2 pi R_k):
///          S_n = -a y_(n-1), 2 C_n = -sum C_i C_(n-i) - sum S_i S_(n-i),
///          n d_n = n S_n - sum_(i<n) i d_i C_(n-i), y = theta_p + delta
/// @eq C-10 R_j - L_k = R_j - R_k - R_k sum_(n>1) C_n c^n + (f/2 pi) sin(theta)
///          sum y_n c^n
/// @src derived from C-5, C-6; C-2 to C-4 are such polynomials as they stand
///
/// @param tooth      0-based
/// @param mark       teeth before, 1 ... teeth
/// @param tolerance  error allowed in the chip [m]
/// @return nothing where that tooth left no mark on some ray, or where the series needs
///         more harmonics than there are
std::optional<numerics::TrigPolynomial> harmonics_over_mark(const Passage& passage,
                                                            const Slice& slice,
                                                            int tooth, int mark,
                                                            double tolerance) noexcept;

}  // namespace trochoid::chip
