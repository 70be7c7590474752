#include "copula/file.hpp"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>
#include <string>
#include <utility>

#include "copula/error.hpp"
#include "tests/support/temporary_folder.hpp"

namespace sklar {
namespace {
namespace fs = std::filesystem;

class File : public test::TemporaryFolder {
 protected:
  static std::string content(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  [[nodiscard]] auto files() const { return std::distance(fs::directory_iterator(folder_), {}); }
};

TEST_F(File, IsWrittenWholeAndReplaced) {
  const std::string first("a\0b\n", 4);
  write_file(folder_ / "x", first);
  EXPECT_EQ(content(folder_ / "x"), first);
  require_writable(folder_ / "x");
  write_file(folder_ / "x", "second");
  EXPECT_EQ(content(folder_ / "x"), "second");
  EXPECT_EQ(files(), 1);
}

TEST_F(File, LinkKeepsPointingAtTheWrittenFile) {
  write_file(folder_ / "x", "old");
  fs::create_symlink(folder_ / "x", folder_ / "link");
  write_file(folder_ / "link", "new");
  EXPECT_TRUE(fs::is_symlink(folder_ / "link"));
  EXPECT_EQ(content(folder_ / "x"), "new");
}

TEST_F(File, IsReadAsWritten) {
  for (const std::string& bytes : {std::string("a\0b\r\n", 5), std::string()}) {
    write_file(folder_ / "x", bytes);
    EXPECT_EQ(read_file(folder_ / "x"), bytes);
  }
}

TEST_F(File, ThatCannotBeReadIsNamed) {
  for (const auto& [path, reason] : {std::pair{folder_ / "missing", std::string("no such file")},
                                     std::pair{folder_, std::string("is a directory, not a file")}}) {
    try {
      (void)read_file(path);
      FAIL() << path << " was read";
    } catch (const FileError& error) {
      EXPECT_EQ(error.what(), path.string() + ": " + reason);
    }
  }
}

TEST_F(File, FailureNamesThePathAndLeavesNothing) {
  for (const fs::path& path : {folder_ / "missing" / "x", folder_}) {
    EXPECT_THROW(require_writable(path), FileError) << path;
    try {
      write_file(path, "bytes");
      FAIL() << path << " was written";
    } catch (const FileError& error) {
      EXPECT_EQ(std::string(error.what()).rfind(path.string() + ": cannot be written: ", 0), 0u) << error.what();
    }
  }
  EXPECT_EQ(files(), 0);
}

}  // namespace
}  // namespace sklar
