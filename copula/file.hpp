#pragma once
/// Whole files: read at once, written all or not at all.

#include <filesystem>
#include <string>
#include <string_view>

namespace sklar {

/// The bytes of a file. @throws FileError naming the path: missing, a directory, or the system's reason.
[[nodiscard]] std::string read_file(const std::filesystem::path& path);

/// Writes bytes beside the target and renames, so that a reader sees the old file or the new one and a failure leaves
/// nothing behind. A target that exists and is not a regular file (a terminal, a pipe) is written to directly.
/// @throws FileError naming the path and the system's reason.
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// Makes a folder and those above it, where they are missing. @throws FileError naming the path and the system's
/// reason.
void make_folder(const std::filesystem::path& path);

/// For before long work: throws what write_file would for a directory, or for a folder that is missing or read-only.
void require_writable(const std::filesystem::path& path);

}  // namespace sklar
