// picture_rows.hpp: what pictures need of a run that was computed without it (run --no-plots).
//
//   run.toml -> the same run once more -> motion.csv, curves.csv, body_motion.csv
//
// A run repeats itself to the last bit, so its events are those of events.csv; where they are not, nothing is written: what
// run.toml reads (records, the run it goes on from) or the program is another by now.
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
