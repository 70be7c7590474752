#include "copula/file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <system_error>
#include <utility>

#include "copula/error.hpp"

namespace sklar {
namespace fs = std::filesystem;
namespace {

std::error_code last_error() {
  return {errno, std::generic_category()};
}

/// An open file.
class Output {
 public:
  explicit Output(const fs::path& path, int flags = 0)
      : file_(::open(path.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_NOCTTY | flags, 0666)) {}
  ~Output() {
    if (file_ >= 0) ::close(file_);
  }
  Output(const Output&) = delete;
  Output& operator=(const Output&) = delete;

  [[nodiscard]] bool is_open() const { return file_ >= 0; }

  /// Waits for others that lock it.
  [[nodiscard]] bool lock() const {
    while (::flock(file_, LOCK_EX) != 0) {
      if (errno != EINTR) return false;
    }
    return true;
  }

  [[nodiscard]] bool is_at(const fs::path& path) const {
    using Stat = struct stat;
    Stat here{}, there{};
    return ::fstat(file_, &here) == 0 && ::lstat(path.c_str(), &there) == 0 && here.st_dev == there.st_dev &&
           here.st_ino == there.st_ino;
  }

  [[nodiscard]] bool clear() const { return ::ftruncate(file_, 0) == 0; }

  [[nodiscard]] bool put(std::string_view bytes) const {
    while (!bytes.empty()) {
      const ssize_t count = ::write(file_, bytes.data(), bytes.size());
      if (count < 0 && errno != EINTR) return false;
      bytes.remove_prefix(static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
    }
    return ::close(::dup(file_)) == 0;  // some file systems report a full disk here
  }

 private:
  int file_;
};

[[noreturn]] void fail(const fs::path& path, const std::error_code& reason) {
  throw FileError(path.string(), "cannot be written: " + reason.message());
}

/// Writes to one file beside the target, which all who write the target lock, and renames it. What a killed one left
/// there is written over.
std::error_code replace(const fs::path& target, std::string_view bytes) {
  fs::path part = target;
  part += ".sklar-part";
  for (;;) {
    const Output out(part, O_NOFOLLOW);
    if (!out.is_open() || !out.lock()) return last_error();
    if (!out.is_at(part)) continue;  // another has renamed or removed it meanwhile
    if (out.clear() && out.put(bytes) && ::rename(part.c_str(), target.c_str()) == 0) return {};
    const std::error_code error = last_error();
    ::unlink(part.c_str());
    return error;
  }
}

}  // namespace

std::string read_file(const fs::path& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (status.type() == fs::file_type::not_found) throw FileError(path.string(), "no such file");
  if (fs::is_directory(status)) throw FileError(path.string(), "is a directory, not a file");
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  std::ostringstream bytes;
  if (in.peek() != std::ifstream::traits_type::eof()) bytes << in.rdbuf();
  if (!in.is_open() || in.bad() || !bytes) {
    error = {errno != 0 ? errno : EIO, std::generic_category()};
    throw FileError(path.string(), "cannot be read: " + error.message());
  }
  return std::move(bytes).str();
}

void make_folder(const fs::path& path) {
  std::error_code error;
  fs::create_directories(path, error);
  if (error) throw FileError(path.string(), error.message());
}

void require_writable(const fs::path& path) {
  if (fs::is_directory(path)) fail(path, std::make_error_code(std::errc::is_a_directory));
  if (fs::exists(path) && !fs::is_regular_file(path)) return;
  const fs::path folder = path.has_parent_path() ? path.parent_path() : ".";
  const int access = ::access(folder.c_str(), W_OK | X_OK);
  if (access != 0) fail(path, {errno, std::generic_category()});
  if (!fs::is_directory(folder)) fail(path, std::make_error_code(std::errc::not_a_directory));
}

void write_file(const fs::path& path, std::string_view bytes) {
  std::error_code error;
  const bool present = fs::exists(path, error);
  if (present && !fs::is_regular_file(path)) {
    if (fs::is_directory(path)) fail(path, std::make_error_code(std::errc::is_a_directory));
    const Output out(path);
    if (!out.is_open() || !out.put(bytes)) fail(path, last_error());
    return;
  }
  error = replace(present ? fs::canonical(path) : path, bytes);
  if (error) fail(path, error);
}

}  // namespace sklar
