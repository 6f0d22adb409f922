#include <trochoid/cases/case.h>
#include <trochoid/cases/sweep.h>
#include <trochoid/cases/tables.h>
#include <trochoid/cases/usual_values.h>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <cctype>

namespace trochoid::cases {

namespace {

constexpr std::string_view introduction = R"(# The case file

<!-- Made by the program from its schema (src/trochoid/cases/schema_*.cpp). -->

A case file says in [TOML](https://toml.io) what is to be computed: the cutter, the cut,
the force law, the measurements. One file serves several commands; each takes the tables
that it needs and checks all of them. `trochoid new COMMAND` writes a file to start from,
`trochoid check CASE.toml` only looks for mistakes.

* The unit is the end of the name of every key: `_mm`, `_um`, `_deg`, `_rpm`, `_MPa`,
  `_GPa`, `_N_per_mm`, `_N_per_mm3`, `_Hz`, `_s`. A key without such an ending is a plain number, a text
  or a choice.
* A key that ends with `_mm` or `_mm_per_min` may be given in inches, `diameter_in`,
  `feed_rate_in_per_min`: one of the two. Results are in millimetres.
* A message has the form `file:line:column: key = value: why; what is right (what it means)`.
  All mistakes are reported at once. Unknown keys are mistakes.
* Relative file names count from the file in which they stand.
* `include = "other.toml"` above all tables takes over the tables of another case file.
  Tables merge key by key and the including file wins; a list of tables (`[[...]]`) is
  replaced as a whole. An included file may include another. If there are several,
  `include = ["x.toml", "y.toml"]`, lists of tables are joined (the `[[mode]]` of both). For
  all other keys the later file wins.
* `schema = 1` above all tables gives the version of these keys. Without it the version of
  the program counts. The number grows when a key is removed or changes its meaning or unit,
  not for new keys. A file of another version is refused before anything else is checked.
* In the folder of results, `case.toml` is the case as it was understood, with every
  default filled in. It is a case file again.
* A force record is a file of [one of these formats](record.md); a measured surface is
  [text or a map](surface.md).
* Editors complete and check keys by [case.schema.json](case.schema.json) (JSON Schema,
  draft 7, with units, ranges and defaults): the line `#:schema case.schema.json` at the
  top of a case, for Even Better TOML and other editors with
  [Taplo](https://taplo.tamasfe.dev). `trochoid new --schema` prints that file. Only
  `trochoid check` finds mistakes that depend on the command, on other tables or on files.
* The letters and signs are those of [the notation](../notation.md).
)";

std::string default_of(const Key& key, const Field& field) {
  std::string text;
  if (key.need == Need::always) {
    text = key.rival.empty() ? "needed" : fmt::format("needed, or `{}`", key.rival);
  } else if (key.need == Need::coefficient || key.need == Need::cutting) {
    text = "`simulate` and `surface` need it";
    text += key.need == Need::cutting ? ", or `[orthogonal]`" : "";
  } else if (key.standard.empty()) {
    const auto value = toml_text(key, field);
    text = value ? fmt::format("`{}`", *value) : "left out";
  }
  if (!key.standard.empty()) {
    text += (text.empty() ? "" : "; ") + std::string(key.standard);
  }
  return text;
}

std::string usual_table() {
  std::string text =
      "\n## Ordinary values\n\nA value outside these is taken, with the warning "
      "`unusual_value`: most are a slip of the unit. What lies outside the ranges of the "
      "tables above is refused.\n\n| key | from | to |\n|---|---|---|\n";
  for (const UsualValue& usual : usual_values()) {
    text += fmt::format("| `{}` | {:g} | {:g} |\n", usual.key, usual.range.low,
                        usual.range.high);
  }
  return text + fmt::format(
                    "\nNor are a feed per tooth above {:g} or an axial depth above "
                    "{:g} times the diameter ordinary.\n",
                    usual_feed_per_diameter, usual_depth_per_diameter);
}

}  // namespace

std::string describe_case_file() {
  std::string text{introduction};
  const Visitor row = [&text](const Key& key, const Field& field) {
    text += fmt::format("| `{}` | {} | {} | {} |\n", key.name, expectation(key, field),
                        default_of(key, field), meaning_of(key));
  };
  const auto head = [&text](std::string_view title, std::string_view meaning) {
    text += fmt::format(
        "\n## {}\n\n{}.\n\n| key | value | default | meaning |\n|---|---|---|---|\n",
        title, meaning);
  };
  CaseTables tables;
  head("Above all tables", "Before the first table");
  text +=
      "| `include` | text, or a list of texts | left out | case files whose tables this one builds on |\n";
  describe(row, tables);
  for (const TableEntry& table : tables_of(tables)) {
    std::string meaning{table.meaning};
    if (!table.needed_by.empty()) {
      std::vector<std::string_view> names;
      for (const Command command : table.needed_by) {
        names.push_back(name_of(command));
      }
      meaning += fmt::format(" (needed by `{}`)", fmt::join(names, "`, `"));
    }
    meaning.front() = static_cast<char>(std::toupper(meaning.front()));
    head(fmt::format("`{}`", heading(table)), meaning);
    if (table.count() == 0) {
      table.add();
    }
    table.describe(0, row);
  }
  head("`[sweep]`",
       "One case over many values of its keys ([the guide](../guide/sweep.md))");
  for (const SweepKeyText& key : sweep_keys()) {
    text += fmt::format("| `{}` | {} | {} | {} |\n", key.name, key.value, key.standard,
                        key.meaning);
  }
  return text + usual_table();
}

}  // namespace trochoid::cases
