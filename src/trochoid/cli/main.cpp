#include <trochoid/base/command.h>
#include <trochoid/base/error.h>
#include <trochoid/cases/case_source.h>
#include <trochoid/cases/document.h>
#include <trochoid/cases/findings.h>
#include <trochoid/cli/commands.h>
#include <trochoid/cli/deliver.h>
#include <trochoid/cli/interface.h>
#include <trochoid/cli/manual.h>
#include <trochoid/cli/system.h>
#include <trochoid/numerics/thread_count.h>

#include <CLI/CLI.hpp>

#include <fmt/core.h>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <exception>
#include <memory>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace {

/// What one fit frees the next one needs: the system is not to have it back in between,
/// for giving it out again page by page takes as long as the fit.
void keep_freed_memory() {
#if defined(__GLIBC__)
  constexpr int kept = 32 << 20;  // bytes; glibc takes no more for the first
  mallopt(M_MMAP_THRESHOLD, kept);
  mallopt(M_TRIM_THRESHOLD, kept);
#endif
}

/// A file that may not grow is an error to be told, not a signal to die of.
void report_full_disks() {
#if defined(SIGXFSZ)
  std::signal(SIGXFSZ, SIG_IGN);
#endif
}

/// A case is a .toml file; Windows may write that in capitals.
bool is_case(const std::string& name) {
  constexpr std::string_view ending = ".toml";
  return name.size() > ending.size() &&
         std::equal(ending.rbegin(), ending.rend(), name.rbegin(), [](char a, char b) {
           return a == (b >= 'A' && b <= 'Z' ? b - 'A' + 'a' : b);
         });
}

/// `trochoid CASE.toml` runs the command that the tables of the case ask for.
std::string command_of_case(const std::string& file) {
  const trochoid::cases::Node root = trochoid::cases::load_document(file);
  return trochoid::cases::find(root, "sweep") != nullptr
             ? "sweep"
             : std::string(name_of(trochoid::cases::command_of(root)));
}

/// An unknown one is named with the nearest one there is, before anything else is looked at.
void refuse_unknown_command(const CLI::App& app, const std::string& first) {
  std::vector<std::string> names;
  for (const CLI::App* sub : app.get_subcommands({})) {
    names.push_back(sub->get_name());
  }
  if (std::find(names.begin(), names.end(), first) == names.end()) {
    throw trochoid::base::InputError(
        {fmt::format("trochoid {}: there is no such command{}", first,
                     trochoid::cases::suggestion(first, names))});
  }
}

int run(int argc, char** argv) {
  CLI::App app;
  trochoid::cli::Chosen chosen;
  trochoid::cli::add_interface(app, chosen);
  trochoid::cli::add_manual(app);
  std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  const std::string first = words.empty() ? "" : words.front();
  const bool of_case = is_case(first);
  if (of_case) {
    words.insert(words.begin(), command_of_case(first));
  } else if (!words.empty() && !first.starts_with('-')) {
    refuse_unknown_command(app, first);
  }
  const std::string name = words.empty() ? "" : words.front();
  try {
    std::ranges::reverse(words);  // as CLI11 takes them
    app.parse(std::move(words));
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? trochoid::cli::answered : trochoid::cli::wrong_input;
  }
  if (of_case && !chosen.options.quiet) {
    trochoid::cli::complain(fmt::format("trochoid {} {}\n", name, first));
  }
  namespace numerics = trochoid::numerics;
  const int threads = chosen.options.threads;
  const auto limit = threads > 0 ? std::make_unique<numerics::ThreadLimit>(threads)
                                 : numerics::thread_limit_of_environment();
  return chosen.command();
}

}  // namespace

int main(int argc, char** argv) {
  try {
    trochoid::cli::prepare_console();
    keep_freed_memory();
    report_full_disks();
    trochoid::cli::say_no_memory_at_the_end_of(argc > 1 ? argv[1] : "");
    const int code = run(argc, argv);
    if (std::fflush(stdout) != 0) {
      throw std::runtime_error("what is printed cannot be written");
    }
    return code;
  } catch (const trochoid::base::InputError& error) {
    trochoid::cli::complain(error.what());
    return trochoid::cli::wrong_input;
  } catch (const std::bad_alloc&) {
    trochoid::cli::say_no_memory(argc > 1 ? argv[1] : "");
    return trochoid::cli::our_bug;
  } catch (const std::exception& error) {
    trochoid::cli::complain(fmt::format("trochoid: {}\n", error.what()));
    const bool full = std::ferror(stdout) != 0;  // the place is wrong, not the program
    return full ? trochoid::cli::wrong_input : trochoid::cli::our_bug;
  }
}
