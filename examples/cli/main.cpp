/// The `sklar` command. Exit status: 0, 1 = one line on stderr says what is wrong, 2 = wrong usage.

#include <tbb/global_control.h>

#include <algorithm>
#include <exception>
#include <iostream>
#include <memory>
#include <new>
#include <thread>
#include <utility>

#include "examples/cli/command.hpp"
#include "examples/cli/help_text.hpp"
#include "examples/cli/text.hpp"

namespace sklar::cli {

void finish_command(CLI::App& command, Common& common, std::function<void()> job) {
  command.add_flag("--json", common.json, "print JSON");
  command.add_option("--seed", common.seed, "seed of everything random")->capture_default_str();
  command.add_option("--threads", common.threads, "number of threads; as many as the machine has by default")
      ->check(CLI::Range(1, 1024));
  command.callback([&common, job = std::move(job)] { common.job = job; });
}

namespace {

/// A flag that prints what text makes of the whole tree of commands and ends the program.
void add_page(CLI::App& app, const char* flag, const char* description, std::string (*text)(const CLI::App&)) {
  app.add_flag_callback(
      flag,
      [&app, text] {
        write_output("", text(app));
        throw CLI::Success();
      },
      description);
}

/// Runs the job of the chosen subcommand. @return the exit status. @throws CLI::ParseError for wrong usage.
int run(int argc, char** argv) {
  Common common;
  CLI::App app{"Copulas, and reflectance models built on them", "sklar"};
  app.set_version_flag("--version", SKLAR_VERSION);
  add_page(app, "--manual", "Print the manual page, for man, and exit", manual_page);
  add_page(app, "--bash-completion", "Print what completes arguments in bash and exit", bash_completion);
  add_page(app, "--zsh-completion", "Print what completes arguments in zsh and exit", zsh_completion);
  add_page(app, "--fish-completion", "Print what completes arguments in fish and exit", fish_completion);
  app.formatter(std::make_shared<HelpText>());
  app.footer("Exit status: 0, 1 with one line on standard error that says what is wrong, 2 for wrong usage.");
  app.require_subcommand(1);
  add_families(app, common);
  CLI::App* copula = app.add_subcommand("copula", "evaluate, sample and fit copulas")->require_subcommand(1);
  add_copula_table(*copula, common);
  add_copula_sample(*copula, common);
  add_copula_fit(*copula, common);
  add_copula_plot(*copula, common);
  add_copula_test(*copula, common);
  add_copula_predict(*copula, common);
  add_copula_derive(*copula, common);
  CLI::App* brdf = app.add_subcommand("brdf", "work on a material")->require_subcommand(1);
  add_brdf_albedo(*brdf, common);
  add_brdf_batch(*brdf, common);
  add_brdf_compare(*brdf, common);
  add_brdf_converge(*brdf, common);
  add_brdf_convert(*brdf, common);
  add_brdf_eval(*brdf, common);
  add_brdf_fit(*brdf, common);
  add_brdf_render(*brdf, common);
  add_brdf_sample(*brdf, common);
  add_tradeoff(app, common);

  std::vector<std::string> arguments(argv + 1, argv + argc);
  protect_formula(arguments);
  std::reverse(arguments.begin(), arguments.end());  // as CLI11 wants them
  try {
    app.parse(std::move(arguments));
  } catch (const CLI::Success& request) {  // --help, --version
    return app.exit(request);
  }
  const auto threads = common.threads > 0 ? static_cast<unsigned>(common.threads) : std::thread::hardware_concurrency();
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads > 0 ? threads : 1);
  common.job();
  return 0;
}

/// One line, and below it only what a formula and the caret under its bad place are: lines that open with two blanks.
int fail(int status, std::string message) {
  for (std::size_t i = 0; i < message.size(); ++i) {
    if (message[i] == '\n' && message.compare(i + 1, 2, "  ") != 0) message[i] = ' ';
  }
  std::cerr << "sklar: " << message << '\n';
  return status;
}

}  // namespace
}  // namespace sklar::cli

int main(int argc, char** argv) {
  try {
    return sklar::cli::run(argc, argv);
  } catch (const CLI::ParseError& error) {
    return sklar::cli::fail(2, std::string(error.what()) + " (--help shows the usage)");
  } catch (const std::bad_alloc&) {
    return sklar::cli::fail(1, "not enough memory");
  } catch (const std::exception& error) {
    return sklar::cli::fail(1, error.what());
  }
}
