// prepared_run.hpp: a scene with overrides, ready to run; and its run, in memory or on disk.
//
//   file + overrides -read-> Scene -cutoff of [reduction] tolerance-> Scene -build-> Model
//   in memory: run.ends(recorder), or simulate(run.model, run.scene.run, recorder)
//   on disk:   RunDirectory directory(...);  ForwardingRecorder watch(&directory);  run.keep(directory, watch)
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "result/run_directory.hpp"
#include "run/forwarding_recorder.hpp"
#include "signorini/certify.hpp"
#include "signorini/model.hpp"
#include "signorini/scene.hpp"

namespace signorini::study {

/// A run that has been written to disk.
struct StoredRun {
  CertifiedReport certified;
  std::string summary;  ///< text of summary.json
};

struct PreparedRun {
  Scene scene;  ///< with the cutoff that was found for a tolerance
  Model model;

  /// Runs in memory, with output rows at both ends only. Errors: SceneError for scenes that the engine refuses.
  Report run_in_memory(Recorder& recorder) const;
  /// Into `directory`, to which `watch` passes all on; certified where options are given. If a file cannot be
  /// written, summary.json has the time that the run reached. Errors: those of ends(); FileError.
  StoredRun run_to_disk(result::RunDirectory& directory, run::ForwardingRecorder& watch,
                        const std::optional<CertifyOptions>& certified = std::nullopt) const;
};

/// go_on: same as in find_cutoff. Errors: those of read_scene, find_cutoff and build_model.
[[nodiscard]] PreparedRun prepare_run(
    const std::string& file, const std::vector<Override>& changes,
    const std::function<bool()>& go_on = [] { return true; });
/// One of several runs that are compared, with the cutoff `found` for the first one.
[[nodiscard]] PreparedRun prepare_run(Scene scene, const std::optional<ReductionSpec>& found);
/// The same run with output rows at both ends only.
[[nodiscard]] RunSpec without_rows(RunSpec run);

// Picture data of a run that was computed without them (run --no-plots).
//
//   run.toml -> the same run once more -> motion.csv, curves.csv, body_motion.csv
//
// Runs are bitwise reproducible, so the repeated events must equal those of events.csv. If they differ, nothing is
// written: files that run.toml refers to (records, the continued run) or the program have changed.

/// A run of this version that ended by itself and has neither table, or none that its manifest lists: one that was not
/// written to its end.
[[nodiscard]] bool lacks_picture_rows(const std::filesystem::path& directory);

/// Computes them and adds them to the manifest; go_on: asked often, false leaves everything as it was. Returns whether they
/// were written. Errors: those of prepare_run; FileError for events that differ.
bool add_picture_rows(const std::filesystem::path& directory, const std::function<bool()>& go_on);

}  // namespace signorini::study
