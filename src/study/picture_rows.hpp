// picture_rows.hpp: picture data of a run that was computed without them (run --no-plots).
//
//   run.toml -> the same run once more -> motion.csv, curves.csv, body_motion.csv
//
// Runs are bitwise reproducible, so the repeated events must equal those of events.csv. If they differ, nothing is
// written: files that run.toml refers to (records, the continued run) or the program have changed.
#pragma once

#include <filesystem>
#include <functional>

namespace signorini {

/// A run of this version that ended by itself and has neither table, or none that its manifest lists: one that was not
/// written to its end.
[[nodiscard]] bool lacks_picture_rows(const std::filesystem::path& directory);

/// Computes them and adds them to the manifest; go_on: asked often, false leaves everything as it was. Returns whether they
/// were written. Errors: those of prepare_run; FileError for events that differ.
bool add_picture_rows(const std::filesystem::path& directory, const std::function<bool()>& go_on);

}  // namespace signorini
