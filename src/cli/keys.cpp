// signorini keys [WORD...]: lists all keys of a scene file, or the keys whose description contains the words. The list is
// the table from which scenes are read (scene/keys.hpp).

#include "cli/keys.hpp"

#include <fmt/core.h>
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cctype>
#include <memory>
#include <vector>

#include "base/files.hpp"
#include "base/text.hpp"
#include "cli/command.hpp"
#include "cli/terminal.hpp"
#include "scene/keys.hpp"
#include "scene/schema.hpp"
#include "signorini/error.hpp"

namespace signorini::cli {
namespace {

std::string path_of(const scene::Key& key) {
  if (key.table.empty()) return std::string(key.name);
  return fmt::format("{}.{}", key.table, key.name);
}

std::string default_of(const scene::Key& key) {
  return key.default_value.empty() ? "-" : std::string(key.default_value);
}

/// Names of the scene's tables, in the order of the key list.
std::vector<std::string_view> tables() {
  std::vector<std::string_view> names;
  for (const scene::Key& key : scene::all_keys())
    if (std::find(names.begin(), names.end(), key.table) == names.end()) names.push_back(key.table);
  return names;
}

/// Escapes text for a cell of a Markdown table.
std::string cell(std::string_view text) {
  std::string result;
  for (char c : text) result += c == '|' ? std::string("\\|") : std::string(1, c);
  return result;
}

std::string code(std::string_view text) { return text.empty() ? "" : fmt::format("`{}`", cell(text)); }

std::string default_cell(const scene::Key& key) {
  return key.default_value == "required" ? "required" : code(key.default_value);
}

std::string name_cell(const scene::Key& key) { return key.name == "*" ? "any name" : code(key.name); }

/// Markdown table of the keys in one table of a scene.
std::string key_table(std::string_view table) {
  std::string rows;
  for (const scene::Key& key : scene::all_keys()) {
    if (key.table != table) continue;
    rows += fmt::format("| {} | {} | {} | {} | {} |\n", name_cell(key), cell(scene::describe_type(key)),
                        cell(key.unit), default_cell(key), cell(key.meaning));
  }
  return rows.empty() ? "" : "| key | value | unit | default | meaning |\n|---|---|---|---|---|\n" + rows;
}

std::string small(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// A search word, and other words that also match it in key descriptions.
struct Synonym {
  std::string_view word;
  std::initializer_list<std::string_view> keys;
};
const Synonym synonyms[] = {
    {"earthquake", {"base_motion", "base motion"}},
    {"quake", {"base_motion", "base motion"}},
    {"seismic", {"base_motion", "base motion"}},
    {"accelerogram", {"base_motion"}},
    {"hanger", {"springs[].preload", "springs[].stiffness"}},
    {"bearing", {"pendulums[]", "normal_force"}},
    {"isolator", {"pendulums[]"}},
    {"stress", {"sif", "output[].quantity", "output[].fibre"}},
    {"temperature", {"thermal"}},
    {"heat", {"temperature", "thermal"}},
    {"thermal", {"temperature"}},
    {"weight", {"gravity", "mass_per_length"}},
    {"shoe", {"contacts[]"}},
    {"guide", {"stops[]"}},
    {"elbow", {"members.bend", "members[].bend"}},
    {"support", {"supports[]", "contacts[]"}},
    {"damper", {"damping"}},
    {"dashpot", {"damping"}},
    {"snubber", {"springs[].damping"}},
    {"impact", {"restitution"}},
};

bool line_has(const std::string& line, const std::string& word) {
  if (line.find(word) != std::string::npos) return true;
  for (const Synonym& synonym : synonyms) {
    if (word != synonym.word && word != std::string(synonym.word) + "s") continue;
    for (const std::string_view key : synonym.keys)
      if (line.find(key) != std::string::npos) return true;
  }
  return false;
}

bool matches_words(const std::vector<std::string>& row, const std::vector<std::string>& words) {
  std::string line;
  for (const std::string& cell : row) line += small(cell) + " ";
  return std::all_of(words.begin(), words.end(),
                     [&](const std::string& word) { return line_has(line, small(word)); });
}

}  // namespace

std::string key_list(const std::vector<std::string>& words) {
  const std::string heading =
      "units are given in terms of force, mass, length and time; \"-\" means that a key has no default "
      "and may be omitted\n";
  std::string text = heading;
  for (const std::string_view table : tables()) {
    Table rows({"", "", "", "", ""}, {false, false, false, false, false});
    bool any = false;
    for (const scene::Key& key : scene::all_keys()) {
      if (key.table != table) continue;
      const std::vector<std::string> row = {path_of(key), scene::describe_type(key), std::string(key.unit),
                                            default_of(key), std::string(key.meaning)};
      if (!matches_words(row, words)) continue;
      any = true;
      rows.row(row);
    }
    if (any) text += rows.str();
  }
  if (text == heading)
    throw UsageError((words.size() == 1 ? "no key matches " : "no key matches all of ") +
                     base::join_quoted(words));
  return text;
}

std::string scene_reference() {
  constexpr std::string_view begin = "@keys ", end = "@\n";
  std::string_view words = base::reference_texts().front().text;
  std::string text;
  std::vector<std::string_view> done;
  for (std::size_t at; (at = words.find(begin)) != std::string_view::npos;) {
    text += words.substr(0, at);
    words.remove_prefix(at + begin.size());
    done.push_back(words.substr(0, words.find(end)));
    text += key_table(done.back());
    words.remove_prefix(done.back().size() + end.size());
  }
  text += words;
  for (const std::string_view table : tables())
    if (std::find(done.begin(), done.end(), table) == done.end())
      text += fmt::format("\n## `{}`\n\n{}", table, key_table(table));
  return text;
}

void add_keys(Program& program) {
  auto markdown = std::make_shared<bool>(false);
  auto words = std::make_shared<std::vector<std::string>>();
  CLI::App* command = program.app.add_subcommand("keys", "list the keys of a scene file");
  command->add_option("WORD", *words,
                      "list only keys with all these words in name, description, type, unit or default; case "
                      "does not matter");
  command->add_flag("--markdown", *markdown, "print docs/scene.md, the reference with examples");
  command->callback([&program, markdown, words] {
    program.action = [markdown, words] {
      if (*markdown && !words->empty()) throw UsageError("--markdown: prints all keys, expected no WORD");
      print(*markdown ? scene_reference() : key_list(*words));
      return ExitCode::done;
    };
  });
}

// signorini schema: prints a JSON Schema of scenes, for editors.

void add_schema(Program& program) {
  CLI::App* command = program.app.add_subcommand(
      "schema", "print a JSON Schema for scene files; editors use it for completion and checks");
  command->callback([&program] {
    program.action = [] {
      print(scene::scene_schema());
      return ExitCode::done;
    };
  });
}

}  // namespace signorini::cli
