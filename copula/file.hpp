#pragma once
/// Whole files, written all or not at all.

#include <filesystem>
#include <string_view>

namespace sklar {

/// Writes bytes beside the target and renames, so that a reader sees the old file or the new one and a failure leaves
/// nothing behind. A target that exists and is not a regular file (a terminal, a pipe) is written to directly.
/// @throws FileError naming the path and the system's reason.
void write_file(const std::filesystem::path& path, std::string_view bytes);

}  // namespace sklar
