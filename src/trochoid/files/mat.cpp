#include <trochoid/files/hdf5_record.h>
#include <trochoid/files/mat.h>
#include <trochoid/files/numeric_matrix.h>

namespace trochoid::files {

bool is_mat(std::string_view head) {
  constexpr std::size_t text_of_head = 116;
  return head.starts_with("MATLAB ") &&
         head.substr(0, text_of_head).find("MAT-file") != std::string_view::npos;
}

signal::Record read_mat_record(std::istream& in, const std::string& name,
                               const RecordSource& source) {
  std::string head(4096, '\0');
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(in.gcount()));
  if (is_hdf5(head)) return read_hdf5_columns(in, name, source, Hdf5Kind::matlab);
  auto table = mat5_table(in, name);
  name_only_matrix(table, name, source);
  return record_of(table, name, source);
}

void refuse_matlab_object(const std::string& name) {
  refuse(
      name,
      "the file contains an object, perhaps a table or timetable, which only MATLAB "
      "reads: save it as a struct, for example: s = table2struct(T, 'ToScalar', true); "
      "save('record.mat', '-struct', 's'); of a timetable, T = timetable2table(TT) "
      "first");
}

}  // namespace trochoid::files
