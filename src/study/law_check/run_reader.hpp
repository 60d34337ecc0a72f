// run_reader.hpp: results in summary.json and events.csv of a run, for the law checker.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "result/csv.hpp"
#include "signorini/result.hpp"

namespace signorini::result {
class CsvReader;
}  // namespace signorini::result

namespace signorini::directory_check {

struct RecordedSummary {
  Engine engine = Engine::automatic;
  std::string flow;      ///< flow of the engine exact: "modal" or "taylor"
  bool ended = true;     ///< false: the run is still being written, or was killed
  bool stopped = false;  ///< true: the run stopped before t_end
  double t = 0.0;        ///< time that the run reached
  long total = 0;        ///< number of events
  std::map<std::string, long> events_by_type;
  /// Extremes of a contact's forces over the run; absent in the summary of an older version.
  struct Load {
    double least_N = 0.0, greatest_N = 0.0, least_T = 0.0, greatest_T = 0.0;
  };
  std::vector<std::optional<Load>> loads;
  std::vector<std::optional<Peak>> peaks;  ///< one per contact
};
/// Reads summary.json. Errors: FileError.
[[nodiscard]] RecordedSummary read_recorded_summary(const std::filesystem::path& directory,
                                                    const Model& model);

/// All rows of events.csv; a user-law state is read as its kind. ended: true if the run has ended; then a
/// last line without a line break is an error. Errors: FileError.
[[nodiscard]] std::vector<Event> read_recorded_events(const std::filesystem::path& directory,
                                                      const Model& model, bool ended);

/// Message for a table that ends too early. lacks: the missing part, for instance "a line break".
[[nodiscard]] std::string truncation_message(const result::CsvReader& reader, const std::string& lacks);

/// Finds the index of a contact by its name. Errors: FileError with file and line if the name is unknown.
class ContactNames {
 public:
  explicit ContactNames(const Model& model);
  [[nodiscard]] int at(const std::string& name, const std::filesystem::path& file, int line) const;

 private:
  std::map<std::string, int> places_;
};

// Reads the rows of contacts.csv and motion.csv.
//
//   RecordedRowReader reader(directory / "contacts.csv", model);
//   while (const auto row = reader.next()) ...
//
// Errors: FileError with line and column.

struct RecordedRow {
  double t = 0.0;
  std::size_t contact = 0;
  std::string state;
  std::optional<double> gap, ratio;
  double ut = 0.0, vt = 0.0, slip = 0.0, N = 0.0, T = 0.0;
};

class RecordedRowReader {
 public:
  RecordedRowReader(const std::filesystem::path& file, const Model& model);

  [[nodiscard]] std::optional<RecordedRow> next();
  /// True if the table has a column `ratio`, which tables of older versions lack.
  [[nodiscard]] bool has_ratios() const { return ratios_; }
  /// True if the last line has no line break. This line was not read as a row.
  [[nodiscard]] bool is_cut() const { return reader_.is_cut(); }
  /// Throws a FileError with the line at which the table ends too early. lacks: the missing part.
  [[noreturn]] void refuse_truncated(const std::string& lacks) const;

 private:
  [[nodiscard]] double number(std::size_t column) const;

  std::filesystem::path file_;
  ContactNames names_;
  result::CsvReader reader_;
  bool ratios_ = false;
};

}  // namespace signorini::directory_check
