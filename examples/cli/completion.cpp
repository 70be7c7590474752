#include "examples/cli/help_text.hpp"

namespace sklar::cli {
namespace {

/// --NAME and -N of an option; none of a positional argument.
std::vector<std::string> flags(const CLI::Option& option) {
  std::vector<std::string> result;
  for (const std::string& name : option.get_lnames()) result.push_back("--" + name);
  for (const std::string& name : option.get_snames()) result.push_back("-" + name);
  return result;
}

/// What a command is called behind the program's name: " copula fit".
std::string path(const NamedCommand& command) {
  std::string result;
  for (std::size_t i = 1; i < command.words.size(); ++i) result += " " + command.words[i];
  return result;
}

constexpr const char* kHead = R"(# Completion for bash, written by `sklar --bash-completion`.
_sklar()
{
  local word=${COMP_WORDS[COMP_CWORD]} before=${COMP_WORDS[COMP_CWORD-1]} command= commands= options= i
  if [[ $word == '=' ]]; then
    word=
  elif [[ $before == '=' ]]; then
    before=${COMP_WORDS[COMP_CWORD-2]}
  fi
  for ((i = 1; i < COMP_CWORD; ++i)); do
    case "$command ${COMP_WORDS[i]}" in
)";

constexpr const char* kTail = R"(      esac ;;
  esac
  if [[ $word == -* ]]; then commands=$options; fi
  COMPREPLY=($(compgen -W "$commands" -- "$word"))
}
complete -o default -F _sklar sklar
)";

}  // namespace

// Where nothing is offered, bash completes names of files.
std::string bash_completion(const CLI::App& app) {
  std::string known, values, words;
  for (const NamedCommand& command : all_commands(app)) {
    std::vector<std::string> children, options;
    for (const CLI::App* child : command.app->get_subcommands({})) {
      children.push_back(child->get_name());
      known += "      '" + path(command) + " " + child->get_name() + "') command+=\" ${COMP_WORDS[i]}\" ;;\n";
    }
    for (const CLI::Option* option : command.app->get_options()) {
      for (const std::string& flag : flags(*option)) {
        options.push_back(flag);
        if (choices(*option).empty()) continue;
        values += "    '" + path(command) + " " + flag + "') commands='" + joined(choices(*option)) + "' ;;\n";
      }
    }
    words +=
        "        '" + path(command) + "') commands='" + joined(children) + "' options='" + joined(options) + "' ;;\n";
  }
  return kHead + known + "    esac\n  done\n  case \"$command $before\" in\n" + values +
         "    *)\n      case \"$command\" in\n" + words + kTail;
}

}  // namespace sklar::cli
