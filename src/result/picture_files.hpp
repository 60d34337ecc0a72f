// picture_files.hpp: files of a set of pictures: scripts, and their tables in addition to those of the results.
//
//   DIR/plots/NAME.gp, TABLE.csv
//
// When run in DIR/plots, each script writes pictures with its own name. gnuplot is not started by this file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "result/picture.hpp"

namespace signorini::result {

class PictureFiles {
 public:
  /// ours: true for files of earlier pictures of this kind, which are replaced. Null: no file is replaced.
  explicit PictureFiles(bool (*ours)(const std::filesystem::path&) = nullptr) : ours_(ours) {}

  /// Adds a picture; one without panels is ignored.
  void add(const PlottedRun& run, const Picture& picture);
  /// Adds a table; `text` includes the header.
  void add_table(const std::string& name, std::string text);
  /// Writes into DIR/plots; returns the scripts, in their order. Without scripts nothing is changed. Errors: FileError.
  std::vector<std::filesystem::path> write(const std::filesystem::path& directory) const;

 private:
  struct File {
    std::string name, text;
  };
  bool (*ours_)(const std::filesystem::path&);
  std::vector<File> scripts_, tables_;
};

// The folder of pictures, from which only the program's own files are removed.

/// True for a script or a picture: .gp, .svg, .png.
[[nodiscard]] bool is_picture(const std::filesystem::path& file);

/// True for a ParaView frame or the list of frames.
[[nodiscard]] bool is_paraview(const std::filesystem::path& file);

/// Removes the files selected by `ours`, and the folder if it is empty then; does nothing without a folder. Errors:
/// FileError.
void clear_plot_folder(const std::filesystem::path& folder, bool (*ours)(const std::filesystem::path&));

/// Creates the folder, or removes our earlier files from it. Errors: FileError.
void begin_plot_folder(const std::filesystem::path& folder, bool (*ours)(const std::filesystem::path&));

}  // namespace signorini::result
