#include <trochoid/numerics/thread_count.h>

#include <trochoid/base/error.h>

#include <charconv>
#include <cstdlib>
#include <string>
#include <string_view>
#include <system_error>

namespace trochoid::numerics {

std::unique_ptr<ThreadLimit> thread_limit_of_environment() {
  const char* text = std::getenv("TROCHOID_THREADS");
  if (text == nullptr) {
    return nullptr;
  }
  const std::string_view wanted(text);
  int threads = 0;
  const auto read =
      std::from_chars(wanted.data(), wanted.data() + wanted.size(), threads);
  if (read.ec != std::errc{} || read.ptr != wanted.data() + wanted.size() ||
      threads < 1 || threads > most_threads) {
    throw base::InputError({"TROCHOID_THREADS = \"" + std::string(wanted) +
                            "\": not a number of threads, from 1 to " +
                            std::to_string(most_threads)});
  }
  return std::make_unique<ThreadLimit>(threads);
}

}  // namespace trochoid::numerics
