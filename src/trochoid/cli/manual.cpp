#include <trochoid/cli/manual.h>

#include <CLI/CLI.hpp>

#include <fmt/core.h>

namespace trochoid::cli {

void add_manual(CLI::App& app) {
  app.add_option_function<std::string>(
         "--manual",
         [&app](const std::string& wanted) {
           const CommandTable table = command_table(app);
           const std::string text = wanted == "man"    ? man_page(table)
                                    : wanted == "bash" ? bash_completion(table)
                                    : wanted == "zsh"  ? zsh_completion(table)
                                                       : fish_completion(table);
           fmt::print("{}", text);
           throw CLI::Success();
         },
         "Print the man page, or the completion of a shell")
      ->check(CLI::IsMember({"man", "bash", "zsh", "fish"}))
      ->group("");
}

}  // namespace trochoid::cli
