// plotted_run.hpp: data of a run for its pictures, read from its tables.
//
//   directory -tables-> PlottedRun -pictures-> scripts
//
// From a killed run, only output times that are complete in all tables are used.
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

  /// Extends the range so that it includes a value, or another range. Values that are not finite are ignored.
  void take(double value);
  void take(const Range& other);
  [[nodiscard]] bool empty() const { return !(least <= greatest); }
  /// The largest magnitude; 0 for an empty range.
  [[nodiscard]] double size() const;
};
/// Ranges of the quantities of a contact: lengths gap, ut, slip; forces N, T.
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
  std::vector<std::string> event_types;                     ///< event types that occur in the run
  std::set<std::pair<std::size_t, std::string>> occurring;  ///< (contact, type) pairs that occur
  std::vector<double> greatest_compression;                 ///< largest -N in the tables, for each contact
  double greatest_force = 0.0;                              ///< largest sqrt(N^2 + T^2) of all contacts
  /// Adjacent rows of a table. first: index of the first row after the header, from 0.
  struct Rows {
    std::size_t first = 0, count = 0;
  };
  std::vector<Rows> motion;  ///< rows of each contact in motion.csv; empty if the run has no such table
  /// Rows of each curve in curves.csv, by its name; empty if the run has no such table.
  std::map<std::string, Rows> curves;
  double legend = Canvas::usual_legend;  ///< width in pixels of a legend to the right of the panels
  std::vector<ContactRanges> ranges;     ///< ranges of each contact in the time window
  std::map<std::string, Range> moves;    ///< ranges of displacements, by name of the column
  std::vector<Mark> marks;               ///< events in the time window; sorted by type, then by contact
  struct Energies {
    std::set<std::string> used;  ///< columns that are not zero throughout
    std::size_t times = 0;       ///< number of rows of energy.csv
    double start = 0.0;          ///< first value of the balance
  } energies;
  std::vector<Frame> frames;  ///< frames in the time window
};

/// Rows of marks.csv with events of this type and, if given, of this contact (Mark::row). A curve draws this range of
/// rows, because a condition in a gnuplot expression would cost 7 us per row.
[[nodiscard]] PlottedRun::Rows marks_of(const PlottedRun& run, const std::string& type,
                                        std::optional<int> row = std::nullopt);

/// A run without data from files, for pictures of several runs or of no run.
[[nodiscard]] PlottedRun empty_plotted_run(const std::string& title, const Units& units,
                                           const PictureStyle& look = {});

/// Time window of pictures; if `from` or `to` is absent, the window begins or ends with the run.
struct PlotWindow {
  std::optional<double> from, to;
};

/// Reads a run, up to the last output time that all tables have; if there are fewer than two output times, no other data
/// are read. Errors: FileError; UsageError if the window contains no part of the run.
[[nodiscard]] PlottedRun read_plotted_run(const TableFolder& tables, const RunFacts& facts,
                                          const PlotWindow& window);
/// The part of the run from the first change of a contact state to the last, with a margin. nullopt if this is 60 % of the run
/// or more, if there are fewer than four changes, or if there are more than six contacts.
[[nodiscard]] std::optional<PlottedRun> event_window(const TableFolder& tables, const PlottedRun& run);
/// Data of a run for pictures that overlay several runs: times, forces and ranges. t_end: end of the longest run.
[[nodiscard]] PlottedRun read_compared(const TableFolder& tables, const RunFacts& facts, double t_end);

/// A word or a phrase of pictures in the language of run.look.
[[nodiscard]] std::string translate(const PlottedRun& run, std::string_view english);
/// The translated phrase with numbers and names inserted, one for each "{}".
template <class... Parts>
[[nodiscard]] std::string translate(const PlottedRun& run, std::string_view english, const Parts&... parts) {
  return fmt::format(fmt::runtime(translate(run, english)), parts...);
}

}  // namespace signorini::result
