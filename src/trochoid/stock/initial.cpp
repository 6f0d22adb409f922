#include <trochoid/stock/initial.h>

#include <trochoid/base/overloaded.h>

#include <algorithm>
#include <numbers>

namespace trochoid::stock {

Heights heights(const Initial& stock) noexcept {
  return std::visit(base::Overloaded{[](const Box& box) {
                                       return Heights{box.low[2], box.high[2]};
                                     },
                                     [](const Cylinder& c) {
                                       return Heights{c.bottom, c.top};
                                     },
                                     [](const HeightField& field) {
                                       return Heights{field.bottom, field.highest};
                                     }},
                    stock);
}

double volume(const Initial& stock) noexcept {
  return std::visit(
      base::Overloaded{
          [](const Box& box) {
            return (box.high[0] - box.low[0]) * (box.high[1] - box.low[1]) *
                   (box.high[2] - box.low[2]);
          },
          [](const Cylinder& c) {
            return std::numbers::pi * c.radius * c.radius * (c.top - c.bottom);
          },
          [](const HeightField& field) {
            double sum = 0.0;
            const auto at = [&](int row, int column) {
              const auto i = static_cast<std::size_t>(row) *
                                 static_cast<std::size_t>(field.columns) +
                             static_cast<std::size_t>(column);
              return std::max(static_cast<double>(field.top[i]) - field.bottom, 0.0);
            };
            for (int i = 0; i + 1 < field.rows; ++i) {
              for (int j = 0; j + 1 < field.columns; ++j) {
                sum += at(i, j) + at(i, j + 1) + at(i + 1, j) + at(i + 1, j + 1);
              }
            }
            return sum / 4 * field.cell * field.cell;
          }},
      stock);
}

double top_at(const HeightField& field, double x, double y) noexcept {
  const double u = (x - field.origin[0]) / field.cell;
  const double v = (y - field.origin[1]) / field.cell;
  if (!(u >= 0 && v >= 0 && u <= field.columns - 1 && v <= field.rows - 1) ||
      field.columns < 2 || field.rows < 2) {
    return field.bottom;
  }
  const int j = std::min(static_cast<int>(u), field.columns - 2);
  const int i = std::min(static_cast<int>(v), field.rows - 2);
  const double a = u - j;
  const double b = v - i;
  const float* at =
      &field.top[static_cast<std::size_t>(i) * static_cast<std::size_t>(field.columns) +
                 static_cast<std::size_t>(j)];
  const float* next = at + field.columns;
  return (1 - b) *
             ((1 - a) * static_cast<double>(at[0]) + a * static_cast<double>(at[1])) +
         b * ((1 - a) * static_cast<double>(next[0]) +
              a * static_cast<double>(next[1]));
}

bool contains(const Initial& stock, double x, double y, double z) noexcept {
  return std::visit(
      base::Overloaded{[&](const Box& box) {
                         return x > box.low[0] && x < box.high[0] && y > box.low[1] &&
                                y < box.high[1] && z > box.low[2] && z < box.high[2];
                       },
                       [&](const Cylinder& c) {
                         const double dx = x - c.axis[0];
                         const double dy = y - c.axis[1];
                         return dx * dx + dy * dy < c.radius * c.radius &&
                                z > c.bottom && z < c.top;
                       },
                       [&](const HeightField& field) {
                         return z > field.bottom && z < top_at(field, x, y);
                       }},
      stock);
}

}  // namespace trochoid::stock
