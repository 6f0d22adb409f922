#include <trochoid/base/printable.h>
#include <trochoid/program/names.h>
#include <trochoid/program/orders.h>

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

namespace trochoid::program {

namespace {

struct Sorting {
  Block& block;
  const Habits& habits;
  Complaints& complaints;
  Orders orders = {};

  [[nodiscard]] std::string shown(const Word& word) const {
    return base::one_line(text_of(block, word));
  }
  void complain(const Word& word, Fault fault, std::string what) {
    program::complain(complaints, block, word.at, fault, std::move(what));
  }
};

/// Number of a G or M word in tenths; -1: it is none.
int tenths_of(const Word& word) noexcept {
  constexpr double most = 1000;
  constexpr double tenth = 10;
  constexpr double slack = 1e-6;
  if (!word.has_value || !(word.value >= 0) || word.value >= most) return -1;
  const double tenths = std::round(word.value * tenth);
  return std::abs(word.value * tenth - tenths) > slack ? -1 : static_cast<int>(tenths);
}

/// M10 for m 010.
std::string canonical(const Word& word) {
  return word.letter == 0 ? std::string(word.name)
                          : fmt::format("{}{:g}", word.letter, word.value);
}

constexpr std::string_view may_be_ignored =
    "; if the load does not depend on it, name it in ignore_words of [program]";

/// What may accompany a word that is ignored.
constexpr std::string_view arguments = "PQLERHKS";

bool is_ignored(Sorting& s, const Word& word) {
  const std::string name = canonical(word);
  const bool ignored =
      std::ranges::any_of(s.habits.ignored_words,
                          [&](const std::string& one) { return same_word(one, name); });
  if (ignored) s.orders.take_all(arguments);
  return ignored;
}

std::string_view shown_name(Dialect dialect) noexcept {
  switch (dialect) {
    case Dialect::iso:
      return "ISO";
    case Dialect::linuxcnc:
      return "LinuxCNC";
    case Dialect::sinumerik:
      return "Sinumerik";
  }
  return {};
}

/// Of the words of a group the first holds.
void add_code(Sorting& s, const Word& word, const Code& code) {
  s.orders.take_all(code.takes);
  if (code.action == Action::tool_change) s.orders.tool_change = true;
  if (code.group == Group::other) return;
  const auto group = static_cast<std::size_t>(code.group);
  const Code*& there = s.orders.code[group];
  if (there == nullptr) {
    there = &code;
    s.orders.at[group] = word.at;
    return;
  }
  const auto moves = [](const Code& c) {
    return c.action == Action::rapid || c.action == Action::line ||
           c.action == Action::clockwise || c.action == Action::counter_clockwise;
  };
  if (code.action == Action::cancel_motion && moves(*there)) {
    s.orders.cancels = true;
    return;
  }
  if (there->action == Action::cancel_motion && moves(code)) {
    s.orders.cancels = true;
    there = &code;
    s.orders.at[group] = word.at;
    return;
  }
  s.complain(word, Fault::group,
             fmt::format("{} cannot stand in one block with {}{:g}", s.shown(word),
                         word.letter, there->tenths / 10.0));
}

bool is_axis_or_center(char c) noexcept {
  return (c >= 'X' && c <= 'Z') || (c >= 'I' && c <= 'K');
}

/// G5 P, G5.1 Q, G8 P: look-ahead. Without P or Q they are splines, or a lathe's.
bool is_look_ahead(const Block& block, const Code& code) noexcept {
  const char needed = code.takes.front();
  const bool has = std::ranges::any_of(
      block.words, [needed](const Word& w) { return w.letter == needed; });
  return has && std::ranges::none_of(block.words, [](const Word& w) {
           return is_axis_or_center(w.letter);
         });
}

void sort_code(Sorting& s, const Word& word) {
  const int tenths = tenths_of(word);
  const Code* code = word.letter == 'G' ? g_code(tenths, s.habits.dialect)
                                        : m_code(tenths, s.habits.dialect);
  if (code == nullptr) {
    if (is_ignored(s, word)) return;
    return s.complain(word, Fault::unknown,
                      fmt::format("{} is not known in {}{}", s.shown(word),
                                  shown_name(s.habits.dialect), may_be_ignored));
  }
  const bool refused =
      code->action == Action::refused ||
      (code->action == Action::look_ahead && !is_look_ahead(s.block, *code));
  if (refused) {
    return s.complain(word, code->fault,
                      fmt::format("{}: {}", s.shown(word), code->what));
  }
  if (code->action == Action::compensation && !s.habits.wear_zero) {
    return s.complain(word, Fault::compensation,
                      fmt::format("{}: compensation of the radius", s.shown(word)));
  }
  add_code(s, word, *code);
}

void sort_rotary(Sorting& s, const Word& word) {
  if (word.value == 0) {
    remark(s.complaints, "rotary_zero",
           {s.block.line, column_of(s.block.text, word.at)},
           fmt::format("{}: the table is taken to stand", s.shown(word)));
    return;
  }
  if (s.block.wrong || s.complaints.rotary_told) {
    s.block.wrong = true;
    return;
  }
  s.complaints.rotary_told = true;
  s.complain(word, Fault::rotary, fmt::format("{}: an axis that turns", s.shown(word)));
}

bool is_rotary(char c) noexcept {
  return (c >= 'A' && c <= 'C') || (c >= 'U' && c <= 'W');
}

/// In a block with G4, U is a time.
bool dwells(const Block& block) noexcept {
  constexpr double dwell = 4;
  return std::ranges::any_of(block.words, [](const Word& w) {
    return w.letter == 'G' && w.has_value && w.value == dwell;
  });
}

/// Whether the number of a program stands where one belongs.
bool leads(const Block& block, const Word& word) noexcept {
  const Word* first = block.words.data();
  return &word == first || (first->letter == 'N' && &word == first + 1);
}

void sort_letter(Sorting& s, const Word& word) {
  const char c = word.letter;
  const bool sinumerik = s.habits.dialect == Dialect::sinumerik;
  if (c == 'E' && !s.orders.is_taken('E')) {
    const bool of_haas = std::ranges::any_of(s.block.words, [](const Word& w) {
      constexpr double smoothing = 187;
      return w.letter == 'G' && w.value == smoothing;
    });
    if (!of_haas && !is_ignored(s, word)) {
      return s.complain(
          word, Fault::unknown,
          fmt::format("{} is not known{}", s.shown(word), may_be_ignored));
    }
  }
  if (c == 'L' && sinumerik) {
    return s.complain(word, Fault::subprogram,
                      fmt::format("{}: a subprogram", s.shown(word)));
  }
  if (c == 'O' && sinumerik) {
    return s.complain(
        word, Fault::unknown,
        fmt::format("{} is not known in Sinumerik{}", s.shown(word), may_be_ignored));
  }
  if (c == 'O' && !leads(s.block, word)) {
    return s.complain(word, Fault::number,
                      fmt::format("{}: the number of a program begins its block; is it "
                                  "the digit zero?",
                                  s.shown(word)));
  }
  if (!word.has_value && !(c == 'T' && !word.inside.empty())) {
    return s.complain(word, Fault::number,
                      fmt::format("{}: not a number", s.shown(word)));
  }
  const Word*& there = s.orders.letter[static_cast<std::size_t>(c - 'A')];
  if (there != nullptr) {
    return s.complain(
        word, Fault::group,
        fmt::format("{} after {}: one letter twice", s.shown(word), s.shown(*there)));
  }
  there = &word;
  if (is_rotary(c) && !(c == 'U' && dwells(s.block))) {
    static_cast<void>(s.orders.take(c));
    sort_rotary(s, word);
  }
}

std::string_view said_of(Fault fault) noexcept {
  switch (fault) {
    case Fault::loop:
      return "a jump or a loop";
    case Fault::subprogram:
      return "a subprogram";
    case Fault::variable:
      return "a variable";
    case Fault::rotary:
      return "axes that turn";
    case Fault::cycle:
      return "a cycle";
    case Fault::arc:
      return "an arc by other words than its center or radius; post it with I J K or CR=";
    case Fault::coordinates:
      return "a frame that the control moves";
    default:
      return "a corner or a curve that the control makes up; post lines and arcs";
  }
}

/// S1=3000, M1=3: of the first spindle.
std::optional<Word> of_first_spindle(const Word& word) {
  if (word.name.size() != 2 || word.name[1] != '1' || !word.has_value) {
    return std::nullopt;
  }
  const char c = word.name[0];
  if (c != 'S' && c != 's' && c != 'M' && c != 'm') return std::nullopt;
  Word plain = word;
  plain.letter = c == 'S' || c == 's' ? 'S' : 'M';
  plain.name = {};
  return plain;
}

bool is_alone(const Block& block) noexcept {
  return std::ranges::count_if(block.words,
                               [](const Word& w) { return w.letter != 'N'; }) == 1;
}

bool is_blank_text(std::string_view text) noexcept {
  return std::ranges::all_of(text, [](char c) { return c == ' ' || c == '\t'; });
}

/// What stands between commas, blanks cut off.
std::vector<std::string_view> arguments_of(std::string_view inside) {
  std::vector<std::string_view> out;
  while (true) {
    const std::size_t comma = inside.find(',');
    std::string_view one = inside.substr(0, comma);
    while (!one.empty() && is_blank_text(one.substr(0, 1))) one.remove_prefix(1);
    while (!one.empty() && is_blank_text(one.substr(one.size() - 1)))
      one.remove_suffix(1);
    out.push_back(one);
    if (comma == std::string_view::npos) return out;
    inside.remove_prefix(comma + 1);
  }
}

/// Left out, or a zero as in 0, -0.0.
bool is_zero(std::string_view argument) noexcept {
  return std::ranges::all_of(
      argument, [](char c) { return c == '0' || c == '.' || c == '-' || c == '+'; });
}

/// CYCLE800: without shift and angles the plane stays level.
void sort_plane(Sorting& s, const Word& word) {
  static constexpr Code lift{0, Group::once, Action::lift};
  constexpr std::size_t first_shift = 4;
  constexpr std::size_t last_shift = 12;
  const std::vector<std::string_view> all = arguments_of(word.inside);
  for (std::size_t i = first_shift; i < std::min(all.size(), last_shift + 1); ++i) {
    if (is_zero(all[i])) continue;
    return s.complain(word, Fault::cycle, "CYCLE800: a tilted plane");
  }
  if (!is_zero(all.front())) add_code(s, word, lift);
}

bool is_dynamics(std::string_view name) noexcept {
  return name.size() > 3 && same_word(name.substr(0, 3), "DYN");
}

void sort_name(Sorting& s, const Word& word) {
  static constexpr Code machine{0, Group::once, Action::machine_place};
  const std::string_view name = word.name;
  const auto fault = refused_name(name, word.assigned, s.habits.dialect);
  if (fault) {
    return s.complain(word, *fault,
                      fmt::format("{}: {}", base::one_line(name), said_of(*fault)));
  }
  if (same_word(name, "CR") || same_word(name, "TURN")) {
    const Word*& there = same_word(name, "CR") ? s.orders.radius : s.orders.turns;
    if (!word.has_value || there != nullptr) {
      return s.complain(word, there != nullptr ? Fault::group : Fault::number,
                        fmt::format("{}: one number is needed", s.shown(word)));
    }
    there = &word;
    return;
  }
  if (same_word(name, "SUPA")) return add_code(s, word, machine);
  if (same_word(name, "CYCLE800")) return sort_plane(s, word);
  if (changes_frame(name)) {
    if (is_alone(s.block) && !word.brackets) return;
    return s.complain(
        word, Fault::coordinates,
        fmt::format("{}: {}", base::one_line(name), said_of(Fault::coordinates)));
  }
  if (without_effect(name) || is_dynamics(name) || is_ignored(s, word)) return;
  s.complain(
      word, Fault::unknown,
      fmt::format("{} is not known in Sinumerik{}", s.shown(word), may_be_ignored));
}

}  // namespace

Orders sort_words(Block& block, const Habits& habits, Complaints& complaints) {
  Sorting s{block, habits, complaints};
  for (Word& word : block.words) {
    if (word.letter == 0) {
      if (const auto plain = of_first_spindle(word)) word = *plain;
    }
    if (word.letter == 0) {
      sort_name(s, word);
    } else if (word.letter == 'G' || word.letter == 'M') {
      sort_code(s, word);
    } else {
      sort_letter(s, word);
    }
  }
  s.orders.take_all("NODHFST");
  if (const Word* n = s.orders.find('N')) {
    constexpr double most = 2147483647;
    s.orders.number =
        n->value >= 0 && n->value <= most ? static_cast<std::int32_t>(n->value) : -1;
  }
  return s.orders;
}

void tell_unused(Block& block, const Orders& orders, Complaints& complaints) {
  for (const Word& word : block.words) {
    const bool of_arc = &word == orders.radius || &word == orders.turns;
    const bool plain = word.letter != 0 && word.letter != 'G' && word.letter != 'M';
    const bool lost =
        of_arc ? !orders.arc_names_taken : plain && !orders.is_taken(word.letter);
    if (!lost) continue;
    complain(complaints, block, word.at, Fault::unused,
             fmt::format("{} has no effect", base::one_line(text_of(block, word))));
  }
}

void note_points(const Block& block, Points& points) {
  constexpr std::string_view lengths = "XYZIJKRQ";
  for (const Word& word : block.words) {
    if (points.any || lengths.find(word.letter) == std::string_view::npos) continue;
    points.any = word.point;
    if (points.first.line == 0) {
      points.first = {block.line, column_of(block.text, word.at)};
    }
  }
}

}  // namespace trochoid::program
