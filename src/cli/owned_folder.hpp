// owned_folder.hpp: a directory of results that a command may replace, because the command created it.
//
//   DIR/MARKER        written first, so that --force can replace the remains of a killed command
//   DIR/FILES...      removed by --force; other files stay
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

/// Errors: FileError unless the folder is absent, empty or, with `force`, one of ours; then also if the scene lies in
/// it and could be lost; `scene`: empty if there is none.
void check_folder(const std::filesystem::path& path, const OwnedFolder& folder, bool force,
                  const std::string& scene);
/// Creates the folder, removes our files and writes the marker. Errors: FileError.
void begin_folder(const std::filesystem::path& path, const OwnedFolder& folder);
/// Reverses begin_folder(), and removes DIR/plots if it is empty. If other files remain, the marker stays.
void leave_folder(const std::filesystem::path& path, const OwnedFolder& folder);

}  // namespace signorini::cli
