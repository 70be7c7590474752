#include <algorithm>
#include <array>
#include <memory>
#include <nlohmann/json.hpp>

#include "copula/symbolic/derive.hpp"
#include "examples/cli/command.hpp"
#include "examples/cli/text.hpp"

namespace sklar::cli {
namespace {

constexpr std::array<std::string_view, 4> kOptionsWithValue = {"--order", "--to", "--seed", "--threads"};

struct Options {
  std::string psi;
  int order = 0;
  std::string language = "text";
};

void run(const Options& options, bool json) {
  const std::string psi = options.psi.substr(std::min(options.psi.find_first_not_of(' '), options.psi.size()));
  const std::string derivative = symbolic::derive(psi, options.order, symbolic::language_named(options.language));
  if (!json) return write_output("", derivative + '\n');
  print_json({{"psi", psi}, {"order", options.order}, {"to", options.language}, {"derivative", derivative}});
}

}  // namespace

// A blank in front makes the parser of arguments take it for no option.
void protect_formula(std::vector<std::string>& arguments) {
  const auto derive = std::find(arguments.begin(), arguments.end(), "derive");
  if (derive == arguments.end()) return;
  for (auto argument = derive + 1; argument != arguments.end(); ++argument) {
    const bool is_value = std::ranges::find(kOptionsWithValue, *(argument - 1)) != kOptionsWithValue.end();
    if (is_value || !argument->starts_with('-') || argument->starts_with("--") || *argument == "-h") continue;
    argument->insert(0, 1, ' ');
  }
}

void add_copula_derive(CLI::App& parent, Common& common) {
  CLI::App* command = parent.add_subcommand("derive", "the derivative of a generator, as one line of text");
  const auto options = std::make_shared<Options>();
  command->add_option("PSI", options->psi, "a formula in t and parameters; it may open with a minus")->required();
  command->add_option("--order", options->order, "how often to differentiate by t")->required();
  command->add_option("--to", options->language, "text, which this command reads again, latex or cpp")
      ->check(CLI::IsMember({"text", "latex", "cpp"}))
      ->capture_default_str();
  finish_command(*command, common, [options, &common] { run(*options, common.json); });
}

}  // namespace sklar::cli
