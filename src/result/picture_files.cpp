#include "result/picture_files.hpp"

#include <string>
#include <utility>
#include <vector>

#include "base/files.hpp"
#include "result/csv.hpp"
#include "signorini/error.hpp"

namespace signorini::result {

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

bool is_picture(const fs::path& file) {
  const std::string type = file.extension().string();
  return type == ".gp" || type == ".svg" || type == ".png" || type == ".pdf";
}

bool is_paraview(const fs::path& file) { return file.extension() == ".vtu" || file.extension() == ".pvd"; }

void clear_plot_folder(const fs::path& folder, bool (*ours)(const fs::path&)) {
  std::error_code error;
  if (!fs::is_directory(fs::symlink_status(folder, error))) return;
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (ours(entry.path())) found.push_back(entry.path());
  for (const fs::path& file : found) {
    fs::remove(file, error);
    if (error) throw FileError(file.string(), "cannot be removed: " + error.message());
  }
  if (fs::is_empty(folder, error) && !error) fs::remove(folder, error);
}

void begin_plot_folder(const fs::path& folder, bool (*ours)(const fs::path&)) {
  base::make_directory(folder);
  clear_plot_folder(folder, ours);
  base::make_directory(folder);
}

}  // namespace signorini::result
