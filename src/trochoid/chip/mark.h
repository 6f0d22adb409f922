#pragma once

namespace trochoid::chip {

/// @brief Distance from the axis to the surface that an earlier tooth left on a ray.
///
/// @eq C-5 R_k sin(delta) + b (theta_p + delta) = 0, b = f cos(theta) / 2 pi
/// @eq C-6 L_k = R_k cos(delta) - f (theta_p + delta) sin(theta) / 2 pi
/// @src [riviere2009] eq. 10 with X = theta_p + delta, and eq. 13
/// @param R_k      radius of that tooth [m], positive
/// @param theta_p  how far that tooth is ahead [rad], in (0, 2 pi]
/// @param feed     f / 2 pi [m/rad]
/// @return L_k [m]; minus infinity where that tooth left no mark on the ray
double surface_left(double R_k, double theta_p, double feed, double sin_theta,
                    double cos_theta) noexcept;

}  // namespace trochoid::chip
