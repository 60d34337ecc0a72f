// sweep_directory.hpp: a sweep on disk, that can be stopped, resumed, shared out and merged.
//
//   DIR/sweep.json        what is swept; a directory is continued only with the same
//   DIR/rows.jsonl        the finished rows as they came (row_file.hpp)
//   DIR/sweep.csv         the table of the finished rows, renewed as they come
//   DIR/results.json      the same as JSON, at the end
//   DIR/strobe.csv        the points of a stroboscopic sweep, at the end (strobe_files.hpp)
//   DIR/runs/000001/      the runs, with --keep
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "result/directory_lock.hpp"
#include "study/sweep/row_file.hpp"
#include "study/sweep/share.hpp"
#include "study/sweep/sweep_row.hpp"
#include "study/sweep/vary.hpp"

namespace signorini {

/// What a stroboscopic sweep takes of every run; text empty: nothing.
struct StrobeSpec {
  std::string text;              ///< --strobe
  double period = 0.0;           ///< 0: after events
  std::optional<double> settle;  ///< --settle
  std::vector<StrobeColumn> columns = {};
};

/// Runs along the last range that begin where the run before has ended.
struct CarrySpec {
  bool on = false;
  bool back = false;  ///< the values of the last range once more, in the opposite order: its second half
  friend bool operator==(const CarrySpec&, const CarrySpec&) = default;
};

/// What is swept. Two sweeps are the same if all but scene and share are equal.
struct SweepSpec {
  std::string scene;                  ///< file, as given
  std::string fingerprint;            ///< of the scene's content with settings and the first values that fit
  std::vector<std::string> settings;  ///< --set, in order
  std::vector<Vary> vary;             ///< the sampled keys last
  /// What is asked of every run (response_query.hpp), and the unit of each answer.
  std::vector<std::string> responses, response_units;
  StrobeSpec strobe;
  CarrySpec carry;
  std::string sampling;  ///< "1000 random, seed 1"; empty where nothing is sampled
  Share share;
  std::string title;
  Units units;
};

/// Errors of all members: FileError.
class SweepDirectory {
 public:
  /// Opens a new directory, or an earlier sweep of the same specification; with `force` an earlier sweep is
  /// removed first. Nobody else can open it before the object, and processes it was handed to, are gone.
  SweepDirectory(std::filesystem::path path, SweepSpec spec, bool force);
  ~SweepDirectory() = default;
  SweepDirectory(const SweepDirectory&) = delete;
  SweepDirectory& operator=(const SweepDirectory&) = delete;

  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  [[nodiscard]] const SweepSpec& spec() const { return spec_; }
  /// Values of the varied keys, one entry a row of the whole sweep.
  [[nodiscard]] const std::vector<std::vector<Override>>& points() const { return points_; }
  /// Finished rows by index.
  [[nodiscard]] const std::map<std::size_t, SweepRow>& rows() const { return rows_; }
  [[nodiscard]] std::filesystem::path run_directory(std::size_t index) const;

  /// The rows of another directory of this sweep, or of a share of it; those that crashed are left out. Errors: also where
  /// one is altered or is no row of this sweep.
  [[nodiscard]] std::map<std::size_t, NumberedRow> rows_in(const std::filesystem::path& file) const;
  /// Writes a row, or lines of row_line(), and takes them.
  void add(const SweepRow& row);
  void add(const std::string& lines);
  /// sweep.csv and, at the end, results.json.
  void write_table() const;
  void write_results() const;

 private:
  std::filesystem::path path_;
  SweepSpec spec_;
  std::vector<std::vector<Override>> points_;
  std::map<std::size_t, SweepRow> rows_;
  DirectoryLock lock_;
  std::optional<RowFile> file_;
};

/// DIR/sweep.json. Errors: FileError where there is no sweep.
[[nodiscard]] SweepSpec read_sweep_spec(const std::filesystem::path& directory);
/// "--vary was a=0:1:0.1, is a=0:1:0.2"; empty when they are the same but for scene and share.
[[nodiscard]] std::string difference(const SweepSpec& was, const SweepSpec& is);

/// Copies the rows of several shares into one directory; returns rows that none of them has (index from 0).
/// Errors: FileError; also where the sweeps are not the same, or two shares contradict each other.
std::vector<std::size_t> merge_sweeps(const std::vector<std::filesystem::path>& from, SweepDirectory& to);

}  // namespace signorini
