#pragma once
/// Runs the built command in an empty folder.

#include <string>
#include <string_view>

#include "tests/support/temporary_folder.hpp"

namespace sklar::cli {

struct Result {
  int status;
  std::string out;
  std::string err;
};

class CommandTest : public test::TemporaryFolder {
 protected:
  void SetUp() override;

  /// `sklar arguments` as the shell understands them, run in the folder.
  [[nodiscard]] Result run(const std::string& arguments) const;

  /// Wrong input: status 1, one line on stderr that holds text, nothing on stdout and no new file.
  void expect_refused(const std::string& arguments, const std::string& text) const;

  /// Wrong usage: status 2, one line on stderr, nothing on stdout.
  void expect_usage_error(const std::string& arguments) const;

  void write(const std::string& name, std::string_view text) const;
  [[nodiscard]] std::string read(const std::string& name) const;

  /// The folder.
  [[nodiscard]] std::filesystem::path work() const { return folder_ / "work"; }
};

}  // namespace sklar::cli
