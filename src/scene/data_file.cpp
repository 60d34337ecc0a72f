#include "scene/data_file.hpp"

#include <fmt/core.h>

#include <cerrno>
#include <cstring>

#include "base/files.hpp"

namespace signorini::scene {

bool read_line(std::istream& in, std::string& line) {
  line.clear();
  char c = 0;
  while (in.get(c) && c != '\n') {
    line += c;
    if (line.size() > max_line_length) return true;
  }
  return in || !line.empty();
}

void refuse_file(const Table& table, std::string_view key, const FileError& error) {
  const SourcePlace place = table.place(key);
  const std::string where =
      place.line > 0 ? fmt::format("{}:{}:{}", place.file, place.line, place.column) : place.file;
  throw FileError(where, fmt::format("{}: {}", table.path(key), error.what()));
}

void refuse_file(const Table& table, std::string_view key, const std::filesystem::path& path,
                 const std::string& why) {
  refuse_file(table, key, FileError(path.string(), why));
}

std::ifstream open_data_file(const Table& table, std::string_view key, const std::filesystem::path& path) {
  // The system would end the name at NUL, and open another file.
  if (path.native().find('\0') != std::string::npos)
    table.wrong(key, "the name of a file, which has no character NUL");
  if (const std::string why = base::input_file_error(path); !why.empty())
    refuse_file(table, key, path, why + ", expected a file");
  errno = 0;
  std::ifstream in(path);
  if (!in) refuse_file(table, key, path, std::strerror(errno ? errno : EIO));
  return in;
}

}  // namespace signorini::scene
