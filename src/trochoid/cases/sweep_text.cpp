#include <trochoid/cases/number_text.h>
#include <trochoid/cases/sweep.h>

#include <fmt/core.h>
#include <fmt/ranges.h>

namespace trochoid::cases {

namespace {

std::string text_of(const Node& value) {
  if (const auto* real = std::get_if<double>(&value.value)) {
    return number_text(*real);
  }
  if (const auto* whole = std::get_if<std::int64_t>(&value.value)) {
    return std::to_string(*whole);
  }
  if (const auto* truth = std::get_if<bool>(&value.value)) {
    return *truth ? "true" : "false";
  }
  return toml_string(std::get<std::string>(value.value));
}

std::string text_of(const SweptKey& key) {
  if (const auto* even = std::get_if<EvenValues>(&key.values)) {
    return fmt::format("{{ from = {}, to = {}{} }}", number_text(even->from),
                       number_text(even->to),
                       even->count ? fmt::format(", count = {}", *even->count) : "");
  }
  if (const auto* normal = std::get_if<NormalValues>(&key.values)) {
    return fmt::format("{{ mean = {}, sd = {} }}", number_text(normal->mean),
                       number_text(normal->sd));
  }
  std::vector<std::string> texts;
  for (const Node& value : std::get<ListedValues>(key.values).values) {
    texts.push_back(text_of(value));
  }
  return fmt::format("{{ values = [{}] }}", fmt::join(texts, ", "));
}

}  // namespace

std::string sweep_toml(const Sweep& sweep) {
  std::string text = fmt::format("[sweep]\ncommand = {}\n", toml_string(sweep.command));
  std::vector<std::string> paths;
  for (const std::string& path : sweep.take) {
    paths.push_back(toml_string(path));
  }
  text += fmt::format("take = [{}]\nmethod = \"{}\"\n", fmt::join(paths, ", "),
                      name_of(sweep.method));
  if (sweep.hdf5) {
    text += "hdf5 = true\n";
  }
  if (!sweep.covariance.empty()) {
    std::vector<std::string> files;
    for (const DrawnFile& drawn : sweep.covariance) {
      const std::string file = toml_string(drawn.path.generic_string());
      files.push_back(drawn.group.empty()
                          ? file
                          : fmt::format("{{ file = {}, group = {} }}", file,
                                        toml_string(drawn.group)));
    }
    text += fmt::format("seed = {}\ncovariance = [{}]\ndraws = {}\n", sweep.seed,
                        fmt::join(files, ", "), sweep.draws);
  } else if (by_chance(sweep.method)) {
    text += fmt::format("seed = {}\ncount = {}\n", sweep.seed, sweep.rows);
  }
  if (sweep.over.empty()) {
    return text;
  }
  text += "[sweep.over]\n";
  for (const SweptKey& key : sweep.over) {
    text += fmt::format("{} = {}\n", toml_string(key.key), text_of(key));
  }
  return text;
}

}  // namespace trochoid::cases
