#include <trochoid/numerics/student.h>

#include <boost/math/distributions/students_t.hpp>

namespace trochoid::numerics {

double student_t(double probability, double freedom) {
  return boost::math::quantile(boost::math::students_t(freedom), probability);
}

}  // namespace trochoid::numerics
