/// The manual page and the completion of arguments, which the command prints of itself.

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <sstream>

#include "copula/file.hpp"
#include "tests/cli/run_command.hpp"

namespace sklar::cli {
namespace {

class HelpCommand : public CommandTest {
 protected:
  /// Standard output of a script of bash that has the completion, its words with blanks between.
  [[nodiscard]] std::string bash(const std::string& script) const {
    write("complete", run("--bash-completion").out);
    write("script", "set -u\n. ./complete\n" + script);
    const std::string work = (folder_ / "work").string();
    const int status = std::system(("cd '" + work + "' && bash --norc script >../words 2>&1").c_str());
    EXPECT_EQ(status, 0);
    std::istringstream words(read_file(folder_ / "words"));
    std::string result;
    for (std::string word; words >> word;) result += (result.empty() ? "" : " ") + word;
    return result;
  }

  /// What is offered for the last of the words.
  [[nodiscard]] std::string offered(const std::string& words) const {
    return bash("COMP_WORDS=(" + words +
                ")\nCOMP_CWORD=$((${#COMP_WORDS[@]} - 1))\n_sklar\necho \"${COMPREPLY[@]}\"\n");
  }
};

TEST_F(HelpCommand, ChoicesAreNames) {
  const std::string help = run("brdf fit --help").out;
  EXPECT_NE(help.find("--method {ls,ml,tau}=ls"), std::string::npos) << help;
  EXPECT_NE(help.find("--spp INT in [1 - 65536]=16"), std::string::npos) << help;
  EXPECT_EQ(help.find("->"), std::string::npos) << help;
  EXPECT_NE(run("--help").out.find("Exit status: 0, 1 "), std::string::npos);
}

TEST_F(HelpCommand, BashCompletesCommandsOptionsAndChoices) {
  EXPECT_EQ(offered("sklar co"), "copula");
  EXPECT_EQ(offered("sklar copula ''"), "table sample fit plot test predict derive");
  EXPECT_EQ(offered("sklar copula f"), "fit");
  EXPECT_EQ(offered("sklar copula fit --m"), "--missing --margins --method --model");
  EXPECT_EQ(offered("sklar copula fit data.csv --method ''"), "ls ml rho tau");
  EXPECT_EQ(offered("sklar copula fit --method = t"), "tau") << "as bash splits --method=t";
  EXPECT_EQ(offered("sklar copula fit --method ="), "ls ml rho tau");
  EXPECT_EQ(offered("sklar --vers"), "--version");
  EXPECT_EQ(offered("sklar brdf convert a.json b.bsdf --form s"), "spectra");
}

TEST_F(HelpCommand, BashCompletesFilesWhereAnythingGoes) {
  EXPECT_EQ(offered("sklar brdf eval ''"), "");
  EXPECT_EQ(offered("sklar brdf eval model.json --directions ''"), "");
  EXPECT_EQ(offered("sklar copula fit --families f"), "");
  EXPECT_EQ(bash("complete -p sklar"), "complete -o default -F _sklar sklar");
}

TEST_F(HelpCommand, ManualHasEveryCommandAndOption) {
  const std::string page = run("--manual").out;
  const std::string fit = page.substr(page.find("\n.SS sklar copula fit\n"));
  EXPECT_LT(fit.find("\n.TP\n\\fB\\-\\-method {ls,ml,rho,tau}=ml\\fR\nmaximum likelihood"), fit.find("\n.SS ", 1))
      << page;
  EXPECT_NE(page.find("\n\\fBsklar copula fit [OPTIONS] FILE\\fR\n"), std::string::npos) << page;
  const std::size_t json = page.find("\\-\\-json");
  EXPECT_NE(json, std::string::npos);
  EXPECT_EQ(page.find("\\-\\-json", json + 1), std::string::npos) << "once, for every command";
  EXPECT_NE(page.find(".SH EXIT STATUS\n"), std::string::npos);
}

TEST_F(HelpCommand, ManualIsSoundTroff) {
  if (std::string(SKLAR_MANDOC).empty()) GTEST_SKIP() << "mandoc is not installed";
  write("sklar.1", run("--manual").out);
  const std::string work = (folder_ / "work").string();
  // There is no date, so that the same sources give the same page.
  const std::string lint =
      "cd '" + work + "' && '" SKLAR_MANDOC "' -T lint -W warning sklar.1 | grep -v 'missing date' ";
  EXPECT_EQ(WEXITSTATUS(std::system((lint + ">../lint 2>&1").c_str())), 1) << read_file(folder_ / "lint");
  EXPECT_EQ(read_file(folder_ / "lint"), "");
}

}  // namespace
}  // namespace sklar::cli
