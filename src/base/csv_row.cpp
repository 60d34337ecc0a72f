#include "base/csv_row.hpp"

namespace signorini {

bool read_csv_row(std::istream& in, std::vector<std::string>& cells) {
  constexpr std::size_t longest = 100u << 20;
  cells.clear();
  std::string cell;
  bool quoted = false;
  std::size_t size = 0;
  std::streambuf& bytes = *in.rdbuf();
  constexpr int end = std::char_traits<char>::eof();
  for (int next = bytes.sbumpc(); next != end && size < longest; next = bytes.sbumpc(), ++size) {
    const char c = static_cast<char>(next);
    if (c == '"') {
      const bool doubled = quoted && bytes.sgetc() == '"';
      if (doubled) cell += static_cast<char>(bytes.sbumpc());
      if (!doubled) quoted = !quoted;
    } else if (!quoted && (c == ',' || c == '\n')) {
      if (c == '\n' && !cell.empty() && cell.back() == '\r') cell.pop_back();
      cells.push_back(std::move(cell));
      cell.clear();
      if (c == '\n') return true;
    } else {
      cell += c;
    }
  }
  if (size > 0) {
    if (!cell.empty() && cell.back() == '\r') cell.pop_back();
    cells.push_back(std::move(cell));
  }
  return false;
}

}  // namespace signorini
