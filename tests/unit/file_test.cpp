#include "copula/file.hpp"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <iterator>
#include <string>
#include <thread>
#include <utility>

#include "copula/error.hpp"
#include "copula/random.hpp"
#include "tests/support/message.hpp"
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

/// A child process that runs the job; killed at the latest when the guard goes.
class Child {
 public:
  template <class Job>
  explicit Child(const Job& job) : id_(::fork()) {
    if (id_ == 0) ::_exit(job());
  }
  ~Child() {
    if (id_ > 0) (void)kill();
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  int kill() {
    ::kill(id_, SIGKILL);
    return wait();
  }
  int wait() {
    int status = 0;
    ::waitpid(std::exchange(id_, -1), &status, 0);
    return status;
  }

 private:
  pid_t id_;
};

TEST_F(File, KillAtAnyMomentLeavesTheOldContentOrTheNew) {
  constexpr int kKills = 50;
  constexpr auto kLongest = 4000;  // microseconds of writing
  const std::string one(1 << 20, '1'), two(3 << 20, '2');
  write_file(folder_ / "x", one);
  Rng rng(1);
  int cut_short = 0;
  for (int n = 0; n < kKills; ++n) {
    int ready[2];
    ASSERT_EQ(::pipe(ready), 0);
    Child child([&] {
      (void)!::write(ready[1], "x", 1);
      for (;;) {
        write_file(folder_ / "x", two);
        write_file(folder_ / "x", one);
      }
      return 0;
    });
    char begun = 0;
    ASSERT_EQ(::read(ready[0], &begun, 1), 1);
    ::close(ready[0]);
    ::close(ready[1]);
    ::usleep(static_cast<useconds_t>(uniform(rng) * kLongest));
    ASSERT_TRUE(WIFSIGNALED(child.kill())) << "the writer ended by itself";
    const std::string found = content(folder_ / "x");
    ASSERT_TRUE(found == one || found == two) << found.size() << " bytes after kill " << n;
    cut_short += files() > 1 ? 1 : 0;
    ASSERT_LE(files(), 2) << "what killed writers leave piles up";
  }
  EXPECT_GT(cut_short, 0) << "no kill came during a write";
  write_file(folder_ / "x", "new");
  EXPECT_EQ(content(folder_ / "x"), "new");
  EXPECT_EQ(files(), 1) << "what the last killed writer left is still there";
}

TEST_F(File, WritersAtTheSameTimeEachWriteItWhole) {
  const std::string one(100000, '1'), two(200000, '2');
  const auto write_often = [&](const std::string& bytes) {
    for (int n = 0; n < 100; ++n) write_file(folder_ / "x", bytes);
  };
  write_file(folder_ / "x", one);
  {
    std::jthread first([&] { write_often(one); });
    std::jthread second([&] { write_often(two); });
    for (int n = 0; n < 100; ++n) {
      const std::string found = read_file(folder_ / "x");
      ASSERT_TRUE(found == one || found == two) << found.size() << " bytes";
    }
  }
  EXPECT_EQ(files(), 1);
}

TEST_F(File, FullDiskLeavesTheOldFileAndNothingElse) {
  write_file(folder_ / "x", "old");
  // A limit on the size of files makes the same call fail that a full disk does; it is the child's own.
  Child child([&] {
    std::signal(SIGXFSZ, SIG_IGN);
    const rlimit limit{100000, 100000};
    ::setrlimit(RLIMIT_FSIZE, &limit);
    try {
      write_file(folder_ / "x", std::string(1 << 20, 'n'));
    } catch (const FileError& error) {
      return std::string(error.what()).starts_with((folder_ / "x").string() + ": cannot be written: ") ? 0 : 1;
    }
    return 2;
  });
  const int status = child.wait();
  EXPECT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0) << "1: another message, 2: no error";
  EXPECT_EQ(content(folder_ / "x"), "old");
  EXPECT_EQ(files(), 1);
}

TEST_F(File, LinkInPlaceOfThePartIsNotFollowed) {
  write_file(folder_ / "other", "kept");
  fs::create_symlink(folder_ / "other", folder_ / "x.sklar-part");
  EXPECT_THROW(write_file(folder_ / "x", "bytes"), FileError);
  EXPECT_EQ(content(folder_ / "other"), "kept");
}

TEST_F(File, FullDeviceIsNamed) {
  EXPECT_EQ(test::message_of<FileError>([] { write_file("/dev/full", "bytes"); }),
            "/dev/full: cannot be written: No space left on device");
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

}  // namespace
}  // namespace sklar
