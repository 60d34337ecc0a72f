#include "cli/table.hpp"

#include <fmt/core.h>

#include <algorithm>

namespace signorini::cli {

namespace {

// Characters, not bytes: continuation bytes of UTF-8 take no room.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(
      text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

}  // namespace

std::string number(double value) { return fmt::format("{:.6g}", value); }

Table::Table(std::vector<std::string> header, std::vector<bool> right) : right_(std::move(right)) {
  rows_.push_back(std::move(header));
}

void Table::row(std::vector<std::string> cells) { rows_.push_back(std::move(cells)); }

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

}  // namespace signorini::cli
