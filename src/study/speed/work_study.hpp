// work_study.hpp: speed against error on one scene.
//
//   WorkStudy study(request);  study.find_reference();
//   for (const WorkPoint& point : work_points(request.ranges)) study.add(point);
//   study.time_all(...);       // round by round, so that a slow minute of the machine meets all alike
//
// The reference is `exact`; where that follows modes, and its Taylor series is expected within the time limit, the
// series, which shares no flow with them; where `exact` refuses the scene or stops early, the tightest setting of
// `ida`, one decade on. What `exact` itself is known to is measured: the same run with all masses changed in their last
// digits. From where such a change decides the sequence of events on, nothing is compared. Rigid contacts
// without a capture_velocity get that of the scene's own tolerance in all runs: else every run would solve a
// problem of its own.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "base/machine.hpp"
#include "study/speed/frontier.hpp"
#include "study/speed/work_run.hpp"

namespace signorini {

struct WorkRequest {
  std::string scene;  ///< file
  /// Settings of the user for an engine, "" for what holds for all.
  std::function<std::vector<Override>(const std::string& engine)> settings;
  WorkRanges ranges;
  std::size_t repeats = 3;
  std::filesystem::path directory;
  WorkLimits limits;
};

/// What a study says (work_files.hpp).
struct WorkReport {
  std::string scene, title;
  Units units;
  Machine machine;
  double t_end = 0.0;
  std::size_t repeats = 0, unknowns = 0, contacts = 0;
  std::string reference;                    ///< name of the reference's run; empty if there is none
  double compared_until = 0.0;              ///< time up to which errors are taken
  std::map<std::string, ErrorRange> range;  ///< of quantities
  std::vector<std::string> notes;           ///< one sentence each
  std::vector<WorkRow> rows;
  bool interrupted = false;
};

class WorkStudy {
 public:
  /// The engine that is the reference; and the one that is where the first cannot be.
  static const std::array<Engine, 2> references;

  /// Reads the scene and builds its model. Errors: SceneError, UsageError, FileError.
  explicit WorkStudy(WorkRequest request);

  /// Where no engine computes the scene in ten times the time limit, runs have times and no errors. Errors:
  /// SceneError where none computes it at all; FileError.
  void find_reference();
  /// Records a run and compares it. A refusal is a row. Errors: FileError.
  const WorkRow& add(const WorkPoint& point);
  /// `before` is told each run's name. A row is repeated until it took ten seconds, at least once.
  void time_all(const std::function<void(const WorkRow&, std::size_t round)>& before);
  /// The series of `exact`, where they are the reference: a run beside those that were asked for.
  [[nodiscard]] const std::optional<WorkPoint>& series() const { return series_; }

  [[nodiscard]] const WorkReport& report() const { return report_; }

 private:
  /// A run that is on disk.
  struct Recorded {
    std::filesystem::path directory;
    bool too_slow = false;
  };
  [[nodiscard]] PreparedRun prepare(const WorkPoint& point) const;
  [[nodiscard]] double seconds_of(const WorkPoint& point) const;
  const Recorded& record(const WorkPoint& point, const WorkLimits& limits);
  bool choose_reference();
  [[nodiscard]] std::optional<WorkPoint> series_of_exact();
  bool try_reference(const WorkPoint& point, std::string& why_not);
  void doubt_reference(const WorkPoint& point);
  void take_ranges();
  void compare(WorkRow& row, const ComparedRun& run) const;

  WorkRequest request_;
  WorkReport report_;
  std::string fingerprint_;                 // of the scene as it was first read
  std::vector<Override> held_;              // capture velocities, the same in all runs
  std::optional<ReductionSpec> reduction_;  // with the cutoff of all runs
  std::map<std::string, Recorded> recorded_;
  ComparedRun reference_, again_;  // again_: `exact` with masses changed in their last digits
  bool doubted_ = false;
  std::optional<WorkPoint> series_;
};

}  // namespace signorini
