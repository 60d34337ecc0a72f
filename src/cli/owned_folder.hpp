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

/// Errors: FileError unless the folder is absent, empty or, with `force`, one of ours.
void check_folder(const std::filesystem::path& path, const OwnedFolder& folder, bool force);
/// Checks, creates it, removes our files and writes the marker. Errors: FileError.
void begin_folder(const std::filesystem::path& path, const OwnedFolder& folder, bool force);
/// Takes back what begin_folder() made, and DIR/plots if it is empty; what else is there stays.
void leave_folder(const std::filesystem::path& path, const OwnedFolder& folder);

}  // namespace signorini::cli
