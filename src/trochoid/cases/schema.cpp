#include <trochoid/base/unit_of_key.h>
#include <trochoid/cases/number_text.h>
#include <trochoid/cases/schema.h>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <cmath>

namespace trochoid::cases {

namespace {

std::string in_words(const Range& range) {
  const std::string low = number_text(range.low);
  const std::string high = number_text(range.high);
  if (std::isinf(range.low) && std::isinf(range.high)) {
    return "";
  }
  if (std::isinf(range.high)) {
    return fmt::format(" {} {}", range.open_low ? "above" : "of at least", low);
  }
  if (!range.open_low && !range.open_high) {
    return fmt::format(" from {} to {}", low, high);
  }
  return fmt::format(" {} {} and {} {}", range.open_low ? "above" : "of at least", low,
                     range.open_high ? "below" : "at most", high);
}

/// `"-y"`, or three numbers.
std::string direction_text(const files::Direction& direction) {
  constexpr std::string_view axes = "xyz";
  for (std::size_t i = 0; i < 3; ++i) {
    for (const double sign : {1.0, -1.0}) {
      files::Direction axis{};
      axis[i] = sign;
      if (direction == axis) {
        return fmt::format("\"{}{}\"", sign > 0 ? '+' : '-', axes[i]);
      }
    }
  }
  return fmt::format("[{}, {}, {}]", number_text(direction[0]),
                     number_text(direction[1]), number_text(direction[2]));
}

struct Expectation {
  const Key& key;

  [[nodiscard]] std::string limits() const {
    const std::string_view symbol = unit::of_key(key.name).symbol;
    const std::string words = in_words(key.range);
    if (words.empty()) {
      return symbol.empty() ? "" : fmt::format(" in {}", symbol);
    }
    return symbol.empty() ? words : fmt::format("{} {}", words, symbol);
  }
  [[nodiscard]] std::string list(std::string_view what) const {
    if (key.gaps) return fmt::format("a list of up to {} {}", key.count, what);
    return key.count > 0 ? fmt::format("a list of {} {}", key.count, what)
                         : fmt::format("a list of {}", what);
  }
  std::string operator()(const bool*) const { return "true or false"; }
  std::string operator()(const int*) const {
    return key.range.low == key.range.high
               ? fmt::format("the whole number {}", number_text(key.range.low))
               : "a whole number" + limits();
  }
  std::string operator()(const double*) const { return "a number" + limits(); }
  std::string operator()(const std::optional<double>*) const {
    return "a number" + limits();
  }
  std::string operator()(const std::string*) const { return "text"; }
  std::string operator()(const files::FileRef*) const { return "text"; }
  std::string operator()(const std::vector<double>*) const {
    return list("numbers") + limits();
  }
  std::string operator()(const std::optional<base::Steps>*) const {
    return "a list of 3 numbers" + limits();
  }
  std::string operator()(const std::vector<std::string>*) const {
    return list("texts");
  }
  std::string operator()(const Rows*) const {
    return fmt::format("{} rows of 3 numbers", key.count > 0 ? key.count : 3) +
           limits();
  }
  std::string operator()(const Pairs*) const {
    return "a list of pairs of numbers" + limits();
  }
  std::string operator()(const ArcLayers*) const {
    return "a list of tables { from_mm = z, to_mm = z, arcs_deg = [[from, to], ...] }";
  }
  std::string operator()(const std::optional<StockCylinder>*) const {
    return "a table { axis_xy = [x, y], radius = r, z = [low, high] }";
  }
  std::string operator()(const ToolName*) const { return "a whole number or a text"; }
  std::string operator()(const std::vector<ToolName>*) const {
    return "a list of whole numbers or texts";
  }
  std::string operator()(const NamedPlaces*) const {
    return "a table { name = [x, y, z], ... }";
  }
  std::string operator()(const NamedFiles*) const {
    return "a table { name = \"file\", ... }";
  }
  std::string operator()(const Choice& c) const {
    return fmt::format("one of \"{}\"", fmt::join(c.names, "\", \""));
  }
  std::string operator()(const Choices& c) const {
    return fmt::format("{}a list with any of \"{}\"", c.alone ? "one, or " : "",
                       fmt::join(c.names, "\", \""));
  }
  std::string operator()(const CutTable*) const {
    return "a table { key = value, ... }";
  }
  std::string operator()(const std::optional<PreviousClamping>*) const {
    return "a table { key = value, ... }";
  }
  std::string operator()(const std::optional<files::SurfaceFrame>*) const {
    return "a table { key = value, ... }";
  }
  std::string operator()(const std::optional<geometry::Serration>*) const {
    return "a table { key = value, ... }";
  }
  std::string operator()(const std::optional<base::Normal>*) const {
    return "a table { mean = value, sd = value }, both numbers" + limits();
  }
  std::string operator()(const PerTooth*) const {
    return fmt::format("a number{0}, or a list of one for each tooth", limits());
  }
  std::string operator()(const std::optional<files::Direction>*) const {
    return "one of \"+x\", \"-x\", \"+y\", \"-y\", \"+z\", \"-z\", or 3 numbers";
  }
};

struct ValueWriter {
  using Text = std::optional<std::string>;
  const Key& key;
  double factor = unit::of_key(key.name).factor;

  Text operator()(const bool* v) const { return *v ? "true" : "false"; }
  Text operator()(const int* v) const { return std::to_string(*v); }
  Text operator()(const double* v) const { return number_text(*v, factor); }
  Text operator()(const std::optional<double>* v) const {
    if (*v) {
      return number_text(**v, factor);
    }
    return key.word.empty() ? Text{} : toml_string(key.word);
  }
  Text operator()(const std::string* v) const {
    return v->empty() ? Text{} : toml_string(*v);
  }
  Text operator()(const files::FileRef* v) const { return (*this)(&v->name); }
  Text operator()(const std::vector<double>* v) const {
    std::vector<std::string> entries;
    entries.reserve(v->size());
    for (const double entry : *v) {
      entries.push_back(number_text(entry, factor));
    }
    if (v->empty()) {
      return key.word.empty() ? Text{} : toml_string(key.word);
    }
    return fmt::format("[{}]", fmt::join(entries, ", "));
  }
  Text operator()(const PerTooth* v) const {
    return v->listed ? (*this)(&v->values) : number_text(v->values.front(), factor);
  }
  Text operator()(const std::optional<base::Steps>* v) const {
    return *v ? fmt::format("[{}, {}, {}]", number_text((*v)->first, factor),
                            number_text((*v)->last, factor), number_text((*v)->count))
              : Text{};
  }
  Text operator()(const std::vector<std::string>* v) const {
    if (v->size() == 1 && v->front() == key.word) {
      return toml_string(key.word);
    }
    std::vector<std::string> entries;
    entries.reserve(v->size());
    for (const std::string& entry : *v) {
      entries.push_back(toml_string(entry));
    }
    return v->empty() ? Text{} : fmt::format("[{}]", fmt::join(entries, ", "));
  }
  Text operator()(const Rows* v) const {
    std::vector<std::string> rows;
    rows.reserve(v->size());
    for (const auto& r : *v) {
      rows.push_back(fmt::format("[{}, {}, {}]", number_text(r[0], factor),
                                 number_text(r[1], factor), number_text(r[2], factor)));
    }
    return v->empty() ? Text{} : fmt::format("[{}]", fmt::join(rows, ", "));
  }
  Text operator()(const Pairs* v) const {
    std::vector<std::string> rows;
    rows.reserve(v->size());
    for (const auto& pair : *v) rows.push_back(pair_text(pair));
    return v->empty() ? Text{} : fmt::format("[{}]", fmt::join(rows, ", "));
  }
  Text operator()(const ArcLayers* v) const {
    std::vector<std::string> layers;
    for (const ArcLayerTable& layer : *v) {
      std::vector<std::string> arcs;
      for (const auto& arc : layer.arcs) {
        arcs.push_back(fmt::format("[{}, {}]", number_text(arc[0], unit::deg),
                                   number_text(arc[1], unit::deg)));
      }
      layers.push_back(fmt::format("{{ from_mm = {}, to_mm = {}, arcs_deg = [{}] }}",
                                   number_text(layer.from, unit::mm),
                                   number_text(layer.to, unit::mm),
                                   fmt::join(arcs, ", ")));
    }
    return layers.empty() ? Text{} : fmt::format("[{}]", fmt::join(layers, ", "));
  }
  [[nodiscard]] std::string pair_text(const std::array<double, 2>& pair) const {
    return fmt::format("[{}, {}]", number_text(pair[0], factor),
                       number_text(pair[1], factor));
  }
  Text operator()(const std::optional<StockCylinder>* v) const {
    if (!*v) return std::nullopt;
    return fmt::format("{{ axis_xy = {}, radius = {}, z = {} }}", pair_text((*v)->axis),
                       number_text((*v)->radius, factor), pair_text((*v)->z));
  }
  /// A number where it is one.
  static std::string tool_text(const ToolName& tool) {
    constexpr std::size_t longest = 9;
    const bool number = tool.text.size() <= longest &&
                        (tool.text.size() == 1 || !tool.text.starts_with('0')) &&
                        tool.text.find_first_not_of("0123456789") == std::string::npos;
    return number ? tool.text : toml_string(tool.text);
  }
  Text operator()(const ToolName* v) const {
    return v->text.empty() ? Text{} : Text(tool_text(*v));
  }
  Text operator()(const std::vector<ToolName>* v) const {
    std::vector<std::string> all;
    all.reserve(v->size());
    for (const ToolName& tool : *v) all.push_back(tool_text(tool));
    return v->empty() ? Text{} : fmt::format("[{}]", fmt::join(all, ", "));
  }
  Text operator()(const NamedPlaces* v) const {
    std::vector<std::string> all;
    for (const auto& [name, p] : *v) {
      all.push_back(fmt::format("{} = [{}, {}, {}]", toml_string(name),
                                number_text(p[0], factor), number_text(p[1], factor),
                                number_text(p[2], factor)));
    }
    return all.empty() ? Text{} : fmt::format("{{ {} }}", fmt::join(all, ", "));
  }
  Text operator()(const NamedFiles* v) const {
    std::vector<std::string> all;
    for (const auto& [name, file] : *v) {
      all.push_back(fmt::format("{} = {}", toml_string(name), toml_string(file.name)));
    }
    return all.empty() ? Text{} : fmt::format("{{ {} }}", fmt::join(all, ", "));
  }
  Text operator()(const Choice& c) const {
    return toml_string(c.names[static_cast<std::size_t>(c.get())]);
  }
  Text operator()(const Choices& c) const {
    std::vector<std::string> entries;
    for (const int i : c.get()) {
      entries.push_back(toml_string(c.names[static_cast<std::size_t>(i)]));
    }
    if (c.alone && entries.size() == 1) return entries.front();
    return entries.empty() ? Text{} : fmt::format("[{}]", fmt::join(entries, ", "));
  }
  Text operator()(const std::optional<base::Normal>* v) const {
    if (!*v) return std::nullopt;
    return fmt::format("{{ mean = {}, sd = {} }}", number_text((*v)->mean, factor),
                       number_text((*v)->sd, factor));
  }
  Text operator()(const std::optional<files::Direction>* v) const {
    return *v ? Text(direction_text(**v)) : Text{};
  }
  Text operator()(const std::optional<PreviousClamping>*) const { return {}; }
  Text operator()(const std::optional<files::SurfaceFrame>*) const {
    return {};
  }  // these
  Text operator()(const std::optional<geometry::Serration>*) const { return {}; }
  Text operator()(const CutTable*) const { return {}; }  // write_case.cpp does it
};

}  // namespace

std::string heading(const TableEntry& table) {
  return fmt::format(fmt::runtime(table.many ? "[[{}]]" : "[{}]"), table.name);
}

std::string meaning_of(const Key& key) {
  if (key.only.selector.empty()) {
    return std::string(key.meaning);
  }
  return fmt::format("only for `{}` = `\"{}\"`: {}", key.only.selector,
                     fmt::join(key.only.values, "\"`, `\""), key.meaning);
}

std::string expectation(const Key& key, const Field& field) {
  const std::string text = std::visit(Expectation{key}, field);
  return key.word.empty() ? text : fmt::format("{}, or \"{}\"", text, key.word);
}

std::optional<std::string> toml_text(const Key& key, const Field& field) {
  return std::visit(ValueWriter{key}, field);
}

}  // namespace trochoid::cases
