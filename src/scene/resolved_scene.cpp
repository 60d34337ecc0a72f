#include "scene/resolved_scene.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <unordered_map>

#include "base/text.hpp"
#include "scene/toml_node.hpp"

namespace signorini::scene {

std::string toml_number(double value) {
  std::string text = base::format_number(value);
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

ResolvedTable ResolvedTable::arranged(const std::vector<std::string>& order) const {
  std::unordered_map<std::string_view, std::size_t> ranks;
  for (const std::string& key : order) ranks.emplace(key, ranks.size());
  const auto rank = [&](const auto& item) {
    const auto found = ranks.find(item.first);
    return found == ranks.end() ? ranks.size() : found->second;
  };
  ResolvedTable result = *this;
  std::stable_sort(result.items_.begin(), result.items_.end(),
                   [&](const auto& a, const auto& b) { return rank(a) < rank(b); });
  return result;
}

std::string ResolvedTable::inline_table() const {
  if (items_.empty()) return "{}";
  std::string result;
  for (const auto& [key, value] : items_)
    result += (result.empty() ? "{ " : ", ") + toml_key(key) + " = " + value;
  return result + " }";
}

std::string ResolvedTable::lines() const {
  std::string result;
  for (const auto& [key, value] : items_) result += toml_key(key) + " = " + value + "\n";
  return result;
}

void ResolvedScene::add(std::string_view table, std::string header, const ResolvedTable& record) {
  sections_.push_back({std::string(table), "\n" + std::move(header) + "\n" + record.lines()});
}

std::string ResolvedScene::text(const std::vector<std::string>& order) const {
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

namespace {

namespace fs = std::filesystem;

// Greatest length of a value in a message; longer values are shown by their fingerprint.
constexpr std::size_t longest_value = 60;

/// True if the text is the name of a file; a resolved scene has full paths of files.
bool names_file(const std::string& text) {
  std::error_code error;
  return text.starts_with('/') && fs::is_regular_file(text, error);
}

std::string content_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw FileError(file, "cannot be read");
  return "file " + base::fingerprint_of({std::istreambuf_iterator<char>(in), {}});
}

void add(const base::Json& value, const std::string& path, ResolvedKeys& keys) {
  const auto inner = [&](const std::string& name) { return path.empty() ? name : path + "." + name; };
  const bool tables = value.is_array() && !value.empty() && value.front().is_object();
  if (value.is_object()) {
    for (const auto& [name, item] : value.items()) add(item, inner(name), keys);
  } else if (tables) {
    for (std::size_t i = 0; i < value.size(); ++i) {
      const bool named = value[i].is_object() && value[i].contains("name") && value[i]["name"].is_string();
      add(value[i], inner(named ? value[i]["name"].get<std::string>() : std::to_string(i + 1)), keys);
    }
  } else if (value.is_string() && names_file(value.get<std::string>())) {
    keys[path] = content_of(value.get<std::string>());
  } else {
    const std::string text = value.dump();
    keys[path] = text.size() <= longest_value ? text : "values " + base::fingerprint_of(text);
  }
}

}  // namespace

ResolvedKeys resolved_keys(const Scene& scene) {
  ResolvedKeys keys;
  add(json_of(toml::parse(scene.resolved)), "", keys);
  keys.erase("title");
  return keys;
}

std::vector<std::string> differing_keys(const ResolvedKeys& kept, const ResolvedKeys& here) {
  std::vector<std::string> list;
  for (const auto& [key, value] : kept) {
    const auto found = here.find(key);
    if (found == here.end())
      list.push_back(fmt::format("{} ({}, here absent)", key, value));
    else if (found->second != value)
      list.push_back(fmt::format("{} ({}, here {})", key, value, found->second));
  }
  for (const auto& [key, value] : here)
    if (!kept.contains(key)) list.push_back(fmt::format("{} (absent, here {})", key, value));
  return list;
}

namespace {

/// Copy of the table without keys that describe excitation.
toml::table undriven(toml::table table) {
  for (const char* key : {"motion", "acceleration", "surface_velocity", "normal_force", "initial_shear",
                          "temperature", "initial_strain"})
    table.erase(key);
  return table;
}

bool same(const toml::node* a, const toml::node* b) {
  if (!a || !b) return a == b;
  if (a->is_table() && b->is_table()) return *a->as_table() == *b->as_table();
  if (!a->is_array() || !b->is_array()) return false;
  const toml::array &x = *a->as_array(), &y = *b->as_array();
  if (!x.is_homogeneous(toml::node_type::table) || !y.is_homogeneous(toml::node_type::table)) return x == y;
  if (x.size() != y.size()) return false;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (undriven(*x[i].as_table()) != undriven(*y[i].as_table())) return false;
  return true;
}

}  // namespace

bool same_units(const toml::table& a, const toml::table& b) { return same(a.get("units"), b.get("units")); }

std::string units_of(const toml::table& scene) {
  std::string text;
  for (const char* key : {"force", "mass", "length", "time"})
    text += (text.empty() ? "" : ", ") + scene["units"][key].value_or(std::string("?"));
  return text;
}

std::vector<std::string> differing_structure(const toml::table& a, const toml::table& b) {
  std::vector<std::string> tables;
  for (const char* key :
       {"nodes", "lines", "sections", "members", "bodies", "surfaces", "seams", "masses", "rigid", "springs",
        "damping", "supports", "contacts", "stops", "pendulums", "reduction", "matrices", "gravity"})
    if (!same(a.get(key), b.get(key))) tables.emplace_back(key);
  if (a["run"]["geometric"].value_or(false) != b["run"]["geometric"].value_or(false))
    tables.emplace_back("run.geometric");
  return tables;
}

}  // namespace signorini::scene
