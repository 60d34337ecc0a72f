#include "result/csv.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <string_view>
#include <system_error>

#include "base/files.hpp"
#include "base/text.hpp"
#include "signorini/error.hpp"

namespace signorini::result {
namespace {

std::string reason(int error) { return std::generic_category().message(error == 0 ? EIO : error); }

}  // namespace

void CsvBlock::separate() {
  if (row_begun_) text_ += ',';
  row_begun_ = true;
}

CsvBlock& CsvBlock::number(double value) {
  separate();
  text_ += base::format_number(value + 0.0);  // + 0.0 turns -0 into 0
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
  std::error_code ignored;  // a pipe cannot be truncated; the error below is thrown anyway
  std::filesystem::resize_file(path_, good_, ignored);
  throw FileError(path_.string(), "cannot be written: " + why);
}

void write_file(const std::filesystem::path& path, const std::string& text) {
  std::filesystem::path draft = path;
  draft += ".part";
  const auto create = [&] { return open(draft.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666); };
  int file = create();
  if (file < 0 && errno == EEXIST) {
    // The draft exists: a killed run left it, or it is a symbolic link, which must not be followed.
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

CsvReader::CsvReader(const std::filesystem::path& path, LastLine last) : path_(path), last_(last) {
  if (const std::string why = base::input_file_error(path); !why.empty())
    throw FileError(path.string(), why + ", expected a file");
  errno = 0;
  file_.open(path, std::ios::binary);
  if (!file_) throw FileError(path.string(), "cannot be read" + base::system_error_text(errno));
  if (!base::read_csv_row(file_, header_) && (header_.empty() || last_ == LastLine::cut))
    throw FileError(path.string(), header_.empty() ? "is empty; expected a header row"
                                                   : "line 1: found no line break, expected a header row");
  constexpr std::string_view mark = "\xEF\xBB\xBF";
  if (last_ == LastLine::counts && header_[0].starts_with(mark)) header_[0].erase(0, mark.size());
  const auto time = std::find(header_.begin(), header_.end(), "t");
  if (time != header_.end()) time_ = static_cast<std::size_t>(time - header_.begin());
}

std::size_t CsvReader::column(const std::string& name) const {
  const auto found = std::find(header_.begin(), header_.end(), name);
  if (found == header_.end()) refuse("has no column '" + name + "'");
  return static_cast<std::size_t>(found - header_.begin());
}

bool CsvReader::next() {
  if (!next_of_any_length()) return false;
  if (const std::string why = row_length_error(); !why.empty())
    refuse(fmt::format("line {}: {}", line_, why));
  return true;
}

bool CsvReader::next_of_any_length() {
  ++line_;
  if (base::read_csv_row(file_, cells_) || (!cells_.empty() && last_ == LastLine::counts)) return true;
  cut_ = !cells_.empty();
  return false;
}

std::string CsvReader::row_length_error() const {
  if (cells_.size() == header_.size()) return {};
  const bool blank = cells_.size() == 1 && cells_[0].empty();
  return fmt::format("found {}, expected {}, as many as in the header",
                     blank ? "a blank line" : base::count_text(cells_.size(), "cell"),
                     base::count_text(header_.size(), "cell"));
}

double CsvReader::number(std::size_t index) const {
  const std::string& text = cells_[index];
  const std::optional<double> value = base::parse_number(text);
  if (!value) refuse("found '" + text + "', expected a number");
  return *value;
}

void CsvReader::refuse(const std::string& why) const { throw FileError(path_.string(), why); }

bool TableFolder::has(const char* table) const {
  std::error_code error;
  return std::filesystem::is_regular_file(directory_ / table, error);
}

}  // namespace signorini::result
