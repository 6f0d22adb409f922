#pragma once

#include <concepts>
#include <functional>
#include <string>
#include <type_traits>
#include <utility>

namespace trochoid::run {

/// @brief What a long command is doing, and how much of that is done.
struct Step {
  std::string what;     ///< for example `limit depth`
  double share = -1.0;  ///< from 0 to 1; below 0: not known

  // Implicit: most steps are a text alone.
  Step(const char* text) : what(text) {}
  Step(std::string text) : what(std::move(text)) {}
  Step(std::string text, double done) : what(std::move(text)), share(done) {}
  /// For those who want the text alone.
  operator const std::string&() const noexcept { return what; }
};

/// @brief Told what a long command is doing; may be empty: then nobody is told.
class Progress {
 public:
  Progress() = default;
  // Implicit: whatever takes a step is one.
  template <class Tell>
  requires(!std::same_as<std::remove_cvref_t<Tell>, Progress> &&
           std::invocable<Tell&, const Step&>) Progress(Tell tell)
      : tell_(std::move(tell)) {}

  /// Whether somebody is told.
  explicit operator bool() const noexcept { return static_cast<bool>(tell_); }

  void operator()(const Step& step) const {
    if (tell_) {
      tell_(step);
    }
  }

 private:
  std::function<void(const Step& step)> tell_;
};

/// @brief A line for a person: `limit depth: 40 %, 12 s, about 18 s left`.
/// @param elapsed  since the command began [s]
/// @param in_step  since this step began [s]: what is left is judged from it
std::string progress_text(const Step& step, double elapsed, double in_step);

}  // namespace trochoid::run
