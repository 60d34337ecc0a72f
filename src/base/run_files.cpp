#include "base/run_files.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cerrno>
#include <fstream>
#include <memory>
#include <system_error>

#include "base/files.hpp"
#include "base/json.hpp"
#include "base/text.hpp"
#include "base/version.hpp"
#include "signorini/error.hpp"

namespace signorini::base {

namespace fs = std::filesystem;

namespace {

bool file_exists(const fs::path& path) {
  std::error_code ignored;
  return fs::exists(path, ignored);
}

void check_kind(const fs::path& path) {
  if (const std::string why = input_file_error(path); !why.empty())
    throw FileError(path.string(), why + ", expected a file of a run");
}

std::ifstream opened(const fs::path& path) {
  check_kind(path);
  errno = 0;
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw FileError(path.string(), "cannot be read" + system_error_text(errno));
  return stream;
}

/// True if the last line of the table has no line end, for example because the run was killed.
bool is_cut(const fs::path& table) {
  if (!input_file_error(table).empty()) return false;
  std::ifstream stream(table, std::ios::binary | std::ios::ate);
  if (!stream || stream.tellg() <= 0) return false;
  stream.seekg(-1, std::ios::end);
  return stream.get() != '\n';
}

ManifestEntry entry_of(const fs::path& directory, std::string_view file) {
  ManifestEntry entry{std::string(file), 0, ""};
  std::ifstream stream = opened(directory / file);
  std::streambuf& bytes = *stream.rdbuf();
  Fingerprint checksum;
  constexpr std::streamsize most = 1 << 18;
  const auto part = std::make_unique_for_overwrite<char[]>(most);
  try {
    for (std::streamsize n = bytes.sgetn(part.get(), most); n > 0; n = bytes.sgetn(part.get(), most)) {
      checksum.add({part.get(), static_cast<std::size_t>(n)});
      entry.size += static_cast<std::uintmax_t>(n);
    }
  } catch (const std::ios_base::failure& error) {  // read error of the disk
    throw FileError((directory / file).string(), std::string("cannot be read: ") + error.what());
  }
  entry.checksum = checksum.text();
  return entry;
}

[[noreturn]] void refuse(const fs::path& directory, std::string_view file, const std::string& found) {
  const std::string manifest = (directory / manifest_file).string();
  throw FileError((directory / file).string(),
                  fmt::format("{} as in {}; the file is damaged, or was changed or removed after the run. "
                              "Compute the run again, or delete {} if the change was intended",
                              found, manifest_file, manifest));
}

void check_file(const fs::path& directory, const Manifest& manifest, std::string_view file) {
  const fs::path path = directory / file;
  const ManifestEntry* expected = manifest.find(file);
  if (expected == nullptr) {
    if (!file_exists(path)) return;
    throw FileError(
        path.string(),
        fmt::format("found a file that {} does not list: the file does not belong to this "
                    "run, or is incomplete. Delete the file, or delete {} if the change was intended",
                    manifest_file, (directory / manifest_file).string()));
  }
  if (!file_exists(path))
    refuse(directory, file, fmt::format("not found, expected {} bytes", expected->size));
  std::error_code error;
  if (const std::uintmax_t size = fs::file_size(path, error); !error && size != expected->size)
    refuse(directory, file, fmt::format("found {} bytes, expected {}", size, expected->size));
  const ManifestEntry found = entry_of(directory, file);
  if (found.checksum != expected->checksum)
    refuse(directory, file,
           fmt::format("found checksum {}, expected {}", found.checksum, expected->checksum));
}

}  // namespace

const ManifestEntry* Manifest::find(std::string_view file) const {
  const auto found =
      std::find_if(files.begin(), files.end(), [&](const ManifestEntry& e) { return e.file == file; });
  return found == files.end() ? nullptr : &*found;
}

void Manifest::remove(std::string_view file) {
  std::erase_if(files, [&](const ManifestEntry& e) { return e.file == file; });
}

void Manifest::add(const fs::path& directory, std::string_view file) {
  remove(file);
  if (!file_exists(directory / file)) return;
  const auto rank = [](std::string_view name) {
    return std::find(result_files.begin(), result_files.end(), name) - result_files.begin();
  };
  const auto behind = std::find_if(files.begin(), files.end(),
                                   [&](const ManifestEntry& e) { return rank(e.file) > rank(file); });
  files.insert(behind, entry_of(directory, file));
}

std::string Manifest::text() const {
  Json json = {{"signorini", program}, {"outcome", outcome}, {"files", Json::array()}};
  for (const ManifestEntry& e : files)
    json["files"].push_back({{"file", e.file}, {"size", e.size}, {"checksum", e.checksum}});
  return json_text(json);
}

Manifest manifest_of(const fs::path& directory, const std::string& outcome) {
  Manifest manifest{version, outcome, {}};
  for (const std::string_view file : result_files) manifest.add(directory, file);
  return manifest;
}

std::optional<Manifest> read_manifest(const fs::path& directory) {
  const fs::path path = directory / manifest_file;
  if (!file_exists(path)) return std::nullopt;
  std::ifstream stream = opened(path);
  try {
    const Json json = parse_json(stream);
    Manifest manifest{json.at("signorini"), json.at("outcome"), {}};
    for (const Json& e : json.at("files")) {
      manifest.files.push_back({e.at("file"), e.at("size"), e.at("checksum")});
      const std::string& file = manifest.files.back().file;
      if (file.empty() || file.find('/') != std::string::npos)
        throw FileError(path.string(), "is not a manifest of a run: found the file name \"" + excerpt(file) +
                                           "\", expected a name without \"/\"");
    }
    return manifest;
  } catch (const Json::exception& error) {
    throw FileError(
        path.string(),
        std::string("is not a manifest of a run: ") + error.what() +
            "; compute the run again, or delete the manifest; the files of the run are then not checked");
  }
}

void remove_manifest(const fs::path& directory) {
  std::error_code error;
  fs::remove(directory / manifest_file, error);
  if (error) throw FileError((directory / manifest_file).string(), "cannot be removed: " + error.message());
}

void check_run_files(const fs::path& directory) {
  std::vector<std::string_view> names(result_files.begin(), result_files.end());
  const std::optional<Manifest> manifest = read_manifest(directory);
  if (manifest)
    for (const ManifestEntry& e : manifest->files)
      if (std::find(names.begin(), names.end(), e.file) == names.end()) names.push_back(e.file);
  check_run_files(directory, names);
}

void check_run_files(const fs::path& directory, const std::vector<std::string_view>& names) {
  for (const std::string_view name : names) check_kind(directory / name);
  const std::optional<Manifest> manifest = read_manifest(directory);
  if (!manifest) return;
  for (const std::string_view name : names) check_file(directory, *manifest, name);
}

std::string unchecked_reason(const fs::path& directory) {
  if (file_exists(directory / manifest_file)) return "";
  std::string why = fmt::format(
      "{}: {} is missing: the run may not have finished, or is of an earlier version; the files of the "
      "run are not checked",
      directory.string(), manifest_file);
  if (is_cut(directory / "states.csv"))
    why += ". The last line of states.csv has no line end, so its state is ignored";
  return why;
}

}  // namespace signorini::base
