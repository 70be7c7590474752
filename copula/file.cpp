#include "copula/file.hpp"

#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <fstream>
#include <sstream>
#include <system_error>
#include <utility>

#include "copula/error.hpp"

namespace sklar {
namespace fs = std::filesystem;
namespace {

bool put(const fs::path& path, std::string_view bytes) {
  errno = 0;
  std::ofstream out(path, std::ios::binary | std::ios::trunc);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  return static_cast<bool>(out);
}

[[noreturn]] void fail(const fs::path& path, const std::error_code& reason) {
  throw FileError(path.string(), "cannot be written: " + reason.message());
}

fs::path sibling(const fs::path& target) {
  static std::atomic<unsigned> counter{0};
  fs::path part = target;
  part += "." + std::to_string(::getpid()) + "-" + std::to_string(counter++) + ".part";
  return part;
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
    if (!put(path, bytes)) fail(path, {errno, std::generic_category()});
    return;
  }
  const fs::path target = present ? fs::canonical(path) : path;
  const fs::path part = sibling(target);
  if (!put(part, bytes)) {
    error = {errno != 0 ? errno : EIO, std::generic_category()};
  } else {
    fs::rename(part, target, error);
  }
  if (!error) return;
  std::error_code ignored;
  fs::remove(part, ignored);
  fail(path, error);
}

}  // namespace sklar
