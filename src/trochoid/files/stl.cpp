#include <trochoid/base/read_text.h>
#include <trochoid/base/units.h>
#include <trochoid/files/numeric_table.h>
#include <trochoid/files/program_file.h>

#include <fmt/core.h>

#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>
#include <string_view>

namespace trochoid::files {

namespace {

constexpr std::size_t head_bytes = 84;
constexpr std::size_t face_bytes = 50;

std::uint32_t count_in(std::string_view bytes) noexcept {
  std::uint32_t count = 0;
  std::memcpy(&count, bytes.data() + head_bytes - sizeof count, sizeof count);
  return count;
}

/// A binary file is as long as its number of faces says, whatever its first word is.
bool is_binary(std::string_view bytes) noexcept {
  return bytes.size() >= head_bytes &&
         bytes.size() == head_bytes + face_bytes * std::size_t{count_in(bytes)};
}

std::vector<stock::Triangle> binary_faces(std::string_view bytes) {
  std::vector<stock::Triangle> faces(count_in(bytes));
  for (std::size_t i = 0; i < faces.size(); ++i) {
    std::array<float, 9> numbers{};  // behind the normal
    std::memcpy(numbers.data(), bytes.data() + head_bytes + face_bytes * i + 12,
                sizeof numbers);
    for (std::size_t k = 0; k < 9; ++k) {
      faces[i][k / 3][k % 3] = static_cast<double>(numbers[k]) * unit::mm;
    }
  }
  return faces;
}

/// The words of a text, with their lines.
class Words {
 public:
  explicit Words(std::string_view text) : rest_(text) {}

  std::optional<std::string_view> next() {
    while (!rest_.empty() && is_blank(rest_.front())) {
      if (rest_.front() == '\n') ++line_;
      rest_.remove_prefix(1);
    }
    if (rest_.empty()) return std::nullopt;
    std::size_t n = 0;
    while (n < rest_.size() && !is_blank(rest_[n])) ++n;
    const std::string_view word = rest_.substr(0, n);
    rest_.remove_prefix(n);
    return word;
  }
  [[nodiscard]] std::size_t line() const noexcept { return line_; }

 private:
  static bool is_blank(char c) noexcept {
    return c == ' ' || c == '\t' || c == '\n' || c == '\r';
  }
  std::string_view rest_;
  std::size_t line_ = 1;
};

std::vector<stock::Triangle> text_faces(std::string_view text, const FileRef& file) {
  Words words(text);
  std::vector<stock::Triangle> faces;
  std::size_t corners = 0;
  while (const auto word = words.next()) {
    if (*word == "endloop" && corners % 3 != 0) {
      refuse(file.path,
             fmt::format("line {}: a face must have three corners", words.line()));
    }
    if (*word != "vertex") continue;
    if (corners % 3 == 0) faces.emplace_back();
    for (double& coordinate : faces.back()[corners % 3]) {
      const auto number = words.next().value_or("");
      const char* end = number.data() + number.size();
      const auto read = std::from_chars(number.data(), end, coordinate);
      if (number.empty() || read.ec != std::errc{} || read.ptr != end) {
        refuse(file.path,
               fmt::format("line {}: a vertex must have three numbers", words.line()));
      }
      coordinate *= unit::mm;
    }
    ++corners;
  }
  if (corners % 3 != 0) refuse(file.path, "the file ends within a face");
  return faces;
}

}  // namespace

std::vector<stock::Triangle> read_stl(const FileRef& file) {
  std::optional<std::string> read;
  if (!file.bytes) read = base::read_text(file.path);
  if (!file.bytes && !read) refuse(file.path, "cannot be read");
  const std::string_view bytes = file.bytes ? *file.bytes : *read;
  const bool text = bytes.substr(0, 5) == "solid";
  if (!is_binary(bytes) && !text) {
    refuse(file.path,
           "this is no STL: must begin with \"solid\", or be as long as the number of "
           "its faces says");
  }
  const auto faces = is_binary(bytes) ? binary_faces(bytes) : text_faces(bytes, file);
  if (faces.empty()) refuse(file.path, "it has no face");
  for (const stock::Triangle& face : faces) {
    for (const stock::Point& p : face) {
      const double size = std::hypot(p[0], p[1], p[2]);
      if (!(size < 100.0)) {
        refuse(file.path, "a corner is farther than 100 m from zero");
      }
    }
  }
  if (const std::size_t open = stock::open_edges(faces); open > 0) {
    refuse(file.path,
           fmt::format("the surface is not closed: {} edges have a face on one "
                       "side only; close it where the file was made",
                       open));
  }
  return faces;
}

}  // namespace trochoid::files
