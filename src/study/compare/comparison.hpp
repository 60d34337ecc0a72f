// comparison.hpp: comparison of two runs of one scene.
//
//   Comparison c = compare_runs(read_run_figures("ida"), read_run_figures("exact"), settings);
//
// Events are aligned one by one (alignment.hpp). Tables are compared at the output times and in the columns that
// both runs have. Files are read as streams, because runs may be larger than memory. Units are those of the scene.
#pragma once

#include <filesystem>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "study/compare/alignment.hpp"
#include "study/compare/run_figures.hpp"

namespace signorini::compare {

/// Figures and events of a run.
struct ComparedRun {
  RunFigures figures;
  std::vector<LoggedEvent> events;
};

/// Reads a run after a check of all its files (base/run_files.hpp). name: the run's name in tables. Errors: FileError.
[[nodiscard]] ComparedRun read_compared_run(const std::filesystem::path& directory, const std::string& name);

struct ComparisonSettings {
  double instant = 0.0;                                    ///< AlignmentSettings::instant
  double t_end = std::numeric_limits<double>::infinity();  ///< later times are not compared
  /// Folder for differences over time (for pictures): motion-SLUG.csv, forces-SLUG.csv; empty: not written.
  std::filesystem::path folder;
  std::string slug;
};

struct Comparison {
  std::string name;    ///< name of the run that is compared with the reference
  double t_end = 0.0;  ///< end of the time that both runs cover
  Alignment alignment;
  Deviation event_time;
  Deviation displacement, rotation, velocity, angular_velocity;
  Deviation force;  ///< N and T of the contacts
  /// Difference of forces away from events: at output times without an event of either run between the
  /// previous and the next output time.
  Deviation force_away;
  Deviation energy;  ///< stored energies, dissipations and works, each separately
  std::vector<std::pair<std::string, Deviation>> columns;  ///< columns of history.csv; then NAME.N and NAME.T
  /// Differences of the response quantities that both runs have, at the times of rows that both runs have.
  struct Response {
    std::string name, unit;
    Deviation deviation;
  };
  std::vector<Response> response;
  std::size_t common_times = 0;
  /// Numbers of rows up to t_end; contacts.csv has one row per time and contact.
  struct Rows {
    RowCount history, contacts, energy, response;
  } rows;
  bool ends_differ = false;        ///< true if one of the runs continues beyond t_end
  std::vector<std::string> notes;  ///< parts that could not be compared, one sentence each
};

/// Compares `other` with `reference`. Errors: FileError, also if the folder in `settings` cannot be written.
[[nodiscard]] Comparison compare_runs(const ComparedRun& reference, const ComparedRun& other,
                                      const ComparisonSettings& settings = {});

}  // namespace signorini::compare
