// prepared_run.hpp: a scene with overrides, ready to run; and its run, in memory or on disk.
//
//   file + overrides -read-> Scene -cutoff of [reduction] tolerance-> Scene -build-> Model
//   in memory: run.run_in_memory(recorder), or simulate(run.model, run.scene.run, recorder)
//   on disk:   RunDirectory directory(...);  ForwardingRecorder watch(&directory);
//              run.run_to_disk(directory, watch)
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
  Scene scene;  ///< with the cutoff found for [reduction] tolerance
  Model model;

  /// Runs in memory, with output rows at both ends only. Errors: SceneError for scenes that the engine refuses.
  Report run_in_memory(Recorder& recorder) const;
  /// Runs and stores the results in `directory`; `watch` must forward all data to the directory. The run is
  /// certified if `certified` has a value. If a file cannot be written, summary.json records the time that
  /// the run reached. Errors: those of run_in_memory(); FileError.
  StoredRun run_to_disk(result::RunDirectory& directory, run::ForwardingRecorder& watch,
                        const std::optional<CertifyOptions>& certified = std::nullopt) const;
};

/// Reads a scene with these changes, finds its cutoff and builds its model. go_on: called often during the search for the
/// cutoff; if it returns false, the search ends.
/// Errors: those of read_scene, find_cutoff and build_model.
[[nodiscard]] PreparedRun prepare_run(
    const std::string& file, const std::vector<Override>& changes,
    const std::function<bool()>& go_on = [] { return true; });
/// Prepares one of several runs that are compared. found: the cutoff of the first run, which all runs use.
[[nodiscard]] PreparedRun prepare_run(Scene scene, const std::optional<ReductionSpec>& found);
/// Copy of `run` with output rows only at the beginning and the end of the run.
[[nodiscard]] RunSpec without_rows(RunSpec run);

// Picture data of a run that was computed with --no-plots.
//
//   run.toml -> the same run once more -> motion.csv, curves.csv, body_motion.csv
//
// Runs are bitwise reproducible, so the events of the new run must equal events.csv. If they differ, the
// program or a file that run.toml refers to (a record, the continued run) has changed, and no file is written.

/// True if the stored run ended without an error of its files, was computed by this version of the program, and has
/// neither motion.csv nor curves.csv. A table that the manifest does not list is incomplete and is regarded as absent.
[[nodiscard]] bool lacks_picture_rows(const std::filesystem::path& directory);

/// Computes the picture data and adds them to the manifest; returns true if they were written. go_on: called
/// often; if it returns false, the computation ends and no file is changed. Errors: those of prepare_run;
/// FileError if events differ.
bool add_picture_rows(const std::filesystem::path& directory, const std::function<bool()>& go_on);

}  // namespace signorini::study
