#include <trochoid/files/child_process.h>

#include <trochoid/base/error.h>
#include <trochoid/files/numeric_table.h>

#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstring>

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

namespace trochoid::files {

namespace {

/// Nothing that is read takes so long [s].
constexpr rlim_t longest = 300;
constexpr std::string_view arrived_whole = "whole";

/// Writes what the other process reads with the same calls in the same order.
struct PipeWriter {
  std::string bytes;

  void raw(const void* data, std::size_t size) {
    bytes.append(static_cast<const char*>(data), size);
  }
  void number(std::uint64_t value) { raw(&value, sizeof value); }
  void text(std::string_view value) {
    number(value.size());
    bytes += value;
  }
  void values(const std::vector<double>& v) {
    number(v.size());
    raw(v.data(), v.size() * sizeof(double));
  }
};

struct PipeReader {
  std::string_view left;

  std::string_view take(std::uint64_t count) {
    const auto taken = left.substr(0, static_cast<std::size_t>(count));
    left.remove_prefix(taken.size());
    return taken;
  }
  std::uint64_t number() {
    std::uint64_t value = 0;
    const auto bytes = take(sizeof value);
    std::memcpy(&value, bytes.data(), bytes.size());
    return value;
  }
  std::string text() { return std::string(take(number())); }
  std::vector<double> values() {
    const auto bytes = take(number() * sizeof(double));
    std::vector<double> v(bytes.size() / sizeof(double));
    if (!v.empty()) std::memcpy(v.data(), bytes.data(), v.size() * sizeof(double));
    return v;
  }
};

void write_record(const signal::Record& record, PipeWriter& out) {
  for (const auto& channel : record.channel) out.values(channel);
  for (const bool measured : record.measured) out.number(measured ? 1 : 0);
  out.number(record.further.size());
  for (const auto& channel : record.further) out.values(channel);
  for (const auto& column : record.further_column) out.text(column);
  out.values(record.angle);
  out.values(record.time);
  out.values(record.line);
  out.values({record.sample_rate});
  for (const auto& column : record.channel_column) out.text(column);
  out.text(record.angle_column);
  out.text(record.time_column);
  out.number(record.notes.size());
  for (const auto& [code, message] : record.notes) {
    out.text(code);
    out.text(message);
  }
}

signal::Record record_in(PipeReader& in) {
  signal::Record record;
  for (auto& channel : record.channel) channel = in.values();
  for (bool& measured : record.measured) measured = in.number() != 0;
  record.further.resize(in.number());
  for (auto& channel : record.further) channel = in.values();
  record.further_column.resize(record.further.size());
  for (auto& column : record.further_column) column = in.text();
  record.angle = in.values();
  record.time = in.values();
  record.line = in.values();
  record.sample_rate = in.values().at(0);
  for (auto& column : record.channel_column) column = in.text();
  record.angle_column = in.text();
  record.time_column = in.text();
  for (auto count = in.number(); count > 0; --count) {
    auto code = in.text();
    record.notes.push_back({std::move(code), in.text()});
  }
  return record;
}

/// What the process of its own says: problems or a record, and that this is all.
std::string answer_of(const std::function<signal::Record()>& read) {
  PipeWriter out;
  try {
    const auto record = read();
    out.number(0);
    write_record(record, out);
  } catch (const base::InputError& error) {
    out.bytes.clear();
    out.number(error.problems().size());
    for (const auto& problem : error.problems()) out.text(problem);
  }
  out.bytes += arrived_whole;
  return std::move(out.bytes);
}

[[noreturn]] void answer_and_end(int to, const std::function<signal::Record()>& read) {
  // What the program does when it breaks down itself is not for this process.
  for (const int fatal : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGALRM}) {
    std::signal(fatal, SIG_DFL);
  }
  const rlimit limit{longest, longest};
  setrlimit(RLIMIT_CPU, &limit);
  const int nowhere = ::open("/dev/null", O_WRONLY);
  if (nowhere >= 0) dup2(nowhere, STDERR_FILENO);  // last words of what breaks down
  try {
    const auto answer = answer_of(read);
    std::string_view left = answer;
    while (!left.empty()) {
      const auto written = ::write(to, left.data(), left.size());
      if (written <= 0) _exit(1);
      left.remove_prefix(static_cast<std::size_t>(written));
    }
  } catch (...) {
    _exit(1);
  }
  _exit(0);  // without the farewells of libraries
}

std::string all_of(int from) {
  std::string bytes;
  std::string part(std::size_t{1} << 16U, '\0');
  while (true) {
    const auto count = ::read(from, part.data(), part.size());
    if (count < 0 && errno == EINTR) continue;
    if (count <= 0) return bytes;
    bytes.append(part, 0, static_cast<std::size_t>(count));
  }
}

}  // namespace

signal::Record read_in_child_process(const std::string& name,
                                     const std::function<signal::Record()>& read) {
  int ends[2] = {-1, -1};
  const pid_t child = pipe(ends) == 0 ? fork() : -1;
  if (child == 0) {
    close(ends[0]);
    answer_and_end(ends[1], read);
  }
  if (ends[1] >= 0) close(ends[1]);
  const std::string answer = child > 0 ? all_of(ends[0]) : std::string();
  if (ends[0] >= 0) close(ends[0]);
  if (child < 0) refuse(name, "no process can be started to read it");
  while (waitpid(child, nullptr, 0) < 0 && errno == EINTR) {
  }
  if (!answer.ends_with(arrived_whole)) {
    refuse(name,
           "the library that reads this format broke down over it, or ran out of "
           "memory: the file is damaged");
  }
  PipeReader in{.left = answer};
  std::vector<std::string> problems(static_cast<std::size_t>(in.number()));
  for (auto& problem : problems) problem = in.text();
  if (!problems.empty()) throw base::InputError(problems);
  auto record = record_in(in);
  record.file = name;
  return record;
}

}  // namespace trochoid::files
