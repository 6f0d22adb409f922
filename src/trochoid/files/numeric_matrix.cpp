#include <trochoid/files/numeric_matrix.h>

#include <trochoid/files/csv.h>
#include <trochoid/files/record_file_columns.h>

#include <fmt/core.h>

#include <algorithm>
#include <array>

namespace trochoid::files {

namespace {

constexpr std::size_t widest_matrix = 100;

}  // namespace

std::size_t MatrixPart::count() const {
  return column ? rows : row ? columns : rows * columns;
}

std::vector<MatrixColumn> matrix_columns(const NumericColumn& like, std::size_t rows,
                                         std::size_t columns) {
  std::vector<MatrixColumn> all;
  const std::size_t least = std::min(rows, columns);
  const auto add = [&](NumericColumn column, const MatrixPart& part) {
    column.count = part.count();
    all.push_back({std::move(column), part});
  };
  if (std::max(rows, columns) < 2 || least == 0 || least > widest_matrix) return all;
  const bool lies = rows < columns;
  for (std::size_t i = 0; i < least; ++i) {
    MatrixPart part{.rows = rows, .columns = columns};
    (lies ? part.row : part.column) = i;
    NumericColumn column = like;
    if (least > 1) {
      const auto index =
          lies ? fmt::format("({},:)", i + 1) : fmt::format("(:,{})", i + 1);
      column.name = like.name + index;
      column.path = like.path + index;
      column.matrix = like.path;
      column.width = least;
      column.place = i;
    }
    add(std::move(column), part);
  }
  return all;
}

void name_only_matrix(NumericTable& table, const std::string& name,
                      const RecordSource& source) {
  auto& columns = table.columns;
  if (!source.columns.empty() ||
      std::any_of(columns.begin(), columns.end(), [](const NumericColumn& column) {
        return column.matrix.empty() && names_force(column.name);
      })) {
    return;
  }
  const auto fits = [](const NumericColumn& column) {
    return column.place == 0 && (column.width == 3 || column.width == 4);
  };
  const auto first = std::find_if(columns.begin(), columns.end(), fits);
  if (first == columns.end()) return;
  const auto second = std::find_if(first + 1, columns.end(), fits);
  if (second != columns.end()) {
    refuse(name,
           fmt::format("{} and {} could both be the forces: columns = [...] in "
                       "[[measurement]] names the three that are meant, for example {}",
                       excerpt(first->matrix), excerpt(second->matrix),
                       excerpt(first->name)));
  }
  constexpr std::array names = {"time", "Fx", "Fy", "Fz"};
  const std::size_t shift = first->width == 3 ? 1 : 0;
  table.notes.push_back(
      {"columns_assumed",
       fmt::format("The columns of {} have no names; they were taken for {}Fx, Fy, Fz, "
                   "in this order.",
                   first->matrix.empty() ? "the matrix" : excerpt(first->matrix),
                   shift == 0 ? "time, " : "")});
  for (auto column = first; column != first + static_cast<int>(first->width);
       ++column) {
    column->name = names[column->place + shift];
  }
}

}  // namespace trochoid::files
