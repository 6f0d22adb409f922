#include <trochoid/files/npy_head.h>

#include <trochoid/files/csv.h>
#include <trochoid/files/numeric_table.h>

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <charconv>

namespace trochoid::files {

namespace {

constexpr std::size_t most_fields = 10000;
constexpr std::uint64_t longest_text = 1U << 20U;

/// Takes pieces of the description off its front.
struct Pieces {
  std::string_view left;
  const std::string& name;

  [[noreturn]] void stop() const {
    refuse(name,
           fmt::format("the description of this NumPy array is not understood from "
                       "{} on: the file is damaged, or of another version",
                       excerpt(left)));
  }
  void skip_blanks() {
    while (!left.empty() && (left.front() == ' ' || left.front() == '\n')) {
      left.remove_prefix(1);
    }
  }
  bool next_is(char c) {
    skip_blanks();
    return !left.empty() && left.front() == c;
  }
  bool take_if(char c) {
    if (!next_is(c)) return false;
    left.remove_prefix(1);
    return true;
  }
  void take(char c) {
    if (!take_if(c)) stop();
  }
  std::string_view quoted() {
    skip_blanks();
    const char mark = left.empty() ? '\0' : left.front();
    const auto end = left.find(mark, 1);
    if ((mark != '\'' && mark != '"') || end == std::string_view::npos) stop();
    const auto text = left.substr(1, end - 1);
    left.remove_prefix(end + 1);
    return text;
  }
  std::uint64_t whole() {
    skip_blanks();
    std::uint64_t value = 0;
    const auto [end, error] =
        std::from_chars(left.data(), left.data() + left.size(), value);
    if (error != std::errc{}) stop();
    left.remove_prefix(static_cast<std::size_t>(end - left.data()));
    return value;
  }
  bool truth() {
    skip_blanks();
    for (const std::string_view word : {"True", "False"}) {
      if (!left.starts_with(word)) continue;
      left.remove_prefix(word.size());
      return word == "True";
    }
    stop();
  }
};

struct Kind {
  std::string_view code;
  NumberKind kind;
};
constexpr std::array kinds = {Kind{"f8", NumberKind::f64}, Kind{"f4", NumberKind::f32},
                              Kind{"i1", NumberKind::i8},  Kind{"i2", NumberKind::i16},
                              Kind{"i4", NumberKind::i32}, Kind{"i8", NumberKind::i64},
                              Kind{"u1", NumberKind::u8},  Kind{"u2", NumberKind::u16},
                              Kind{"u4", NumberKind::u32}, Kind{"u8", NumberKind::u64},
                              Kind{"b1", NumberKind::u8}};

/// Append the field that a code like `<f8` means; its bytes are added to the item's.
void add_field(NpyHead& head, std::string_view code, std::string_view field,
               const std::string& name) {
  NpyField made{.name = std::string(field), .offset = head.item_bytes};
  const char mark = code.empty() ? '\0' : code.front();
  const bool known = mark == '<' || mark == '>' || mark == '|' || mark == '=';
  const auto plain = known ? code.substr(1) : std::string_view();
  made.order = mark == '>' ? std::endian::big : std::endian::little;
  const auto* const found = std::find_if(
      kinds.begin(), kinds.end(), [&](const Kind& kind) { return kind.code == plain; });
  std::uint64_t bytes = 0;
  if (found != kinds.end()) {
    made.kind = found->kind;
    bytes = size_of(found->kind);
  } else if (plain.starts_with('S') || plain.starts_with('U') ||
             plain.starts_with('V')) {
    Pieces size{.left = plain.substr(1), .name = name};
    bytes = std::min(size.whole(), longest_text) * (plain.front() == 'U' ? 4 : 1);
  } else {
    refuse(name,
           fmt::format("the numbers of this NumPy array are of the kind {}, which "
                       "is not read: save them with astype('float64')",
                       excerpt(code)));
  }
  head.item_bytes += bytes;
  head.fields.push_back(std::move(made));
}

/// `'<f8'`, or a list of fields `('Fx', '<f8')`.
void read_items(NpyHead& head, Pieces& pieces) {
  if (!pieces.take_if('[')) {
    add_field(head, pieces.quoted(), "", pieces.name);
    return;
  }
  while (!pieces.take_if(']')) {
    pieces.take('(');
    const auto field = pieces.quoted();
    pieces.take(',');
    if (!pieces.next_is('\'') && !pieces.next_is('"')) {
      refuse(pieces.name,
             fmt::format("the field {} of this NumPy array has fields of its own: save "
                         "them side by side",
                         excerpt(field)));
    }
    add_field(head, pieces.quoted(), field, pieces.name);
    if (pieces.take_if(',') && !pieces.next_is(')')) {
      refuse(pieces.name, fmt::format("the field {} of this NumPy array is an array: "
                                      "save its columns side by side",
                                      excerpt(field)));
    }
    pieces.take(')');
    pieces.take_if(',');
    if (head.fields.size() > most_fields) pieces.stop();
  }
}

void read_shape(NpyHead& head, Pieces& pieces) {
  pieces.take('(');
  while (!pieces.take_if(')')) {
    head.shape.push_back(pieces.whole());
    pieces.take_if(',');
    if (head.shape.size() > 32) pieces.stop();
  }
}

}  // namespace

NpyHead npy_head(std::string_view text, const std::string& name) {
  Pieces pieces{.left = text, .name = name};
  NpyHead head;
  bool shaped = false;
  pieces.take('{');
  while (!pieces.take_if('}')) {
    const auto key = pieces.quoted();
    pieces.take(':');
    if (key == "descr" && head.fields.empty()) {
      read_items(head, pieces);
    } else if (key == "fortran_order") {
      head.fortran_order = pieces.truth();
    } else if (key == "shape" && !shaped) {
      read_shape(head, pieces);
      shaped = true;
    } else {
      pieces.stop();
    }
    pieces.take_if(',');
  }
  if (head.fields.empty() || !shaped || head.item_bytes == 0) pieces.stop();
  return head;
}

}  // namespace trochoid::files
