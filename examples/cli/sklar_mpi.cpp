/// `mpirun -n N sklar-mpi brdf batch ...`: the command `sklar` beside this program, on each rank with its --part. When
/// all have ended, rank 0 runs it without --part, which does what a rank has left and writes the tables. Exit status:
/// of that.

#include <fcntl.h>
#include <mpi.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

namespace {

constexpr int kUsage = 2;  // of the command

/// Runs the command and waits. @return its exit status, 1 where it has none.
int run(std::vector<std::string> arguments, bool silent) {
  const std::filesystem::path command = std::filesystem::canonical("/proc/self/exe").parent_path() / "sklar";
  arguments.insert(arguments.begin(), command.string());
  std::vector<char*> pointers(arguments.size() + 1);  // the last one stays null
  std::transform(arguments.begin(), arguments.end(), pointers.begin(), [](std::string& text) { return text.data(); });
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  if (silent) posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const int failure = posix_spawn(&child, command.c_str(), &actions, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (failure != 0) {
    std::fprintf(stderr, "sklar-mpi: %s cannot be run\n", command.c_str());
    return 1;
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 1;
}

/// The largest status of all ranks. MPI's own waiting would keep a processor busy, which a rank that still works needs.
int largest(int status) {
  int result = 0, ready = 0;
  MPI_Request request;
  MPI_Iallreduce(&status, &result, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD, &request);
  while (true) {
    MPI_Test(&request, &ready, MPI_STATUS_IGNORE);
    if (ready != 0) return result;
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

int run_on_all(const std::vector<std::string>& arguments) {
  int rank = 0, ranks = 1;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  std::vector<std::string> part = arguments;
  part.insert(part.end(), {"--part", std::to_string(rank + 1) + "/" + std::to_string(ranks)});
  if (largest(run(part, true)) == kUsage) return kUsage;
  return largest(rank == 0 ? run(arguments, false) : 0);
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  const int status = run_on_all({argv + 1, argv + argc});
  MPI_Finalize();
  return status;
}
