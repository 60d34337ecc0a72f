#include "scene/matrix_market.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <limits>
#include <sstream>
#include <tuple>
#include <vector>

#include "base/text.hpp"
#include "scene/data_file.hpp"

namespace signorini::scene {

namespace {

constexpr long long most_entries = 20'000'000;

class Reader {
 public:
  Reader(std::istream& in, const std::string& file, const std::string& key, bool vector = false)
      : in_(in), file_(file), key_(key), vector_(vector) {}

  MatrixSpec read() {
    read_header();
    read_size();
    coordinate_ ? read_coordinates() : read_array();
    if (next())
      fail(fmt::format("found \"{}\" after the last of {} entries, expected the end of the file",
                       base::excerpt(line_), count_));
    tidy(matrix_);
    return std::move(matrix_);
  }

 private:
  [[noreturn]] void fail(const std::string& message) const {
    throw SceneError({file_, number_, 0}, key_, message);
  }

  bool next_line() {
    ++number_;
    if (!read_line(in_, line_)) return false;
    const bool cut = line_.size() > max_line_length;
    if (cut && line_[0] != '%') fail(fmt::format("found a line of more than {} characters", max_line_length));
    for (char& c : line_) {
      const auto code = static_cast<unsigned char>(c);
      if (code == '\t' || code == '\r') c = ' ';
      if (code == 0 || code > 0x7f) {
        if (line_[0] != '%' || code == 0) fail("found binary data, expected a Matrix Market file");
        c = '?';
      }
    }
    if (cut) in_.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
    std::istringstream words(line_);
    words_.clear();
    for (std::string word; words >> word;) words_.push_back(word);
    return true;
  }

  /// Advances to the next line that is neither a comment nor blank; false at the end of the file.
  bool next() {
    while (next_line()) {
      if (!words_.empty() && words_[0][0] != '%') return true;
    }
    return false;
  }

  void read_header() {
    const std::string expected =
        "expected \"%%MatrixMarket matrix coordinate|array real|integer general|symmetric\"";
    if (!next_line()) fail("the file is empty, " + expected);
    for (std::string& word : words_) {
      for (char& c : word) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    }
    // One % instead of two is a common mistake with printf, in which %% writes one %.
    if (!words_.empty() && words_[0] == "%matrixmarket") words_[0] = "%%matrixmarket";
    const auto is = [&](std::size_t i, const char* a, const char* b) {
      return words_[i] == a || words_[i] == b;
    };
    if (words_.size() != 5 || words_[0] != "%%matrixmarket" || words_[1] != "matrix" ||
        !is(2, "coordinate", "array") || !is(3, "real", "integer") || !is(4, "general", "symmetric")) {
      fail(fmt::format("found \"{}\", {}", base::excerpt(line_), expected));
    }
    coordinate_ = words_[2] == "coordinate";
    symmetric_ = words_[4] == "symmetric";
  }

  long long index(std::size_t word, long long least, long long most, const char* what) const {
    const auto value = base::parse_integer(words_[word]);
    if (!value || *value < least || *value > most) {
      fail(fmt::format("found \"{}\", expected {} from {} to {}", base::excerpt(words_[word]), what, least,
                       most));
    }
    return *value;
  }

  double entry(std::size_t word) const {
    const auto value = base::parse_number(words_[word]);
    if (!value || !std::isfinite(*value))
      fail(fmt::format("found \"{}\", expected a number", base::excerpt(words_[word])));
    return *value;
  }

  void read_size() {
    const std::size_t expected = coordinate_ ? 3 : 2;
    if (!next()) fail("the file ends, expected the size of the matrix");
    if (words_.size() != expected) {
      fail(fmt::format("found \"{}\", expected {}", base::excerpt(line_),
                       coordinate_ ? "rows, columns and number of entries" : "rows and columns"));
    }
    const long long rows = index(0, 1, max_dofs, "a number of rows");
    const long long columns = index(1, 1, max_dofs, "a number of columns");
    if (vector_ && (columns != 1 || symmetric_))
      fail(symmetric_ ? "found a symmetric matrix, expected a general matrix with one column"
                      : fmt::format("found {} columns, expected one", columns));
    if (!vector_ && rows != columns)
      fail(fmt::format("found a matrix of {} x {}, expected a square matrix", rows, columns));
    matrix_.size = static_cast<int>(rows);
    if (coordinate_) {
      count_ = index(2, 0, std::min(most_entries, rows * columns), "a number of entries");
    } else {
      count_ = symmetric_ ? rows * (rows + 1) / 2 : rows * columns;
      if (count_ > most_entries)
        fail(fmt::format("found {} entries, expected at most {}", count_, most_entries));
    }
  }

  void add(int row, int column, double value) {
    matrix_.entries.push_back({row, column, value});
    if (symmetric_ && row != column) matrix_.entries.push_back({column, row, value});
  }

  void expect(long long i, std::size_t words, const char* what) {
    if (!next()) fail(fmt::format("the file ends after {} of {} entries, expected all entries", i, count_));
    if (words_.size() != words) fail(fmt::format("found \"{}\", expected {}", base::excerpt(line_), what));
  }

  void read_coordinates() {
    for (long long i = 0; i < count_; ++i) {
      expect(i, 3, "row, column and value");
      const auto row = static_cast<int>(index(0, 1, matrix_.size, "a row"));
      const auto column = static_cast<int>(index(1, 1, vector_ ? 1 : matrix_.size, "a column"));
      if (symmetric_ && column > row) {
        fail(
            fmt::format("found \"{}\" above the diagonal, expected only the lower half of a symmetric matrix",
                        base::excerpt(line_)));
      }
      add(row - 1, column - 1, entry(2));
    }
  }

  void read_array() {
    int row = 0, column = 0;
    for (long long i = 0; i < count_; ++i) {
      expect(i, 1, "one value");
      add(row, column, entry(0));
      if (++row == matrix_.size) row = symmetric_ ? ++column : (++column, 0);
    }
  }

  std::istream& in_;
  std::string file_, key_, line_;
  std::vector<std::string> words_;
  int number_ = 0;
  bool vector_ = false, coordinate_ = true, symmetric_ = false;
  long long count_ = 0;
  MatrixSpec matrix_;
};

}  // namespace

void tidy(MatrixSpec& matrix) {
  auto& entries = matrix.entries;
  std::stable_sort(entries.begin(), entries.end(), [](const auto& a, const auto& b) {
    return std::tie(a.row, a.column) < std::tie(b.row, b.column);
  });
  std::size_t kept = 0;
  for (std::size_t i = 0; i < entries.size(); ++i) {
    if (kept > 0 && entries[kept - 1].row == entries[i].row &&
        entries[kept - 1].column == entries[i].column) {
      entries[kept - 1].value += entries[i].value;
    } else {
      entries[kept++] = entries[i];
    }
  }
  entries.resize(kept);
  std::erase_if(entries, [](const auto& e) { return e.value == 0.0; });
}

std::vector<double> read_market_vector(std::istream& in, const std::string& file, const std::string& key) {
  const MatrixSpec matrix = Reader(in, file, key, true).read();
  std::vector<double> values(static_cast<std::size_t>(matrix.size), 0.0);
  for (const MatrixSpec::Entry& e : matrix.entries) values[static_cast<std::size_t>(e.row)] = e.value;
  return values;
}

MatrixSpec read_matrix_market(std::istream& in, const std::string& file, const std::string& key) {
  return Reader(in, file, key).read();
}

}  // namespace signorini::scene
