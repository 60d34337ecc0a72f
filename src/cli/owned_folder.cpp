#include "cli/owned_folder.hpp"

#include <fmt/core.h>

#include <system_error>

#include "result/csv.hpp"
#include "signorini/error.hpp"

namespace signorini::cli {

namespace fs = std::filesystem;

void check_folder(const fs::path& path, const OwnedFolder& folder, bool force) {
  std::error_code error;
  if (!fs::exists(fs::symlink_status(path, error))) return;
  if (!fs::is_directory(path, error)) throw FileError(path.string(), "is there already and is no directory");
  if (fs::is_empty(path, error)) return;
  if (!force)
    throw FileError(
        path.string(),
        fmt::format("is there already and not empty; --force replaces the {} in it", folder.what));
  if (!fs::exists(path / folder.marker, error))
    throw FileError(path.string(),
                    fmt::format("is not empty and holds no {} (no {}) that --force could replace",
                                folder.what, folder.marker));
}

void begin_folder(const fs::path& path, const OwnedFolder& folder, bool force) {
  check_folder(path, folder, force);
  std::error_code error;
  fs::create_directories(path, error);
  if (error) throw FileError(path.string(), "cannot be created: " + error.message());
  for (const std::string& name : folder.files) fs::remove(path / name, error);
  write_file(path / folder.marker, "{}\n");
}

void leave_folder(const fs::path& path, const OwnedFolder& folder) {
  std::error_code ignored;
  for (const fs::path& made : {path / folder.marker, path / "plots", path}) fs::remove(made, ignored);
}

}  // namespace signorini::cli
