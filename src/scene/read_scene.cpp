// Reads a Scene from a file: parses TOML, applies --set, reads table by table.
#include <fmt/core.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "scene/overrides.hpp"
#include "scene/readers.hpp"
#include "scene/resolved_scene.hpp"
#include "scene/saved_state.hpp"
#include "scene/toml_node.hpp"

namespace signorini::scene {

namespace {

/// Index of the closing quote of the string that begins at i. A string without closing quote ends at the line break or
/// at text.size().
std::size_t end_of_string(const std::string& text, std::size_t i) {
  const std::string quote(1, text[i]), three(3, text[i]);
  const std::string& mark = text.compare(i, 3, three) == 0 ? three : quote;
  for (i += mark.size(); i < text.size(); ++i) {
    if (text[i] == '\\' && quote == "\"") {
      ++i;
    } else if (text.compare(i, mark.size(), mark) == 0) {
      return i + mark.size() - 1;
    } else if (text[i] == '\n' && mark.size() == 1) {
      return i;
    }
  }
  return text.size();
}

/// Refuses deep nesting: the parser handles a.a.a = { a.a.a = ... } recursively, and would overflow the stack.
void check_depth(const std::string& text, const std::string& file) {
  constexpr int deepest = 1000;
  std::vector<int> outer;  // for each open bracket: number of parts of its key, plus one
  int parts = 0, depth = 0, line = 1;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (c == '#') {
      i = std::min(text.find('\n', i), text.size()) - 1;
    } else if (c == '"' || c == '\'') {
      const std::size_t end = end_of_string(text, i);
      line += static_cast<int>(
          std::count(text.begin() + static_cast<std::ptrdiff_t>(i),
                     text.begin() + static_cast<std::ptrdiff_t>(std::min(end + 1, text.size())), '\n'));
      i = end;
    } else if (c == '[' || c == '{') {
      outer.push_back(parts + 1);
      depth += outer.back();
      parts = 0;
    } else if ((c == ']' || c == '}') && !outer.empty()) {
      depth -= outer.back();
      outer.pop_back();
      parts = 0;
    } else if (c == ',' || c == '\n') {
      parts = 0;
      line += c == '\n' ? 1 : 0;
    } else if (c == '.' && ++parts > deepest) {
      throw SceneError({file, line, 0}, "", fmt::format("found a key of more than {} parts", deepest));
    }
    if (depth + parts > deepest)
      throw SceneError({file, line, 0}, "", fmt::format("found tables nested deeper than {}", deepest));
  }
}

toml::table parse_text(const std::string& text, const std::string& file) {
  if (const std::size_t zero = text.find('\0'); zero != std::string::npos) {
    const auto lines = std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(zero), '\n');
    throw SceneError({file, static_cast<int>(lines) + 1, 0}, "", "found binary data, expected TOML text");
  }
  check_depth(text, file);
  try {
    return toml::parse(text, std::string_view(file));
  } catch (const toml::parse_error& error) {
    std::string message(error.description());
    for (char& c : message) {
      if (static_cast<unsigned char>(c) < 0x20) c = ' ';
    }
    throw SceneError(place_of(error.source()), "", "not TOML: " + message);
  }
}

void check_schema(const toml::table& root, const std::string& file) {
  const std::vector<Entry> entries = entries_of(root);
  if (entries.empty()) throw SceneError({file, 1, 1}, "schema", "the file is empty, expected schema = 1");
  const toml::node* schema = root.get("schema");
  if (!schema) {
    throw SceneError({file, 1, 1}, "schema", "missing, expected schema = 1 as the first key of the file");
  }
  if (schema->value<std::int64_t>() != 1) {
    refuse(place_of(*schema), "schema", "found " + describe(*schema) + ", expected 1");
  }
  if (entries[0].name != "schema") {
    refuse(place_of(*schema), "schema",
           fmt::format("found after \"{}\", expected as the first key of the file", entries[0].name));
  }
}

/// Compares the scene with the scene of the run that it continues. The units must be equal, because the saved numbers
/// have these units. A different structure may be intended: it is allowed, and reported.
void compare_with_run(Scene& scene) {
  const std::filesystem::path path = std::filesystem::path(scene.initial.saved->run) / "run.toml";
  std::ifstream in(path);
  if (!in) return;
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  const toml::table run = parse_text(text, path.string()), here = parse_text(scene.resolved, scene.file);
  if (!same_units(run, here))
    throw SceneError(scene.initial.place, "run.initial.run",
                     fmt::format("found a run in the units {}, expected the units of this scene, {}",
                                 units_of(run), units_of(here)));
  const bool had_geometric = run.at_path("run.geometric").value_or(false);
  if (had_geometric && scene.run.geometric && !scene.initial.saved->prestress)
    throw SceneError(
        scene.initial.place, "run.initial.run",
        fmt::format(
            "found no {}; this file has the frozen static forces, on which the stiffness of a run with "
            "run.geometric = true depends",
            (std::filesystem::path(scene.initial.saved->run) / prestress_file).string()));
  scene.initial.saved->structure_differences = differing_structure(run, here);
}

Scene build(const std::string& text, const std::string& file, const std::vector<Override>& overrides) {
  toml::table root = parse_text(text, file);
  apply_overrides(root, overrides);
  check_schema(root, file);

  Scene scene;
  ResolvedScene record;
  scene.file = file;
  Table top(&root, "", "", {file, 1, 1});
  record.top.set("schema", std::to_string(top.integer("schema")));
  scene.title = top.text("title");
  record.top.set("title", toml_string(scene.title));
  read_units(top, scene, record);

  if (top.has("matrices")) {
    read_matrices(top, scene, record);
    read_run(top, scene, record);
  } else {
    scene.gravity = top.vector("gravity");
    record.top.set("gravity", toml_numbers(scene.gravity));
    read_nodes(top, scene, record);
    read_lines(top, scene, record);
    if (const auto t_end = root.at_path("run.t_end").value<double>(); t_end && *t_end > 0.0)
      scene.run.t_end = *t_end;  // histories of bodies are expanded up to t_end; read_run() checks it
    read_bodies(top, scene, record);
    read_rigid(top, scene, record);
    if (scene.nodes.empty())
      throw SceneError({file, 1, 1}, "nodes", "missing, expected [nodes], [[bodies]] or [matrices]");
    read_run(top, scene, record);  // before loads: histories are expanded up to t_end
    read_sections(top, scene, record);
    read_members(top, scene, record);
    read_masses(top, scene, record);
    read_supports(top, scene, record);
    read_springs(top, scene, record);
    read_damping(top, scene, record);
  }
  read_reduction(top, scene, record);
  read_contacts(top, scene, record);  // after [run]: compressions are checked up to t_end
  read_stops(top, scene, record);
  read_pendulums(top, scene, record);
  read_surfaces(top, scene, record);
  read_seams(top, scene, record);
  read_loads(top, scene, record);
  read_base_motion(top, scene, record);
  read_outputs(top, scene, record);
  top.finish();

  std::vector<std::string> order;
  for (const Entry& entry : entries_of(root)) order.push_back(entry.name);
  scene.resolved = record.text(order);
  if (scene.initial.saved) compare_with_run(scene);
  return scene;
}

bool can_be_read(const std::string& text, const std::string& file) {
  try {
    (void)build(text, file, {});
    return true;
  } catch (const Error&) {
    return false;
  }
}

}  // namespace

}  // namespace signorini::scene

namespace signorini {

Scene parse_scene(const std::string& text, const std::string& file, const std::vector<Override>& overrides) {
  std::string message;
  try {
    return scene::build(text, file, overrides);
  } catch (const SceneError& error) {
    // If the file alone is valid, an override has made another key invalid (kinetic above static): name all overrides.
    if (overrides.empty() || !scene::can_be_read(text, file)) throw;
    message = error.what();
  }
  std::string all;
  for (const Override& change : overrides) all += (all.empty() ? "" : " ") + scene::override_text(change);
  throw UsageError(all + ": " + message);
}

Scene read_scene(const std::string& path, const std::vector<Override>& overrides) {
  return parse_scene(scene::scene_text(path), path, overrides);
}

}  // namespace signorini

namespace signorini::scene {

std::vector<std::string> places_in(const std::string& scene, const std::string& path) {
  return places_of(parse_text(scene_text(scene), scene), path);
}

std::string count_matching_tables_in(const std::string& scene, const std::vector<Override>& before,
                                     const std::string& path) {
  if (path.find('*') == std::string::npos) return {};  // most paths contain no *
  toml::table root = parse_text(scene_text(scene), scene);
  apply_overrides(root, before);
  return count_matching_tables(root, path);
}

}  // namespace signorini::scene
