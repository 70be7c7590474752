/// Prints the instructions that one batch call executes, as offsets in this program, one a line; "-" for those outside
/// it. By single steps of a child process: exact counts, on machines without counters too. Run by tests/counts.sh.
///   kernel_trace FAMILY log_pdf|h|h_inv fast|standard ROWS

#include <sys/ptrace.h>
#include <sys/user.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <string>

#include "copula/study/tradeoff.hpp"
#include "families/registry.hpp"

namespace {

using namespace sklar;

using Evaluate = Column (Copula::*)(const PointsRef&, Accuracy) const;

Evaluate find_quantity(const std::string& name) {
  if (name == "log_pdf") return &Copula::log_pdf;
  if (name == "h") return &Copula::h;
  if (name == "h_inv") return &Copula::h_inv;
  throw std::invalid_argument("unknown quantity " + name);
}

/// Where this program lies in memory.
struct Extent {
  unsigned long long first = 0, last = 0;

  explicit Extent(pid_t process) {
    std::ifstream maps("/proc/" + std::to_string(process) + "/maps");
    char path[4096];
    const auto length = readlink("/proc/self/exe", path, sizeof path);
    const std::string program(path, static_cast<std::size_t>(length));
    for (std::string line; std::getline(maps, line);) {
      if (!line.ends_with(program)) continue;
      if (first == 0) first = std::stoull(line, nullptr, 16);
      last = std::stoull(line.substr(line.find('-') + 1), nullptr, 16);
    }
  }
};

void trace(pid_t child) {
  int status;
  waitpid(child, &status, 0);
  const Extent program(child);
  while (true) {
    ptrace(PTRACE_SINGLESTEP, child, nullptr, nullptr);
    waitpid(child, &status, 0);
    if (WIFEXITED(status) || WSTOPSIG(status) != SIGTRAP) break;
    user_regs_struct registers;
    ptrace(PTRACE_GETREGS, child, nullptr, &registers);
    const bool inside = registers.rip >= program.first && registers.rip < program.last;
    if (inside) {
      std::printf("%llx\n", registers.rip - program.first);
    } else {
      std::puts("-");
    }
  }
  ptrace(PTRACE_KILL, child, nullptr, nullptr);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 5) return 2;
  const FamilyInfo& family = families::find(argv[1]);
  const Evaluate evaluate = find_quantity(argv[2]);
  const Accuracy accuracy = std::string(argv[3]) == "fast" ? Accuracy::fast : Accuracy::standard;
  const CopulaPtr copula = family.make(2, medium_theta(family, 2));
  Rng rng(2);
  const Points u = copula->sample(std::stol(argv[4]), rng);
  ((*copula).*evaluate)(u, accuracy);  // resolves what is resolved once
  const pid_t child = fork();
  if (child != 0) {
    trace(child);
    return 0;
  }
  ptrace(PTRACE_TRACEME, 0, nullptr, nullptr);
  std::raise(SIGSTOP);
  const Column values = ((*copula).*evaluate)(u, accuracy);
  std::raise(SIGUSR1);
  _exit(values.size() > 0 ? 0 : 1);
}
