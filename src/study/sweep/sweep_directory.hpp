// sweep_directory.hpp: a sweep on disk, which can be stopped, resumed, divided into shares and merged.
//
//   DIR/sweep.json        specification of the sweep; a sweep is resumed only with an equal specification
//   DIR/rows.jsonl        the finished rows in the order of completion (row_file.hpp)
//   DIR/sweep.csv         the table of the finished rows, updated during the sweep
//   DIR/results.json      the table as JSON, written at the end
//   DIR/strobe.csv        the points of a stroboscopic sweep, written at the end (sweep_table.hpp)
//   DIR/runs/000001/      the runs, with --keep
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "result/run_directory.hpp"
#include "study/sweep/parameter_range.hpp"
#include "study/sweep/row_file.hpp"
#include "study/sweep/sweep_row.hpp"

namespace signorini::sweep {

/// Points that a stroboscopic sweep records in every run; `text` is empty for other sweeps.
struct StroboscopicSpec {
  std::string text;              ///< value of --strobe
  double period = 0.0;           ///< time between points; 0: points are after events
  std::optional<double> settle;  ///< value of --settle
  std::vector<StroboscopicColumn> columns = {};
};

/// Option --carry: along the last range each run begins with the final state of the previous run.
struct CarrySpec {
  bool on = false;
  bool back = false;  ///< the last range contains its values twice, the second time in the opposite order
  friend bool operator==(const CarrySpec&, const CarrySpec&) = default;
};

/// Specification of a sweep. Two sweeps are the same if their specifications are equal apart from scene and share.
struct SweepSpec {
  std::string scene;  ///< scene file, as given by the user
  /// Fingerprint of the scene's content, with settings and the first valid values of the varied keys.
  std::string fingerprint;
  std::vector<std::string> settings;  ///< values of --set, in their order
  std::vector<ParameterRange> vary;   ///< varied keys; sampled keys are last
  /// Queries for every run (response_query.hpp), and the unit of each result.
  std::vector<std::string> responses, response_units;
  StroboscopicSpec strobe;
  CarrySpec carry;
  std::string sampling;  ///< "1000 random, seed 1"; empty if nothing is sampled
  Share share;
  std::string title;
  Units units;
};

/// Directory of a sweep. Errors of all members: FileError.
class SweepDirectory {
 public:
  /// Opens a new directory, or the directory of a sweep with the same specification; with `force` an existing sweep
  /// is removed first. No other process can open the directory while this object, or a process that inherited
  /// the object, exists.
  SweepDirectory(std::filesystem::path path, SweepSpec spec, bool force);
  ~SweepDirectory() = default;
  SweepDirectory(const SweepDirectory&) = delete;
  SweepDirectory& operator=(const SweepDirectory&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] const SweepSpec& spec() const { return spec_; }
  /// Values of the varied keys, one entry per row of the whole sweep.
  [[nodiscard]] const std::vector<std::vector<Override>>& points() const { return points_; }
  /// Finished rows by index.
  [[nodiscard]] const std::map<std::size_t, SweepRow>& rows() const { return rows_; }
  [[nodiscard]] std::filesystem::path run_directory(std::size_t index) const;

  /// Rows of a file that belongs to this sweep or to one of its shares, without crashed rows. Errors: FileError,
  /// also if a row is altered or does not belong to this sweep.
  [[nodiscard]] std::map<std::size_t, NumberedRow> rows_in(const std::filesystem::path& file) const;
  /// Appends a row, or lines of row_line(), to the file and to rows().
  void add(const SweepRow& row);
  void add(const std::string& lines);
  /// Writes sweep.csv.
  void write_table() const;
  /// Writes results.json, at the end.
  void write_results() const;

 private:
  std::filesystem::path path_;
  SweepSpec spec_;
  std::vector<std::vector<Override>> points_;
  std::map<std::size_t, SweepRow> rows_;
  result::DirectoryLock lock_;
  std::optional<RowFile> file_;
};

/// Reads DIR/sweep.json. Errors: FileError if there is no sweep.
[[nodiscard]] SweepSpec read_sweep_spec(const std::filesystem::path& directory);
/// Text of the first difference, "--vary was a=0:1:0.1, is a=0:1:0.2"; empty if the specifications are equal
/// apart from scene and share.
[[nodiscard]] std::string difference(const SweepSpec& was, const SweepSpec& is);

/// Copies the rows of several shares into one directory; returns the indices, from 0, of rows that no share
/// has. Errors: FileError; also if the sweeps are not the same, or if two shares contradict each other.
std::vector<std::size_t> merge_sweeps(const std::vector<std::filesystem::path>& from, SweepDirectory& to);

}  // namespace signorini::sweep
