/// The manual page and the completion of arguments, which the command prints of itself.

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <cstdlib>
#include <optional>
#include <regex>
#include <set>
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

  /// Standard output of a script of a shell that is installed, its lines with blanks between, or nothing.
  [[nodiscard]] std::optional<std::string> of_shell(const std::string& shell, const std::string& script) const {
    if (std::system(("command -v " + shell + " >/dev/null").c_str()) != 0) return std::nullopt;
    write("script", script);
    const std::string in_work = "cd '" + (folder_ / "work").string() + "' && HOME=. ";
    EXPECT_EQ(std::system((in_work + shell + " ./script >../words 2>&1").c_str()), 0) << read_file(folder_ / "words");
    return std::regex_replace(read_file(folder_ / "words"), std::regex("\n+(?!$)"), " ");
  }

  /// " copula fit" and " copula fit --method" for every command and flag that --help shows, from one on.
  [[nodiscard]] std::set<std::string> helped(const std::string& command = "") const {
    std::set<std::string> all;
    std::istringstream help(run(command + " --help").out);
    bool commands = false;
    for (std::string line; std::getline(help, line);) {
      if (!line.starts_with(' ')) commands = line == "Subcommands:";
      std::smatch found;
      if (commands && std::regex_search(line, found, std::regex("^  (\\w+)"))) {
        all.insert(command + " " + found[1].str());
        all.merge(helped(command + " " + found[1].str()));
      } else if (!commands && std::regex_search(line, found, std::regex("^  (-\\S+)"))) {
        std::istringstream flags(found[1]);
        for (std::string flag; std::getline(flags, flag, ',');) all.insert(command + " " + flag);
      }
    }
    return all;
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

/// Each match of a pattern in a text, its groups joined.
std::set<std::string> matches(const std::string& text, const std::string& pattern, const std::string& before = "") {
  const std::regex regex(pattern);
  std::set<std::string> all;
  for (std::sregex_iterator at(text.begin(), text.end(), regex), end; at != end; ++at) {
    std::string joined = before;
    for (std::size_t group = 1; group < at->size(); ++group) joined += (*at)[group].str();
    all.insert(joined);
  }
  return all;
}

TEST_F(HelpCommand, ZshIsToldOfEveryCommandAndFlag) {
  const std::string script = run("--zsh-completion").out;
  std::set<std::string> told;
  const std::regex block("\n  '([^']*)'\\)\n    below=\\((.*) \\)\n    flags=\\((.*) \\) ;;");
  for (std::sregex_iterator at(script.begin(), script.end(), block), end; at != end; ++at) {
    told.merge(matches((*at)[2], " '(\\w+):", (*at)[1].str() + " "));
    told.merge(matches((*at)[3], " '(-[^:' ]+):", (*at)[1].str() + " "));
  }
  EXPECT_EQ(told, helped());
}

TEST_F(HelpCommand, FishIsToldOfEveryCommandAndFlag) {
  const std::string script = run("--fish-completion").out;
  const std::string at = "\ncomplete -c sklar -n \"__sklar_at '([^']*)'\"";
  std::set<std::string> told = matches(script, at + " -f -a( \\w+)");
  for (const char* length : {" -l", " -s"}) {
    for (const std::string& entry : matches(script, at + "(?: -l [^ ]+)*" + length + "( [^ ]+)")) {
      const std::size_t blank = entry.rfind(' ') + 1;
      told.insert(entry.substr(0, blank) + (length[1] == '-' && length[2] == 'l' ? "--" : "-") + entry.substr(blank));
    }
  }
  EXPECT_EQ(told, helped());
}

TEST_F(HelpCommand, ZshCompletes) {
  write("_sklar", run("--zsh-completion").out);
  const auto offered_by_zsh = [&](const std::string& words, const std::string& prefix) {
    return of_shell("zsh -f", R"(compadd() { print -l -- ${(P)2} }
_describe() { print -l -- ${${(P)@[-1]}%%:*} }
_files() { print files }
compset() { PREFIX=${PREFIX#*=} }
words=(sklar )" + words + " '" + prefix +
                                  "') PREFIX='" + prefix + "'\nCURRENT=$#words\n. ./_sklar\n");
  };
  if (!offered_by_zsh("", "")) GTEST_SKIP() << "zsh is not installed";
  EXPECT_EQ(offered_by_zsh("", "").value(), "families copula brdf tradeoff\n");
  EXPECT_EQ(offered_by_zsh("copula fit data.csv --method", "").value(), "ls ml rho tau\n");
  EXPECT_EQ(offered_by_zsh("copula fit", "--method=t").value(), "ls ml rho tau\n");
  EXPECT_EQ(offered_by_zsh("copula fit", "").value(), "files\n");
  EXPECT_NE(offered_by_zsh("copula fit", "--m")->find("--missing --weights --families --margins"), std::string::npos);
}

TEST_F(HelpCommand, FishCompletes) {
  write("sklar.fish", run("--fish-completion").out);
  const auto offered_by_fish = [&](const std::string& line) {
    return of_shell("fish --no-config",
                    "source sklar.fish\ncomplete -C '" + line + "' | string replace -r '\t.*' ''\n");
  };
  if (!offered_by_fish("sklar ")) GTEST_SKIP() << "fish is not installed";
  EXPECT_EQ(offered_by_fish("sklar co").value(), "copula\n");
  EXPECT_EQ(offered_by_fish("sklar copula fit --m").value(), "--margins --method --missing --model\n");
  EXPECT_EQ(offered_by_fish("sklar copula fit data.csv --method ").value(), "ls ml rho tau\n");
  EXPECT_EQ(offered_by_fish("sklar copula fit --method=t").value(), "--method=tau\n");
}

TEST_F(HelpCommand, ManualHasEveryCommandAndOption) {
  const std::string page = run("--manual").out;
  const std::string fit = page.substr(page.find("\n.SS sklar copula fit\n"));
  EXPECT_LT(fit.find("\n.TP\n\\fB\\-\\-method {ls,ml,rho,tau}=ml\\fR\nmaximum likelihood"), fit.find("\n.SS ", 1))
      << page;
  EXPECT_NE(page.find("\n\\fBsklar copula fit [OPTIONS] FILE\\fR\n"), std::string::npos) << page;
  const std::string entry = "\n\\fB\\-\\-json\\fR\n";
  const std::size_t json = page.find(entry);
  EXPECT_NE(json, std::string::npos);
  EXPECT_EQ(page.find(entry, json + 1), std::string::npos) << "once, for every command";
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
