#pragma once

#include <trochoid/chip/chip.h>
#include <trochoid/numerics/trig_polynomial.h>

#include <optional>

namespace trochoid::chip {

/// Above this f/(2 pi R) the series of C-9 may not converge for every mark, and the bounds
/// of MarkEstimate are not known to hold.
inline constexpr double largest_feed = 0.1;

/// @brief The chip over a mark to second order in the feed, with u = sin(theta): between
/// mean + sine u + square (1 - u^2) - (skew |u| + rest) and the same plus.
struct MarkEstimate {
  double mean = 0.0;
  double sine = 0.0;
  double square = 0.0;
  double skew = 0.0;
  double rest = 0.0;
};

/// @param mark  teeth before, 1 ... teeth
/// @note  Of the effective theta for the exact chip, of the nominal one for simple models.
MarkEstimate estimate_over_mark(const Passage& passage, const Slice& slice, int tooth,
                                int mark) noexcept;

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
/// @return nothing where the feed is too large for the series (a above 0.1), or it needs
///         more harmonics than there are
std::optional<numerics::TrigPolynomial> harmonics_over_mark(const Passage& passage,
                                                            const Slice& slice,
                                                            int tooth, int mark,
                                                            double tolerance) noexcept;

}  // namespace trochoid::chip
