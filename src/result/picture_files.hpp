// picture_files.hpp: the files of a set of pictures: scripts, and tables that they read beside those of the results.
//
//   DIR/plots/NAME.gp, TABLE.csv
//
// Run in DIR/plots, each script writes pictures of its own name. Nothing here starts gnuplot.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "result/picture.hpp"

namespace signorini {

class PictureFiles {
 public:
  /// `ours`: which files in the folder earlier pictures of this kind have left; they are replaced. None: nothing is.
  explicit PictureFiles(bool (*ours)(const std::filesystem::path&) = nullptr) : ours_(ours) {}

  /// A picture without panels is none.
  void add(const PlottedRun& run, const Picture& picture);
  /// `text`: with its header.
  void add_table(const std::string& name, std::string text);
  /// Into DIR/plots; the scripts, in their order. Without any nothing is touched. Errors: FileError.
  std::vector<std::filesystem::path> write(const std::filesystem::path& directory) const;

 private:
  struct File {
    std::string name, text;
  };
  bool (*ours_)(const std::filesystem::path&);
  std::vector<File> scripts_, tables_;
};

}  // namespace signorini
