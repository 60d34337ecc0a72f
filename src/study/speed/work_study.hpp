// work_study.hpp: speed against error for one scene.
//
//   WorkStudy study(request);  study.find_reference();
//   for (const WorkPoint& point : work_points(request.ranges)) study.add(point);
//   study.time_all(...);       // round by round: temporary load affects all runs equally
//
// The reference is `exact`. If `exact` uses modes, and its Taylor series is expected to finish within the time
// limit, the reference is the series, which is independent of modes. If `exact` refuses the scene or stops
// early, the reference is `ida` with a tolerance one decade below the smallest. The error of `exact` is its
// difference from the same run with all masses changed in their last digits. If this change alters the sequence
// of events, times after the alteration are not compared. In all runs rigid contacts without a capture_velocity
// get the value that belongs to the scene's own tolerance; otherwise every run would solve a different problem.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/host_info.hpp"
#include "study/speed/pareto_front.hpp"
#include "study/speed/work_run.hpp"

namespace signorini::speed {

struct WorkRequest {
  std::string scene;  ///< file name
  /// Overrides that the user gives for an engine; for "", overrides for all engines.
  std::function<std::vector<Override>(const std::string& engine)> settings;
  WorkRanges ranges;
  std::size_t repeats = 3;
  std::filesystem::path directory;
  WorkLimits limits;
};

/// Results of a study (work_files.hpp).
struct WorkReport {
  std::string scene, title;
  Units units;
  base::HostInfo machine;
  double t_end = 0.0;
  std::size_t repeats = 0, unknowns = 0, contacts = 0;
  std::string reference;                    ///< name of the reference's run; empty if there is none
  double compared_until = 0.0;              ///< time up to which errors are evaluated
  std::map<std::string, ErrorRange> range;  ///< range of errors for each quantity
  std::vector<std::string> notes;           ///< one sentence each
  std::vector<WorkRow> rows;
  bool interrupted = false;
};

class WorkStudy {
 public:
  /// Engine of the reference, and the engine that replaces it if the first one cannot compute the scene.
  static const std::array<Engine, 2> references;

  /// Reads the scene and builds its model. Errors: SceneError, UsageError, FileError.
  explicit WorkStudy(WorkRequest request);

  /// Computes the reference. If no engine computes the scene within ten times the time limit, runs have times
  /// but no errors. Errors: SceneError if no engine computes the scene at all; FileError.
  void find_reference();
  /// Records a run, compares it with the reference and returns its row. A refused run also has a row. Errors:
  /// FileError.
  const WorkRow& add(const WorkPoint& point);
  /// Measures the times of all runs, in rounds. A run is repeated until its repetitions have taken ten
  /// seconds, at least once; `before` is called before each repetition.
  void time_all(const std::function<void(const WorkRow&, std::size_t round)>& before);
  /// The run of `exact` with its Taylor series, if this run is the reference.
  [[nodiscard]] const std::optional<WorkPoint>& series() const { return series_; }

  [[nodiscard]] const WorkReport& report() const { return report_; }

 private:
  /// A run on disk.
  struct Recorded {
    std::filesystem::path directory;
    bool too_slow = false;
  };
  [[nodiscard]] study::PreparedRun prepare(const WorkPoint& point) const;
  [[nodiscard]] double seconds_of(const WorkPoint& point) const;
  const Recorded& record(const WorkPoint& point, const WorkLimits& limits);
  bool choose_reference();
  [[nodiscard]] std::optional<WorkPoint> series_of_exact();
  bool try_reference(const WorkPoint& point, std::string& why_not);
  void measure_reference_error(const WorkPoint& point);
  void set_error_ranges();
  void compare(WorkRow& row, const compare::ComparedRun& run) const;

  WorkRequest request_;
  WorkReport report_;
  std::string fingerprint_;                   // fingerprint of the scene as first read
  std::vector<Override> capture_velocities_;  // capture velocities, the same in all runs
  std::optional<ReductionSpec> reduction_;    // reduction and its cutoff, the same in all runs
  std::map<std::string, Recorded> recorded_;
  // perturbed_reference_: `exact` with masses changed in their last digits
  compare::ComparedRun reference_, perturbed_reference_;
  bool reference_error_measured_ = false;
  std::optional<WorkPoint> series_;
};

}  // namespace signorini::speed
