#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <string>
#include <unordered_map>
#include <vector>

namespace trochoid::base {

/// @brief A long list of texts of which few are different: each of these is kept once.
class Texts {
 public:
  Texts() = default;
  Texts(std::initializer_list<std::string> texts) {
    for (const std::string& text : texts) push_back(text);
  }

  void push_back(const std::string& text) {
    const auto fresh = static_cast<std::uint32_t>(words_.size());
    const auto [known, added] = numbers_.try_emplace(text, fresh);
    if (added) words_.push_back(text);
    list_.push_back(known->second);
  }

  [[nodiscard]] bool empty() const noexcept { return list_.empty(); }
  [[nodiscard]] std::size_t size() const noexcept { return list_.size(); }
  const std::string& operator[](std::size_t i) const { return words_[list_[i]]; }

  /// The different ones.
  [[nodiscard]] const std::vector<std::string>& words() const noexcept {
    return words_;
  }

  /// Forget those behind the first ones.
  void cut(std::size_t size) {
    if (size < list_.size()) list_.resize(size);
  }

 private:
  std::vector<std::uint32_t> list_;
  std::vector<std::string> words_;
  std::unordered_map<std::string, std::uint32_t> numbers_;
};

}  // namespace trochoid::base
