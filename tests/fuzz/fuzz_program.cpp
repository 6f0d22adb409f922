#include <trochoid/program/read_program.h>
#include <trochoid/program/write_feeds.h>

#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "bytes.h"

namespace {

using trochoid::fuzz::demand;
using namespace trochoid::program;

bool finite_or_unknown(double value) {
  return !std::isinf(value);
}

/// What every move is.
void use(const Move& move, const Program& program, std::uint32_t lines) {
  demand(move.line >= 1 && move.line <= lines);
  demand(move.tool >= -1 && move.tool < static_cast<int>(program.tools.size()));
  for (const double x : move.end) demand(finite_or_unknown(x));
  demand(!(move.time < 0) && !(move.spindle < 0) && !(move.feed < 0));
  const bool fed = move.kind != MoveKind::rapid && move.kind != MoveKind::dwell;
  if (fed) {
    demand(move.feed > 0 || move.time == 0);  // G93 over no length
    for (const double x : move.end) demand(!std::isnan(x));
  }
  if (move.kind == MoveKind::arc) {
    demand(!std::isnan(move.center[0]) && !std::isnan(move.center[1]));
    demand(move.turn != 0);
  }
}

/// Every program can be written with other feeds.
void write_slower(std::string_view text, const Program& program) {
  std::vector<FeedPart> parts;
  for (std::uint32_t i = 0; i < program.moves.size(); ++i) {
    const Move& move = program.moves[i];
    const bool fed = move.kind != MoveKind::rapid && move.kind != MoveKind::dwell;
    if (!fed || !(move.feed > 0) || !(move.time > 0)) continue;
    parts.push_back({i, 0.0, 0.5, move.feed});
    parts.push_back({i, 0.5, 1.0, 0.5 * move.feed});
  }
  const std::string slower = write_feeds(text, program, parts);
  demand(slower.size() >= text.size() / 2);
}

}  // namespace

/// The first byte is the dialect, or that it is to be found.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0) return 0;
  ReadOptions options;
  constexpr int dialects = 3;
  if (const int which = data[0] % (dialects + 1); which > 0) {
    options.dialect = static_cast<Dialect>(which - 1);
  }
  options.block_delete = (data[0] & 0x80U) != 0;
  options.wear_zero = (data[0] & 0x40U) != 0;
  options.ignored_words = {"M10", "FOO"};
  const std::string_view text(reinterpret_cast<const char*>(data) + 1, size - 1);
  const ProgramText read = read_program(text, options);
  std::uint32_t lines = 1;
  for (const char c : text) lines += c == '\n' || c == '\r' ? 1U : 0U;
  demand(read.problems.size() <= Complaints::most);
  Place last{1, 1};
  for (const Problem& problem : read.problems) {
    demand(!problem.text.empty());
    demand(problem.place.line >= last.line && problem.place.line <= lines);
    demand(problem.place.column >= 1 && problem.place.column <= size + 1);
    last = problem.place;
  }
  for (const Remark& remark : read.remarks) demand(remark.place.line <= lines);
  if (!read.problems.empty()) return 0;
  for (const Move& move : read.program.moves) use(move, read.program, lines);
  write_slower(text, read.program);
  return 0;
}
