#pragma once
/// What --help, the manual page and shell completion say of the commands: all of it is asked of the parser, so that
/// they agree with it and with each other.

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace sklar::cli {

/// The values that an option takes by name; empty where it takes others.
[[nodiscard]] std::vector<std::string> choices(const CLI::Option& option);

/// --help with choices as {a,b} and ranges as INT in [1 - 9].
class HelpText final : public CLI::Formatter {
 public:
  [[nodiscard]] std::string make_option_opts(const CLI::Option* option) const override;
};

/// A command that does something, with the words that call it: {"sklar", "copula", "fit"}.
struct NamedCommand {
  std::vector<std::string> words;
  const CLI::App* app;
};

[[nodiscard]] std::string joined(const std::vector<std::string>& words);  ///< with blanks between

/// Every command of the tree, those with subcommands too, before these.
[[nodiscard]] std::vector<NamedCommand> all_commands(const CLI::App& app);

/// `man sklar` in the macros of man(7).
[[nodiscard]] std::string manual_page(const CLI::App& app);

/// Scripts that tell a shell how to complete the arguments.
[[nodiscard]] std::string bash_completion(const CLI::App& app);
[[nodiscard]] std::string zsh_completion(const CLI::App& app);
[[nodiscard]] std::string fish_completion(const CLI::App& app);

}  // namespace sklar::cli
