// data_file.hpp: files that a scene refers to: matrices, and tables of time and value.
//
//   t,value        a first line of words is a heading
//   0.0,1.5        two numbers a line, separated by a comma, a semicolon or blanks
//   # ...          comments and blank lines are skipped
//
// Times ascend; a repeated time is a jump. If a column is given, the file may have more than two columns. If a time
// step is given, all numbers are values, in lines of any length. A PEER file (.AT2) states its own step:
//
//   PEER NGA STRONG MOTION DATABASE RECORD      three lines of words, one of them with the unit:
//   ... ACCELERATION TIME SERIES IN UNITS OF G  G, CM/S/S, M/S/S, MM/S/S, GAL, with blanks, SEC, S**2, S^2
//   NPTS= 5372, DT= .0050 SEC                   or: 5372 0.0050 NPTS, DT; always in seconds
//   .1E-04  .2E-04 ...                          NPTS values
#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

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

inline constexpr double standard_gravity = 9.80665;  // m/s^2

struct TimeTable {
  std::vector<double> times, values;
  bool in_g = false;  ///< the file states that its values are multiples of the acceleration of gravity
  /// Unit of the values in m/s^2, if the file states one; 9.80665 if the file states g.
  std::optional<double> unit = {};
};

/// Layout of a table file, as far as the scene gives it.
struct TableLayout {
  int column = 0;          ///< number of the column with the values, >= 2; 0: the file has two columns
  double time_step = 0.0;  ///< > 0: the file has values only, at this interval; 0: the file has times
  bool peer = false;
  bool unit_given = false;  ///< the scene gives the unit, so that a PEER file need not state it
  double second = 1.0;      ///< one second in the scene's unit of time, to convert the step of a PEER file
};

/// Reads a table of time and value. Errors: SceneError at the line of the file; `key` begins the message.
[[nodiscard]] TimeTable read_time_table(std::istream& in, const std::string& file, const std::string& key,
                                        const TableLayout& layout = {});

}  // namespace signorini::scene
