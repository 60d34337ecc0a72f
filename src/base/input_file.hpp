// input_file.hpp: checks a file before it is read.
#pragma once

#include <filesystem>
#include <string>

namespace signorini {

/// Reason why this is not a readable file, "is a directory"; empty for a regular file, and for a missing one, for which
/// opening reports the reason. A pipe would wait for a writer, and a device may never end.
[[nodiscard]] std::string why_no_input_file(const std::filesystem::path& path);

/// ": No such file or directory" for a value of errno, or "".
[[nodiscard]] std::string because(int error);

}  // namespace signorini
