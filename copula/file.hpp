#pragma once
/// Whole files: read at once, written all or not at all.

#include <filesystem>
#include <string>
#include <string_view>

namespace sklar {

/// The bytes of a file. @throws FileError naming the path: missing, a directory, or the system's reason.
[[nodiscard]] std::string read_file(const std::filesystem::path& path);

/// Writes bytes to PATH.sklar-part and renames it, so that a reader sees the old file or the new one, also after a kill
/// at any moment: then PATH.sklar-part may be left, which the next call for PATH takes over. A failure, such as a full
/// disk, leaves the old file and nothing else. Calls for one path, of any process, wait for each other. After a crash
/// of the machine the file system decides: nothing is flushed to the disk. A target that exists and is not a regular
/// file (a terminal, a pipe) is written to directly.
/// @throws FileError naming the path and the system's reason.
void write_file(const std::filesystem::path& path, std::string_view bytes);

/// Makes a folder and those above it, where they are missing. @throws FileError naming the path and the system's
/// reason.
void make_folder(const std::filesystem::path& path);

/// For before long work: throws what write_file would for a directory, or for a folder that is missing or read-only.
void require_writable(const std::filesystem::path& path);

}  // namespace sklar
