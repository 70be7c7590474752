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

/// A text between single quotes as the shells take it; `quote` stands for one inside.
std::string quoted(const std::string& text, const std::string& quote) {
  std::string result = "'";
  for (const char c : text) result += c == '\'' ? quote : std::string(1, c);
  return result + "'";
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

constexpr const char* kZshHead = R"(#compdef sklar
# Completion for zsh, written by `sklar --zsh-completion`.
local command= before=${words[CURRENT-1]} word
local -a below flags values  # zsh has parameters commands and options
for word in ${words[2,CURRENT-1]}; do
  case "$command $word" in
)";

constexpr const char* kZshTail = R"(esac
if (( $#values )); then
  compadd -a values
elif [[ $PREFIX == -* ]]; then
  _describe -o option flags
elif (( $#below )); then
  _describe command below
else
  _files
fi
)";

constexpr const char* kFishHead = R"(# Completion for fish, written by `sklar --fish-completion`.
function __sklar_at
    set -l command ''
    for word in (commandline -opc)[2..-1]
        switch "$command $word"
)";

constexpr const char* kFishTail = R"(        end
    end
    test "$command" = "$argv[1]"
end
)";

/// NAME:DESCRIPTION for zsh.
std::string described(const std::string& name, const std::string& description) {
  return " " + quoted(name + ":" + description, R"('\'')");
}

/// How fish is told of an option.
std::string fish_option(const CLI::Option& option) {
  std::string result;
  for (const std::string& name : option.get_lnames()) result += " -l " + name;
  for (const std::string& name : option.get_snames()) result += " -s " + name;
  if (!choices(option).empty()) {
    result += " -x -a '" + joined(choices(option)) + "'";
  } else if (option.get_items_expected_max() > 0) {
    result += " -r";
  }
  return result + " -d " + quoted(option.get_description(), R"(\')");
}

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

std::string zsh_completion(const CLI::App& app) {
  std::string known, values, words;
  for (const NamedCommand& command : all_commands(app)) {
    std::string children, options;
    for (const CLI::App* child : command.app->get_subcommands({})) {
      children += described(child->get_name(), child->get_description());
      known += "    '" + path(command) + " " + child->get_name() + "') command+=\" $word\" ;;\n";
    }
    for (const CLI::Option* option : command.app->get_options()) {
      for (const std::string& flag : flags(*option)) {
        options += described(flag, option->get_description());
        if (choices(*option).empty()) continue;
        values += "  '" + path(command) + " " + flag + "') values=(" + joined(choices(*option)) + ") ;;\n";
      }
    }
    words += "  '" + path(command) + "')\n    below=(" + children + " )\n    flags=(" + options + " ) ;;\n";
  }
  return kZshHead + known +
         "  esac\ndone\nif [[ $PREFIX == --*=* ]]; then\n  before=${PREFIX%%=*}\n  compset -P '*='\nfi\n" +
         "case \"$command $before\" in\n" + values + "esac\ncase $command in\n" + words + kZshTail;
}

// Files are offered beside what is told, but for commands that have others below them.
std::string fish_completion(const CLI::App& app) {
  std::string known, words;
  for (const NamedCommand& command : all_commands(app)) {
    const std::string here = "complete -c sklar -n \"__sklar_at '" + path(command) + "'\"";
    for (const CLI::App* child : command.app->get_subcommands({})) {
      known += "            case '" + path(command) + " " + child->get_name() +
               "'\n                set command \"$command $word\"\n";
      words += here + " -f -a " + child->get_name() + " -d " + quoted(child->get_description(), R"(\')") + "\n";
    }
    for (const CLI::Option* option : command.app->get_options()) {
      if (!flags(*option).empty()) words += here + fish_option(*option) + "\n";
    }
  }
  return kFishHead + known + kFishTail + words;
}

}  // namespace sklar::cli
