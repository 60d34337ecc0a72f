#include "result/plot_folder.hpp"

#include <string>
#include <vector>

#include "base/output_directory.hpp"
#include "signorini/error.hpp"

namespace signorini {

namespace fs = std::filesystem;

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
  make_directory(folder);
  clear_plot_folder(folder, ours);
  make_directory(folder);
}

}  // namespace signorini
