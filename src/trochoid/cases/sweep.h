#pragma once

#include <trochoid/cases/document.h>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

/// [sweep]: one case over many values of its keys.
namespace trochoid::cases {

/// Evenly from the first to the last; where rows are drawn by chance, uniform between.
struct EvenValues {
  double from = 0.0;
  double to = 0.0;
  std::optional<int> count;  ///< of a grid or a list
};

/// These, as a file of TOML would hold them: numbers, texts, truths.
struct ListedValues {
  std::vector<Node> values;
};

/// By chance, with the mean and the standard deviation of a normal distribution.
struct NormalValues {
  double mean = 0.0;
  double sd = 0.0;  ///< above 0
};

/// A key and what it is set to.
struct SweptKey {
  std::string key;  ///< its path: `cut.spindle_rpm`, `mode[1].frequency_Hz`
  Location where;   ///< of the values
  std::variant<EvenValues, ListedValues, NormalValues> values;
};

/// Which rows there are.
enum class SweepMethod {
  grid,             ///< every combination, the last key fastest
  list,             ///< the first values of all keys, then the second ones
  latin_hypercube,  ///< by chance, each key spread evenly over its distribution
  random,           ///< by chance
};

/// As files spell it.
constexpr std::string_view name_of(SweepMethod method) noexcept {
  switch (method) {
    case SweepMethod::grid:
      return "grid";
    case SweepMethod::list:
      return "list";
    case SweepMethod::latin_hypercube:
      return "latin_hypercube";
    case SweepMethod::random:
      return "random";
  }
  return {};
}

/// What an earlier command found, to be drawn with its covariance.
struct DrawnFile {
  std::filesystem::path path;  ///< summary.json, or the folder that holds it
  std::string group;           ///< of records; empty: the first
  Location where;
};

/// [sweep] of a case.
struct Sweep {
  std::vector<SweptKey> over;
  std::vector<DrawnFile> covariance;
  std::size_t draws = 0;  ///< of each row; by chance one, and as many rows; 0: none
  SweepMethod method = SweepMethod::grid;
  std::uint64_t seed = 1;
  std::size_t rows = 0;           ///< of all methods, before draws multiply them
  std::string command;            ///< empty: the command line says it
  std::vector<std::string> take;  ///< paths in summary.json; empty: the same
  bool hdf5 = false;              ///< the table as HDF5 too
};

/// No sweep has more rows.
inline constexpr std::size_t most_sweep_rows = 100'000'000;
inline constexpr std::size_t most_draws = 1'000'000;

/// Whether each row is drawn by chance.
constexpr bool by_chance(SweepMethod method) noexcept {
  return method == SweepMethod::random || method == SweepMethod::latin_hypercube;
}

/// @brief Read [sweep] of a case.
/// @param root  the case, with what it includes
/// @param file  of the case, for messages and as the place that file names count from
/// @throws base::InputError with every problem; also where there is no [sweep]
Sweep read_sweep(const Node& root, const std::filesystem::path& file);

/// @brief [sweep] as a file would say it.
std::string sweep_toml(const Sweep& sweep);

/// A key of [sweep] in words, for the page of keys and the schema.
struct SweepKeyText {
  std::string_view name;
  std::string_view value;     ///< what it accepts
  std::string_view standard;  ///< where it is left out
  std::string_view meaning;
};

std::span<const SweepKeyText> sweep_keys() noexcept;

/// @brief [sweep] in JSON Schema (draft 7): what read_sweep takes.
std::string sweep_schema();

/// @brief The same case without its [sweep].
Node without_sweep(Node root);

/// @brief As set_key of settings.h.
void set_key(Node& root, const SweptKey& key, const Node& value);

}  // namespace trochoid::cases
