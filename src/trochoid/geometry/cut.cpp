#include <trochoid/geometry/cut.h>

namespace trochoid::geometry {

namespace {

struct ToBand {
  double D;
  Band operator()(const Slot& /*slot*/) const { return {}; }
  Band operator()(const UpMilling& up) const { return {.y_lo = D / 2 - up.a_e}; }
  Band operator()(const DownMilling& down) const {
    return {.y_hi = -(D / 2 - down.a_e)};
  }
  Band operator()(const Band& band) const { return band; }
  Band operator()(const Arcs& /*arcs*/) const { return {}; }
};

}  // namespace

Band stock_band(const Engagement& engagement, double D) {
  return std::visit(ToBand{D}, engagement);
}

}  // namespace trochoid::geometry
