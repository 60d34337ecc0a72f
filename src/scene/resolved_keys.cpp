#include "scene/resolved_keys.hpp"

#include <fmt/core.h>

#include <filesystem>
#include <fstream>
#include <iterator>

#include "base/fingerprint.hpp"
#include "scene/toml_json.hpp"

namespace signorini {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t longest_value =
    60;  // length of a value in a message; longer values are shown by their fingerprint

/// True if the text is the name of a file; a resolved scene has full paths of files.
bool names_file(const std::string& text) {
  std::error_code error;
  return text.starts_with('/') && fs::is_regular_file(text, error);
}

std::string content_of(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw FileError(file, "cannot be read");
  return "file " + fingerprint_of({std::istreambuf_iterator<char>(in), {}});
}

void add(const Json& value, const std::string& path, ResolvedKeys& keys) {
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
    keys[path] = text.size() <= longest_value ? text : "values " + fingerprint_of(text);
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

}  // namespace signorini
