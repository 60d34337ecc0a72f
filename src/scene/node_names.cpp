// Names of nodes and groups: what a scene may refer to, and messages for names that it does not have.
#include <fmt/core.h>

#include <algorithm>
#include <optional>

#include "base/text.hpp"
#include "scene/readers.hpp"

namespace signorini::scene {

namespace {

/// The body of "BODY.REST"; null if no body has this name.
const NameScope::Body* body_of_name(const std::string& name, const NameScope& space) {
  const auto found = std::find_if(space.bodies.begin(), space.bodies.end(), [&](const NameScope::Body& body) {
    return name.starts_with(body.name + ".");
  });
  return found == space.bodies.end() ? nullptr : &*found;
}

/// Names to suggest: nodes that the scene names, and groups; not the thousands of numbered nodes of meshes.
std::vector<std::string> names_to_suggest(const NameScope& space, bool groups) {
  if (space.bodies.empty()) return space.names.list();
  std::vector<std::string> names;
  for (const std::string& name : space.names.list())
    if (!body_of_name(name, space)) names.push_back(name);
  if (!groups) return names;
  for (const NameScope::Body& body : space.bodies) {
    names.push_back(body.name);
    for (const std::string& group : body.groups) names.push_back(body.name + "." + group);
  }
  return names;
}

/// The numbers of the nodes of a body, for the end of a message.
std::string nodes_text(const NameScope::Body& body, const NameScope& space) {
  std::optional<long long> lowest, highest;
  for (const std::string& name : space.names.list()) {
    if (!name.starts_with(body.name + ".")) continue;
    const auto number = base::parse_integer(name.substr(body.name.size() + 1));
    if (!number) continue;
    lowest = std::min(lowest.value_or(*number), *number);
    highest = std::max(highest.value_or(*number), *number);
  }
  if (!lowest) return fmt::format("all nodes of body \"{}\" have names", body.name);
  return fmt::format("its nodes are numbered, \"{0}.{1}\" to \"{0}.{2}\"", body.name, *lowest, *highest);
}

/// Groups of the body, for the end of a message; if its mesh has none: how they arise.
std::string groups_text(const NameScope::Body& body) {
  if (!body.groups.empty())
    return fmt::format("groups of body \"{}\": {}", body.name, base::join_texts(body.groups, 12));
  return fmt::format(
      "body \"{}\" has no groups, because {} has no physical curves or points; in Gmsh, write for example "
      "Physical "
      "Curve(\"bottom\") = {{1}}, and Physical Surface(\"all\") = {{1}}, without which the elements are not "
      "saved",
      body.name, body.mesh.empty() ? "its mesh" : body.mesh);
}

}  // namespace

std::size_t check_node(const std::string& name, const NameScope& space, const SourcePlace& place,
                       const std::string& path, bool groups) {
  if (const auto index = space.names.index(name)) return *index;
  const std::vector<std::string> names = names_to_suggest(space, groups);
  if (!groups && space.groups.contains(name))
    refuse(place, path, fmt::format("found \"{}\", a group of nodes, expected the name of one node", name));
  const NameScope::Body* body = body_of_name(name, space);
  if (!body) refuse(place, path, fmt::format("unknown node \"{}\"{}", name, base::suggestion(name, names)));
  const bool number = base::parse_integer(name.substr(body->name.size() + 1)).has_value();
  const std::string meant = number ? "" : base::did_you_mean(name, names);
  refuse(place, path,
         fmt::format("unknown {} \"{}\"{}", groups && !number ? "group or node" : "node", name,
                     !meant.empty()      ? meant
                     : groups && !number ? "; " + groups_text(*body) + "; " + nodes_text(*body, space)
                                         : "; " + nodes_text(*body, space)));
}

std::string groups_of_bodies_text(const std::string& name, const Scene& scene, bool edges) {
  std::vector<std::string> there;
  for (const BodySpec& body : scene.bodies)
    for (const PlaneMesh::Group& group : body.mesh.groups)
      if (!edges || !group.edges.empty()) there.push_back(body.name + "." + group.name);
  if (!there.empty()) return base::suggestion(name, there);
  const NameScope space = name_scope(scene);
  return space.bodies.empty() ? "; the scene has no [[bodies]]" : "; " + groups_text(space.bodies.front());
}

}  // namespace signorini::scene
