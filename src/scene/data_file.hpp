// data_file.hpp: files that a scene names: matrices, and tables of time and value.
//
//   t,value        a first line of words is a heading
//   0.0,1.5        two numbers a line, separated by a comma, a semicolon or blanks
//   # ...          comments and blank lines are skipped
//
// Times ascend; a time that stands twice is a jump.
#pragma once

#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <vector>

#include "scene/table.hpp"

namespace signorini {

/// Of a line of numbers; longer ones are no such line.
inline constexpr std::size_t longest_line = 200;
/// The next line, at most `longest_line` + 1 bytes of it: a file without line breaks must not fill memory.
bool read_line(std::istream& in, std::string& line);

/// Opens the file that `key` names. Errors: FileError with the place of the key.
[[nodiscard]] std::ifstream open_data_file(const Table& table, std::string_view key,
                                           const std::filesystem::path& path);

struct TimeTable {
  std::vector<double> times, values;
};

/// Errors: SceneError at the line of the file; `key` stands in front of the message.
[[nodiscard]] TimeTable read_time_table(std::istream& in, const std::string& file, const std::string& key);

}  // namespace signorini
