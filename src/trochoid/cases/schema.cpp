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
  std::string operator()(const Rows*) const { return "3 rows of 3 numbers" + limits(); }
  std::string operator()(const Choice& c) const {
    return fmt::format("one of \"{}\"", fmt::join(c.names, "\", \""));
  }
  std::string operator()(const Choices& c) const {
    return fmt::format("a list with any of \"{}\"", fmt::join(c.names, "\", \""));
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
    return v->empty() ? Text{} : fmt::format("[{}]", fmt::join(entries, ", "));
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
  Text operator()(const Choice& c) const {
    return toml_string(c.names[static_cast<std::size_t>(c.get())]);
  }
  Text operator()(const Choices& c) const {
    std::vector<std::string> entries;
    for (const int i : c.get()) {
      entries.push_back(toml_string(c.names[static_cast<std::size_t>(i)]));
    }
    return entries.empty() ? Text{} : fmt::format("[{}]", fmt::join(entries, ", "));
  }
  Text operator()(const std::optional<files::Direction>* v) const {
    return *v ? Text(direction_text(**v)) : Text{};
  }
  Text operator()(const std::optional<PreviousClamping>*) const { return {}; }
  Text operator()(const std::optional<files::SurfaceFrame>*) const {
    return {};
  }                                                      // these
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
