#include <trochoid/program/split_block.h>

#include <trochoid/base/units.h>

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace trochoid::program {

namespace {

using Point = std::array<double, 3>;
constexpr std::string_view axis_names = "XYZ";
constexpr double whole_turn = 2 * std::numbers::pi;

bool is_one_of(double value, std::initializer_list<double> all) noexcept {
  return std::ranges::find(all, value) != all.end();
}

/// Words that are executed before the move, and hold afterwards as well.
bool acts_before(const Word& word) noexcept {
  if (word.letter == 0 || word.sense != Sense::modal || !word.has_value) return false;
  switch (word.letter) {
    case 'G':
      return is_one_of(word.value,
                       {1, 2, 3, 17, 20, 21, 40, 90, 91, 90.1, 91.1, 94, 95, 93});
    case 'M':
      return is_one_of(word.value, {3, 7, 8});
    case 'N':
    case 'X':
    case 'Y':
    case 'Z':
    case 'I':
    case 'J':
    case 'R':
    case 'F':
    case 'S':
      return true;
    default:
      return false;
  }
}

const Word* find(const Block& block, char letter) noexcept {
  const auto at = std::ranges::find(block.words, letter, &Word::letter);
  return at == block.words.end() ? nullptr : &*at;
}

/// With a blank between.
void append(std::string_view word, std::string& text) {
  if (word.empty()) return;
  if (!text.empty()) text += ' ';
  text.append(word);
}

const Point& zero_of(const Program& program, std::size_t move) {
  const auto after =
      std::ranges::upper_bound(program.zeros, move, {}, &Zero::first_move);
  return std::prev(after)->place;
}

/// Turns the parts of a move into words.
class Splitter {
 public:
  Splitter(const MoveBlock& of, std::span<const SplitPart> parts)
      : block_(of.block),
        move_(of.program.moves[of.move]),
        start_(of.program.moves[of.move - 1].end),
        zero_(zero_of(of.program, of.move)),
        parts_(parts),
        inches_((move_.writing & in_inches) != 0),
        unit_(inches_ ? unit::inch : unit::mm),
        digits_(digits_of(block_, inches_)) {
    for (std::size_t i = 0; i < 3; ++i) {
      axes_[i] = find(block_, axis_names[i]);
    }
    find_ends();
  }

  [[nodiscard]] std::vector<std::string> texts() const {
    std::vector<std::string> out{first_text()};
    for (std::size_t k = 1; k < parts_.size(); ++k) {
      std::string text;
      if (is_arc()) append(move_.turn > 0 ? "G3" : "G2", text);
      for (const std::string& word : words_of(k)) append(word, text);
      append(parts_[k].F, text);
      out.push_back(std::move(text));
    }
    return out;
  }

 private:
  [[nodiscard]] bool is_arc() const noexcept { return move_.kind == MoveKind::arc; }
  [[nodiscard]] bool writes(std::size_t axis) const noexcept {
    return axes_[axis] != nullptr || (is_arc() && axis < 2);
  }

  [[nodiscard]] Point point_at(double u) const noexcept {
    Point p{};
    for (std::size_t i = 0; i < 3; ++i) {
      p[i] = start_[i] + u * (move_.end[i] - start_[i]);
    }
    if (is_arc()) {
      const double c = std::cos(u * move_.turn);
      const double s = std::sin(u * move_.turn);
      const double x = start_[0] - move_.center[0];
      const double y = start_[1] - move_.center[1];
      p[0] = move_.center[0] + c * x - s * y;
      p[1] = move_.center[1] + s * x + c * y;
    }
    return p;
  }

  /// Places as they are written: rounded, but for the last one.
  void find_ends() {
    ends_.push_back(in_program(start_));
    const double grid = std::pow(10.0, digits_);
    for (const SplitPart& part : parts_.first(parts_.size() - 1)) {
      Point p = in_program(point_at(part.to));
      for (double& value : p) value = std::round(value * grid) / grid;
      ends_.push_back(p);
    }
    ends_.push_back(in_program(move_.end));
  }

  [[nodiscard]] Point in_program(Point p) const noexcept {
    for (std::size_t i = 0; i < 3; ++i) p[i] = (p[i] - zero_[i]) / unit_;
    return p;
  }

  [[nodiscard]] std::string axis_word(std::size_t axis, std::size_t k) const {
    const bool last = k + 1 == parts_.size();
    const bool steps = (move_.writing & by_increments) != 0;
    const bool written = !steps && axes_[axis] != nullptr;
    if (written && (last || ends_[k + 1][axis] == axes_[axis]->value)) {
      return std::string(text_of(block_, *axes_[axis]));
    }
    const double before = steps ? ends_[k][axis] : 0.0;
    // What is left of an increment may need the digits of its start.
    return axis_names[axis] +
           number_text(ends_[k + 1][axis] - before, last || steps ? 7 : digits_);
  }

  /// By the center where the program gives the radius, too: near half a circle rounded ends
  /// and a radius tell little of it.
  [[nodiscard]] std::vector<std::string> center_words(std::size_t k) const {
    std::vector<std::string> out;
    const Point center = in_program({move_.center[0], move_.center[1], 0.0});
    for (std::size_t axis = 0; axis < 2; ++axis) {
      const bool by_place = (move_.writing & center_by_place) != 0;
      out.push_back("IJ"[axis] +
                    number_text(center[axis] - (by_place ? 0.0 : ends_[k][axis]),
                                by_place ? 7 : digits_ + 1));
    }
    return out;
  }

  [[nodiscard]] std::vector<std::string> words_of(std::size_t k) const {
    std::vector<std::string> out;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const bool stays = k > 0 && !is_arc() && start_[axis] == move_.end[axis];
      if (writes(axis) && !stays) out.push_back(axis_word(axis, k));
    }
    if (is_arc()) {
      for (std::string& word : center_words(k)) out.push_back(std::move(word));
    }
    return out;
  }

  /// The block with its other words where they stand.
  [[nodiscard]] std::string first_text() const {
    std::vector<std::string> texts(block_.words.size());
    std::string behind;
    bool has_F = false;
    const std::vector<std::string> words = words_of(0);
    std::vector<bool> placed(words.size(), false);
    for (std::size_t i = 0; i < block_.words.size(); ++i) {
      const char letter = block_.words[i].letter;
      for (std::size_t w = 0; w < words.size(); ++w) {
        const bool is_center = letter == 'I' || letter == 'J';
        if (words[w].front() != letter) continue;
        placed[w] = true;
        if (!is_center) texts[i] = words[w];  // it starts where it did
      }
      if (letter == 'R' && is_arc()) {
        for (const std::string& word : center_words(0)) append(word, texts[i]);
      }
      if (letter == 'F') {
        has_F = true;
        texts[i] = parts_[0].F;
      }
    }
    for (std::size_t w = 0; w < words.size(); ++w) {
      const bool is_center = words[w].front() == 'I' || words[w].front() == 'J';
      if (!placed[w] && !is_center) append(words[w], behind);
    }
    if (!has_F) append(parts_[0].F, behind);
    if (!behind.empty()) behind.insert(0, 1, ' ');
    return with_words(block_, texts, behind);
  }

  const Block& block_;
  const Move& move_;
  Point start_;
  Point zero_;
  std::span<const SplitPart> parts_;
  bool inches_;
  double unit_;
  int digits_;
  std::array<const Word*, 3> axes_{};
  std::vector<Point> ends_;  ///< in the unit of the program, from its zero
};

}  // namespace

bool can_split(const MoveBlock& of) {
  const Block& block = of.block;
  const Move& move = of.program.moves[of.move];
  if (of.move == 0 || block.deleted || block.optional_from != Block::all) return false;
  if (move.kind != MoveKind::line && move.kind != MoveKind::arc) return false;
  if (move.note != MoveNote::none || std::abs(move.turn) > whole_turn + 1e-9) {
    return false;
  }
  return std::ranges::all_of(block.words, acts_before);
}

std::vector<std::string> split_texts(const MoveBlock& of,
                                     std::span<const SplitPart> parts) {
  return Splitter(of, parts).texts();
}

std::string with_words(const Block& block, std::span<const std::string> texts,
                       std::string_view behind) {
  std::string out;
  std::size_t at = 0;
  for (std::size_t i = 0; i < block.words.size(); ++i) {
    const Word& word = block.words[i];
    const std::size_t end = word.at + word.size;
    if (!texts[i].empty()) {
      out += block.text.substr(at, word.at - at);
      out += texts[i];
      at = end;
    }
    const bool last = i + 1 == block.words.size();
    const bool next_is_optional = i + 1 == block.optional_from;
    if ((last && block.optional_from > i) || next_is_optional) {
      if (at < end) out += block.text.substr(at, end - at);
      out += behind;
      at = std::max(at, end);
    }
  }
  return out += block.text.substr(at);
}

std::string number_text(double value, int digits) {
  std::string text = fmt::format("{:#.{}f}", value, digits);
  text.erase(text.find_last_not_of('0') + 1);
  if (text == "-0.") text.erase(0, 1);
  return text;
}

int digits_of(const Block& block, bool inches) noexcept {
  std::size_t most = inches ? 4 : 3;
  for (const Word& word : block.words) {
    if (axis_names.find(word.letter) == std::string_view::npos || word.letter == 0) {
      continue;
    }
    const std::string_view text = text_of(block, word);
    const std::size_t point = text.find('.');
    if (point == std::string_view::npos) continue;
    std::size_t digits = 0;
    for (std::size_t i = point + 1; i < text.size(); ++i) {
      if (text[i] >= '0' && text[i] <= '9') ++digits;
    }
    most = std::max(most, digits);
  }
  return static_cast<int>(std::min<std::size_t>(most, 6));
}

}  // namespace trochoid::program
