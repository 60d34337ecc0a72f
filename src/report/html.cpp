#include "report/html.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "base/rounding.hpp"
#include "base/text.hpp"
#include "result/csv.hpp"

namespace signorini::report {

namespace fs = std::filesystem;

std::string html_text(std::string_view text) {
  std::string result;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '<') {
      result += "&lt;";
    } else if (c == '>') {
      result += "&gt;";
    } else if (c == '&') {
      result += "&amp;";
    } else if (c == '"') {
      result += "&quot;";
    } else if (c == '\'') {
      result += "&#39;";
    } else if ((byte < 0x20 && c != '\n' && c != '\t') || byte == 0x7f) {
      result += "\xef\xbf\xbd";
    } else {
      result += c;
    }
  }
  return result;
}

std::string script_json(const std::string& json) {
  std::string result;
  for (const char c : json) {
    if (c == '<') {
      result += "\\u003c";
    } else {
      result += c;
    }
  }
  return result;
}

std::string short_number(const std::string& cell, int digits) {
  if (cell.empty()) return cell;
  char* end = nullptr;
  const double value = std::strtod(cell.c_str(), &end);
  if (*end != '\0' || !std::isfinite(value)) return cell;
  return fmt::format("{:.{}g}", value, digits);
}

namespace {

std::string table_row(const std::vector<std::string>& cells, const char* tag) {
  std::string row = "<tr>";
  for (const std::string& cell : cells) {
    const bool number = !cell.empty() && cell.find_first_not_of("0123456789+-.e") == std::string::npos;
    row += fmt::format("<{}{}>{}</{}>", tag, number ? " class=n" : "", html_text(cell), tag);
  }
  return row + "</tr>\n";
}

/// Gives all columns of forces one common greatest value, likewise all columns of velocities: the scale of rounding.
void share_scales(const std::vector<std::string>& header, std::vector<double>& greatest) {
  for (const std::vector<std::string_view>& alike :
       {std::vector<std::string_view>{"N", "T", "N_after", "T_after"},
        std::vector<std::string_view>{"vn", "vt", "vn_after", "vt_after"}}) {
    const auto among = [&](const std::string& name) {
      return std::find(alike.begin(), alike.end(), name) != alike.end();
    };
    double most = 0.0;
    for (std::size_t i = 0; i < header.size(); ++i)
      if (among(header[i])) most = std::max(most, greatest[i]);
    for (std::size_t i = 0; i < header.size(); ++i)
      if (among(header[i])) greatest[i] = most;
  }
}

}  // namespace

std::string csv_table(const fs::path& file, std::size_t most, const std::vector<std::string>& columns,
                      const std::map<std::string, std::string>& units) {
  std::error_code error;
  if (!fs::is_regular_file(file, error)) return "";
  result::CsvReader reader(file);
  std::vector<std::string> header = columns.empty() ? reader.header() : columns;
  std::vector<std::size_t> index;
  for (const std::string& name : header) index.push_back(reader.column(name));
  std::vector<std::vector<std::string>> kept;
  std::vector<double> greatest(header.size(), 0.0);
  std::size_t count = 0;
  while (reader.next()) {
    for (std::size_t i = 0; i < index.size(); ++i)
      if (const auto value = base::parse_number(reader.cell(index[i])); value && std::isfinite(*value))
        greatest[i] = std::max(greatest[i], std::abs(*value));
    if (++count > most) continue;
    std::vector<std::string>& cells = kept.emplace_back();
    for (const std::size_t i : index) cells.push_back(reader.cell(i));
  }
  share_scales(header, greatest);
  std::string rows;
  for (std::vector<std::string>& cells : kept) {
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const auto value = base::parse_number(cells[i]);
      // A value that is a rounding error compared with its column is shown as 0.
      if (value && std::abs(*value) <= rounding::elimination * greatest[i]) cells[i] = "0";
      cells[i] = short_number(cells[i], header[i] == "t" ? 11 : 6);
    }
    rows += table_row(cells, "td");
  }
  if (count == 0) return "";
  for (std::string& name : header)
    if (const auto found = units.find(name); found != units.end() && !found->second.empty())
      name += " [" + found->second + "]";
  std::string text =
      fmt::format("<div class=wide><table><thead>{}</thead><tbody>\n{}</tbody></table></div>\n",
                  table_row(header, "th"), rows);
  if (count > most)
    text +=
        fmt::format("<p>{} more rows are in {}.</p>\n", count - most, html_text(file.filename().string()));
  return text;
}

std::string section(const std::string& id, const std::string& heading, const std::string& body) {
  if (body.empty()) return "";
  return fmt::format("<section id=\"{}\">\n<h2>{}</h2>\n{}</section>\n", html_text(id), html_text(heading),
                     body);
}

std::string fill_template(std::string_view page, const std::vector<Insertion>& values) {
  std::string result;
  for (std::size_t at = 0; at < page.size();) {
    const auto here = std::find_if(values.begin(), values.end(), [&](const Insertion& value) {
      return page.substr(at).starts_with("@" + value.name + "@");
    });
    if (page[at] != '@' || here == values.end()) {
      result += page[at++];
      continue;
    }
    result += here->value;
    at += here->name.size() + 2;
  }
  return result;
}

}  // namespace signorini::report
