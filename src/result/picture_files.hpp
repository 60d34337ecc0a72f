// picture_files.hpp: files of a set of pictures: gnuplot scripts, and tables that only the pictures need.
//
//   DIR/plots/NAME.gp, TABLE.csv
//
// When run in DIR/plots, each script writes pictures with its own name. PictureFiles does not start gnuplot.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "result/picture.hpp"

namespace signorini::result {

class PictureFiles {
 public:
  /// ours: selects the files of earlier pictures of this kind, which write() removes. Null: write() removes no file.
  explicit PictureFiles(bool (*ours)(const std::filesystem::path&) = nullptr) : ours_(ours) {}

  /// Adds a picture, unless it has no panels.
  void add(const PlottedRun& run, const Picture& picture);
  /// Adds a table; `text` includes the header.
  void add_table(const std::string& name, std::string text);
  /// Writes all files into DIR/plots; returns the paths of the scripts. Without scripts nothing changes. Errors: FileError.
  std::vector<std::filesystem::path> write(const std::filesystem::path& directory) const;

 private:
  struct File {
    std::string name, text;
  };
  bool (*ours_)(const std::filesystem::path&);
  std::vector<File> scripts_, tables_;
};

// Functions for the folder of pictures. They remove only files that the program has written.

/// True for a script or a picture: .gp, .svg, .png, .pdf.
[[nodiscard]] bool is_picture(const std::filesystem::path& file);

/// True for a ParaView frame (.vtu) or the list of frames (.pvd).
[[nodiscard]] bool is_paraview(const std::filesystem::path& file);

/// Removes the files selected by `ours`, and the folder if it is then empty; does nothing if there is no folder. Errors:
/// FileError.
void clear_plot_folder(const std::filesystem::path& folder, bool (*ours)(const std::filesystem::path&));

/// Creates the folder if there is none, and removes the files selected by `ours`. Errors: FileError.
void begin_plot_folder(const std::filesystem::path& folder, bool (*ours)(const std::filesystem::path&));

}  // namespace signorini::result
