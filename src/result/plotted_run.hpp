// plotted_run.hpp: data of a run for its pictures, read from its tables.
//
//   directory -tables-> PlottedRun -pictures-> scripts
//
// In killed runs only complete rows that all tables have are used.
#pragma once

#include <fmt/format.h>

#include <limits>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "result/csv.hpp"
#include "result/frames.hpp"
#include "result/picture_style.hpp"
#include "result/summary.hpp"
#include "result/table.hpp"

namespace signorini::result {

/// Range of a curve's values.
struct Range {
  double least = std::numeric_limits<double>::infinity(), greatest = -least;

  /// Extends the range to a value, or to another range.
  void take(double value);
  void take(const Range& other);
  [[nodiscard]] bool empty() const { return !(least <= greatest); }
  /// The largest magnitude; 0 for an empty range.
  [[nodiscard]] double size() const;
};
/// Ranges of a contact's quantities.
struct ContactRanges {
  Range gap, ut, slip, N, T;
};

/// An event in marks.csv, thinned to the resolution of a picture.
struct Mark {
  int row = -1;  ///< index of the contact (its row in the pictures); -1: a jump of a load
  double t = 0.0;
  std::string event;
  double N = 0.0, T = 0.0;
};

struct PlottedRun {
  RunFacts facts;
  std::vector<std::string> slugs;    ///< one per contact: a unique file name made from its name
  std::vector<std::string> columns;  ///< columns of history.csv
  std::vector<std::string> loads;    ///< columns of loads.csv, if it exists
  /// Columns of response.csv, if it exists, as numbers for gnuplot, t first.
  std::vector<std::size_t> responses;
  std::size_t times = 0;  ///< rows of history.csv
  double t_first = 0.0, t_last = 0.0;
  double from = 0.0, to = 0.0;  ///< time window
  std::string suffix;           ///< suffix of the pictures' names
  PictureStyle look;
  /// Intervals of constant state, one list per contact, in the order of time.
  struct Band {
    double from, to;
    std::string state;
  };
  std::vector<std::vector<Band>> bands;
  std::vector<std::string> event_types;                     ///< types that occur
  std::set<std::pair<std::size_t, std::string>> occurring;  ///< (contact, type) pairs that occur
  std::vector<double> greatest_compression;                 ///< -N in the tables, one per contact
  double greatest_force = 0.0;                              ///< |(N, T)| of any contact
  /// Rows of a contact in motion.csv; empty for runs without that table.
  struct Rows {
    std::size_t first = 0, count = 0;
  };
  std::vector<Rows> motion;
  /// Rows of a curve in curves.csv, by its name; empty for runs without that table.
  std::map<std::string, Rows> curves;
  double legend = Canvas::usual_legend;  ///< width in pixels of a legend beside the panels
  std::vector<ContactRanges> ranges;     ///< in the time window, one per contact
  std::map<std::string, Range> moves;    ///< of displacements, by name of the column
  std::vector<Mark> marks;               ///< in the time window; sorted by type, then by contact
  struct Energies {
    std::set<std::string> used;  ///< columns that are not zero throughout
    std::size_t times = 0;       ///< number of rows of energy.csv
    double start = 0.0;          ///< the first balance
  } energies;
  std::vector<Frame> frames;  ///< in the time window
};

/// Rows of marks.csv with events of this type and, if given, of this contact (Mark::row). A curve draws this
/// range of rows: a condition would cost gnuplot 7 us per row, since it guards each expression by system
/// calls.
[[nodiscard]] PlottedRun::Rows marks_of(const PlottedRun& run, const std::string& type,
                                        std::optional<int> row = std::nullopt);

/// A run without data from files, for pictures of several runs, or of none.
[[nodiscard]] PlottedRun empty_plotted_run(const std::string& title, const Units& units,
                                           const PictureStyle& look = {});

/// Time window; absent ends are those of the run.
struct PlotWindow {
  std::optional<double> from, to;
};

/// The whole run, with output times limited to those that all tables have; if there are fewer than two, no
/// other data are read. Errors: FileError; UsageError if the window contains no part of the run.
[[nodiscard]] PlottedRun read_plotted_run(const TableFolder& tables, const RunFacts& facts,
                                          const PlotWindow& window);
/// The same run from its first event to its last, with a margin; nullopt if this is no short part of the run.
[[nodiscard]] std::optional<PlottedRun> event_window(const TableFolder& tables, const PlottedRun& run);
/// Data for overlays of several runs: times, forces and ranges. t_end: of the longest run.
[[nodiscard]] PlottedRun read_compared(const TableFolder& tables, const RunFacts& facts, double t_end);

/// A word or a phrase of pictures in the language of run.look.
[[nodiscard]] std::string translate(const PlottedRun& run, std::string_view english);
/// Same with numbers and names inserted, one for each "{}".
template <class... Parts>
[[nodiscard]] std::string translate(const PlottedRun& run, std::string_view english, const Parts&... parts) {
  return fmt::format(fmt::runtime(translate(run, english)), parts...);
}

}  // namespace signorini::result
