#include "study/sweep/row_file.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>
#include <cerrno>
#include <fstream>
#include <system_error>
#include <utility>

#include "base/files.hpp"
#include "base/json.hpp"
#include "base/text.hpp"
#include "signorini/error.hpp"

namespace signorini::sweep {

namespace fs = std::filesystem;

namespace {

void check_kind(const fs::path& file) {
  std::error_code ignored;
  std::string why = base::input_file_error(file);
  if (fs::is_symlink(fs::symlink_status(file, ignored))) why = "is a symbolic link";
  if (!why.empty()) throw FileError(file.string(), why + ", expected a file with the rows of a sweep");
}

/// Calls take(line, number) for each complete line; returns the total size of these lines in bytes.
template <class Take>
std::uintmax_t read_complete_lines(const fs::path& file, const Take& take) {
  check_kind(file);
  errno = 0;
  std::ifstream stream(file, std::ios::binary);
  std::error_code ignored;
  if (!stream && fs::exists(file, ignored))
    throw FileError(file.string(), "cannot be read" + base::system_error_text(errno));
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
  read_complete_lines(file, [&](const std::string& line, std::size_t number) {
    const auto wrong = [&](const std::string& what) {
      return FileError(file.string(), fmt::format("line {} {}", number, what));
    };
    try {
      if (!is_unaltered(line)) throw wrong("has been altered since it was written");
      SweepRow row = parse_row(line);
      const std::size_t index = row.index;
      rows[index] = {std::move(row), number};
    } catch (const base::Json::exception& error) {
      throw wrong(std::string("is not a row of a sweep: ") + error.what());
    }
  });
  return rows;
}

RowFile::RowFile(fs::path path)
    : path_(std::move(path)), good_(read_complete_lines(path_, [](const std::string&, std::size_t) {})) {
  file_ = open(path_.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW, 0666);
  if (file_ < 0) throw FileError(path_.string(), "cannot be opened" + base::system_error_text(errno));
  if (ftruncate(file_, static_cast<off_t>(good_)) == 0) return;
  const int error = errno;
  close(file_);
  throw FileError(path_.string(),
                  "cannot be truncated after its last complete line" + base::system_error_text(error));
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
  // If this truncation also fails, the next sweep that opens the file truncates it.
  [[maybe_unused]] const int ignored = ftruncate(file_, static_cast<off_t>(good_));
  throw FileError(path_.string(), "cannot be written" + base::system_error_text(error));
}

namespace {

constexpr long long max_shares = 1000000000;

std::optional<long long> integer(const Environment& environment, const char* name) {
  const std::optional<std::string> text = environment(name);
  if (!text || text->empty()) return std::nullopt;
  const std::optional<long long> value = base::parse_integer(*text);
  if (!value || *value < 0 || *value > max_shares)
    throw UsageError(
        fmt::format("--share auto: {} is \"{}\", expected an integer from 0 to {}", name, *text, max_shares));
  return value;
}

struct Place {
  long long rank, size;
};

void check(const Place& place, const char* names) {
  if (place.rank < place.size) return;
  throw UsageError(fmt::format(
      "--share auto: {} give rank {} of {} processes, expected a rank below the number of processes", names,
      place.rank, place.size));
}

std::optional<Place> launcher(const Environment& environment) {
  constexpr const char* names[][2] = {{"OMPI_COMM_WORLD_RANK", "OMPI_COMM_WORLD_SIZE"},
                                      {"PMI_RANK", "PMI_SIZE"}};
  for (const auto& [rank, size] : names) {
    const auto r = integer(environment, rank), s = integer(environment, size);
    if (!r || !s) continue;
    const Place place{*r, *s};
    check(place, fmt::format("{} and {}", rank, size).c_str());
    return place;
  }
  return std::nullopt;
}

std::optional<Place> array(const Environment& environment) {
  const auto id = integer(environment, "SLURM_ARRAY_TASK_ID");
  if (!id) return std::nullopt;
  const auto count = integer(environment, "SLURM_ARRAY_TASK_COUNT");
  if (!count)
    throw UsageError(
        "--share auto: SLURM_ARRAY_TASK_ID is set and SLURM_ARRAY_TASK_COUNT is not; give --share K/N");
  const long long first = integer(environment, "SLURM_ARRAY_TASK_MIN").value_or(0);
  const long long last = integer(environment, "SLURM_ARRAY_TASK_MAX").value_or(first + *count - 1);
  const long long step = *count > 1 ? (last - first) / (*count - 1) : 1;
  // The tasks of an irregular list such as --array=1,5,6 cannot be numbered by a rule.
  const bool even = *count >= 1 && step >= 1 && first + step * (*count - 1) == last && *id >= first &&
                    *id <= last && (*id - first) % step == 0;
  if (!even)
    throw UsageError(fmt::format(
        "--share auto: Slurm task {} ({} tasks, from {} to {}) does not belong to an evenly spaced array; "
        "give --share K/N, or --array=1-N",
        *id, *count, first, last));
  return Place{(*id - first) / step, *count};
}

}  // namespace

Share parse_share(const std::string& text, const Environment& environment) {
  if (text == "auto") {
    const std::optional<Place> rank = launcher(environment), task = array(environment);
    if (!rank && !task)
      throw UsageError(
          "--share auto: found none of OMPI_COMM_WORLD_RANK, PMI_RANK, SLURM_ARRAY_TASK_ID in the "
          "environment; "
          "give --share K/N");
    const Place r = rank.value_or(Place{0, 1}), t = task.value_or(Place{0, 1});
    return {static_cast<std::size_t>(t.rank * r.size + r.rank + 1),
            static_cast<std::size_t>(t.size * r.size)};
  }
  const std::size_t slash = text.find('/');
  const auto number = base::parse_integer(text.substr(0, slash));
  const auto count = slash == std::string::npos ? std::nullopt : base::parse_integer(text.substr(slash + 1));
  if (!number || !count || *number < 1 || *count < *number || *count > max_shares)
    throw UsageError("--share " + text + ": expected K/N with K from 1 to N, such as 3/16, or auto");
  return {static_cast<std::size_t>(*number), static_cast<std::size_t>(*count)};
}

std::size_t ranks(const Environment& environment) {
  const std::optional<Place> place = launcher(environment);
  return place ? static_cast<std::size_t>(place->size) : 1;
}

}  // namespace signorini::sweep
