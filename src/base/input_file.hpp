// input_file.hpp: what may be opened to be read whole.
#pragma once

#include <filesystem>
#include <string>

namespace signorini {

/// Why this is nothing to read from, "is a directory"; empty for a regular file, and for one that is missing,
/// where opening says why. A pipe would wait for a writer, and a device may never end.
[[nodiscard]] std::string why_no_input_file(const std::filesystem::path& path);

/// ": No such file or directory" for what errno was, or nothing.
[[nodiscard]] std::string because(int error);

}  // namespace signorini
