#include <trochoid/files/hdf5_record.h>

#include <trochoid/files/child_process.h>
#include <trochoid/files/csv.h>
#include <trochoid/files/disk_file.h>
#include <trochoid/files/hdf5_handle.h>
#include <trochoid/files/mat.h>
#include <trochoid/files/numeric_matrix.h>

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <memory>

#include <hdf5.h>

namespace trochoid::files {

namespace {

constexpr int deepest_group = 16;
constexpr std::size_t most_objects = 10000;
constexpr std::size_t longest_name = 1024;
constexpr int most_members = 1000;
/// Deflate packs at most 1032 to 1.
constexpr double densest_set = 1100.0;

/// What holds for all that a group holds.
struct Facts {
  std::string unit;
  double sample_rate = 0.0;
};

/// Where a column is found.
struct Hdf5Source {
  std::string path;
  std::string member;  ///< of a compound; empty: the data set is of numbers
  MatrixPart part;     ///< as the library counts rows and columns
  bool flat = false;   ///< of one dimension
};

struct Hdf5Reading {
  const std::string& name;
  hid_t file = -1;
  NumericTable table;
  std::vector<Hdf5Source> sources;
  std::size_t objects = 0;
  bool matlab = false;  ///< rows and columns are swapped, and classes are stated
  bool tables = false;  ///< there are objects of MATLAB, tables perhaps
};

/// What the attributes of an object change.
Facts facts_of(hid_t object, Facts facts) {
  if (auto unit = hdf5_text(object, "unit")) facts.unit = std::move(*unit);
  if (const auto rate = hdf5_number(object, "sample_rate_Hz")) {
    facts.sample_rate = *rate;
  } else if (const auto step = hdf5_number(object, "dt")) {
    facts.sample_rate = *step > 0.0 ? 1.0 / *step : 0.0;
  }
  return facts;
}

/// Whether the numbers are there and no packing hides too many; else why not.
std::string hidden_size(hid_t set, double count) {
  const Hdf5Handle list(H5Dget_create_plist(set), H5Pclose);
  const Hdf5Handle type(H5Dget_type(set), H5Tclose);
  if (!list.open() || !type.open()) return "it cannot be read";
  if (H5Pget_external_count(list.id()) > 0 || H5Pget_layout(list.id()) == H5D_VIRTUAL) {
    return "its numbers lie in other files, which are not read";
  }
  const auto each = static_cast<double>(H5Tget_size(type.id()));
  if (count * 8.0 > largest_record || count * each > largest_record) {
    return fmt::format(
        "it says that it has {:.3g} numbers: at most {:.2g} bytes are "
        "read; save a part of the record",
        count, largest_record);
  }
  const auto stored = static_cast<double>(H5Dget_storage_size(set));
  if (count * each > densest_set * std::max(stored, 64.0)) {
    return fmt::format(
        "{:.3g} bytes of it are to come out of {:.3g}, which no packing "
        "does: it was never written, or the file is damaged",
        count * each, stored);
  }
  std::array<hsize_t, 2> chunk{1, 1};
  if (H5Pget_layout(list.id()) == H5D_CHUNKED &&
      H5Pget_chunk(list.id(), 2, chunk.data()) > 0 &&
      static_cast<double>(chunk[0]) * static_cast<double>(chunk[1]) * each >
          largest_record) {
    return "one chunk of it is larger than what is read of a record";
  }
  return {};
}

/// A data set of compounds: each member that is a number is a column.
void add_members(Hdf5Reading& reading, hid_t type, const Hdf5Source& whole,
                 const Facts& facts) {
  const int members = std::min(H5Tget_nmembers(type), most_members);
  for (int i = 0; i < members; ++i) {
    const auto at = static_cast<unsigned>(i);
    const auto kind = H5Tget_member_class(type, at);
    if (kind != H5T_INTEGER && kind != H5T_FLOAT) continue;
    char* text = H5Tget_member_name(type, at);
    if (text == nullptr) continue;
    Hdf5Source source = whole;
    source.member = text;
    H5free_memory(text);
    // Members are of different kinds: the unit of all is none of theirs.
    reading.table.columns.push_back(
        {.name = source.member,
         .path = fmt::format("{}.{}", whole.path, source.member),
         .count = source.part.count(),
         .sample_rate = facts.sample_rate});
    reading.sources.push_back(source);
  }
}

/// Whether a data set of MATLAB is an array of numbers; notes its objects.
bool is_matlab_array(Hdf5Reading& reading, hid_t set) {
  const auto stated = hdf5_text(set, "MATLAB_class");
  if (H5Aexists(set, "MATLAB_object_decode") > 0) reading.tables = true;
  return stated && *stated != "char" && *stated != "cell" && !reading.tables &&
         H5Aexists(set, "MATLAB_empty") <= 0;
}

void add_set(Hdf5Reading& reading, hid_t set, const NumericColumn& named,
             const Facts& around) {
  const Hdf5Handle space(H5Dget_space(set), H5Sclose);
  const Hdf5Handle type(H5Dget_type(set), H5Tclose);
  std::array<hsize_t, 2> size{0, 1};
  const int rank = space.open() ? H5Sget_simple_extent_ndims(space.id()) : -1;
  if (!type.open() || rank < 1 || rank > 2 ||
      H5Sget_simple_extent_dims(space.id(), size.data(), nullptr) < 0 ||
      (reading.matlab && !is_matlab_array(reading, set))) {
    return;
  }
  const auto kind = H5Tget_class(type.id());
  const auto rows = static_cast<std::size_t>(size[0]);
  const auto columns = static_cast<std::size_t>(size[1]);
  const Facts facts = facts_of(set, around);
  Hdf5Source source{.path = named.path, .member = {}, .part = {}, .flat = rank == 1};
  if (kind == H5T_COMPOUND && rank == 1 && rows > 1) {
    source.part = {.rows = rows, .columns = 1};
    add_members(reading, type.id(), source, facts);
  }
  if (kind != H5T_INTEGER && kind != H5T_FLOAT) return;
  NumericColumn like = named;
  like.unit = facts.unit;
  like.sample_rate = facts.sample_rate;
  if (reading.matlab) std::replace(like.path.begin(), like.path.end(), '/', '.');
  const auto all = reading.matlab ? matrix_columns(like, columns, rows)
                                  : matrix_columns(like, rows, columns);
  for (const auto& [column, part] : all) {
    reading.table.columns.push_back(column);
    source.part = part;
    if (reading.matlab) {
      std::swap(source.part.rows, source.part.columns);
      std::swap(source.part.row, source.part.column);
    }
    reading.sources.push_back(source);
  }
}

/// All data sets of a group and of those in it. Links into other files are not followed.
void add_group(Hdf5Reading& reading, hid_t group, const std::string& path,
               const Facts& around, int depth) {
  H5G_info_t info;
  if (depth > deepest_group || H5Gget_info(group, &info) < 0) return;
  const Facts facts = facts_of(group, around);
  for (hsize_t i = 0; i < info.nlinks; ++i) {
    if (++reading.objects > most_objects) {
      refuse(reading.name, fmt::format("the file has more than {} objects: save the "
                                       "forces alone",
                                       most_objects));
    }
    std::array<char, longest_name> text{};
    const auto length = H5Lget_name_by_idx(group, ".", H5_INDEX_NAME, H5_ITER_INC, i,
                                           text.data(), text.size(), H5P_DEFAULT);
    if (length <= 0 || static_cast<std::size_t>(length) >= text.size()) continue;
    H5L_info_t link;
    if (H5Lget_info(group, text.data(), &link, H5P_DEFAULT) < 0 ||
        link.type != H5L_TYPE_HARD) {
      continue;
    }
    const Hdf5Handle object(H5Oopen(group, text.data(), H5P_DEFAULT), H5Oclose);
    const auto kind = object.open() ? H5Iget_type(object.id()) : H5I_BADID;
    const std::string leaf = text.data();
    if (reading.matlab && leaf.starts_with('#')) continue;  // of MATLAB's own
    const std::string inside = path.empty() ? leaf : fmt::format("{}/{}", path, leaf);
    if (kind == H5I_GROUP) add_group(reading, object.id(), inside, facts, depth + 1);
    if (kind == H5I_DATASET) {
      add_set(reading, object.id(), {.name = leaf, .path = inside}, facts);
    }
  }
}

/// What is selected of a data set: all of it, or one column or row of a matrix.
bool select(hid_t space, const Hdf5Source& source) {
  if (source.flat) return H5Sselect_all(space) >= 0;
  const MatrixPart& part = source.part;
  std::array<hsize_t, 2> start{part.row.value_or(0), part.column.value_or(0)};
  std::array<hsize_t, 2> count{part.row ? 1 : part.rows,
                               part.column ? 1 : part.columns};
  return H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, count.data(),
                             nullptr) >= 0;
}

std::vector<double> values_of(hid_t file, const std::string& name,
                              const Hdf5Source& source) {
  const auto refuse_set = [&](const std::string& why) {
    refuse(name, fmt::format("the data set {}: {}", excerpt(source.path), why));
  };
  const Hdf5Handle set(H5Dopen2(file, source.path.c_str(), H5P_DEFAULT), H5Dclose);
  const Hdf5Handle space(set.open() ? H5Dget_space(set.id()) : -1, H5Sclose);
  if (!space.open()) refuse_set("it cannot be opened: the file is damaged");
  const auto all = H5Sget_simple_extent_npoints(space.id());
  const auto why = hidden_size(set.id(), static_cast<double>(all));
  if (!why.empty()) refuse_set(why);
  const hsize_t count = source.part.count();
  const Hdf5Handle memory(H5Screate_simple(1, &count, nullptr), H5Sclose);
  const Hdf5Handle member(
      source.member.empty() ? -1 : H5Tcreate(H5T_COMPOUND, sizeof(double)), H5Tclose);
  if (member.open())
    H5Tinsert(member.id(), source.member.c_str(), 0, H5T_NATIVE_DOUBLE);
  const hid_t type = source.member.empty() ? H5T_NATIVE_DOUBLE : member.id();
  std::vector<double> values(source.part.count());
  if (!select(space.id(), source) ||
      H5Sget_select_npoints(space.id()) != static_cast<hssize_t>(source.part.count()) ||
      H5Dread(set.id(), type, memory.id(), space.id(), H5P_DEFAULT, values.data()) <
          0) {
    refuse_set(
        "its numbers cannot be read: the file is damaged or cut off, or packed "
        "by a filter that is not installed");
  }
  return values;
}

NumericTable hdf5_table(std::shared_ptr<Hdf5Handle> file, const std::string& name,
                        Hdf5Kind kind) {
  Hdf5Reading reading{
      .name = name, .file = file->id(), .matlab = kind == Hdf5Kind::matlab};
  const Hdf5Handle root(H5Gopen2(file->id(), "/", H5P_DEFAULT), H5Gclose);
  if (root.open()) add_group(reading, root.id(), "", {}, 0);
  if (reading.tables && reading.table.columns.size() < 3) refuse_matlab_object(name);
  auto table = std::move(reading.table);
  table.values = [file, name, sources = std::move(reading.sources)](std::size_t i) {
    return values_of(file->id(), name, sources[i]);
  };
  return table;
}

}  // namespace

signal::Record read_hdf5_columns(std::istream& in, const std::string& name,
                                 const RecordSource& source, Hdf5Kind kind) {
  const DiskFile disk(in, name, source);
  return read_in_child_process(name, [&] {
    const Hdf5Silence silence;
    const auto file = std::make_shared<Hdf5Handle>(
        H5Fopen(disk.path().c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
    if (!file->open()) {
      refuse(name,
             "this HDF5 file cannot be opened: it is cut off or damaged, or another "
             "program still writes it");
    }
    auto table = hdf5_table(file, name, kind);
    name_only_matrix(table, name, source);
    return record_of(table, name, source);
  });
}

}  // namespace trochoid::files
