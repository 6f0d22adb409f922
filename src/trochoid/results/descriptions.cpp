#include <trochoid/results/descriptions.h>

#include <fmt/core.h>

namespace trochoid::results {

std::vector<Description> descriptions() {
  return {description_of_simulate(),  description_of_identify(),
          description_of_surface(),   description_of_calibrate(),
          description_of_stability(), description_of_dynamics(),
          description_of_modes(),     description_of_actuator(),
          description_of_correct(),   description_of_plan(),
          description_of_wall_plan(), description_of_finish_plan(),
          description_of_program(),   description_of_sweep()};
}

namespace {

std::string tables_on_page(const Description& description) {
  std::string text = "| key | what |\n|---|---|\n";
  for (const KeyText& key : description.keys) {
    text += fmt::format("| `{}` | {} |\n", key.path, key.meaning);
  }
  if (description.columns.empty()) return text;
  text += "\n| file | column | what |\n|---|---|---|\n";
  for (const ColumnText& column : description.columns) {
    text +=
        fmt::format("| `{}` | `{}` | {} |\n", column.file, column.name, column.meaning);
  }
  return text;
}

}  // namespace

std::string page_with_descriptions(std::string page) {
  for (const Description& one : descriptions()) {
    const std::string mark =
        fmt::format("<!-- {}: made of src/trochoid/results -->\n", one.command);
    const std::size_t at = page.find(mark);
    if (at == page.npos) continue;
    const std::size_t from = at + mark.size();
    const std::size_t to = page.find("<!-- end -->", from);
    page.replace(from, to - from, tables_on_page(one));
  }
  return page;
}

}  // namespace trochoid::results
