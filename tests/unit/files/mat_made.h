#pragma once

#include <matio.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

/// MATLAB files for tests, of every version, made by matio.
namespace trochoid::files::made {

struct MatVariable {
  std::string name;
  std::vector<double> values;
  std::size_t rows = 0;  ///< 0: one column
};

inline matvar_t* mat_variable(const MatVariable& v) {
  const std::size_t rows = v.rows == 0 ? v.values.size() : v.rows;
  std::array<std::size_t, 2> dims{rows, v.values.size() / rows};
  return Mat_VarCreate(v.name.c_str(), MAT_C_DOUBLE, MAT_T_DOUBLE, 2, dims.data(),
                       const_cast<double*>(v.values.data()), 0);
}

/// @param structure  not empty: the variables are fields of a struct of this name
inline std::string mat_file(const std::vector<MatVariable>& variables, mat_ft version,
                            matio_compression packed = MAT_COMPRESSION_NONE,
                            const std::string& structure = {}) {
  const auto path = std::filesystem::temp_directory_path() /
                    ("trochoid-mat-" + std::to_string(getpid()) + ".mat");
  mat_t* file = Mat_CreateVer(path.c_str(), nullptr, version);
  if (structure.empty()) {
    for (const auto& v : variables) {
      matvar_t* variable = mat_variable(v);
      Mat_VarWrite(file, variable, packed);
      Mat_VarFree(variable);
    }
  } else {
    std::vector<const char*> names;
    for (const auto& v : variables) names.push_back(v.name.c_str());
    const std::array<std::size_t, 2> one{1, 1};
    matvar_t* parent =
        Mat_VarCreateStruct(structure.c_str(), 2, const_cast<std::size_t*>(one.data()),
                            names.data(), static_cast<unsigned>(names.size()));
    for (const auto& v : variables) {
      Mat_VarSetStructFieldByName(parent, v.name.c_str(), 0, mat_variable(v));
    }
    Mat_VarWrite(file, parent, packed);
    Mat_VarFree(parent);
  }
  Mat_Close(file);
  std::ifstream in(path, std::ios::binary);
  std::string bytes{std::istreambuf_iterator<char>(in), {}};
  std::filesystem::remove(path);
  return bytes;
}

}  // namespace trochoid::files::made
