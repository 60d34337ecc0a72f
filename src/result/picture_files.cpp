#include "result/picture_files.hpp"

#include <utility>

#include "result/csv.hpp"
#include "result/plot_folder.hpp"

namespace signorini {

namespace fs = std::filesystem;

void PictureFiles::add(const PlottedRun& run, const Picture& picture) {
  if (!picture.panels.empty()) scripts_.push_back({picture.name + ".gp", script_of(run, picture)});
}

void PictureFiles::add_table(const std::string& name, std::string text) {
  tables_.push_back({name + ".csv", std::move(text)});
}

std::vector<fs::path> PictureFiles::write(const fs::path& directory) const {
  std::vector<fs::path> written;
  if (scripts_.empty()) return written;
  const fs::path folder = directory / "plots";
  if (ours_ != nullptr) begin_plot_folder(folder, ours_);
  for (const auto* files : {&scripts_, &tables_})
    for (const File& file : *files) {
      if (files == &scripts_) written.push_back(folder / file.name);
      write_file(folder / file.name, file.text);
    }
  return written;
}

}  // namespace signorini
