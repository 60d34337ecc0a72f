// record_header.hpp: headings of files with strong-motion records.
//
// PEER: lines of words, one of them with quantity and unit, the last with the number of values and their step in seconds
//
//   PEER NGA STRONG MOTION DATABASE RECORD
//   ACCELERATION TIME SERIES IN UNITS OF G            or VELOCITY (CM/S), DISPLACEMENT (CM)
//   NPTS= 5372, DT= .0050 SEC                         or: 5372 0.0050 NPTS, DT
//
// CSMIP (.V2) and COSMOS (.V2C): blocks of acceleration, velocity and displacement, each below one line, in columns of a
// Fortran format. The line of a COSMOS block does not state the step.
//
//   3000 points of accel data equally spaced at .020 sec, in cm/sec2. (8f10.3)
//   12725 acceleration pts, approx 63 secs, units=cm/s^2,Format=(8F10.5)
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace signorini::scene {

enum class RecordQuantity { none, acceleration, velocity, displacement };
/// "acceleration"; "values" for none.
[[nodiscard]] const char* name_of(RecordQuantity quantity);

inline constexpr double standard_gravity = 9.80665;  // m/s^2

struct RecordUnit {
  std::string_view name;  ///< as in the scene: "cm/s^2"
  RecordQuantity quantity = RecordQuantity::none;
  double si = 1.0;  ///< value in m and s
};
/// The unit at the beginning of a text, in upper or lower case: "g. Filter ...", "(CM/SEC**2)", "cm/s^2".
[[nodiscard]] std::optional<RecordUnit> record_unit(std::string_view text);
/// Units of a quantity as headings spell them, for messages: "M/S, CM/S or MM/S".
[[nodiscard]] const char* units_of(RecordQuantity quantity);

struct RecordHeader {
  std::size_t points = 0;
  double time_step = 0.0;  ///< in seconds; 0: the heading does not state it
  RecordQuantity quantity = RecordQuantity::none;
  bool names_unit = false;         ///< a line states a unit, known or not
  std::optional<RecordUnit> unit;  ///< empty if no unit is stated, or an unknown one
  int width = 0;                   ///< characters of one value; 0: values are separated by blanks
};

/// Number of values and their step in seconds, in the last line of a PEER heading. nullopt for any other line.
[[nodiscard]] std::optional<RecordHeader> peer_points(std::string_view line);
/// Adds the quantity and the unit that a line of a PEER heading states. True if it states one of them.
bool add_peer_line(std::string_view line, RecordHeader& header);
/// The first line of a block of CSMIP or COSMOS; nullopt for any other line.
[[nodiscard]] std::optional<RecordHeader> block_header(std::string_view line);

}  // namespace signorini::scene
