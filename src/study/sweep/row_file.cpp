#include "study/sweep/row_file.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <system_error>
#include <utility>

#include "base/input_file.hpp"
#include "base/json.hpp"

namespace signorini {

namespace fs = std::filesystem;

namespace {

void check_kind(const fs::path& file) {
  std::error_code ignored;
  std::string why = why_no_input_file(file);
  if (fs::is_symlink(fs::symlink_status(file, ignored))) why = "is a link";
  if (!why.empty()) throw FileError(file.string(), why + ", expected the rows of a sweep");
}

/// Calls take(line, number) for each complete line; returns their total size.
template <class Take>
std::uintmax_t whole_lines(const fs::path& file, const Take& take) {
  check_kind(file);
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  std::error_code ignored;
  if (!stream && fs::exists(file, ignored)) throw FileError(file.string(), "cannot be read" + because(errno));
  std::uintmax_t bytes = 0;
  std::string line;
  for (std::size_t number = 1; std::getline(stream, line) && !stream.eof(); ++number) {
    take(line, number);
    bytes += line.size() + 1;
  }
  return bytes;
}

}  // namespace

std::map<std::size_t, NumberedRow> read_rows(const fs::path& file) {
  std::map<std::size_t, NumberedRow> rows;
  whole_lines(file, [&](const std::string& line, std::size_t number) {
    const auto wrong = [&](const std::string& what) {
      return FileError(file.string(), fmt::format("line {} {}", number, what));
    };
    try {
      if (!is_unaltered(line)) throw wrong("has been altered since it was written");
      SweepRow row = parse_row(line);
      const std::size_t index = row.index;
      rows[index] = {std::move(row), number};
    } catch (const Json::exception& error) {
      throw wrong(std::string("is not a row of a sweep: ") + error.what());
    }
  });
  return rows;
}

RowFile::RowFile(fs::path path)
    : path_(std::move(path)), good_(whole_lines(path_, [](const std::string&, std::size_t) {})) {
  file_ = open(path_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW, 0666);
  if (file_ < 0) throw FileError(path_.string(), "cannot be opened" + because(errno));
  if (ftruncate(file_, static_cast<off_t>(good_)) == 0) return;
  const int error = errno;
  close(file_);
  throw FileError(path_.string(), "cannot be cut to whole lines" + because(error));
}

RowFile::~RowFile() { close(file_); }

void RowFile::append(const std::string& lines) {
  errno = 0;
  std::size_t done = 0;
  while (done < lines.size()) {
    const ssize_t n = ::write(file_, lines.data() + done, lines.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) break;
    done += static_cast<std::size_t>(n);
  }
  if (done == lines.size()) {
    good_ += done;
    return;
  }
  const int error = errno;
  // If truncation fails, too, the next sweep truncates.
  [[maybe_unused]] const int ignored = ftruncate(file_, static_cast<off_t>(good_));
  throw FileError(path_.string(), "cannot be written" + because(error));
}

}  // namespace signorini
