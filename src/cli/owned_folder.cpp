#include "cli/owned_folder.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <system_error>

#include "base/output_directory.hpp"
#include "result/csv.hpp"
#include "signorini/error.hpp"

namespace signorini::cli {

namespace fs = std::filesystem;

namespace {

bool lies_in(const fs::path& folder, const fs::path& file) {
  std::error_code error;
  const fs::path outer = fs::weakly_canonical(folder, error), inner = fs::weakly_canonical(file, error);
  return std::mismatch(outer.begin(), outer.end(), inner.begin(), inner.end()).first == outer.end();
}

}  // namespace

void check_folder(const fs::path& path, const OwnedFolder& folder, bool force, const std::string& scene) {
  check_output_directory(path, {folder.what, folder.marker}, force);
  std::error_code error;
  const bool holds_results = fs::exists(path / folder.marker, error);
  if (holds_results && !scene.empty() && lies_in(path, scene))
    throw FileError(
        scene,
        fmt::format("lies in {}, where --force replaces files; move it, or name another -o", path.string()));
}

void begin_folder(const fs::path& path, const OwnedFolder& folder) {
  make_directory(path);
  std::error_code error;
  for (const std::string& name : folder.files) fs::remove(path / name, error);
  write_file(path / folder.marker, "{}\n");
}

void leave_folder(const fs::path& path, const OwnedFolder& folder) {
  std::error_code error;
  fs::remove(path / "plots", error);
  for (const auto& entry : fs::directory_iterator(path, error))
    if (entry.path().filename() != folder.marker) return;
  fs::remove(path / folder.marker, error);
  fs::remove(path, error);
}

}  // namespace signorini::cli
