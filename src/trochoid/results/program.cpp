#include <trochoid/results/program.h>

#include <trochoid/base/units.h>
#include <trochoid/results/descriptions.h>

#include <fmt/core.h>
#include <fmt/ranges.h>

#include <cmath>
#include <limits>

namespace trochoid::results {

namespace {

using program::Move;
using program::MoveKind;

constexpr double empty_field = std::numeric_limits<double>::quiet_NaN();

bool is_fed(const Move& move) noexcept {
  return move.kind != MoveKind::rapid && move.kind != MoveKind::dwell;
}

/// NaN is an empty field.
const Columns<ProgramResult>& move_columns() {
  using R = const ProgramResult&;
  const auto of = [](auto get) {
    return [get](R r, std::size_t i) { return given(get(r.program.moves[i])); };
  };
  const auto of_arc = [](auto get) {
    return [get](R r, std::size_t i) {
      const Move& m = r.program.moves[i];
      return given(m.kind == MoveKind::arc ? get(m) : empty_field);
    };
  };
  static const Columns<ProgramResult> all{
      "moves.csv",
      [](R r) { return r.program.moves.size(); },
      {{"move", "from 0", [](R, std::size_t i) { return i; }},
       {"line", "of the text, from 1",
        [](R r, std::size_t i) { return r.program.moves[i].line; }},
       {"block", "its N number; empty: it has none",
        [](R r, std::size_t i) {
          const auto block = r.program.moves[i].block;
          return block < 0 ? empty_field : static_cast<double>(block);
        }},
       {"kind",
        "`rapid`, `line` (plunges too), `arc` (in G17, helices too), `chord` (a piece of "
        "an arc in G18 or G19), `dwell`",
        [](R, std::size_t) { return 0.0; }},
       {"note",
        "`cycle`: of a drilling cycle; `retract`: to a place that is not in the program "
        "(G28, G30, G53, SUPA)",
        [](R, std::size_t) { return 0.0; }},
       {"x_mm", "end of the move in the frame of the stock; empty: not known",
        of([](const Move& m) { return m.end[0]; })},
       {"y_mm", "the same", of([](const Move& m) { return m.end[1]; })},
       {"z_mm", "the same", of([](const Move& m) { return m.end[2]; })},
       {"center_x_mm", "of an arc", of_arc([](const Move& m) { return m.center[0]; })},
       {"center_y_mm", "of an arc", of_arc([](const Move& m) { return m.center[1]; })},
       {"turn_deg", "of an arc, positive counter-clockwise",
        of_arc([](const Move& m) { return m.turn; })},
       {"time_s", "that the move takes", of([](const Move& m) { return m.time; })},
       {"feed_mm_per_min", "along the path; empty: a rapid or a dwell",
        of([](const Move& m) { return is_fed(m) ? m.feed : empty_field; })},
       {"spindle_rpm", "0: it stands", of([](const Move& m) { return m.spindle; })},
       {"tool", "number or name; empty: neither T nor M6 before",
        [](R, std::size_t) { return 0.0; }}}};
  return all;
}

base::Table moves_table(const ProgramResult& r) {
  base::Table table = move_columns().table(r);
  const auto put = [&](std::string_view name, const auto& text) {
    for (base::Table::Column& column : table.columns) {
      if (column.name != name) continue;
      column.values.clear();
      for (const Move& move : r.program.moves) {
        column.texts.push_back(std::string(text(move)));
      }
    }
  };
  put("kind", [](const Move& m) { return name_of(m.kind); });
  put("note", [](const Move& m) { return name_of(m.note); });
  const auto& tools = r.program.tools;
  put("tool", [&tools](const Move& m) {
    return m.tool < 0 ? std::string() : tools[static_cast<std::size_t>(m.tool)];
  });
  return table;
}

double total_time(const ProgramResult& r) noexcept {
  double time = 0.0;
  for (const Move& move : r.program.moves) time += move.time;
  return time;
}

const Fields<ProgramResult>& program_fields() {
  using R = const ProgramResult&;
  static const Fields<ProgramResult> all{
      {"dialect", "`iso`, `linuxcnc` or `sinumerik`, as given or as found",
       [](R r) { return name_of(r.program.dialect); }},
      {"moves", "number of moves", [](R r) { return r.program.moves.size(); }},
      {"tools", "numbers or names, in the order of their first use",
       [](R r) { return r.program.tools; }},
      {"time_s", "of all moves", total_time}};
  return all;
}

std::string short_table(const ProgramResult& r) {
  std::size_t fed = 0;
  for (const Move& move : r.program.moves) fed += is_fed(move) ? 1U : 0U;
  return fmt::format(
      "dialect {}, {} moves, {} of them fed, {:.6g} s\ntools: {}\n",
      name_of(r.program.dialect), r.program.moves.size(), fed, total_time(r),
      r.program.tools.empty() ? "that of the case"
                              : fmt::format("{}", fmt::join(r.program.tools, ", ")));
}

}  // namespace

Answer answer_of(const ProgramResult& r) {
  constexpr std::size_t most_moves = 1000000;
  Answer answer{.command = "program",
                .heading = r.heading,
                .result = program_fields().object(r),
                .short_table = r.heading.ok ? short_table(r) : std::string(),
                .tables = {},
                .texts = {}};
  if (r.all_moves || r.program.moves.size() <= most_moves) {
    answer.tables.push_back(moves_table(r));
  }
  return answer;
}

Description description_of_program() {
  Description all{.command = "program", .keys = program_fields().texts()};
  move_columns().add_texts(all.columns);
  return all;
}

}  // namespace trochoid::results
