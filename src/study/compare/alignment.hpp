// alignment.hpp: pairs the events of two runs, and the rows of their tables.
//
//   reference  a1 a2 b1 a3 ...
//   other      a1 b1 a2 a3 ...
//
// Partners have the same contact, event, from and to. The events of each contact keep their order. The first event
// without a partner ends the list of pairs.
//
// Only events of different contacts may have a different order, and only if the order is insignificant: the events
// are within one instant, or, in one of the two lists, closer than their uncertainties (these events are counted as
// `swapped`). Rows of the type `time` are ignored, because they are jumps of the loads, not changes of the motion.
#pragma once

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "result/csv.hpp"
#include "signorini/event.hpp"

namespace signorini::compare {

/// The largest of many differences, and its place.
struct MaxDifference {
  double value = 0.0;
  double t = 0.0;
  std::string where;  ///< name of the column, contact or event

  /// Keeps the larger difference. NaN is regarded as larger than all numbers.
  void update(double difference, double at, const std::string& place) {
    if (std::isnan(value) || difference <= value) return;
    value = difference;
    t = at;
    where = place;
  }
};

/// Largest differences of one quantity. whole: over the time that both runs cover; until_split: up to the
/// first difference between the event sequences.
struct Deviation {
  MaxDifference whole, until_split;
  std::size_t count = 0;               ///< number of compared pairs; 0: nothing to compare
  std::size_t count_until_split = 0;   ///< number of pairs after t = 0 and before the sequences differ
  std::vector<std::string> unmatched;  ///< columns or contacts that only one of the two runs has

  void update(double difference, double at, const std::string& place, double split) {
    ++count;
    whole.update(difference, at, place);
    if (!(at < split)) return;
    until_split.update(difference, at, place);
    if (at > 0.0) ++count_until_split;
  }
};

// Reads two CSV tables over time in parallel.
//
//   TimeJoin join(a / "history.csv", b / "history.csv");
//   while (join.next()) use(join.t(), join.a().number(3), join.b().number(4));
//   join.rows()                                               numbers of rows of both tables, and of common rows
//
// Rows at times that only one table has are counted but not compared. Times are equal if they differ by rounding only.

/// Number of rows of two tables, and number of compared rows.
struct RowCount {
  std::size_t compared = 0, reference = 0, other = 0;
  [[nodiscard]] bool all() const { return compared == reference && compared == other; }
  friend bool operator==(const RowCount&, const RowCount&) = default;
};

/// Reads the common rows of two tables. Errors of all members: FileError.
class TimeJoin {
 public:
  /// Rows after `until` are ignored.
  TimeJoin(const std::filesystem::path& a, const std::filesystem::path& b,
           double until = std::numeric_limits<double>::infinity())
      : a_(a), b_(b), until_(until) {}
  /// Moves to the next common time. Returns false if there is no further common time; rows() then counts all rows.
  bool next();
  /// Numbers of rows read so far. reference: table a; other: table b.
  [[nodiscard]] const RowCount& rows() const { return rows_; }
  [[nodiscard]] double t() const { return t_; }
  [[nodiscard]] const result::CsvReader& a() const { return a_; }
  [[nodiscard]] const result::CsvReader& b() const { return b_; }

 private:
  bool read(result::CsvReader& reader, std::size_t& count) const;

  result::CsvReader a_, b_;
  double until_, t_ = 0.0;
  RowCount rows_;
};

/// Reads contacts.csv, which has one row per time and contact, time by time.
class ContactRowReader {
 public:
  explicit ContactRowReader(const std::filesystem::path& path);
  /// Moves to the next time; returns false after the last one. An incomplete last time has fewer contacts.
  bool next();
  struct Forces {
    double N = 0.0, T = 0.0;
  };
  [[nodiscard]] double t() const { return t_; }
  [[nodiscard]] const std::map<std::string, Forces>& forces() const { return forces_; }

 private:
  result::CsvReader reader_;
  std::size_t contact_, N_, T_;
  bool pending_ = false;  // the reader is at the first row of the next time
  double t_ = 0.0;
  std::map<std::string, Forces> forces_;
};

/// True if the times are equal up to rounding.
[[nodiscard]] bool same_time(double a, double b);
/// True if t is after the end, by more than rounding.
[[nodiscard]] inline bool beyond(double t, double end) { return t > end && !same_time(t, end); }

/// Columns of a row of events.csv that the comparison uses.
struct LoggedEvent {
  double t = 0.0;
  std::string contact, type, from, to;
  double uncertainty = 0.0;  ///< t_uncertainty of events.csv; 0 if the run has none

  /// True for a change of state; false for a jump of a load.
  [[nodiscard]] bool is_change() const { return type != to_string(EventType::time); }
  /// Text of the event: "first slip, stick -> slip+".
  [[nodiscard]] std::string name() const;
};

struct AlignedPair {
  std::size_t reference = 0, other = 0;  ///< indices of both partners in their lists
  /// True if, in the other list, this event comes after an event that follows it in the reference.
  bool swapped = false;
};

struct Alignment {
  std::vector<AlignedPair> pairs;  ///< in the order of the reference
  std::size_t swapped = 0;
  /// First difference between the sequences. reference, other: indices of the events there; nullopt if the
  /// list has no further event.
  struct Split {
    double t = 0.0;  ///< earlier time of the two events
    std::optional<std::size_t> reference, other;
    std::size_t unaligned = 0;  ///< number of remaining events in the longer list
  };
  std::optional<Split> split;
};

struct AlignmentSettings {
  double t_end = 0.0;    ///< time that both runs reach; later events are ignored
  double instant = 0.0;  ///< events closer than this time may swap; at least the rounding of t_end
};

/// Aligns the events of two runs. Both lists must ascend in t. Cost: proportional to the number of events
/// times the number of events per instant.
[[nodiscard]] Alignment align(const std::vector<LoggedEvent>& reference,
                              const std::vector<LoggedEvent>& other, const AlignmentSettings& settings);

}  // namespace signorini::compare
