#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <utility>

namespace trochoid::cases {

/// @brief Data of a case. Their file is read when they are first needed, so that a command
/// neither waits for a file that it does not use nor fails on it.
///
/// Copies share the data.
template <class Data>
class Held {
 public:
  Held() = default;
  /// Data that are there already.
  explicit Held(Data data) : state_(std::make_shared<State>()) {
    state_->data = std::move(data);
  }
  /// @param read  asked at most once, unless it throws
  static Held by(std::function<Data()> read) {
    Held held;
    held.state_ = std::make_shared<State>();
    held.state_->read = std::move(read);
    return held;
  }

  /// @throws base::InputError  with all that is wrong with the file
  const Data& get() const {
    if (!state_) throw std::logic_error("the case has no such data");
    const std::lock_guard lock(state_->guard);
    if (!state_->data) state_->data = state_->read();
    return *state_->data;
  }

 private:
  struct State {
    std::mutex guard;
    std::optional<Data> data;
    std::function<Data()> read;
  };
  std::shared_ptr<State> state_;
};

}  // namespace trochoid::cases
