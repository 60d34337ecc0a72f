// joined_tables.hpp: two CSV tables of time, walked together.
//
//   TimeJoin join(a / "history.csv", b / "history.csv");
//   while (join.next()) use(join.t(), join.a().number(3), join.b().number(4));
//
// Rows at times that only one table has are passed over. Times are equal if they differ by roundoff only.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "result/csv_read.hpp"

namespace signorini {

/// Errors of all members: FileError.
class TimeJoin {
 public:
  TimeJoin(const std::filesystem::path& a, const std::filesystem::path& b) : a_(a), b_(b) {}
  /// Moves to the next common time.
  bool next();
  [[nodiscard]] double t() const { return t_; }
  [[nodiscard]] const CsvReader& a() const { return a_; }
  [[nodiscard]] const CsvReader& b() const { return b_; }

 private:
  CsvReader a_, b_;
  double t_ = 0.0;
};

/// contacts.csv has one row a time and contact: here all rows of one time together.
class ContactRowReader {
 public:
  explicit ContactRowReader(const std::filesystem::path& path);
  /// Moves to the next time; a last time whose rows are not all there may have fewer contacts.
  bool next();
  struct Forces {
    double N = 0.0, T = 0.0;
  };
  [[nodiscard]] double t() const { return t_; }
  [[nodiscard]] const std::map<std::string, Forces>& forces() const { return forces_; }

 private:
  CsvReader reader_;
  std::size_t contact_, N_, T_;
  bool pending_ = false;  // the reader stands on the first row of the next time
  double t_ = 0.0;
  std::map<std::string, Forces> forces_;
};

/// Equal but for roundoff.
[[nodiscard]] bool same_time(double a, double b);

}  // namespace signorini
