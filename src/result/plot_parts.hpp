// plot_parts.hpp: what the pictures share: the run's facts, the look, and gnuplot's quoting.
//
// A script sets up, then draws once for each format; its panels share one time axis:
//
//   script = begin_script(run, "energy", panels) + panel(...) + "plot ..." + ... + end_script()
#pragma once

#include <fmt/format.h>

#include <array>
#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "result/csv_read.hpp"
#include "result/picture_look.hpp"
#include "result/plot_ranges.hpp"
#include "result/summary.hpp"
#include "result/table.hpp"

namespace signorini {

/// Pixels of a canvas above the panels, for title and subtitle, and below them, for the axis and its name.
inline constexpr double room_above = 62.0, room_below = 70.0;

/// A run as the pictures see it.
struct PlottedRun {
  RunFacts facts;
  std::vector<std::string> slugs;    ///< one a contact: its name made fit for a file name, unique
  std::vector<std::string> columns;  ///< of history.csv
  std::size_t times = 0;             ///< rows of history.csv
  double t_first = 0.0, t_last = 0.0;
  double from = 0.0, to = 0.0;  ///< the time shown
  std::string suffix;           ///< of the pictures' names
  PictureLook look;
  /// Intervals of constant state, one list a contact.
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
};

/// Pixels of a legend with these names, no longer than legend_name() makes them.
[[nodiscard]] double room_for(const std::vector<std::string>& names);
/// A name that is too long for a legend without its middle.
[[nodiscard]] std::string legend_name(const std::string& name);

/// A word or a phrase of pictures in the run's language.
[[nodiscard]] std::string say(const PlottedRun& run, std::string_view english);
/// The same with its numbers and names put in, each by "{}".
template <class... Parts>
[[nodiscard]] std::string say(const PlottedRun& run, std::string_view english, const Parts&... parts) {
  return fmt::format(fmt::runtime(say(run, english)), parts...);
}
/// 'text' for gnuplot: nothing in it is expanded. An apostrophe at its beginning becomes a typographic one.
[[nodiscard]] std::string quoted(const std::string& text);
/// The same as the label of a tick, where gnuplot reads % as the beginning of a format.
[[nodiscard]] std::string quoted_tick(const std::string& text);
/// " every ..." for rows of a table with `group` rows a time: thins out what no picture could show.
[[nodiscard]] std::string every(const PlottedRun& run, std::size_t group, std::size_t index);

/// The rows of a contact: of motion.csv, else of contacts.csv; both have the same columns. run_directory: as seen
/// from the folder of the scripts.
[[nodiscard]] std::string contact_rows(const PlottedRun& run, std::size_t k,
                                       const std::string& run_directory = "..");

/// Rows of a table for gnuplot, and the numbers of their columns of time and value, from 1.
struct TableColumn {
  std::string data;
  std::size_t time = 1, number = 0;
};
/// A curve by name: of curves.csv where it has it, else of `table`, where it is the number-th column.
[[nodiscard]] TableColumn curve_of(const PlottedRun& run, const std::string& table, const std::string& name,
                                   std::size_t number);

/// Lower and upper edge of a panel, as fractions of the picture's height.
struct PanelEdges {
  double bottom = 0.0, top = 1.0;
};
/// The i-th of `count` equal ones above each other; `space` between them in pixels.
[[nodiscard]] PanelEdges stacked(std::size_t i, std::size_t count, const Canvas& canvas, double space = 22.0);
/// Panels above each other, as high as these weights are to each other.
[[nodiscard]] std::vector<PanelEdges> stacked(const std::vector<double>& weights, const Canvas& canvas,
                                              double space = 22.0);

/// Pixels of a row where `count` stand above each other: less than usual where the picture would be taller than can be
/// drawn.
[[nodiscard]] double row_height(double usual, std::size_t count, const PictureLook& look);
/// Names of contacts beside rows of this height: as many as do not overlap.
[[nodiscard]] std::string row_ticks(const std::vector<RunFacts::Contact>& contacts, double height);

/// Size and headings of a picture.
struct Picture {
  std::string name;      ///< of its files
  std::string subtitle;  ///< below the run's title
  Canvas canvas;
  bool over_time = true;
};
[[nodiscard]] std::string begin_script(const PlottedRun& run, const Picture& picture);
[[nodiscard]] std::string end_script();

/// Axes of a panel; the last one carries the time axis.
[[nodiscard]] std::string panel(const PlottedRun& run, const Canvas& canvas, const PanelEdges& edges,
                                const std::string& label, bool last);
/// Fill colour of a state, "#rrggbb".
[[nodiscard]] std::string state_colour(const std::string& state);
/// states-CONTACT.csv.
[[nodiscard]] const CsvTable<PlottedRun::Band>& band_table();
/// For gnuplot: where a band of this state begins, and nothing for the other bands.
[[nodiscard]] std::string band_at(const std::string& state);
/// States in the order of legends.
[[nodiscard]] const std::vector<std::string>& state_names();
/// Plot elements that fill the panel (second y axis 0..1) with the states of contact k; `opacity` 0..1.
[[nodiscard]] std::vector<std::string> band_elements(const PlottedRun& run, std::size_t k, double opacity);
/// Legend entries of the states that occur.
[[nodiscard]] std::vector<std::string> band_legend(const PlottedRun& run, std::size_t k);
/// "plot a, b, c", a line each.
[[nodiscard]] std::string plot_command(const std::vector<std::string>& elements);

[[nodiscard]] std::string displacement_script(const PlottedRun& run);
[[nodiscard]] std::string contact_script(const PlottedRun& run, std::size_t k);
/// Where a contact is in the plane of -N and T, with its friction cone; empty without friction.
[[nodiscard]] std::string cone_script(const PlottedRun& run);
/// The events that pictures show, from the top of a lane to its bottom, with their colours "#rrggbb".
struct EventLook {
  EventType type;
  const char* colour;
};
inline constexpr std::array event_looks = {
    EventLook{EventType::separation, "#2166ac"}, EventLook{EventType::contact, "#17a2a2"},
    EventLook{EventType::impact, "#c0182b"},     EventLook{EventType::slip, "#e08214"},
    EventLook{EventType::reversal, "#7b3294"},   EventLook{EventType::stick, "#2e8b3d"},
};
static_assert(event_looks.size() + 1 == all_event_types.size(),
              "every type but the jump of a load has a colour");
/// The events of all contacts over time, a row a contact, a lane a type.
[[nodiscard]] std::string raster_script(const PlottedRun& run);
/// An event in marks.csv, for both: thinned to what a picture can resolve.
struct Mark {
  int row = -1;  ///< the contact's; -1: a jump of a load
  double t = 0.0;
  std::string event;
  double N = 0.0, T = 0.0;
};
[[nodiscard]] const CsvTable<Mark>& mark_table();
[[nodiscard]] std::vector<Mark> marks_of(const std::filesystem::path& directory, const PlottedRun& run);
/// The states of all contacts over time, a row a contact.
[[nodiscard]] std::string states_script(const PlottedRun& run);
/// Loads over time, and the base's acceleration; `columns`: of loads.csv. Empty when there are none.
[[nodiscard]] std::string loads_script(const PlottedRun& run, const std::vector<std::string>& columns);
/// The outputs over time, a panel a unit; `table`: response.csv. Empty when there are none.
[[nodiscard]] std::string response_script(const PlottedRun& run, const CsvReader& table);
/// `used`: the columns of energy.csv that are not zero throughout; `start`: the first balance.
[[nodiscard]] std::string energy_script(const PlottedRun& run, const std::set<std::string>& used,
                                        double start);

}  // namespace signorini
