// table_rows.hpp: contacts.csv and motion.csv before the witness.
//
//   state of a row = that after the last instant;   guards of the state;   N = kn g,  T = kt (ut - p) or -s fk N
//   ratio = |T| / |N| where there is friction, the contact is closed and N is not 0
//   contacts.csv: every contact has a row at every time;   peaks of summary.json >= rows up to the last instant of a run that stopped
//
//   TableRows rows(model, engine, witness);
//   for each instant: rows.instant(record);
//   rows.check(directory / "contacts.csv", true, found);
#pragma once

#include <filesystem>
#include <functional>
#include <vector>

#include "run/witnessed_motion.hpp"
#include "study/witness/told_run.hpp"

namespace signorini {

class CsvReader;

class TableRows {
 public:
  using Found = std::function<void(Violation)>;

  /// All must outlive it. stopped: the run ended before t_end, by itself.
  TableRows(const Model& model, const WitnessedEngine& engine, const Witness& witness, bool stopped);
  /// In the order of time.
  void instant(const InstantRow& row, const InstantRecord& record);
  /// complete: all contacts have a row at each time. Returns how many rows there were. Errors: FileError.
  long check(const std::filesystem::path& file, bool complete, const Found& found);
  /// Of the rows that were checked, and of the instants.
  void check_peaks(const std::vector<std::optional<Peak>>& told, const Found& found) const;

 private:
  struct Row {
    double t = 0.0;
    std::size_t contact = 0;
    std::string state;
    std::optional<double> gap, ratio;
    double ut = 0.0, vt = 0.0, slip = 0.0, N = 0.0, T = 0.0;
  };
  struct States {
    double t = 0.0, resolution = 0.0;
    std::vector<ContactState> before, after;
  };
  /// Sizes of terms over the whole run.
  struct Size {
    double place = 0.0, speed = 0.0, force = 0.0, gap_at_start = 0.0, ut_at_start = 0.0;
  };
  [[nodiscard]] std::vector<ContactState> states_at(std::size_t contact, double t) const;
  void check(const Row& row, const char* file, const Found& found);
  [[nodiscard]] std::vector<Violation> broken_by(const Row& row, const ContactState& state,
                                                 const char* file) const;
  void check_forces(const Row& row, const ContactState& state, const char* file, const Found& found) const;
  void check_ratio(const Row& row, const char* file, const Found& found) const;
  void reach(const Row& row);

  const Model& model_;
  const WitnessedEngine& engine_;
  const Witness& witness_;
  bool stopped_;
  std::vector<States> states_;
  std::vector<Size> sizes_;
  std::vector<Peak> peaks_;
};

}  // namespace signorini
