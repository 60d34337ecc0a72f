#include "cli/terminal.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <unistd.h>
#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <string_view>
#include <system_error>

#include "base/text.hpp"
#include "signorini/error.hpp"

namespace signorini::cli {
namespace {

bool colour() {
  const char* no_color = std::getenv("NO_COLOR");
  return stderr_is_terminal() && (no_color == nullptr || *no_color == '\0');
}

void message(const char* escape, const char* word, const std::string& text) {
  const std::string head = colour() ? std::string(escape) + word + "\x1b[0m" : std::string(word);
  std::fprintf(stderr, "%s: %s\n", head.c_str(), base::printable(text).c_str());
}

}  // namespace

void print(const std::string& raw) {
  const std::string text = base::printable(raw);
  errno = 0;
  if (std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0) return;
  const int error = errno == 0 ? EIO : errno;
  throw FileError("standard output", "cannot be written: " + std::generic_category().message(error));
}

void print_error(const std::string& text) { message("\x1b[1;31m", "error", text); }

void print_warning(const std::string& text) { message("\x1b[1;33m", "warning", text); }

void print_note(const std::string& text) { message("\x1b[1m", "note", text); }

bool stderr_is_terminal() { return isatty(STDERR_FILENO) == 1; }

void open_closed_streams() {
  for (int stream = STDIN_FILENO; stream <= STDERR_FILENO; ++stream) {
    // Standard output cannot be written then, so that print() reports the loss. Messages have no other place to go.
    const int access = stream == STDOUT_FILENO ? O_RDONLY : O_RDWR;
    if (fcntl(stream, F_GETFD) < 0 && errno == EBADF && open("/dev/null", access) != stream) std::abort();
  }
}

void progress_line(const std::string& text) {
  std::fprintf(stderr, "\r\x1b[K%s", base::printable(text).c_str());
  std::fflush(stderr);
}

namespace {

// Number of characters of UTF-8 text: all bytes except continuation bytes.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

std::string markdown(const std::string& text) {
  std::string result;
  for (const char c : text) result += c == '|' ? std::string("\\|") : std::string(1, c);
  return result;
}

std::string latex(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (std::string_view("&%$#_{}").find(c) != std::string_view::npos)
      result += std::string("\\") + c;
    else if (c == '\\')
      result += "\\textbackslash{}";
    else if (c == '~' || c == '^')
      result += std::string("\\") + c + "{}";
    else if (c == '<' || c == '>' || c == '|')
      result += std::string("$") + c + "$";
    else
      result += c;
  }
  return result;
}

std::string joined(const std::vector<std::string>& cells, const char* between,
                   std::string (*written)(const std::string&)) {
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) line += (i > 0 ? between : "") + written(cells[i]);
  return line;
}

}  // namespace

TableStyle table_style(const std::string& name) {
  if (name.empty()) return TableStyle::plain;
  if (name == "markdown") return TableStyle::markdown;
  if (name == "latex") return TableStyle::latex;
  throw UsageError("--table " + name + ": expected markdown or latex");
}

std::string number(double value) { return fmt::format("{:.6g}", value); }

Table::Table(std::vector<std::string> header, std::vector<bool> right) : right_(std::move(right)) {
  rows_.push_back(std::move(header));
}

void Table::row(std::vector<std::string> cells) {
  for (std::string& cell : cells) cell = base::printable(cell);  // before its width is measured
  rows_.push_back(std::move(cells));
}

void Table::line(std::string text) { rows_.push_back({std::move(text)}); }

std::string Table::str() const {
  std::vector<std::size_t> widths(right_.size(), 0);
  for (const auto& cells : rows_) {
    if (cells.size() != right_.size()) continue;
    for (std::size_t i = 0; i < cells.size(); ++i) widths[i] = std::max(widths[i], width(cells[i]));
  }
  std::string text;
  for (const auto& cells : rows_) {
    std::string line;
    if (cells.size() != right_.size()) {
      line = "  " + cells[0];
    } else {
      for (std::size_t i = 0; i < cells.size(); ++i) {
        const std::string blanks(widths[i] - width(cells[i]), ' ');
        line += "  " + (right_[i] ? blanks + cells[i] : cells[i] + blanks);
      }
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + "\n";
  }
  return text;
}

std::string Table::str(TableStyle style) const {
  if (style == TableStyle::plain) return str();
  const bool tex = style == TableStyle::latex;
  std::string text, behind;
  if (tex) {
    text = "\\begin{tabular}{";
    for (const bool right : right_) text += right ? 'r' : 'l';
    text += "}\n\\hline\n";
  }
  bool first = true;
  for (const auto& cells : rows_) {
    if (cells.size() != right_.size()) {
      behind += tex ? "% " + cells[0] + "\n" : "\n" + markdown(cells[0]) + "\n";
      continue;
    }
    text += tex ? joined(cells, " & ", latex) + " \\\\\n" : "| " + joined(cells, " | ", markdown) + " |\n";
    if (first && tex) text += "\\hline\n";
    if (first && !tex) {
      text += "|";
      for (const bool right : right_) text += right ? "---:|" : "---|";
      text += "\n";
    }
    first = false;
  }
  return text + (tex ? "\\hline\n\\end{tabular}\n" : "") + behind;
}

}  // namespace signorini::cli
