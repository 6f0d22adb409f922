#include <trochoid/program/write_feeds.h>

#include <trochoid/base/units.h>
#include <trochoid/program/dialect.h>
#include <trochoid/program/split_block.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace trochoid::program {

namespace {

constexpr double minute = 60;
/// Feeds that differ by less are one.
constexpr double same_feed = 1e-9;

bool is_fed(const Move& move) noexcept {
  using enum MoveKind;
  return move.feed > 0 && (move.kind == line || move.kind == arc || move.kind == chord);
}

/// A word F, or none.
const Word* feed_word(const Block& block) noexcept {
  const auto at = std::ranges::find(block.words, 'F', &Word::letter);
  return at == block.words.end() ? nullptr : &*at;
}

/// In Sinumerik F of a dwell is a time; elsewhere it is a feed.
bool is_dwell(const Block& block, Dialect dialect) noexcept {
  return dialect == Dialect::sinumerik &&
         std::ranges::any_of(block.words, [](const Word& w) {
           return w.letter == 'G' && w.value == 4;
         });
}

/// Words behind a / may be left out at the machine: which feed holds then is not known, and
/// the next one is written.
bool is_optional(const Block& block) noexcept {
  return block.deleted || block.optional_from != Block::all;
}
constexpr std::string_view not_known = "not known";

/// A number that is whole has a point where others of the program have one.
std::string as_written(std::string text, bool point) {
  if (text.back() == '.' && !point) text.pop_back();
  return text;
}

/// The number of an F word, of four digits or all before the point, rounded down.
std::string rounded_down(double value, bool point) {
  constexpr double digit = 1e-9;  // what is this near the next one is that one
  const int before = static_cast<int>(std::floor(std::log10(value))) + 1;
  const int digits = std::clamp(4 - before, 0, 7);
  const double grid = std::pow(10.0, digits);
  std::string text = number_text(std::floor(value * grid * (1 + digit)) / grid, digits);
  return as_written(std::move(text), point);
}

/// Goes through the text line by line.
class FeedWriter {
 public:
  FeedWriter(const Program& program, std::span<const FeedPart> parts, bool split)
      : program_(program), parts_(parts), splits_(split) {}

  std::string write(std::string_view text) {
    constexpr std::string_view mark = "\xEF\xBB\xBF";
    if (text.starts_with(mark)) {
      out_ += mark;
      text.remove_prefix(mark.size());
    }
    Block block;
    Complaints ignored;
    for (std::size_t at = 0; at < text.size(); ++block.line) {
      const auto [line, next] = line_at(text, at);
      block.text = line;
      program::split(block, program_.dialect, ignored);
      ignored = {};
      ending_ = text.substr(at + line.size(), next - at - line.size());
      if (!ending_.empty()) usual_ending_ = ending_;
      write_block(block);
      at = next;
    }
    return std::move(out_);
  }

 private:
  /// The moves of a line, which follow one another.
  std::span<const Move> moves_of(std::uint32_t line) {
    const auto& moves = program_.moves;
    while (move_ < moves.size() && moves[move_].line < line) ++move_;
    std::size_t end = move_;
    while (end < moves.size() && moves[end].line == line) ++end;
    return std::span(moves).subspan(move_, end - move_);
  }

  /// The parts of some moves.
  std::span<const FeedPart> parts_of(std::size_t moves) {
    while (part_ < parts_.size() && parts_[part_].move < move_) ++part_;
    std::size_t end = part_;
    while (end < parts_.size() && parts_[end].move < move_ + moves) ++end;
    return parts_.subspan(part_, end - part_);
  }

  void write_block(const Block& block) {
    const auto moves = moves_of(block.line);
    const auto fed = std::ranges::find_if(moves, is_fed);
    const Word* F = is_dwell(block, program_.dialect) ? nullptr : feed_word(block);
    if (F != nullptr && F->has_value) {
      point_ = text_of(block, *F).find('.') != std::string_view::npos;
    }
    if (fed == moves.end()) {
      if (F != nullptr) current_.clear();
      if (F != nullptr && is_optional(block)) current_ = not_known;
      return copy(block.text);
    }
    const auto parts = parts_of(moves.size());
    const auto index = static_cast<std::size_t>(fed - moves.begin()) + move_;
    const MoveBlock of{block, program_, index};
    const bool alone = std::ranges::count_if(moves, is_fed) == 1;
    if (parts.size() > 1 && splits_ && alone && can_split(of)) {
      return write_parts(of, parts);
    }
    double feed = parts.empty() ? fed->feed : parts.front().feed;
    for (const FeedPart& part : parts) feed = std::min(feed, part.feed);
    const std::string text = word_for(feed, *fed, F);
    if (is_optional(block) && (F != nullptr || !text.empty())) current_ = not_known;
    if (text.empty()) return copy(block.text);
    std::vector<std::string> texts(block.words.size());
    if (F == nullptr) return copy(with_words(block, texts, ' ' + text));
    texts[static_cast<std::size_t>(F - block.words.data())] = text;
    copy(with_words(block, texts, ""));
  }

  void write_parts(const MoveBlock& of, std::span<const FeedPart> parts) {
    const Move& move = program_.moves[of.move];
    const double length = move.feed * move.time;
    const bool inverse = (move.writing & inverse_time) != 0;
    std::vector<SplitPart> out;
    for (std::size_t i = 0; i < parts.size(); ++i) {
      const double part = length * (parts[i].to - parts[i].from);
      const Word* F = i == 0 ? feed_word(of.block) : nullptr;
      out.push_back({parts[i].to, inverse ? inverse_word(parts[i].feed / part)
                                          : word_for(parts[i].feed, move, F)});
    }
    const std::vector<std::string> texts = split_texts(of, out);
    for (std::size_t i = 0; i + 1 < texts.size(); ++i) {
      out_ += texts[i];
      out_ += usual_ending_;
    }
    copy(texts.back());
  }

  /// The F word that a feed needs where it comes; empty: what stands there does.
  std::string word_for(double feed, const Move& move, const Word* F) {
    const bool inverse = (move.writing & inverse_time) != 0;
    const bool same = std::abs(feed - move.feed) <= same_feed * move.feed;
    if (inverse) {
      return same || F == nullptr ? "" : inverse_word(feed / (move.feed * move.time));
    }
    if (same && (F != nullptr || current_.empty())) {
      current_.clear();
      return "";
    }
    const double number = value_of(feed, move);
    std::string text = 'F' + (same ? as_written(number_text(number, 6), point_)
                                   : rounded_down(number, point_));
    if (F == nullptr && current_ == text) return "";
    if (same) {
      current_.clear();
    } else {
      current_ = text;
    }
    return text;
  }

  std::string inverse_word(double per_second) const {
    return 'F' + rounded_down(per_second * minute, point_);
  }

  static double value_of(double feed, const Move& move) noexcept {
    const double unit = (move.writing & feed_in_inches) != 0 ? unit::inch : unit::mm;
    if ((move.writing & feed_per_turn) != 0) {
      return feed * unit::turn / move.spindle / unit;
    }
    return feed * minute / unit;
  }

  void copy(std::string_view text) {
    out_ += text;
    out_ += ending_;
  }

  const Program& program_;
  std::span<const FeedPart> parts_;
  bool splits_;
  std::string out_;
  std::string_view ending_;               ///< of this line; the last one may have none
  std::string_view usual_ending_ = "\n";  ///< of the line before it
  std::size_t move_ = 0;  ///< the first one of this line or of later ones
  std::size_t part_ = 0;  ///< likewise
  std::string current_;   ///< F that holds; empty: the program's
  bool point_ = false;    ///< F words have one
};

}  // namespace

std::string write_feeds(std::string_view text, const Program& program,
                        std::span<const FeedPart> parts, bool split) {
  return FeedWriter(program, parts, split).write(text);
}

}  // namespace trochoid::program
