#include "examples/cli/help_text.hpp"

#include <sstream>

namespace sklar::cli {

// CLI11 describes a set as TEXT:{a,b}, a map as ENUM:value in {a->0,b->1} OR {0,1}.
std::vector<std::string> choices(const CLI::Option& option) {
  const std::string type = option.get_type_name();
  const std::size_t open = type.find('{'), close = type.find('}');
  std::vector<std::string> result;
  if (open == std::string::npos || close == std::string::npos) return result;
  std::istringstream list(type.substr(open + 1, close - open - 1));
  for (std::string choice; std::getline(list, choice, ',');) result.push_back(choice.substr(0, choice.find("->")));
  return result;
}

std::string HelpText::make_option_opts(const CLI::Option* option) const {
  std::string text = CLI::Formatter::make_option_opts(option);
  const std::string type = option->get_type_name();
  std::string shown;
  for (const std::string& choice : choices(*option)) shown += (shown.empty() ? "{" : ",") + choice;
  shown = shown.empty() ? type.substr(type.find(':') + 1) : shown + "}";
  const std::size_t at = text.find(type);
  return type.empty() || at == std::string::npos ? text : text.replace(at, type.size(), shown);
}

std::string joined(const std::vector<std::string>& words) {
  std::string result;
  for (const std::string& word : words) result += (result.empty() ? "" : " ") + word;
  return result;
}

std::vector<NamedCommand> all_commands(const CLI::App& app) {
  std::vector<NamedCommand> result = {{{app.get_name()}, &app}};
  for (const CLI::App* child : app.get_subcommands({})) {
    for (NamedCommand& command : all_commands(*child)) {
      command.words.insert(command.words.begin(), app.get_name());
      result.push_back(std::move(command));
    }
  }
  return result;
}

}  // namespace sklar::cli
