#include "scene/record.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <unordered_map>

#include "base/number.hpp"

namespace signorini {

std::string toml_number(double value) {
  std::string text = shortest(value);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

std::string toml_string(std::string_view text) {
  std::string result = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      result += {'\\', c};
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      result += fmt::format("\\u{:04x}", static_cast<unsigned>(static_cast<unsigned char>(c)));
    } else {
      result += c;
    }
  }
  return result + '"';
}

std::string toml_key(std::string_view key) {
  const bool bare = !key.empty() && std::all_of(key.begin(), key.end(), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' || c == '-';
  });
  return bare ? std::string(key) : toml_string(key);
}

std::string toml_array(const std::vector<std::string>& items) {
  std::string result = "[";
  for (const std::string& item : items) result += (result.size() > 1 ? ", " : "") + item;
  return result + "]";
}

std::string toml_numbers(std::span<const double> values) {
  std::vector<std::string> items;
  for (const double value : values) items.push_back(toml_number(value));
  return toml_array(items);
}

std::string toml_strings(const std::vector<std::string>& texts) {
  std::vector<std::string> items;
  for (const std::string& text : texts) items.push_back(toml_string(text));
  return toml_array(items);
}

Record Record::arranged(const std::vector<std::string>& order) const {
  std::unordered_map<std::string_view, std::size_t> ranks;
  for (const std::string& key : order) ranks.emplace(key, ranks.size());
  const auto rank = [&](const auto& item) {
    const auto found = ranks.find(item.first);
    return found == ranks.end() ? ranks.size() : found->second;
  };
  Record result = *this;
  std::stable_sort(result.items_.begin(), result.items_.end(),
                   [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
  return result;
}

std::string Record::inline_table() const {
  if (items_.empty()) return "{}";
  std::string result;
  for (const auto& [key, value] : items_)
    result += (result.empty() ? "{ " : ", ") + toml_key(key) + " = " + value;
  return result + " }";
}

std::string Record::lines() const {
  std::string result;
  for (const auto& [key, value] : items_) result += toml_key(key) + " = " + value + "\n";
  return result;
}

void RecordedScene::add(std::string_view table, std::string header, const Record& record) {
  sections_.push_back({std::string(table), "\n" + std::move(header) + "\n" + record.lines()});
}

std::string RecordedScene::text(const std::vector<std::string>& order) const {
  const auto rank = [&](const Section& section) {
    return std::find(order.begin(), order.end(), section.table) - order.begin();
  };
  std::vector<Section> sorted = sections_;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [&](const Section& a, const Section& b) { return rank(a) < rank(b); });
  std::string result = top.lines();
  for (const Section& section : sorted) result += section.text;
  return result;
}

}  // namespace signorini
