#include "result/csv.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <system_error>

#include "base/number.hpp"
#include "signorini/error.hpp"

namespace signorini {

namespace {

std::string reason(int error) { return std::generic_category().message(error == 0 ? EIO : error); }

}  // namespace

void CsvBlock::separate() {
  if (row_begun_) text_ += ',';
  row_begun_ = true;
}

CsvBlock& CsvBlock::number(double value) {
  separate();
  text_ += shortest(value + 0.0);  // no negative zero
  return *this;
}

CsvBlock& CsvBlock::number(const std::optional<double>& value) { return value ? number(*value) : empty(); }

CsvBlock& CsvBlock::raw(std::string_view cells) {
  separate();
  text_ += cells;
  return *this;
}

CsvBlock& CsvBlock::text(std::string_view value) {
  separate();
  if (value.find_first_of(",\"\r\n") == std::string_view::npos) {
    text_ += value;
    return *this;
  }
  text_ += '"';
  for (const char c : value) {
    if (c == '"') text_ += '"';
    text_ += c;
  }
  text_ += '"';
  return *this;
}

CsvBlock& CsvBlock::empty() {
  separate();
  return *this;
}

void CsvBlock::end_row() {
  text_ += '\n';
  row_begun_ = false;
}

CsvFile::CsvFile(const std::filesystem::path& path) : path_(path) {
  errno = 0;
  file_.reset(std::fopen(path.c_str(), "wb"));
  if (!file_) throw FileError(path.string(), "cannot be created: " + reason(errno));
  std::setvbuf(file_.get(), nullptr, _IONBF, 0);  // one write per block
}

void CsvFile::write(CsvBlock& block) {
  const std::string& text = block.str();
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size()) fail();
  good_ += text.size();
  block.clear();
}

void CsvFile::fail() {
  const std::string why = reason(errno);
  file_.reset();
  std::error_code ignored;  // not every file can be truncated, and the message is more important
  std::filesystem::resize_file(path_, good_, ignored);
  throw FileError(path_.string(), "cannot be written: " + why);
}

void write_file(const std::filesystem::path& path, const std::string& text) {
  std::filesystem::path draft = path;
  draft += ".part";
  const auto create = [&] { return open(draft.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666); };
  int file = create();
  if (file < 0 && errno == EEXIST) {
    // A file there is a draft of a killed run, or a foreign link, which must not be followed.
    unlink(draft.c_str());
    file = create();
  }
  if (file < 0) throw FileError(path.string(), "cannot be created: " + reason(errno));
  errno = 0;
  std::size_t done = 0;
  while (done < text.size()) {
    const ssize_t n = ::write(file, text.data() + done, text.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) break;
    done += static_cast<std::size_t>(n);
  }
  int error = done == text.size() ? 0 : errno;
  if (close(file) != 0 && error == 0 && done == text.size()) error = errno;
  const bool written = done == text.size() && error == 0;
  if (written && std::rename(draft.c_str(), path.c_str()) == 0) return;
  if (written) error = errno;
  unlink(draft.c_str());
  throw FileError(path.string(), "cannot be written: " + reason(error));
}

}  // namespace signorini
