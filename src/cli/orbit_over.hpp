// orbit_over.hpp: signorini orbit SCENE --over PATH=FROM:TO.
#pragma once

#include <filesystem>

#include "cli/settings.hpp"
#include "signorini/orbit.hpp"

namespace signorini::cli {

/// Parses PATH=FROM:TO. Errors: UsageError.
void read_over(const std::string& text, BranchOptions& options);

/// scene: the file; resume: continues the branch in the directory. Errors: those of follow(), FileError.
[[nodiscard]] ExitCode run_over(const std::string& scene, const SceneReader& read, BranchOptions over,
                                const std::filesystem::path& path, const OutputOptions& options, bool resume);

}  // namespace signorini::cli
