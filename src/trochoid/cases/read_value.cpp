#include <trochoid/base/unit_of_key.h>
#include <trochoid/cases/read_value.h>
#include <trochoid/cases/usual_values.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace trochoid::cases {

namespace {

bool contains(const Range& range, double value) {
  return (range.open_low ? value > range.low : value >= range.low) &&
         (range.open_high ? value < range.high : value <= range.high);
}

/// `+x`, `x` or `-X`
std::optional<files::Direction> axis_named(std::string_view text) {
  const bool minus = text.starts_with('-');
  if (minus || text.starts_with('+')) text.remove_prefix(1);
  const auto at = std::string_view("xyzXYZ").find(text);
  if (text.size() != 1 || at == std::string_view::npos) return std::nullopt;
  files::Direction direction{};
  direction[at % 3] = minus ? -1.0 : 1.0;
  return direction;
}

struct ValueReader {
  const Node& node;
  const std::string& path;
  const Key& key;
  const Field& field;
  Findings& findings;
  unit::Named unit = unit::of_key(key.name);

  /// @param at     the value that does not fit, or an entry of it
  /// @param entry  1, 2 ... in a list; 0: not in a list
  void refuse(const Node& at, std::size_t entry, std::string_view why) const {
    const std::string what = entry > 0 ? fmt::format("{} entry {}", path, entry) : path;
    report(findings, path, at.where,
           fmt::format("{} = {}: {}; must be {} ({})", what, shown_value(key.name, at),
                       why, expectation(key, field), key.meaning));
  }
  std::optional<double> number(const Node& at, std::size_t entry) const {
    const auto value = number_in(at);
    if (!value) {
      refuse(at, entry, "not a number");
    } else if (!std::isfinite(*value)) {
      refuse(at, entry, "not a finite number");
    } else if (!contains(key.range, *value)) {
      refuse(at, entry, "out of range");
    } else {
      note_if_unusual(at, *value);
      return *value * unit.factor;
    }
    return std::nullopt;
  }
  /// Once for a key, whatever the length of its list.
  void note_if_unusual(const Node& at, double value) const {
    const Range* usual = usual_range(path);
    if (usual == nullptr || contains(*usual, value)) {
      return;
    }
    const std::string start = path + " = ";
    const auto same = [&](const base::Warning& note) {
      return note.message.find(": " + start) != std::string::npos;
    };
    if (std::none_of(findings.notes.begin(), findings.notes.end(), same)) {
      findings.notes.push_back(
          {"unusual_value",
           fmt::format(
               "{}: {}{}: ordinary are {:g} to {:g} {} ({}); is the unit right?",
               to_string(at.where), start, shown_value(key.name, at), usual->low,
               usual->high, unit.symbol, key.meaning)});
    }
  }
  [[nodiscard]] bool is_word() const {
    const auto* text = std::get_if<std::string>(&node.value);
    return text != nullptr && !key.word.empty() && *text == key.word;
  }
  const Array* list(std::size_t length) const {
    const auto* entries = std::get_if<Array>(&node.value);
    if (entries == nullptr) {
      refuse(node, 0, "not a list");
    } else if (entries->empty()) {
      refuse(node, 0, "an empty list");
      return nullptr;
    } else if (length > 0 &&
               (entries->size() > length || (entries->size() < length && !key.gaps))) {
      refuse(node, 0, fmt::format("{} entries", entries->size()));
      return nullptr;
    }
    return entries;
  }
  std::optional<int> chosen(const Node& at, std::size_t entry,
                            std::span<const std::string_view> names) const {
    const auto* text = std::get_if<std::string>(&at.value);
    if (text == nullptr) {
      refuse(at, entry, "not a text");
      return std::nullopt;
    }
    const auto found = std::find(names.begin(), names.end(), *text);
    if (found == names.end()) {
      const std::string near =
          nearest(*text, std::vector<std::string>(names.begin(), names.end()));
      refuse(at, entry,
             near.empty() ? "unknown"
                          : fmt::format("unknown, did you mean \"{}\"?", near));
      return std::nullopt;
    }
    return static_cast<int>(found - names.begin());
  }

  void operator()(bool* target) const {
    if (const auto* value = std::get_if<bool>(&node.value)) {
      *target = *value;
    } else {
      refuse(node, 0, "neither true nor false");
    }
  }
  void operator()(int* target) const {
    const auto value = number_in(node);
    if (!value || (std::isfinite(*value) && *value != std::round(*value))) {
      refuse(node, 0, "not a whole number");
    } else if (const auto whole = number(node, 0)) {
      *target = static_cast<int>(*whole);
    }
  }
  void operator()(double* target) const { *target = number(node, 0).value_or(*target); }
  void operator()(std::optional<double>* target) const {
    if (is_word()) {
      target->reset();
    } else {
      *target = number(node, 0);
    }
  }
  void operator()(std::string* target) const {
    const auto* value = std::get_if<std::string>(&node.value);
    if (value == nullptr) {
      refuse(node, 0, "not a text");
    } else if (value->empty() && key.need == Need::always) {
      refuse(node, 0, "an empty text");
    } else {
      *target = *value;
    }
  }
  void operator()(files::FileRef* target) const { (*this)(&target->name); }
  void operator()(std::vector<double>* target) const {
    target->clear();
    if (is_word()) {
      return;
    }
    const Array* entries = list(key.count);
    for (std::size_t i = 0; entries != nullptr && i < entries->size(); ++i) {
      target->push_back(number((*entries)[i], i + 1).value_or(0.0));
    }
  }
  void operator()(PerTooth* target) const {
    target->listed = std::holds_alternative<Array>(node.value);
    if (target->listed) {
      (*this)(&target->values);
    } else {
      target->values = {number(node, 0).value_or(0.0)};
    }
  }
  void operator()(std::optional<base::Steps>* target) const {
    const Array* entries = list(3);
    if (entries == nullptr) {
      return;
    }
    const auto first = number((*entries)[0], 1);
    const auto last = number((*entries)[1], 2);
    const auto count = number_in((*entries)[2]);
    if (!count) {
      refuse((*entries)[2], 3, "not a number");
    } else if (first && last) {
      *target = {*first, *last, *count};
    }
  }
  void operator()(std::vector<std::string>* target) const {
    if (is_word()) {
      *target = {std::string(key.word)};
      return;
    }
    target->clear();
    const Array* entries = list(key.count);
    for (std::size_t i = 0; entries != nullptr && i < entries->size(); ++i) {
      const auto* text = std::get_if<std::string>(&(*entries)[i].value);
      if (text == nullptr || (text->empty() && !key.gaps)) {
        refuse((*entries)[i], i + 1, "not a text");
      }
      target->push_back(text == nullptr ? "" : *text);
    }
  }
  void operator()(Rows* target) const {
    target->clear();
    const Array* rows = list(key.count > 0 ? key.count : 3);
    for (std::size_t i = 0; rows != nullptr && i < rows->size(); ++i) {
      const auto* row = std::get_if<Array>(&(*rows)[i].value);
      if (row == nullptr || row->size() != 3) {
        refuse((*rows)[i], i + 1, "not a row of 3 numbers");
        continue;
      }
      auto& numbers = target->emplace_back();
      for (std::size_t j = 0; j < 3; ++j) {
        numbers[j] = number((*row)[j], 3 * i + j + 1).value_or(0.0);
      }
    }
  }
  void operator()(const Choice& choice) const {
    if (const auto i = chosen(node, 0, choice.names)) {
      choice.set(*i);
    }
  }
  void operator()(const Choices& choices) const {
    if (choices.alone && std::holds_alternative<std::string>(node.value)) {
      if (const auto i = chosen(node, 0, choices.names)) choices.set({*i});
      return;
    }
    std::vector<int> all;
    const Array* entries = list(0);
    for (std::size_t i = 0; entries != nullptr && i < entries->size(); ++i) {
      const auto one = chosen((*entries)[i], i + 1, choices.names);
      if (one && std::find(all.begin(), all.end(), *one) != all.end()) {
        refuse((*entries)[i], i + 1, "twice in the list");
      } else if (one) {
        all.push_back(*one);
      }
    }
    if (entries != nullptr) {
      choices.set(all);
    }
  }
  void operator()(std::optional<base::Normal>* target) const {
    const auto* table = std::get_if<Members>(&node.value);
    const Node* mean = table != nullptr ? find(node, "mean") : nullptr;
    const Node* sd = table != nullptr ? find(node, "sd") : nullptr;
    if (mean == nullptr || sd == nullptr || table->size() != 2) {
      return refuse(node, 0, "not a table with mean and sd");
    }
    const auto value = number(*mean, 0);
    const auto error = number(*sd, 0);
    if (error && !(*error > 0.0)) return refuse(*sd, 0, "an sd that is not above 0");
    if (value && error) target->emplace(base::Normal{*value, *error});
  }
  void operator()(std::optional<files::Direction>* target) const {
    if (const auto* text = std::get_if<std::string>(&node.value)) {
      *target = axis_named(*text);
      if (!*target) refuse(node, 0, "no direction");
      return;
    }
    const Array* entries = list(3);
    if (entries == nullptr) return;
    files::Direction direction{};
    double largest = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const auto entry = number((*entries)[i], i + 1);
      if (!entry) return;
      direction[i] = *entry;
      largest = std::max(largest, std::abs(*entry));
    }
    if (largest == 0.0) {
      refuse(node, 0, "points nowhere");
    } else {
      *target = direction;
    }
  }
  void operator()(Pairs* target) const {
    target->clear();
    const Array* rows = list(key.count);
    for (std::size_t i = 0; rows != nullptr && i < rows->size(); ++i) {
      if (const auto pair = pair_in((*rows)[i], i)) target->push_back(*pair);
    }
  }
  /// @param row  from 0
  std::optional<std::array<double, 2>> pair_in(const Node& at, std::size_t row) const {
    const auto* pair = std::get_if<Array>(&at.value);
    if (pair == nullptr || pair->size() != 2) {
      refuse(at, row + 1, "not a pair of numbers");
      return std::nullopt;
    }
    const auto first = number((*pair)[0], 2 * row + 1);
    const auto second = number((*pair)[1], 2 * row + 2);
    if (!first || !second) return std::nullopt;
    return std::array{*first, *second};
  }
  void operator()(ArcLayers* target) const {
    target->clear();
    const Array* layers = list(0);
    for (std::size_t i = 0; layers != nullptr && i < layers->size(); ++i) {
      if (auto layer = layer_in((*layers)[i], i + 1)) {
        target->push_back(*std::move(layer));
      }
    }
  }
  std::optional<ArcLayerTable> layer_in(const Node& at, std::size_t entry) const {
    const auto* table = std::get_if<Members>(&at.value);
    const auto member = [&](std::string_view name) {
      return table != nullptr ? find(at, name) : nullptr;
    };
    const Node* from = member("from_mm");
    const Node* to = member("to_mm");
    const Node* given = member("arcs_deg");
    const auto* arcs = given != nullptr ? std::get_if<Array>(&given->value) : nullptr;
    if (from == nullptr || to == nullptr || arcs == nullptr || table->size() != 3) {
      refuse(at, entry, "not a table with from_mm, to_mm and arcs_deg");
      return std::nullopt;
    }
    const auto low = number(*from, entry);
    const auto high = number(*to, entry);
    if (!low || !high) return std::nullopt;
    ArcLayerTable layer{*low * unit::mm, *high * unit::mm, {}};
    for (std::size_t k = 0; k < arcs->size(); ++k) {
      const auto pair = pair_in((*arcs)[k], k);
      if (!pair) return std::nullopt;
      layer.arcs.push_back({(*pair)[0] * unit::deg, (*pair)[1] * unit::deg});
    }
    return layer;
  }
  void operator()(std::optional<StockCylinder>* target) const {
    const auto* table = std::get_if<Members>(&node.value);
    const Node* axis = table != nullptr ? find(node, "axis_xy") : nullptr;
    const Node* radius = table != nullptr ? find(node, "radius") : nullptr;
    const Node* z = table != nullptr ? find(node, "z") : nullptr;
    if (axis == nullptr || radius == nullptr || z == nullptr || table->size() != 3) {
      return refuse(node, 0, "not a table with axis_xy, radius and z");
    }
    const auto center = pair_in(*axis, 0);
    const auto heights = pair_in(*z, 0);
    const auto size = number(*radius, 0);
    if (size && !(*size > 0)) return refuse(*radius, 0, "a radius that is not above 0");
    if (center && heights && size) *target = StockCylinder{*center, *size, *heights};
  }
  std::optional<ToolName> tool_in(const Node& at, std::size_t entry) const {
    const auto* text = std::get_if<std::string>(&at.value);
    const auto* whole = std::get_if<std::int64_t>(&at.value);
    if (whole != nullptr && *whole >= 0) return ToolName{std::to_string(*whole)};
    if (text != nullptr && !text->empty()) return ToolName{*text};
    refuse(at, entry, "no number and no name of a tool");
    return std::nullopt;
  }
  void operator()(ToolName* target) const {
    if (auto tool = tool_in(node, 0)) *target = *std::move(tool);
  }
  void operator()(std::vector<ToolName>* target) const {
    target->clear();
    const Array* entries = list(0);
    for (std::size_t i = 0; entries != nullptr && i < entries->size(); ++i) {
      if (auto tool = tool_in((*entries)[i], i + 1)) {
        target->push_back(*std::move(tool));
      }
    }
  }
  void operator()(NamedPlaces* target) const {
    const auto* table = std::get_if<Members>(&node.value);
    if (table == nullptr) return refuse(node, 0, "not a table");
    target->clear();
    for (const Member& member : *table) {
      const auto* place = std::get_if<Array>(&member.node.value);
      if (place == nullptr || place->size() != 3) {
        refuse(member.node, 0, "not a place of 3 numbers");
        continue;
      }
      auto& numbers = (*target)[member.key];
      for (std::size_t i = 0; i < 3; ++i) {
        numbers[i] = number((*place)[i], i + 1).value_or(0.0);
      }
    }
  }
  void operator()(NamedFiles* target) const {
    const auto* table = std::get_if<Members>(&node.value);
    if (table == nullptr) return refuse(node, 0, "not a table");
    target->clear();
    for (const Member& member : *table) {
      const auto* name = std::get_if<std::string>(&member.node.value);
      if (name == nullptr || name->empty()) {
        refuse(member.node, 0, "not a text");
        continue;
      }
      (*target)[member.key].name = *name;
      findings.places[path + "." + member.key] = member.node.where;
    }
  }
  void operator()(std::optional<PreviousClamping>*) const {}     // read_table does it
  void operator()(std::optional<geometry::Serration>*) const {}  // so this
  void operator()(std::optional<files::SurfaceFrame>*) const {}  // so this
  void operator()(CutTable*) const {}  // read_table does it: it needs [cut] as well
};

}  // namespace

std::optional<double> number_in(const Node& node) {
  if (const auto* whole = std::get_if<std::int64_t>(&node.value)) {
    return static_cast<double>(*whole);
  }
  if (const auto* number = std::get_if<double>(&node.value)) {
    return *number;
  }
  return std::nullopt;
}

std::string shown_value(std::string_view key, const Node& node) {
  const std::string_view symbol = unit::of_key(key).symbol;
  return number_in(node) && !symbol.empty()
             ? fmt::format("{} {}", to_string(node), symbol)
             : to_string(node);
}

void read_value(const Node& node, const std::string& path, const Key& key,
                const Field& field, Findings& findings) {
  std::visit(ValueReader{node, path, key, field, findings}, field);
}

}  // namespace trochoid::cases
