#include "tests/cli/run_command.hpp"

#include <sys/wait.h>

#include <algorithm>
#include <cstdlib>
#include <iterator>

#include "copula/file.hpp"

namespace sklar::cli {
namespace {

auto lines(const std::string& text) {
  return std::count(text.begin(), text.end(), '\n');
}

auto files_in(const std::filesystem::path& folder) {
  return std::distance(std::filesystem::directory_iterator(folder), {});
}

}  // namespace

void CommandTest::SetUp() {
  TemporaryFolder::SetUp();
  std::filesystem::create_directory(work());
}

Result CommandTest::run(const std::string& arguments) const {
  const std::string command =
      "cd '" + work().string() + "' && '" SKLAR_COMMAND "' " + arguments + " >../out 2>../err </dev/null";
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_file(folder_ / "out"), read_file(folder_ / "err")};
}

void CommandTest::expect_refused(const std::string& arguments, const std::string& text) const {
  SCOPED_TRACE("sklar " + arguments);
  const auto files = files_in(work());
  const Result result = run(arguments);
  EXPECT_EQ(result.status, 1);
  EXPECT_TRUE(result.err.starts_with("sklar: ")) << result.err;
  EXPECT_EQ(lines(result.err), 1) << result.err;
  EXPECT_NE(result.err.find(text), std::string::npos) << result.err;
  EXPECT_EQ(result.out, "");
  EXPECT_EQ(files_in(work()), files);
}

void CommandTest::expect_usage_error(const std::string& arguments) const {
  SCOPED_TRACE("sklar " + arguments);
  const Result result = run(arguments);
  EXPECT_EQ(result.status, 2);
  EXPECT_EQ(lines(result.err), 1) << result.err;
  EXPECT_EQ(result.out, "");
}

void CommandTest::write(const std::string& name, std::string_view text) const {
  write_file(work() / name, text);
}

std::string CommandTest::read(const std::string& name) const {
  return read_file(work() / name);
}

}  // namespace sklar::cli
