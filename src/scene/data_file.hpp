// data_file.hpp: opens files that a scene refers to, and reads their lines.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

#include "scene/table.hpp"

namespace signorini::scene {

/// Longest allowed line of numbers, in bytes.
inline constexpr std::size_t max_line_length = 200;
/// Reads the next line, at most `max_line_length` + 1 bytes of it: a file without line breaks must not fill memory.
/// Returns false at the end of the file.
bool read_line(std::istream& in, std::string& line);

/// Throws a FileError that names the place of the key, the file and the reason `why`.
[[noreturn]] void refuse_file(const Table& table, std::string_view key, const std::filesystem::path& path,
                              const std::string& why);
/// Throws `error`, which already names the file, with the place of the key in front.
[[noreturn]] void refuse_file(const Table& table, std::string_view key, const FileError& error);
/// Opens the file that `key` names. Errors: FileError with the place of the key.
[[nodiscard]] std::ifstream open_data_file(const Table& table, std::string_view key,
                                           const std::filesystem::path& path);

}  // namespace signorini::scene
