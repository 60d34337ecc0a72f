// owned_folder.hpp: a directory of results that a command may replace, because it is known to be its own.
//
//   DIR/MARKER        says so from the first moment on, so that --force can replace what a kill has left
//   DIR/FILES...      removed by --force; what else is there stays
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace signorini::cli {

struct OwnedFolder {
  std::string what;    ///< "comparison"
  std::string marker;  ///< "compare.json"
  std::vector<std::string> files;
};

/// Errors: FileError unless the folder is absent, empty or, with `force`, one of ours; then also if the scene
/// lies in it, which could be lost; `scene`: empty if there is none.
void check_folder(const std::filesystem::path& path, const OwnedFolder& folder, bool force,
                  const std::string& scene);
/// Creates it, removes our files and writes the marker. Errors: FileError.
void begin_folder(const std::filesystem::path& path, const OwnedFolder& folder);
/// Takes back what begin_folder() made, and DIR/plots if it is empty. Where more is left the marker stays.
void leave_folder(const std::filesystem::path& path, const OwnedFolder& folder);

}  // namespace signorini::cli
