// plot_parts.hpp: parts shared by the pictures of a run: rows of tables, bands for states, styles of events.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "result/picture.hpp"
#include "result/plotted_run.hpp"
#include "result/table.hpp"

namespace signorini::result {

// Axes of nearly constant curves.
//
//   range of a curve from least to greatest, m its middle, s the largest length or force of the run:
//   within 1e3 eps s of 0 rounding:   axis 0 +- 1e-3 s, a flat line
//   narrower than 2e-4 m  constant:   axis m (1 +- 0.01)
//   otherwise             gnuplot's automatic axis
//
// 1e3 eps: src/base/rounding.hpp. 2e-4: above it about ten tic labels with six digits are all different.
// 1e-3, 0.01: chosen values; the line looks flat, and tic labels have few digits.

struct ContactScales {
  double length = 0.0, force = 0.0;
};
/// Largest magnitudes of lengths and forces of all contacts.
[[nodiscard]] ContactScales scales_of(const std::vector<ContactRanges>& ranges);

/// "set yrange [a:b]" and a line break, or "" for gnuplot's automatic axis.
[[nodiscard]] std::string constant_axis(const Range& range, double scale);
/// True if all values of the range are rounding errors compared with `scale`.
[[nodiscard]] bool is_rounding(const Range& range, double scale);

/// gnuplot data source: rows of a table with one row per time, thinned to the resolution of a picture.
[[nodiscard]] std::string rows_over_time(const std::string& table, std::size_t times);

/// gnuplot data source: rows of contact k in motion.csv, if it has them, else in contacts.csv; both have the same
/// columns. run_directory: path from the folder of the scripts.
[[nodiscard]] std::string contact_rows(const PlottedRun& run, std::size_t k,
                                       const std::string& run_directory = "..");

/// Rows of a table for gnuplot, and the column numbers of time and value, from 1.
struct TableColumn {
  std::string rows;
  std::size_t time = 1, number = 0;
  [[nodiscard]] std::string columns() const { return fmt::format("{}:{}", time, number); }
};
/// gnuplot data source: the given rows of a table. table: file name in quotes.
[[nodiscard]] std::string table_rows(const std::string& table, const PlottedRun::Rows& rows);
/// A curve by name: its rows in curves.csv if they exist, `otherwise` if not.
[[nodiscard]] TableColumn curve_of(const PlottedRun& run, const std::string& name,
                                   const TableColumn& otherwise);

/// Height in pixels of one of `count` stacked rows: `usual`, or less if the picture would be too tall.
[[nodiscard]] double row_height(double usual, std::size_t count, const PictureStyle& look);
/// gnuplot command for contact names as tics, one per row; leaves out names that would overlap. height: pixels of a row.
[[nodiscard]] std::string row_tics(const std::vector<RunFacts::Contact>& contacts, double height);

/// Fill colour of a state, "#rrggbb".
[[nodiscard]] std::string state_colour(const std::string& state);
/// Text of states-CONTACT.csv: bands sorted by state.
[[nodiscard]] std::string band_table(std::vector<PlottedRun::Band> bands);
/// Bands of contact k in this state, from y = `low` to `high`; opacity 0..1. nullopt if the state never occurs.
[[nodiscard]] std::optional<Curve> band_curve(const PlottedRun& run, std::size_t k, const std::string& state,
                                              double low, double high, double opacity);
/// States in the order of legends.
[[nodiscard]] const std::vector<std::string>& state_names();
/// Bands that fill the panel (second y axis 0..1) with the states of contact k; `opacity` 0..1.
[[nodiscard]] std::vector<Curve> bands_of(const PlottedRun& run, std::size_t k, double opacity);
/// Legend entries of the states that occur.
[[nodiscard]] std::vector<Curve> band_legend(const PlottedRun& run, std::size_t k);

/// Event types shown in pictures, from the top of a contact's row to its bottom, with their colours
/// "#rrggbb".
struct EventStyle {
  EventType type;
  const char* colour;
};
inline constexpr std::array event_styles = {
    EventStyle{EventType::separation, "#2166ac"}, EventStyle{EventType::contact, "#17a2a2"},
    EventStyle{EventType::impact, "#c0182b"},     EventStyle{EventType::slip, "#e08214"},
    EventStyle{EventType::reversal, "#7b3294"},   EventStyle{EventType::stick, "#2e8b3d"},
};
static_assert(event_styles.size() + 1 == all_event_types.size(),
              "every type but the jump of a load has a colour");
/// Columns of marks.csv.
[[nodiscard]] const CsvTable<Mark>& mark_table();

// Pictures of a run; a picture without panels is not written.

/// Displacements of named nodes over time.
[[nodiscard]] Picture displacement_picture(const PlottedRun& run);
/// States, forces, gap and tangential motion of contact k over time.
[[nodiscard]] Picture contact_picture(const PlottedRun& run, std::size_t k);
/// Paths of contacts in the plane of -N and T, with their friction cones; without panels if there is no friction.
[[nodiscard]] Picture cone_picture(const PlottedRun& run);
/// The events of all contacts over time: one row per contact, and within it one line per event type.
[[nodiscard]] Picture raster_picture(const PlottedRun& run);
/// The states of all contacts over time, one row per contact.
[[nodiscard]] Picture states_picture(const PlottedRun& run);
/// Loads over time, and the base's acceleration.
[[nodiscard]] Picture loads_picture(const PlottedRun& run);
/// The outputs over time, one panel per unit.
[[nodiscard]] Picture response_picture(const PlottedRun& run);
/// Energies, works, losses and the balance over time.
[[nodiscard]] Picture energy_picture(const PlottedRun& run);

}  // namespace signorini::result
