/// `sklar brdf batch`: what it keeps, goes on with and refuses; the same over threads, parts and MPI.

#include <gtest/gtest.h>
#include <sys/wait.h>

#include <csignal>
#include <cstdlib>
#include <map>
#include <nlohmann/json.hpp>

#include "copula/file.hpp"
#include "tests/cli/run_command.hpp"

namespace sklar::cli {
namespace {

const std::string kBroken = "wi_x,wi_y,wi_z,wo_x,wo_y,wo_z,r,g,b\n0,0,1,0,0,3,1,1,1\n";  // line 2: wo is no direction

/// A grey material as scattered measurements.
std::string grey() {
  std::string text = "wi_x,wi_y,wi_z,wo_x,wo_y,wo_z,r,g,b\n";
  for (const std::string wi : {"0,0,1", "0.6,0,0.8", "0.8,0,0.6"}) {
    for (const std::string wo : {"0,0,1", "0.6,0,0.8", "-0.6,0,0.8", "0,0.6,0.8"}) {
      text.append(wi).append(",").append(wo).append(",0.2,0.2,0.2\n");
    }
  }
  return text;
}

bool has(const std::string& program) {
  return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

bool has_mpi() {
  return !std::string_view(SKLAR_MPI).empty() && has("mpirun");
}

using Times = std::map<std::string, std::filesystem::file_time_type>;

class BatchCommand : public CommandTest {
 protected:
  /// A line of the shell in the folder.
  [[nodiscard]] Result shell(const std::string& line) const {
    const std::string command = "cd '" + work().string() + "' && { " + line + "\n} >../out 2>../err </dev/null";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read_file(folder_ / "out"), read_file(folder_ / "err")};
  }

  /// The command in the background; a signal once a file is there. @return status and output of the command
  [[nodiscard]] Result run_and_signal(const std::string& arguments, const std::string& file,
                                      const std::string& signal) const {
    return shell("'" SKLAR_COMMAND "' " + arguments + " & until [ -e " + file + " ]; do sleep 0.02; done; kill -" +
                 signal + " $!; wait $!");
  }

  /// The rows of the database db by the time they were written.
  [[nodiscard]] Times rows(const std::string& database) const {
    Times result;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(work() / database)) {
      const std::string path = entry.path().lexically_relative(work() / database).string();
      if (path.ends_with("/lambert.json")) result[path] = entry.last_write_time();
    }
    return result;
  }

  /// By two processes: MPI's ranks, or parts where there is no MPI. @return of the run that ends it
  [[nodiscard]] Result run_by_two(const std::string& arguments) const {
    // Root may, and what Open MPI holds at its end is no leak of ours.
    const std::string variables =
        "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 ASAN_OPTIONS=detect_leaks=0 ";
    if (has_mpi()) return shell(variables + "mpirun -n 2 --oversubscribe '" SKLAR_MPI "' " + arguments);
    EXPECT_EQ(run(arguments + "--part 1/2").status, 1) << "the first and the last";
    EXPECT_EQ(run(arguments + "--part 2/2").status, 0);
    return run(arguments);
  }

  /// models.json of a database but for what time measures.
  [[nodiscard]] nlohmann::json table(const std::string& database) const {
    auto rows = nlohmann::json::parse(read(database + "/models.json"))["rows"];
    for (auto& row : rows) {
      row.erase("fit_s");
      row.erase("eval_ns");
    }
    return rows;
  }
};

/// Between two materials that cannot be read one that can.
TEST_F(BatchCommand, GoesOnWhereItWasAndIsTheSameOverProcesses) {
  write("first.csv", kBroken);
  write("grey.csv", grey());
  write("last.csv", kBroken);
  write("list.txt", "# three\nfirst.csv\n\n  grey.csv\r\nlast.csv\n");
  const std::string batch = "brdf batch list.txt --models lambert --out ", database = batch + "db --threads 1 ";

  EXPECT_EQ(run_and_signal(database, "db/first/lambert.json", "KILL").status, 128 + SIGKILL);
  const Times killed = rows("db");
  ASSERT_EQ(killed.size(), 1U) << "it was killed too late";
  const Result stopped = run_and_signal(database, "db/grey", "INT");
  EXPECT_EQ(stopped.status, 1);
  EXPECT_EQ(stopped.err, "sklar: interrupted; what is done is kept, the same command goes on\n");
  const Times interrupted = rows("db");
  ASSERT_EQ(interrupted.size(), 2U) << "the job that runs is finished, the next does not begin";
  EXPECT_EQ(interrupted.at("first/lambert.json"), killed.at("first/lambert.json"));

  ASSERT_TRUE(has("script")) << "bsdutils has it";
  const Result finished = shell("script -qec \"'" SKLAR_COMMAND "' " + database + "\" /dev/null");
  EXPECT_EQ(finished.status, 1);
  EXPECT_NE(finished.out.find("2 of 3 jobs, 1 failed; last: lambert"), std::string::npos) << finished.out;
  EXPECT_NE(finished.out.find("last, lambert: last.csv: line 2: wo must have length 1"), std::string::npos);
  EXPECT_NE(finished.out.find("sklar: 2 of 3 jobs failed"), std::string::npos);
  const Times all = rows("db");
  ASSERT_EQ(all.size(), 3U);
  for (const auto& [row, time] : interrupted) EXPECT_EQ(all.at(row), time) << row << " was done twice";
  const nlohmann::json once = table("db");
  ASSERT_EQ(once.size(), 3U);
  EXPECT_EQ(once[1]["material"], "grey");
  EXPECT_LT(once[1]["log1p_mae"], 1e-6);
  EXPECT_NE(once[2]["error"], "");

  const Result by_two = run_by_two(batch + "other --threads 2 ");
  EXPECT_EQ(by_two.status, 1);
  EXPECT_NE(by_two.out.find("other/models.csv\n"), std::string::npos) << by_two.out << by_two.err;
  EXPECT_EQ(table("other"), once);
  if (!has_mpi()) GTEST_SKIP() << "no MPI: by parts instead";
}

TEST_F(BatchCommand, DoesAgainWhatHasChangedOrIsAskedFor) {
  for (const char* name : {"a.csv", "b.csv", "c.csv"}) write(name, kBroken);
  write("list.txt", "a.csv\nb.csv\nc.csv\n");
  const std::string batch = "brdf batch list.txt --models lambert,phong --out db ";
  EXPECT_EQ(run(batch + "--part 1/2").err, "sklar: 4 of 4 jobs failed\n");
  Times before = rows("db");
  ASSERT_EQ(before.size(), 2U) << "of a and c";
  EXPECT_FALSE(before.contains("b/lambert.json"));
  EXPECT_FALSE(std::filesystem::exists(work() / "db/models.json"));
  const Result whole = run(batch + "--json");
  EXPECT_EQ(whole.err, "sklar: 6 of 6 jobs failed\n");
  EXPECT_EQ(whole.out, read("db/models.json"));
  const Times after = rows("db");
  ASSERT_EQ(after.size(), 3U);
  for (const auto& [row, time] : before) EXPECT_EQ(after.at(row), time) << row;

  write("b.csv", kBroken + "\n");
  EXPECT_EQ(run(batch).status, 1);
  before = rows("db");
  EXPECT_EQ(before.at("a/lambert.json"), after.at("a/lambert.json"));
  EXPECT_NE(before.at("b/lambert.json"), after.at("b/lambert.json")) << "the material has changed";
  EXPECT_EQ(run(batch + "--retry-failed").status, 1);
  for (const auto& [row, time] : rows("db")) EXPECT_NE(before.at(row), time) << row;
}

TEST_F(BatchCommand, RefusesWhatItCannotDoBeforeItWorks) {
  std::filesystem::create_directory(work() / "other");
  for (const char* name : {"dark.csv", "other/dark.csv"}) write(name, "");
  write("missing.txt", "dark.csv\n# felt\nfelt.bsdf\n");
  expect_refused("brdf batch missing.txt --out db", "missing.txt: line 3: felt.bsdf: no such file");
  write("unknown.txt", "other/../notes\n");
  expect_refused("brdf batch unknown.txt --out db", "unknown.txt: line 1: other/../notes: has extension '', expected");
  write("twice.txt", "dark.csv\nother/dark.csv\n");
  expect_refused("brdf batch twice.txt --out db",
                 "twice.txt: line 2: other/dark.csv: has the name of another material, dark (dark.csv)");
  expect_refused("brdf batch dark.csv other/dark.csv --out db", "other/dark.csv: has the name of another material");
  write("empty.txt", "# nothing\n");
  expect_refused("brdf batch empty.txt --out db", "empty.txt: names no material");
  expect_refused("brdf batch none.txt --out db", "none.txt: no such file");
  expect_refused("brdf batch dark.csv --models shiny --out db", "unknown model 'shiny'");
  expect_refused("brdf batch dark.csv --models pca --out db", "--models pca: learns from the other materials");
  for (const std::string part : {"3/2", "0/2", "1/-1", "1", "/", "1/2x"}) {
    expect_refused("brdf batch dark.csv --out db --part " + part, "--part " + part + ": must be I/N with 1 <= I <= N");
  }
  expect_usage_error("brdf batch dark.csv");
  expect_usage_error("brdf batch --out db");
}

}  // namespace
}  // namespace sklar::cli
