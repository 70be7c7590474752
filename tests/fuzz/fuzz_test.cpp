#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <map>
#include <vector>

#include "copula/file.hpp"
#include "tests/fuzz/mutate.hpp"
#include "tests/fuzz/targets.hpp"

namespace sklar::test {

/// As GoogleTest shows a parameter.
void PrintTo(const FuzzTarget& target, std::ostream* out) {
  *out << target.name;
}

namespace {
namespace fs = std::filesystem;

std::vector<FuzzTarget> all_targets() {
  std::vector<FuzzTarget> targets;
  for (const auto part : {copula_targets(), brdf_targets(), command_targets()}) {
    targets.insert(targets.end(), part.begin(), part.end());
  }
  return targets;
}

/// By file name.
std::map<std::string, std::string> corpus_of(const FuzzTarget& target) {
  std::map<std::string, std::string> inputs;
  for (const auto& entry : fs::directory_iterator(fs::path(SKLAR_FUZZ_CORPUS) / target.name)) {
    inputs[entry.path().filename().string()] = read_file(entry.path());
  }
  return inputs;
}

/// While it lives, memory beyond what is in use now and 64 MB ends in std::bad_alloc. Sanitizers reserve address space
/// of their own, under them it does nothing.
class MemoryLimit {
 public:
  MemoryLimit() {
    ::getrlimit(RLIMIT_AS, &before_);
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    rlimit limit = before_;
    limit.rlim_cur = pages * static_cast<rlim_t>(::sysconf(_SC_PAGESIZE)) + (rlim_t{64} << 20);
    ::setrlimit(RLIMIT_AS, &limit);
#endif
  }
  ~MemoryLimit() {
    ::setrlimit(RLIMIT_AS, &before_);
  }
  MemoryLimit(const MemoryLimit&) = delete;
  MemoryLimit& operator=(const MemoryLimit&) = delete;

 private:
  rlimit before_{};
};

/// How often each target's number of mutations is made: SKLAR_FUZZ_FACTOR, by default once.
int factor() {
  const char* text = std::getenv("SKLAR_FUZZ_FACTOR");
  return text == nullptr ? 1 : std::stoi(text);
}

class Fuzz : public testing::TestWithParam<FuzzTarget> {
 protected:
  /// Anything but the documented refusal fails the test and leaves the input in a file.
  static bool is_read(const std::string& bytes, const std::string& input) {
    try {
      return GetParam().is_read(bytes);
    } catch (const std::exception& error) {
      const fs::path file = fs::path(testing::TempDir()) / (std::string("sklar_fuzz_") + GetParam().name);
      write_file(file, bytes);
      ADD_FAILURE() << input << ": " << error.what() << "; the input is in " << file;
      return false;
    }
  }
};

TEST_P(Fuzz, CorpusIsReadOrRefusedAsItsNameSays) {
  const MemoryLimit limit;
  int read = 0, refused = 0;
  for (const auto& [name, bytes] : corpus_of(GetParam())) {
    const bool expected = name.starts_with("read");
    ++(expected ? read : refused);
    EXPECT_EQ(is_read(bytes, name), expected) << name;
  }
  EXPECT_GT(read, 0);
  EXPECT_GT(refused, 0);
}

TEST_P(Fuzz, MutationsAreReadOrRefused) {
  std::vector<std::string> inputs;
  for (auto& [name, bytes] : corpus_of(GetParam())) inputs.push_back(std::move(bytes));
  const MemoryLimit limit;
  Mutator mutator(GetParam().name);
  for (int n = 0; n < factor() * GetParam().mutations && !HasFailure(); ++n) {
    (void)is_read(mutator.next(inputs), "mutation " + std::to_string(n));
  }
}

INSTANTIATE_TEST_SUITE_P(Reader, Fuzz, testing::ValuesIn(all_targets()),
                         [](const auto& target) { return std::string(target.param.name); });

}  // namespace
}  // namespace sklar::test
