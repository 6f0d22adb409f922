#include <trochoid/cli/progress_line.h>
#include <trochoid/cli/system.h>

#include <chrono>
#include <cstdio>
#include <exception>
#include <utility>

namespace trochoid::cli {

namespace {

using namespace std::chrono_literals;

constexpr auto first_word = 2s;
constexpr auto on_terminal = 1s;
constexpr auto plain_lines = 3s;

double seconds() {
  return std::chrono::duration<double>(
             std::chrono::steady_clock::now().time_since_epoch())
      .count();
}

}  // namespace

ProgressLine::ProgressLine(Talk talk, run::Step first)
    : talk_(talk),
      terminal_(clears_lines()),
      started_(seconds()),
      step_started_(started_),
      told_(started_),
      step_(std::move(first)) {
  if (talk != Talk::nothing) {
    try {
      teller_ = std::thread([this] { tell_until_done(); });
    } catch (
        const std::exception&) {  // no thread to be had: the work is done in silence
    }
  }
}

ProgressLine::~ProgressLine() {
  {
    const std::lock_guard lock(mutex_);
    done_ = true;
  }
  ended_.notify_all();
  if (teller_.joinable()) {
    teller_.join();
  }
  tell_end_of_step();
  if (shown_ && terminal_) {
    std::fputs("\r\033[K", stderr);
  }
}

void ProgressLine::operator()(const run::Step& step) {
  const std::lock_guard lock(mutex_);
  if (step.what != step_.what) {
    tell_end_of_step();
    step_started_ = seconds();
  }
  step_ = step;
  // Where there are no threads, in a browser say, the work speaks up by itself.
  constexpr double pause = 0.3;  // [s]
  if (talk_ != Talk::nothing && !teller_.joinable() && seconds() - told_ > pause) {
    tell();
  }
}

void ProgressLine::tell_if_alone() {
  const std::lock_guard lock(mutex_);
  if (talk_ != Talk::nothing && !teller_.joinable()) tell();
}

std::string ProgressLine::doing() {
  const std::lock_guard lock(mutex_);
  const double now = seconds();
  return run::progress_text(step_, now - started_, now - step_started_);
}

void ProgressLine::tell_until_done() {
  std::unique_lock lock(mutex_);
  std::chrono::seconds wait = first_word;
  while (!ended_.wait_for(lock, wait, [this] { return done_; })) {
    try {
      tell();
    } catch (const std::exception&) {  // no memory for a line: not for that we end
    }
    wait = terminal_ ? on_terminal : plain_lines;
  }
}

void ProgressLine::tell() {
  const double now = seconds();
  const std::string text =
      run::progress_text(step_, now - started_, now - step_started_);
  std::fprintf(stderr, terminal_ ? "\r\033[K%s" : "%s\n", text.c_str());
  std::fflush(stderr);
  shown_ = true;
  told_ = now;
}

void ProgressLine::tell_end_of_step() {
  constexpr double nothing = 1e-3;  // [s]
  if (talk_ != Talk::every_step || seconds() - step_started_ < nothing) {
    return;
  }
  std::fprintf(stderr, "%s%8.2f s  %s\n", shown_ && terminal_ ? "\r\033[K" : "",
               seconds() - step_started_, step_.what.c_str());
  shown_ = false;
}

}  // namespace trochoid::cli
