// table_rows.hpp: checks of contacts.csv and motion.csv by the law checker.
//
//   state    the state after the last instant; the guards of this state are satisfied
//   forces   N = kn g;  sticking: T = kt (ut - p);  slipping: T = -s fk N
//   ratio    |T| / |N|, only for a closed contact with friction and N != 0
//   peaks    in summary.json: no row exceeds them; in a stopped run, no row up to the last instant
//
//   TableRowChecker rows(model, engine, checker);
//   for each instant: rows.instant(record);
//   rows.contacts(directory / "contacts.csv", run, found);
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "run/run_law_checker.hpp"
#include "study/law_check/run_reader.hpp"

namespace signorini::directory_check {

// Rows that contacts.csv and motion.csv must have.
//
//   contacts.csv   every contact at each t of the grid in run.toml, up to t_end, the time of the stop, or
//                  the last instant
//   motion.csv     contact by contact, t ascending, the first row at 0; in a completed run the last row is
//                  at t_end
//
// Rows out of place are violations ("rows"). A table that ends too early is an error: FileError, with the
// line.

/// Time span of a run.
struct RunSpan {
  std::vector<double> grid;           ///< output times, up to t_end
  bool ended = true, stopped = true;  ///< ended: not still running; stopped: before t_end
  /// Time that the run reached, from summary.json; if the run has not ended, time of the last instant.
  double reached = 0.0;
};

class TableRowOrder {
 public:
  using Found = std::function<void(Violation)>;

  /// All arguments must outlive the object.
  TableRowOrder(const Model& model, const RunSpan& run, const Found& found)
      : model_(model), run_(run), found_(found) {}

  /// Checks the next row of contacts.csv.
  void grid_row(const RecordedRow& row);
  /// Checks that contacts.csv is complete.
  void end_of_grid(const RecordedRowReader& reader) const;
  /// Checks the next row of motion.csv.
  void block_row(const RecordedRow& row);
  /// Checks that motion.csv is complete.
  void end_of_blocks(const RecordedRowReader& reader) const;

 private:
  void misplaced(const char* file, double t, std::size_t contact);
  [[nodiscard]] static bool same(double a, double b);
  [[nodiscard]] bool is_complete_run() const { return run_.ended && !run_.stopped; }

  const Model& model_;
  const RunSpan& run_;
  const Found& found_;
  std::size_t place_ = 0, due_ = 0;  // expected next row: index in the grid, and contact
  bool in_order_ = true;
  std::optional<RecordedRow> last_;  // the previous row of motion.csv
};

class TableRowChecker {
 public:
  using Found = std::function<void(Violation)>;

  /// All arguments must outlive the object. stopped: true if the run stopped itself before t_end.
  TableRowChecker(const Model& model, const run::CheckedEngine& engine, const law_check::LawChecker& witness,
                  bool stopped);
  /// Stores the states on both sides of an instant. Instants must be passed in the order of time.
  void instant(const InstantRow& row, const law_check::InstantRecord& record);
  /// Each function checks all rows and the completeness of one table, contacts.csv or motion.csv, and returns
  /// the number of rows. Errors: FileError.
  long contacts(const std::filesystem::path& file, const RunSpan& run, const Found& found);
  long motion(const std::filesystem::path& file, const RunSpan& run, const Found& found);
  /// Checks that no checked row exceeds the recorded peaks.
  void check_peaks(const std::vector<std::optional<Peak>>& recorded, const Found& found) const;
  /// Checks that the recorded extremes of N and T agree with the checked rows and with the peaks.
  void check_loads(const std::vector<std::optional<RecordedSummary::Load>>& recorded,
                   const std::vector<std::optional<Peak>>& peaks, const Found& found) const;

 private:
  struct States {
    double t = 0.0, resolution = 0.0;
    std::vector<ContactState> before, after;
  };
  /// Largest magnitudes of a contact's terms over the whole run, which determine rounding limits; gap and ut
  /// at the start.
  struct Size {
    double place = 0.0, speed = 0.0, force = 0.0, gap_at_start = 0.0, ut_at_start = 0.0;
  };
  struct Order {  // checks of the order and of the end of a table
    void (TableRowOrder::*row)(const RecordedRow&);
    void (TableRowOrder::*end)(const RecordedRowReader&) const;
  };
  long read(const std::filesystem::path& file, const char* name, const Order& order, const RunSpan& run,
            const Found& found);
  [[nodiscard]] std::vector<ContactState> states_at(std::size_t contact, double t) const;
  void check(const RecordedRow& row, const RecordedRowReader& reader, const char* file, const Found& found);
  [[nodiscard]] std::vector<Violation> violations_of(const RecordedRow& row, const ContactState& state,
                                                     const char* file) const;
  void check_forces(const RecordedRow& row, const ContactState& state, const char* file,
                    const Found& found) const;
  void check_slip(const RecordedRow& row, const char* file, double of_force, const Found& found) const;
  void check_ratio(const RecordedRow& row, const char* file, const Found& found) const;
  void reach(const RecordedRow& row);
  [[nodiscard]] double length_limit_of(std::size_t k) const;
  [[nodiscard]] double force_limit_of(std::size_t k) const;

  const Model& model_;
  const run::CheckedEngine& engine_;
  const law_check::LawChecker& law_checker_;
  bool stopped_;
  std::vector<States> states_;
  std::vector<Size> sizes_;
  std::vector<Peak> peaks_;
  std::vector<RecordedSummary::Load> loads_;  // extremes over the checked rows
  std::vector<bool> reached_;                 // true if loads_ contains a row of the contact
};

}  // namespace signorini::directory_check
