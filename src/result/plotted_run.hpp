// plotted_run.hpp: a run as its pictures see it, read from its tables.
//
//   directory -tables-> PlottedRun -pictures-> scripts
//
// What killed runs lack is left out: rows are those that every table has whole.
#pragma once

#include <fmt/format.h>

#include <limits>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "result/csv_read.hpp"
#include "result/frame_data.hpp"
#include "result/picture_look.hpp"
#include "result/summary.hpp"
#include "result/table.hpp"

namespace signorini {

/// What a curve covers.
struct Range {
  double least = std::numeric_limits<double>::infinity(), greatest = -least;

  void take(double value);
  void take(const Range& other);
  [[nodiscard]] bool empty() const { return !(least <= greatest); }
  /// The greatest magnitude; 0 of nothing.
  [[nodiscard]] double size() const;
};
/// Of a contact.
struct ContactRanges {
  Range gap, ut, slip, N, T;
};

/// An event in marks.csv: thinned to what a picture can resolve.
struct Mark {
  int row = -1;  ///< the contact's; -1: a jump of a load
  double t = 0.0;
  std::string event;
  double N = 0.0, T = 0.0;
};

struct PlottedRun {
  RunFacts facts;
  std::vector<std::string> slugs;    ///< one a contact: its name made fit for a file name, unique
  std::vector<std::string> columns;  ///< of history.csv
  std::vector<std::string> loads;    ///< columns of loads.csv, where that is
  std::vector<std::size_t>
      responses;          ///< where response.csv is: numbers of its columns, t first, for gnuplot
  std::size_t times = 0;  ///< rows of history.csv
  double t_first = 0.0, t_last = 0.0;
  double from = 0.0, to = 0.0;  ///< the time shown
  std::string suffix;           ///< of the pictures' names
  PictureLook look;
  /// Intervals of constant state, one list a contact, in the order of time.
  struct Band {
    double from, to;
    std::string state;
  };
  std::vector<std::vector<Band>> bands;
  std::vector<std::string> event_types;                     ///< those that occur
  std::set<std::pair<std::size_t, std::string>> occurring;  ///< of which contact which
  std::vector<double> greatest_compression;                 ///< -N in the tables, one a contact
  double greatest_force = 0.0;                              ///< |(N, T)| of any contact
  /// Rows of a contact in motion.csv; none in runs that have no such table.
  struct Rows {
    std::size_t first = 0, count = 0;
  };
  std::vector<Rows> motion;
  /// Rows of a curve in curves.csv, by its name; none in runs that have no such table.
  std::map<std::string, Rows> curves;
  double legend = Canvas::usual_legend;  ///< pixels beside its panels
  std::vector<ContactRanges> ranges;     ///< of the time shown, one a contact
  std::map<std::string, Range> moves;    ///< of the displacements, by name of the column
  std::vector<Mark> marks;  ///< in the time shown; those of a type together, and in them a contact's
  struct Energies {
    std::set<std::string> used;  ///< columns that are not zero throughout
    std::size_t times = 0;       ///< rows of energy.csv
    double start = 0.0;          ///< the first balance
  } energies;
  std::vector<Frame> frames;  ///< in the time shown
};

/// Which of the marks are of this type, and of this row of the pictures where one is given. gnuplot takes 7 us for an
/// expression (it guards each by system calls): a curve reads the rows that it draws, and does not look for them.
[[nodiscard]] PlottedRun::Rows marks_of(const PlottedRun& run, const std::string& type,
                                        std::optional<int> row = std::nullopt);

/// A run of which nothing is read: what several runs, or none, are drawn as.
[[nodiscard]] PlottedRun untold_run(const std::string& title, const Units& units,
                                    const PictureLook& look = {});

/// The time shown; absent ends are those of the run.
struct PlotWindow {
  std::optional<double> from, to;
};

/// All of it, and the times that the tables of history.csv have; no more than those where they are fewer than two. Errors:
/// FileError; UsageError when the window shows nothing of the run.
[[nodiscard]] PlottedRun read_plotted_run(const TableFolder& tables, const RunFacts& facts,
                                          const PlotWindow& window);
/// The same run from its first event to its last, with some air. Nothing where that is no short part of it.
[[nodiscard]] std::optional<PlottedRun> closer(const TableFolder& tables, const PlottedRun& run);
/// What lays it over others: times, forces and ranges. t_end: that of the longest.
[[nodiscard]] PlottedRun read_compared(const TableFolder& tables, const RunFacts& facts, double t_end);

/// A word or a phrase of pictures in the run's language.
[[nodiscard]] std::string say(const PlottedRun& run, std::string_view english);
/// The same with its numbers and names put in, each by "{}".
template <class... Parts>
[[nodiscard]] std::string say(const PlottedRun& run, std::string_view english, const Parts&... parts) {
  return fmt::format(fmt::runtime(say(run, english)), parts...);
}

}  // namespace signorini
