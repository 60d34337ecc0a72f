// sweep_row.hpp: one run of a sweep, as a row of its table.
//
//   SweepRow row = compute_row(
//       {.scene = "belt.toml", .changes = {{"run.rtol", "1e-9"}}, .index = 0, .values = {"1e-9"}});
//
// A run that cannot start or stops early also has a row, with its outcome and reason.
#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "signorini/scene.hpp"
#include "study/sweep/stroboscopic_map.hpp"

namespace signorini::sweep {

struct SweepRow {
  std::size_t index = 0;            ///< index of the row in the whole sweep, from 0
  std::vector<std::string> values;  ///< values of the varied keys
  std::string outcome;              ///< done, stopped, refused (no run began), crashed
  std::string reason;               ///< reason for another outcome than "done"
  double t = 0.0;                   ///< time that the run reached
  std::map<std::string, long> events;
  /// Peaks over all steps: tangential and normal motion relative to the start, |N|, |T|. friction: dissipated work.
  struct Contact {
    std::string name;
    double tangential = 0.0, normal = 0.0, N = 0.0, T = 0.0, friction = 0.0;
  };
  std::vector<Contact> contacts;
  /// One result per query of the sweep, NaN if the run has none; empty if no run began.
  std::vector<double> responses;
  std::vector<StroboscopicPoint> points;  ///< points of a stroboscopic sweep
  std::string sequence;    ///< hash of the events: equal for equal sequences (response_query.hpp)
  double wall_time = 0.0;  ///< in s
  long steps = 0;
  double balance = 0.0;  ///< relative error of the energy balance
  std::size_t warnings = 0;

  [[nodiscard]] bool ran() const { return outcome == "done" || outcome == "stopped"; }
  /// Number of events without jumps of the loads (type `time`).
  [[nodiscard]] long changes() const;
  /// Result of the i-th query; nullopt if the run has none.
  [[nodiscard]] std::optional<double> response(std::size_t i) const;
};

/// A figure of a contact, with its name in tables.
struct SweepFigure {
  const char* name;
  double SweepRow::Contact::*value;
};
inline constexpr std::array sweep_figures = {
    SweepFigure{"peak_t", &SweepRow::Contact::tangential},
    SweepFigure{"peak_n", &SweepRow::Contact::normal},
    SweepFigure{"peak_N", &SweepRow::Contact::N},
    SweepFigure{"peak_T", &SweepRow::Contact::T},
    SweepFigure{"friction_work", &SweepRow::Contact::friction},
};

struct RowTask {
  std::string scene;              ///< file name, for messages and to find data files in its folder
  std::string text;               ///< content of the file when the sweep began: all rows use the same scene
  std::vector<Override> changes;  ///< the sweep's settings, then the varied keys
  std::size_t index = 0;
  std::vector<std::string> values;
  std::filesystem::path keep;  ///< directory in which the run is stored; empty: only the row is kept
  std::vector<std::string> command_line;
  std::vector<std::string> responses = {};  ///< queries, as given
  std::string strobe = {};                  ///< value of --strobe; empty: no points
  std::optional<double> settle = {};        ///< earliest time of the first point; absent: half of t_end
};

/// Runs a task. Errors: FileError if files cannot be written.
[[nodiscard]] SweepRow compute_row(const RowTask& task);
/// Runs a task from the final state of the previous row, `carried`, if there is one. Afterwards `carried` is
/// the final state of this run; it is unchanged if this run does not reach its end.
[[nodiscard]] SweepRow compute_row(const RowTask& task, std::optional<SavedState>& carried);

/// The row as JSON, without checksum.
[[nodiscard]] std::string row_json(const SweepRow& row);
/// The row as a line of a file, with a checksum, which detects altered lines, and a line break.
[[nodiscard]] std::string row_line(const SweepRow& row);
/// True if the line (without its line break) is exactly as row_line() wrote it.
[[nodiscard]] bool is_unaltered(const std::string& line);
/// Parses a line of row_line(). Errors: Json::exception.
[[nodiscard]] SweepRow parse_row(const std::string& line);
/// True if the rows are equal except for their wall time.
[[nodiscard]] bool same_result(const SweepRow& a, const SweepRow& b);

}  // namespace signorini::sweep
