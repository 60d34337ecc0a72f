// joined_tables.hpp: reads two CSV tables over time in parallel.
//
//   TimeJoin join(a / "history.csv", b / "history.csv");
//   while (join.next()) use(join.t(), join.a().number(3), join.b().number(4));
//   join.rows()                                               number of rows of each, and of common ones
//
// Rows at times that only one table has are skipped, and counted. Times are equal if they differ by rounding only.
#pragma once

#include <cstddef>
#include <filesystem>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "result/csv_read.hpp"

namespace signorini {

/// Number of rows of two tables, and number of compared rows.
struct RowCount {
  std::size_t compared = 0, reference = 0, other = 0;
  [[nodiscard]] bool all() const { return compared == reference && compared == other; }
  friend bool operator==(const RowCount&, const RowCount&) = default;
};

/// Errors of all members: FileError.
class TimeJoin {
 public:
  /// Rows after `until` are ignored.
  TimeJoin(const std::filesystem::path& a, const std::filesystem::path& b,
           double until = std::numeric_limits<double>::infinity())
      : a_(a), b_(b), until_(until) {}
  /// Moves to the next common time; false: there is none, and all rows have been counted.
  bool next();
  /// Rows of a (reference) and b (other).
  [[nodiscard]] const RowCount& rows() const { return rows_; }
  [[nodiscard]] double t() const { return t_; }
  [[nodiscard]] const CsvReader& a() const { return a_; }
  [[nodiscard]] const CsvReader& b() const { return b_; }

 private:
  bool read(CsvReader& reader, std::size_t& count) const;

  CsvReader a_, b_;
  double until_, t_ = 0.0;
  RowCount rows_;
};

/// Reads contacts.csv, which has one row per time and contact, time by time.
class ContactRowReader {
 public:
  explicit ContactRowReader(const std::filesystem::path& path);
  /// Moves to the next time; an incomplete last time may have fewer contacts.
  bool next();
  struct Forces {
    double N = 0.0, T = 0.0;
  };
  [[nodiscard]] double t() const { return t_; }
  [[nodiscard]] const std::map<std::string, Forces>& forces() const { return forces_; }

 private:
  CsvReader reader_;
  std::size_t contact_, N_, T_;
  bool pending_ = false;  // the reader is at the first row of the next time
  double t_ = 0.0;
  std::map<std::string, Forces> forces_;
};

/// True if the times are equal up to rounding.
[[nodiscard]] bool same_time(double a, double b);
/// True if t is after the end, by more than rounding.
[[nodiscard]] inline bool beyond(double t, double end) { return t > end && !same_time(t, end); }

}  // namespace signorini
