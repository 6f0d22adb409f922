#include <trochoid/files/surface_columns.h>

#include <trochoid/files/csv_columns.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace trochoid::files {

namespace {

using namespace std::string_view_literals;

// Names as `plain` makes them: small letters without blanks, `_` and `-`. Umlauts stand
// in UTF-8, then in Latin-1.
constexpr std::array x_names = {"x"sv, "position"sv, "pos"sv};
constexpr std::array step_names = {"step"sv, "k"sv};
constexpr std::array offset_names = {"feedoffset"sv};
constexpr std::array height_names = {"height"sv, "z"sv, "h\xC3\xB6he"sv, "h\xF6he"sv,
                                     "hoehe"sv};
constexpr std::array error_names = {"error"sv,      "deviation"sv, "dev"sv, "dev."sv,
                                    "abweichung"sv, "abw"sv,       "abw."sv};
constexpr std::array actual_names = {"actual"sv,  "measured"sv, "meas"sv,
                                     "meas."sv,   "act"sv,      "ist"sv,
                                     "istwert"sv, "messwert"sv};
constexpr std::array nominal_names = {"nominal"sv, "nom"sv, "nom."sv, "soll"sv,
                                      "sollwert"sv};
constexpr std::array tooth_names = {"tooth"sv, "zahn"sv};
constexpr std::array coordinate_names = {
    std::array{"x"sv, "xcoordinate"sv, "xcoord"sv, "xactual"sv, "actualx"sv, "xmeas"sv,
               "measx"sv, "measuredx"sv, "xmeasured"sv, "testx"sv, "xtest"sv, "xist"sv,
               "istx"sv},
    std::array{"y"sv, "ycoordinate"sv, "ycoord"sv, "yactual"sv, "actualy"sv, "ymeas"sv,
               "measy"sv, "measuredy"sv, "ymeasured"sv, "testy"sv, "ytest"sv, "yist"sv,
               "isty"sv},
    std::array{"z"sv, "zcoordinate"sv, "zcoord"sv, "zactual"sv, "actualz"sv, "zmeas"sv,
               "measz"sv, "measuredz"sv, "zmeasured"sv, "testz"sv, "ztest"sv, "zist"sv,
               "istz"sv}};
constexpr std::array axis_names = {"ax"sv, "axis"sv, "achse"sv};
constexpr std::array<NameList, 11> all_lists = {x_names,
                                                step_names,
                                                offset_names,
                                                height_names,
                                                error_names,
                                                tooth_names,
                                                actual_names,
                                                nominal_names,
                                                coordinate_names[0],
                                                coordinate_names[1],
                                                coordinate_names[2]};

bool among(std::string_view name, NameList list) {
  return std::find(list.begin(), list.end(), name) != list.end();
}

bool is_surface_name(std::string_view name) {
  return std::any_of(all_lists.begin(), all_lists.end(),
                     [&](NameList list) { return among(name, list); });
}

/// A search with its own problems, for heads that may not be one.
struct Trial {
  explicit Trial(const TableHead& head)
      : search{head, problems, notes, is_surface_name} {}
  Problems problems;
  std::vector<base::Warning> notes;
  ColumnSearch search;
};

/// Whether a coordinate changes where a reading lies, or what it is.
bool matters(const SurfaceSource& source, std::size_t axis, bool error_known) {
  const SurfaceFrame& frame = *source.frame;
  return (*frame.feed)[axis] != 0.0 || (!source.height && (*frame.up)[axis] != 0.0) ||
         (!error_known && (*frame.normal)[axis] != 0.0);
}

struct Finder {
  const ColumnSearch& search;
  const SurfaceSource& source;
  SurfaceColumns columns = {};

  [[nodiscard]] std::optional<TableColumn> found(NameList names,
                                                 Quantity quantity) const {
    const auto at = usual_column(search, names);
    return at ? std::optional(column_at(search, *at, quantity)) : std::nullopt;
  }
  void lacks(std::string_view wanted, std::string_view hint = "") const {
    search.problems.add(search.head.names_line, 1,
                        fmt::format("no column is named {}: the columns are {}{}",
                                    wanted, all_names(search.head), hint));
  }

  void find_values() {
    columns.step = found(step_names, Quantity::number);
    columns.feed_offset = found(offset_names, Quantity::length);
    columns.tooth = found(tooth_names, Quantity::number);
    columns.error = found(error_names, Quantity::length);
    columns.actual = found(actual_names, Quantity::length);
    columns.nominal = found(nominal_names, Quantity::length);
  }

  /// Where a reading lies, and its error if it has no column, by coordinates.
  void find_coordinates(const SurfaceFrame& frame) {
    const bool error_known = this->error_known();
    if (!error_known) columns.actual.reset();
    for (std::size_t i = 0; i < 3; ++i) {
      if (!matters(source, i, error_known)) continue;
      columns.coordinate[i] = found(coordinate_names[i], Quantity::length);
      if (!columns.coordinate[i]) {
        lacks(fmt::format("{0}, for example {0}_mm, which the frame of the case needs",
                          "XYZ"[i]));
      }
    }
    const bool along_axis =
        std::count(frame.normal->begin(), frame.normal->end(), 0.0) == 2;
    if (!error_known && columns.nominal && !along_axis) {
      search.problems.add(
          search.head.names_line, search.head.names[columns.nominal->index].column,
          "a nominal value alone tells an error where the normal of the frame is an axis "
          "of the machine: a column of deviations is needed");
    }
  }

  void find_place() {
    columns.x = found(x_names, Quantity::length);
    const bool points = has(coordinate_names[0]) && has(coordinate_names[1]) &&
                        has(coordinate_names[2]);
    constexpr std::string_view frame =
        "; for coordinates X, Y, Z the case says how the wall lies by frame = { feed = "
        "..., normal = ..., up = ..., origin_mm = [...] }";
    if (!columns.x && !columns.step) {
      lacks("x or position, for example x_mm, or step",
            points ? frame
            : columns.error && columns.actual
                ? "; a list of characteristics does not say where each point lies: "
                  "export the points with their coordinates"
                : "");
    }
    const auto height = found(height_names, Quantity::length);
    if (!source.height) {
      columns.height = height;
      if (!height) {
        lacks("height or z, for example height_mm",
              columns.x && !points
                  ? "; of a trace at one height the case says height_mm = ..."
                  : "");
      }
    } else if (!error_known()) {
      columns.error = height;  // as a roughness instrument has it
    } else if (height && base_name(search, height->name) != "z") {
      search.problems.add(search.head.names_line,
                          search.head.names[height->index].column,
                          fmt::format("column {} has the heights of the readings, but "
                                      "the case says height_mm: leave out one of both",
                                      excerpt(height->name)));
    }
    if (!error_known()) {
      lacks("error or deviation, for example error_mm",
            columns.actual || columns.nominal
                ? "; measured values need nominal values as well"
            : points ? frame
            : has(coordinate_names[2]) && !source.height
                ? "; of a trace at one height, whose z is the error, the case says "
                  "height_mm = ..."
                : "");
    }
  }

  [[nodiscard]] bool error_known() const {
    return columns.error || (columns.actual && columns.nominal);
  }
  [[nodiscard]] bool has(NameList names) const {
    return std::any_of(
        search.head.names.begin(), search.head.names.end(),
        [&](const Field& name) { return among(base_name(search, name.text), names); });
  }
};

SurfaceColumns find_with(const ColumnSearch& search, const SurfaceSource& source) {
  Finder finder{search, source};
  finder.find_values();
  if (source.frame) {
    finder.find_coordinates(*source.frame);
  } else {
    finder.find_place();
  }
  return finder.columns;
}

}  // namespace

SurfaceColumns find_surface_columns(const TableHead& head, const SurfaceSource& source,
                                    Problems& problems) {
  std::vector<base::Warning> notes;  // lengths without a unit are refused: none come
  const ColumnSearch search{head,
                            problems,
                            notes,
                            is_surface_name,
                            "leave out, or rename, the one that is not meant",
                            source.unit ? factor_of(*source.unit) : 0.0};
  if (lacks_names(search, surface_kind.example)) {
    return {};
  }
  return find_with(search, source);
}

bool names_surface(const TableHead& head, const SurfaceSource& source) {
  Trial trial(head);
  const SurfaceSource none;
  const Finder finder{trial.search, none};
  const auto has = [&](NameList names) { return finder.has(names); };
  const bool error = has(error_names) || (has(actual_names) && has(nominal_names));
  if (!source.frame) {
    const bool place = has(x_names) || has(step_names);
    // Of a trace at one height Z is the error.
    return place &&
           (source.height ? error || has(height_names) : error && has(height_names));
  }
  for (std::size_t i = 0; i < 3; ++i) {
    if (matters(source, i, error) && !has(coordinate_names[i])) return false;
  }
  return true;
}

std::size_t known_names(const TableHead& head) {
  Trial trial(head);
  return static_cast<std::size_t>(
      std::count_if(head.names.begin(), head.names.end(), [&](const Field& name) {
        return is_surface_name(base_name(trial.search, name.text));
      }));
}

bool lists_axes(const TableHead& head) {
  const auto has = [&](NameList names) {
    return std::any_of(head.names.begin(), head.names.end(), [&](const Field& name) {
      return among(plain(name.text), names);
    });
  };
  return has(axis_names) && (has(nominal_names) || has(actual_names));
}

std::vector<std::size_t> used_columns(const SurfaceColumns& columns) {
  std::vector<std::size_t> used;
  const auto add = [&](const std::optional<TableColumn>& column) {
    if (column) used.push_back(column->index);
  };
  for (const auto* column :
       {&columns.x, &columns.height, &columns.step, &columns.feed_offset,
        &columns.tooth, &columns.error, &columns.actual, &columns.nominal}) {
    add(*column);
  }
  for (const auto& column : columns.coordinate) {
    add(column);
  }
  std::sort(used.begin(), used.end());
  return used;
}

}  // namespace trochoid::files
