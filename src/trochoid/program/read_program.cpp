#include <trochoid/program/dialect.h>
#include <trochoid/program/machine.h>

#include <fmt/core.h>

#include <algorithm>
#include <iterator>

namespace trochoid::program {

namespace {

/// What a block leads to although it is not executed: places that it names are known.
void skip_motion(Run& run, const Orders& orders) {
  run.machine.doubtful = true;
  for (const auto& [letter, axis] : {std::pair{'X', 0U}, {'Y', 1U}, {'Z', 2U}}) {
    const Word* word = orders.find(letter);
    if (word == nullptr || run.machine.incremental) continue;
    run.machine.place[axis] =
        word->value * run.machine.length_unit + run.machine.shift[axis];
  }
  if (orders.has(Group::motion)) run.machine.motion = orders.of(Group::motion);
}

/// @return  whether the program goes on
bool execute(Run& run, Block& block) {
  const std::size_t told = run.complaints.problems.size();
  Orders orders = sort_words(block, run.habits, run.complaints);
  Sorted sorted{block, orders};
  const bool right = !block.wrong;
  set_modes(run, sorted);
  if (right) {
    pause(run, sorted);
    move(run, sorted);
    if (!block.wrong) tell_unused(block, orders, run.complaints);
  } else {
    skip_motion(run, orders);
  }
  if (block.wrong) run.machine.doubtful = true;
  auto& problems = run.complaints.problems;
  std::stable_sort(problems.begin() + static_cast<std::ptrdiff_t>(told), problems.end(),
                   [](const Problem& a, const Problem& b) {
                     return a.place.column < b.place.column;
                   });
  return orders.of(Group::stop) != Action::end;
}

/// Words that were split but are to be executed in the order of the text.
void read_blocks(Run& run, std::string_view text) {
  Block block;
  int marks = 0;
  for (std::size_t at = 0; at < text.size();) {
    const auto [line, next] = line_at(text, at);
    block.text = line;
    const std::size_t told = run.complaints.problems.size();
    split(block, run.habits.dialect, run.complaints);
    at = next;
    if (block.mark && ++marks == 2) return;
    const bool left_out = block.deleted && run.options.block_delete;
    if (run.options.block_delete && block.optional_from < block.words.size()) {
      block.words.resize(block.optional_from);
    }
    if (left_out) {
      run.complaints.problems.resize(told);
    } else if (!block.mark && (!block.words.empty() || block.wrong)) {
      note_points(block, run.points);
      if (!execute(run, block)) return;
    }
    if (run.complaints.problems.size() >= Complaints::most) return;
    ++block.line;
  }
}

void remark_on_points(Run& run) {
  const bool plain = run.habits.dialect == Dialect::iso && !run.points.any &&
                     run.points.first.line > 0;
  if (!plain) return;
  remark(run.complaints, "no_decimal_point", run.points.first,
         "no length has a decimal point: they are read in mm or inches; some controls "
         "read them in thousandths");
}

std::string_view without_byte_order_mark(std::string_view text) noexcept {
  constexpr std::string_view mark = "\xEF\xBB\xBF";
  return text.starts_with(mark) ? text.substr(mark.size()) : text;
}

/// The machine stands somewhere before the first block.
void begin_at(Run& run, const std::array<double, 3>& start) {
  for (std::size_t i = 0; i < 3; ++i) {
    run.machine.place[i] = run.options.origin[i] + start[i];
  }
  run.program.moves.push_back({.end = run.machine.place,
                               .line = 1,
                               .kind = MoveKind::rapid,
                               .note = MoveNote::start});
}

ProgramText heidenhain(std::string_view text, std::size_t at) {
  Block block;
  std::size_t start = 0;
  while (true) {
    const auto [line, next] = line_at(text, start);
    block.text = line;
    if (at <= start + line.size() || next >= text.size()) break;
    start = next;
    ++block.line;
  }
  Complaints complaints;
  complain(complaints, block, at - start, Fault::dialect,
           "a program in Heidenhain's own language");
  return {.program = {}, .problems = std::move(complaints.problems), .remarks = {}};
}

}  // namespace

std::string offset_name(std::string_view text) {
  std::string name;
  for (const char c : text) {
    if (c == ' ' || c == '\t') continue;
    name += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  }
  return name;
}

ProgramText read_program(std::string_view bytes, const ReadOptions& options) {
  const std::string_view text = without_byte_order_mark(bytes);
  const Outline outline = outline_of(text, options.dialect, options.name);
  if (outline.heidenhain) return heidenhain(text, *outline.heidenhain);
  Run run{.options = options,
          .habits = {outline.dialect, options.wear_zero, options.ignored_words},
          .changes_tool = outline.changes_tool};
  run.machine.shift = options.origin;
  run.program.zeros.push_back({0, options.origin});
  if (options.start) begin_at(run, *options.start);
  run.program.dialect = outline.dialect;
  read_blocks(run, text);
  remark_on_points(run);
  Complaints& found = run.complaints;
  if (found.problems.size() > Complaints::most) {
    found.problems.resize(Complaints::most);
  }
  std::ranges::stable_sort(found.remarks, {}, [](const Remark& r) {
    return std::pair(r.place.line, r.place.column);
  });
  return {std::move(run.program), std::move(found.problems), std::move(found.remarks)};
}

}  // namespace trochoid::program
