#include <algorithm>

#include "examples/cli/help_text.hpp"

namespace sklar::cli {
namespace {

/// Text as troff shows it literally.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char character : text) {
    if (character == '\\') {
      result += "\\e";
    } else if (character == '-') {
      result += "\\-";
    } else if ((character == '.' || character == '\'') && (result.empty() || result.back() == '\n')) {
      result += std::string("\\&") + character;
    } else {
      result += character;
    }
  }
  return result;
}

/// The entry of an option; the same for the same option of two commands.
std::string entry(const CLI::Option& option) {
  const HelpText help;
  return ".TP\n\\fB" +
         escaped(help.make_option_name(&option, option.get_positional()) + help.make_option_opts(&option)) + "\\fR\n" +
         escaped(help.make_option_desc(&option)) + "\n";
}

std::vector<std::string> entries(const CLI::App& app) {
  std::vector<std::string> result;
  for (const CLI::Option* option : app.get_options()) result.push_back(entry(*option));
  return result;
}

/// Those of the first command that every other has, too.
std::vector<std::string> shared_entries(const std::vector<NamedCommand>& commands) {
  std::vector<std::string> shared = entries(*commands.front().app);
  for (const NamedCommand& command : commands) {
    const std::vector<std::string> own = entries(*command.app);
    std::erase_if(shared,
                  [&](const std::string& text) { return std::find(own.begin(), own.end(), text) == own.end(); });
  }
  return shared;
}

/// "sklar copula fit [OPTIONS] FILE"
std::string usage(const NamedCommand& command) {
  const std::string text = HelpText().make_usage(command.app, joined(command.words));
  const std::string label = "Usage: ";
  return text.substr(label.size(), text.find('\n') - label.size());
}

}  // namespace

std::string manual_page(const CLI::App& app) {
  std::vector<NamedCommand> commands = all_commands(app);
  std::erase_if(commands, [](const NamedCommand& command) { return !command.app->get_subcommands({}).empty(); });
  std::string page = ".TH SKLAR 1 \"\" \"sklar " SKLAR_VERSION "\" \"User Commands\"\n.SH NAME\n" + app.get_name() +
                     " \\- " + escaped(app.get_description()) + "\n.SH SYNOPSIS\n";
  for (const NamedCommand& command : commands) {
    page += (command.app == commands.front().app ? "\\fB" : ".br\n\\fB") + escaped(usage(command)) + "\\fR\n";
  }
  page += ".SH OPTIONS\n";
  for (const std::string& text : entries(app)) page += text;
  page += ".PP\nOptions of every command:\n";
  const std::vector<std::string> shared = shared_entries(commands);
  for (const std::string& text : shared) page += text;
  page += ".SH COMMANDS\n";
  for (const NamedCommand& command : commands) {
    page += ".SS " + escaped(joined(command.words)) + "\n" + escaped(command.app->get_description()) + ".\n";
    for (const std::string& text : entries(*command.app)) {
      if (std::find(shared.begin(), shared.end(), text) == shared.end()) page += text;
    }
  }
  return page + ".SH EXIT STATUS\n" + escaped(app.get_footer()) + "\n";
}

}  // namespace sklar::cli
