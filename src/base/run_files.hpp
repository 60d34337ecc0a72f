// run_files.hpp: the files in a run's directory, and the manifest, by which readers detect incomplete and changed files.
//
//   DIR/manifest.json   {"signorini": "0.9.0", "outcome": "done",
//                        "files": [{"file": "events.csv", "size": 5120, "checksum": "9d0c5f1e2a7b4c38"}, ...]}
//
//   size: bytes;  checksum: Fingerprint of all bytes (base/text.hpp);  files: the existing files, in the order of result_files
//
// A run removes the manifest before it changes any other file, and writes the manifest after all other files. So a killed run
// has no manifest. Pictures and pages are drawn from files of the manifest and are not listed in it.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace signorini::base {

inline constexpr const char* manifest_file = "manifest.json";

/// All result files of a run.
inline constexpr std::array<std::string_view, 21> result_files = {
    "events.csv", "history.csv",   "errors.csv",         "seams.csv",        "contacts.csv",
    "motion.csv", "response.csv",  "energy.csv",         "curves.csv",       "body_motion.csv",
    "loads.csv",  "frames.csv",    "frame_contacts.csv", "frame_bodies.csv", "frame_seams.csv",
    "states.csv", "geometric.csv", "instants.csv",       "orbit.json",       "summary.json",
    "run.toml"};
/// Files from which pictures are drawn. A run may omit them; they can be added later.
inline constexpr std::array<std::string_view, 3> picture_rows = {"motion.csv", "curves.csv",
                                                                 "body_motion.csv"};

struct ManifestEntry {
  std::string file;
  std::uintmax_t size = 0;
  std::string checksum;
};

struct Manifest {
  std::string program, outcome;  ///< program: version of Signorini; outcome: done, stopped or interrupted
  std::vector<ManifestEntry> files;

  /// Entry of a file; nullptr: the file is not listed.
  [[nodiscard]] const ManifestEntry* find(std::string_view file) const;
  void remove(std::string_view file);
  /// Records the present size and checksum of the file; removes its entry if the file does not exist. Errors: FileError.
  void add(const std::filesystem::path& directory, std::string_view file);
  /// Text of manifest.json.
  [[nodiscard]] std::string text() const;
};

/// Manifest with all result files that exist. Errors: FileError.
[[nodiscard]] Manifest manifest_of(const std::filesystem::path& directory, const std::string& outcome);
/// Reads DIR/manifest.json; nullopt if the file is missing. Errors: FileError.
[[nodiscard]] std::optional<Manifest> read_manifest(const std::filesystem::path& directory);
/// Removes the manifest. Must be called before any file in the directory is changed. Errors: FileError.
void remove_manifest(const std::filesystem::path& directory);

/// Checks that the files are regular files and, if there is a manifest, that they are listed in it and have the listed size and
/// checksum. Without names, checks all files that a run writes. Errors: FileError with the name of the file.
void check_run_files(const std::filesystem::path& directory);
void check_run_files(const std::filesystem::path& directory, const std::vector<std::string_view>& names);
/// Reason why the files cannot be checked: there is no manifest; mentions an incomplete last line of states.csv. Empty: there
/// is a manifest.
[[nodiscard]] std::string unchecked_reason(const std::filesystem::path& directory);

}  // namespace signorini::base
