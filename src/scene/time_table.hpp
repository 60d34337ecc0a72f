// time_table.hpp: files of time and value, and strong-motion records.
//
//   t,value        a first line of words is a heading
//   0.0,1.5        two numbers a line, separated by a comma, a semicolon or blanks
//   # ...          comments begin with #, %, ! or //, on a line of their own or behind numbers
//
// Times ascend; a repeated time is a jump. If a column is given, the file may have more than two columns. If a time
// step is given, all numbers are values, in lines of any length. Records (record_header.hpp) have their own step.
#pragma once

#include <istream>
#include <optional>
#include <string>
#include <vector>

#include "scene/record_header.hpp"

namespace signorini::scene {

struct TimeTable {
  std::vector<double> times, values;
  /// Unit of the values that a record states; empty for tables, and for records that state none.
  std::optional<RecordUnit> unit = {};
};

/// Layout of a table file, as far as the scene gives it.
struct TableLayout {
  int column = 0;          ///< number of the column with the values, >= 2; 0: the file has two columns
  double time_step = 0.0;  ///< > 0: the file has values only, at this interval; 0: the file has times
  bool peer = false;       ///< by its name a PEER file; other records are found by their content
  RecordQuantity by_name = RecordQuantity::none;  ///< quantity that the file's name states (.VT2)
  /// Quantity of the records that the key takes; none: it takes no record.
  RecordQuantity wanted = RecordQuantity::none;
  bool unit_given = false;  ///< the scene gives the unit, so that a record need not state it
  double second = 1.0;      ///< one second in the scene's unit of time, to convert the step of a record
};

/// Reads a table of time and value, or a record. Errors: SceneError at the line of the file; `key` begins the message.
[[nodiscard]] TimeTable read_time_table(std::istream& in, const std::string& file, const std::string& key,
                                        const TableLayout& layout = {});

}  // namespace signorini::scene
