#include <trochoid/results/compared.h>

#include <trochoid/base/error.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace trochoid::results {

namespace {

constexpr std::size_t longest_list = 24;
/// Numbers that differ by less than this part are called the same.
constexpr double same = 1e-3;
/// The largest differences, named in the sentence.
constexpr std::size_t most_named = 3;

/// A number of a result, and its standard error where it has one.
struct Number {
  std::string path;
  std::optional<double> value;
  std::optional<double> se = {};
};

std::optional<double> number_of(const Value* value) {
  if (value == nullptr) return std::nullopt;
  if (const auto* real = std::get_if<double>(&value->data)) return *real;
  const auto* whole = std::get_if<std::int64_t>(&value->data);
  return whole == nullptr ? std::optional<double>() : static_cast<double>(*whole);
}

/// All numbers below a value, in their order.
void flatten(const Value& value, const std::string& path, std::vector<Number>& out) {
  if (const auto number = number_of(&value)) {
    out.push_back({path, number});
  } else if (const auto* list = std::get_if<Array>(&value.data)) {
    if (list->size() > longest_list) return;
    for (std::size_t i = 0; i < list->size(); ++i) {
      flatten((*list)[i], fmt::format("{}[{}]", path, i + 1), out);
    }
  } else if (const auto* object = std::get_if<Object>(&value.data)) {
    if (const auto estimate = number_of(find(value, "value"))) {
      out.push_back({path, estimate, number_of(find(value, "se"))});
      return;
    }
    for (const Member& member : *object) {
      if (member.key == "covariance" || member.key == "correlation") continue;
      const std::string below =
          path.empty() ? member.key : fmt::format("{}.{}", path, member.key);
      flatten(member.value, below, out);
    }
  }
}

/// A number of both answers.
struct Pair {
  std::string path;
  double a = 0.0;
  double b = 0.0;
  std::optional<double> se;  ///< of the difference

  [[nodiscard]] double part() const noexcept {
    const double size = std::max(std::abs(a), std::abs(b));
    return size > 0 ? std::abs(b - a) / size : 0.0;
  }
  [[nodiscard]] bool differs() const noexcept { return part() > same; }
  /// How many standard errors they are apart.
  [[nodiscard]] std::optional<double> errors() const noexcept {
    return se && *se > 0 ? std::optional(std::abs(b - a) / *se) : std::nullopt;
  }
};

std::vector<Pair> pairs_of(const Answer& a, const Answer& b) {
  std::vector<Number> first;
  std::vector<Number> second;
  flatten(a.result, "", first);
  flatten(b.result, "", second);
  std::map<std::string, const Number*> by_path;
  for (const Number& number : second) by_path.emplace(number.path, &number);
  std::vector<Pair> pairs;
  for (const Number& number : first) {
    const auto found = by_path.find(number.path);
    if (found == by_path.end() || !number.value || !found->second->value) continue;
    const Number& other = *found->second;
    std::optional<double> se;
    if (number.se && other.se) se = std::hypot(*number.se, *other.se);
    pairs.push_back({number.path, *number.value, *other.value, se});
  }
  return pairs;
}

std::string_view trimmed(std::string_view text) {
  const auto first = text.find_first_not_of(' ');
  return first == text.npos
             ? ""
             : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

/// The keys of an echoed case, by their paths. It has one key a line.
std::map<std::string, std::string> keys_of(std::string_view toml) {
  std::map<std::string, std::string> keys;
  std::map<std::string, int> entries;
  std::string table;
  while (!toml.empty()) {
    const std::size_t end = std::min(toml.find('\n'), toml.size());
    const std::string_view line = trimmed(toml.substr(0, end));
    toml.remove_prefix(std::min(end + 1, toml.size()));
    const std::size_t equals = line.find(" = ");
    if (line.starts_with("[[")) {
      const std::string name(line.substr(2, line.find(']') - 2));
      table = fmt::format("{}[{}].", name, ++entries[name]);
    } else if (line.starts_with('[')) {
      table = fmt::format("{}.", line.substr(1, line.find(']') - 1));
    } else if (!line.starts_with('#') && equals != line.npos) {
      keys[table + std::string(line.substr(0, equals))] = line.substr(equals + 3);
    }
  }
  return keys;
}

Array inputs_of(const Answer& a, const Answer& b) {
  const auto first = keys_of(a.heading.case_toml);
  const auto second = keys_of(b.heading.case_toml);
  auto all = first;
  all.insert(second.begin(), second.end());
  Array inputs;
  for (const auto& entry : all) {
    const std::string& key = entry.first;
    const auto text = [&](const std::map<std::string, std::string>& keys) {
      const auto found = keys.find(key);
      return found == keys.end() ? std::string() : found->second;
    };
    if (text(first) != text(second) && key != "title") {
      inputs.emplace_back(
          Object{{"key", key}, {"a", text(first)}, {"b", text(second)}});
    }
  }
  return inputs;
}

/// Those with a standard error that are the most of it apart; where none has one, what
/// changed most of the numbers that stand by themselves.
std::vector<Pair> worth_naming(const std::vector<Pair>& pairs) {
  const bool known = std::ranges::any_of(pairs, [](const Pair& pair) {
    return pair.differs() && pair.errors().has_value();
  });
  std::vector<Pair> most;
  for (const Pair& pair : pairs) {
    const bool alone = pair.path.find_first_of(".[") == pair.path.npos;
    if (pair.differs() && (known ? pair.errors().has_value() : alone)) {
      most.push_back(pair);
    }
  }
  std::ranges::stable_sort(most, std::ranges::greater{}, [](const Pair& pair) {
    return pair.errors().value_or(pair.part());
  });
  most.resize(std::min(most.size(), most_named));
  return most;
}

/// Whether a result only repeats an input that differs: `spindle_rpm`, cut.spindle_rpm.
bool repeats(const std::string& path, const Array& inputs) {
  return std::ranges::any_of(inputs, [&](const Value& input) {
    const auto& key = std::get<std::string>(find(input, "key")->data);
    return key == path || key.ends_with("." + path);
  });
}

std::string sentence(const std::vector<Pair>& pairs) {
  const auto count =
      static_cast<std::size_t>(std::ranges::count_if(pairs, &Pair::differs));
  if (count == 0) {
    return fmt::format("All {} numbers of the two are the same within {:g} %.",
                       pairs.size(), 100 * same);
  }
  std::string text = fmt::format("{} of {} numbers differ by more than {:g} %", count,
                                 pairs.size(), 100 * same);
  std::string_view before = "; most: ";
  for (const Pair& pair : worth_naming(pairs)) {
    text += fmt::format("{}{} from {:.5g} to {:.5g}", std::exchange(before, ", "),
                        pair.path, pair.a, pair.b);
    if (pair.errors()) text += fmt::format(" ({:.2g} standard errors)", *pair.errors());
  }
  return text + ".";
}

Object about(const NamedAnswer& one) {
  return {{"name", one.name},
          {"title", one.answer.heading.title},
          {"ok", one.answer.heading.ok},
          {"message", one.answer.heading.message}};
}

void add_tables(const char* whose, const Answer& answer, Answer& out) {
  for (base::Table table : answer.tables) {
    table.file = fmt::format("{}: {}", whose, table.file);
    out.tables.push_back(std::move(table));
  }
}

}  // namespace

Answer compared(const NamedAnswer& a, const NamedAnswer& b) {
  if (a.answer.command != b.answer.command) {
    throw base::InputError({fmt::format(
        "{} is of {}, {} of {}: only answers of one command can be compared", a.name,
        a.answer.command, b.name, b.answer.command)});
  }
  Array inputs = inputs_of(a.answer, b.answer);
  std::vector<Pair> pairs = pairs_of(a.answer, b.answer);
  std::erase_if(pairs, [&](const Pair& pair) { return repeats(pair.path, inputs); });
  Array numbers;
  for (const Pair& pair : pairs) {
    numbers.emplace_back(Object{{"path", pair.path},
                                {"a", pair.a},
                                {"b", pair.b},
                                {"differs", pair.differs()},
                                {"standard_errors", pair.errors()}});
  }
  Answer out{.command = "compare",
             .heading = {.title = fmt::format("{} and {}", a.name, b.name),
                         .message = sentence(pairs)},
             .result = Object{{"of", a.answer.command},
                              {"a", about(a)},
                              {"b", about(b)},
                              {"numbers", std::move(numbers)},
                              {"inputs", std::move(inputs)}}};
  out.heading.case_toml =
      fmt::format("# {}\n{}\n# {}\n{}", a.name, a.answer.heading.case_toml, b.name,
                  b.answer.heading.case_toml);
  add_tables("a", a.answer, out);
  add_tables("b", b.answer, out);
  return out;
}

}  // namespace trochoid::results
