#include "base/files.hpp"

#include <fmt/core.h>
#include <fstream>
#include <system_error>

#include "signorini/error.hpp"

namespace signorini::base {

namespace fs = std::filesystem;

std::string input_file_error(const fs::path& path) {
  std::error_code ignored;
  const fs::file_status status = fs::status(path, ignored);
  if (!fs::exists(status) || fs::is_regular_file(status)) return "";
  if (fs::is_directory(status)) return "is a directory";
  if (fs::is_fifo(status)) return "is a pipe";
  if (fs::is_socket(status)) return "is a socket";
  return "is a device";
}

std::string system_error_text(int error) {
  return error == 0 ? "" : ": " + std::generic_category().message(error);
}

namespace fs = std::filesystem;

void check_output_directory(const fs::path& path, const ResultsKind& kind, bool replace) {
  std::error_code error;
  const fs::file_status status = fs::symlink_status(path, error);
  if (!fs::exists(status)) {
    if (error && error != std::errc::no_such_file_or_directory)
      throw FileError(path.string(), "cannot be accessed: " + error.message());
    return;
  }
  if (!fs::is_directory(path, error)) throw FileError(path.string(), "exists and is not a directory");
  const bool empty = fs::is_empty(path, error);
  if (error) throw FileError(path.string(), "cannot be read: " + error.message());
  if (empty) return;
  if (!replace)
    throw FileError(path.string(),
                    fmt::format("directory exists and is not empty; use --force to replace the {} in it",
                                kind.description));
  if (!fs::exists(path / kind.marker, error))
    throw FileError(
        path.string(),
        fmt::format("is not empty, and --force replaces only a {} (found no {}); choose another directory",
                    kind.description, kind.marker));
}

void check_output_file(const fs::path& path, const std::string& what, std::string_view mark) {
  constexpr std::size_t first_bytes = 1024;
  std::error_code error;
  if (!fs::is_regular_file(path, error) || fs::is_empty(path, error)) return;
  std::string begin(first_bytes, '\0');
  std::ifstream file(path, std::ios::binary);
  file.read(begin.data(), first_bytes);
  begin.resize(static_cast<std::size_t>(file.gcount()));
  if (begin.find(mark) == std::string::npos)
    throw FileError(
        path.string(),
        fmt::format(
            "already exists and is not a {}, so it is not replaced; give another name, or remove the file",
            what));
}

fs::path make_directory(const fs::path& path) {
  fs::path first;
  std::error_code error;
  for (fs::path p = fs::absolute(path).lexically_normal(); !fs::exists(p, error) && p != p.parent_path();
       p = p.parent_path())
    if (!p.filename().empty()) first = p;
  fs::create_directories(path, error);
  if (error) throw FileError(path.string(), "cannot be created: " + error.message());
  return first;
}

void remove_created_directories(const fs::path& path, const fs::path& first) {
  if (first.empty()) return;
  std::error_code error;
  fs::path p = fs::absolute(path).lexically_normal();
  if (p.filename().empty()) p = p.parent_path();
  for (;; p = p.parent_path()) {
    fs::remove(p, error);
    if (error || p == first) return;
  }
}

std::string file_name(std::string_view text, std::size_t most, std::string_view kept, char other) {
  std::string name(text.substr(0, most));
  for (char& c : name) {
    const bool plain = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
                       kept.find(c) != std::string_view::npos;
    if (!plain) c = other;
  }
  return name;
}

}  // namespace signorini::base
