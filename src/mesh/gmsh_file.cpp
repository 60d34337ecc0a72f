#include "mesh/gmsh_file.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <unordered_map>

#include "base/text.hpp"
#include "mesh/mesh_quality.hpp"
#include "mesh/shape_functions.hpp"

namespace signorini::mesh {
namespace {

constexpr std::size_t longest_word = 200;
constexpr long most_entries = 10'000'000;

bool is_blank(int c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

std::string found(const std::string& word) {
  return word.empty() ? "the end of the file" : "\"" + word + "\"";
}

}  // namespace

std::string GmshTokenizer::token() {
  int c = in_.get();
  for (; c != EOF && is_blank(c); c = in_.get())
    if (c == '\n') ++line_;
  std::string text;
  for (; c != EOF && !is_blank(c); c = in_.get()) {
    if (text.size() == longest_word)
      fail("found a word of more than 200 characters, expected a mesh of Gmsh in ASCII");
    text += static_cast<char>(c);
  }
  if (c != EOF) in_.unget();  // token() counts this line break when it reads the next word
  return text;
}

bool GmshTokenizer::next_section(std::string& name) {
  const std::string text = token();
  if (text.empty()) return false;
  if (text[0] != '$')
    fail(fmt::format("found {}, expected a section of a mesh of Gmsh, \"$...\"", found(text)));
  name = text.substr(1);
  return true;
}

void GmshTokenizer::skip_section(const std::string& name) {
  const std::string wanted = "$End" + name;
  for (std::string text = token(); text != wanted; text = token())
    if (text.empty()) fail(fmt::format("found the end of the file, expected {}", wanted));
}

void GmshTokenizer::end_section(const std::string& name) {
  if (const std::string text = token(); text != "$End" + name)
    fail(fmt::format("found {}, expected $End{}", found(text), name));
}

long GmshTokenizer::integer(const char* what) {
  const std::string text = token();
  const auto value = base::parse_integer(text);
  if (!value) fail(fmt::format("found {}, expected {}, an integer", found(text), what));
  return static_cast<long>(*value);
}

long GmshTokenizer::count(const char* what) {
  const long value = integer(what);
  if (value < 0 || value > most_entries)
    fail(fmt::format("found {}, expected {} from 0 to {}", value, what, most_entries));
  return value;
}

double GmshTokenizer::number(const char* what) {
  const std::string text = token();
  const auto value = base::parse_number(text);
  if (!value || !std::isfinite(*value))
    fail(fmt::format("found {}, expected {}, a number", found(text), what));
  return *value;
}

std::string GmshTokenizer::quoted(const char* what) {
  int c = in_.get();
  for (; c != EOF && is_blank(c); c = in_.get())
    if (c == '\n') ++line_;
  if (c != '"') fail(fmt::format("found no quote, expected {}", what));
  std::string text;
  for (c = in_.get(); c != EOF && c != '"' && c != '\n'; c = in_.get()) {
    if (text.size() == longest_word) fail(fmt::format("found more than 200 characters, expected {}", what));
    text += static_cast<char>(c);
  }
  if (c != '"') fail(fmt::format("found no closing quote, expected {}", what));
  return text;
}

namespace {

struct GmshType {
  int number, dimension;
  std::size_t nodes;
  std::optional<PlaneShape> shape;
};
constexpr std::array gmsh_types = {GmshType{15, 0, 1, {}},
                                   GmshType{1, 1, 2, {}},
                                   GmshType{8, 1, 3, {}},
                                   GmshType{2, 2, 3, PlaneShape::t3},
                                   GmshType{9, 2, 6, PlaneShape::t6},
                                   GmshType{3, 2, 4, PlaneShape::q4},
                                   GmshType{16, 2, 8, PlaneShape::q8}};

using Tag = std::pair<int, long>;  // dimension and number

struct RawElement {
  const GmshType* type = nullptr;
  std::vector<int> nodes;
  std::vector<long> physical;  // physical groups that contain the element
  long number = 0;
  SourcePlace place;
};

/// Contents of the file, from which a body is made.
struct GmshContent {
  std::vector<PlaneMesh::Node> nodes;
  std::unordered_map<long, int> node_index;
  std::vector<RawElement> elements;
  std::map<Tag, std::string> names;  // names of physical groups
  std::map<Tag, std::vector<long>>
      groups_of_entity;  // tags of the physical groups of each entity (format 4.1)

  [[nodiscard]] std::string name(int dimension, long tag) const {
    const auto known = names.find({dimension, tag});
    if (known != names.end()) return known->second;
    constexpr std::array kinds = {"point", "curve", "surface", "volume"};
    return kinds[static_cast<std::size_t>(dimension)] +
           std::to_string(tag);  // the digits alone would be the name of a node
  }
};

class GmshReader {
 public:
  GmshReader(std::istream& in, const std::string& file, const std::string& key) : words_(in, file, key) {}

  GmshContent read() {
    std::string section;
    while (words_.next_section(section)) {
      if (version_ == 0 && section != "MeshFormat")
        words_.fail(fmt::format("found ${}, expected $MeshFormat first", section));
      if (section == "MeshFormat")
        read_format();
      else if (section == "PhysicalNames")
        read_names();
      else if (section == "Entities" && version_ == 4)
        read_entities();
      else if (section == "Nodes")
        version_ == 4 ? read_nodes() : read_old_nodes();
      else if (section == "Elements")
        version_ == 4 ? read_elements() : read_old_elements();
      else {
        words_.skip_section(section);
        continue;
      }
      words_.end_section(section);
    }
    if (content_.elements.empty()) words_.fail("found no elements, expected $Elements");
    return std::move(content_);
  }

 private:
  void read_format() {
    const double version = words_.number("the version");
    if (version != 4.1 && version != 2.2)
      words_.fail(fmt::format("found version {:.6g}, expected 4.1 or 2.2 (gmsh -format msh41)", version));
    version_ = version == 4.1 ? 4 : 2;
    if (words_.integer("the file type") != 0)
      words_.fail("found a binary mesh, expected ASCII (Mesh.Binary = 0 in Gmsh)");
    static_cast<void>(words_.integer("the data size"));
  }

  void read_names() {
    for (long n = words_.count("the number of names"); n > 0; --n) {
      const auto dimension = static_cast<int>(words_.integer("a dimension"));
      const long tag = words_.integer("a physical tag");
      std::string name = words_.quoted("the name of a physical group");
      if (dimension < 2 && !name.empty() && name.find_first_not_of("0123456789") == std::string::npos)
        words_.fail(
            fmt::format("found a physical group named \"{}\", expected a name that contains a character "
                        "other than a digit, because numbers denote nodes",
                        name));
      content_.names[{dimension, tag}] = std::move(name);
    }
  }

  void read_entities() {
    std::array<long, 4> counts{};
    for (long& n : counts) n = words_.count("the number of entities");
    for (int dimension = 0; dimension < 4; ++dimension)
      for (long n = counts[static_cast<std::size_t>(dimension)]; n > 0; --n) {
        const long tag = words_.integer("the tag of an entity");
        for (int i = 0; i < (dimension == 0 ? 3 : 6); ++i) static_cast<void>(words_.number("a coordinate"));
        std::vector<long>& groups = content_.groups_of_entity[{dimension, tag}];
        for (long k = words_.count("the number of physical groups of an entity"); k > 0; --k)
          groups.push_back(std::abs(words_.integer("a physical tag")));
        if (dimension == 0) continue;
        for (long k = words_.count("the number of bounding entities"); k > 0; --k)
          static_cast<void>(words_.integer("the tag of an entity"));
      }
  }

  void add_node(long number, SourcePlace place, double x, double y, double z) {
    if (!content_.node_index.emplace(number, static_cast<int>(content_.nodes.size())).second)
      words_.fail(fmt::format("found node {} twice, expected each node once", number));
    if (content_.nodes.empty()) z_ = z;
    if (z != z_)
      words_.fail(fmt::format("found z = {:.6g} of node {}, expected {:.6g} for all nodes of a plane mesh", z,
                              number, z_));
    content_.nodes.push_back({x, y, number, std::move(place)});
  }

  void read_nodes() {
    long blocks = words_.count("the number of blocks");
    for (int i = 0; i < 3; ++i) static_cast<void>(words_.integer("the number of nodes, or a tag"));
    for (; blocks > 0; --blocks) {
      const long dimension = words_.integer("a dimension");
      static_cast<void>(words_.integer("the tag of an entity"));
      const bool parametric = words_.integer("0 or 1") != 0;
      std::vector<std::pair<long, SourcePlace>> numbers(
          static_cast<std::size_t>(words_.count("the number of nodes of a block")));
      for (auto& [number, place] : numbers) {
        number = words_.integer("the tag of a node");
        place = words_.place();
      }
      for (auto& [number, place] : numbers) {
        const double x = words_.number("x"), y = words_.number("y"), z = words_.number("z");
        for (long i = 0; parametric && i < dimension; ++i) static_cast<void>(words_.number("a parameter"));
        add_node(number, words_.place(), x, y, z);
      }
    }
  }

  void read_old_nodes() {
    for (long n = words_.count("the number of nodes"); n > 0; --n) {
      const long number = words_.integer("the number of a node");
      const double x = words_.number("x"), y = words_.number("y"), z = words_.number("z");
      add_node(number, words_.place(), x, y, z);
    }
  }

  const GmshType& type_of(long number, long element) const {
    const auto found = std::find_if(gmsh_types.begin(), gmsh_types.end(),
                                    [number](const GmshType& t) { return t.number == number; });
    if (found != gmsh_types.end()) return *found;
    const std::string hint = number == 10 ? " (nine nodes: set Mesh.SecondOrderIncomplete = 1 in Gmsh)" : "";
    words_.fail(
        fmt::format("element {} has type {}{}, expected points (15), lines (1, 8), triangles (2, 9) or "
                    "quadrilaterals (3, 16)",
                    element, number, hint));
  }

  void read_element(const GmshType& type, long number, std::vector<long> physical) {
    RawElement element{&type, {}, std::move(physical), number, words_.place()};
    for (std::size_t i = 0; i < type.nodes; ++i) {
      const long node = words_.integer("the number of a node");
      const auto known = content_.node_index.find(node);
      if (known == content_.node_index.end())
        words_.fail(fmt::format("element {} has node {}, which is not in $Nodes", number, node));
      element.nodes.push_back(known->second);
    }
    content_.elements.push_back(std::move(element));
  }

  void read_elements() {
    long blocks = words_.count("the number of blocks");
    for (int i = 0; i < 3; ++i) static_cast<void>(words_.integer("the number of elements, or a tag"));
    for (; blocks > 0; --blocks) {
      const auto dimension = static_cast<int>(words_.integer("a dimension"));
      const long entity = words_.integer("the tag of an entity"), type = words_.integer("a type of elements");
      const long n = words_.count("a number of elements");
      for (long i = 0; i < n; ++i) {
        const long number = words_.integer("the tag of an element");
        read_element(type_of(type, number), number, content_.groups_of_entity[{dimension, entity}]);
      }
    }
  }

  void read_old_elements() {
    for (long n = words_.count("the number of elements"); n > 0; --n) {
      const long number = words_.integer("the number of an element"),
                 type = words_.integer("a type of elements");
      std::vector<long> physical;
      const long tags = words_.count("a number of tags");
      for (long i = 0; i < tags; ++i) {
        const long tag = words_.integer("a tag");
        if (i == 0 && tag != 0) physical.push_back(std::abs(tag));
      }
      read_element(type_of(type, number), number, std::move(physical));
    }
  }

  GmshTokenizer words_;
  GmshContent content_;
  int version_ = 0;
  double z_ = 0.0;
};

/// Builds the mesh of one body, with its groups of edges and nodes.
class BodyBuilder {
 public:
  BodyBuilder(const GmshContent& content, const std::string& file, const std::string& key)
      : content_(content), file_(file), key_(key), index_(content.nodes.size(), -1) {}

  PlaneMesh build(const std::vector<std::string>& surfaces) {
    check_used();
    add_elements(surfaces);
    check_elements(mesh_, key_);
    add_edges(mesh_.elements, edges_);
    for (const RawElement& raw : content_.elements)
      if (raw.type->dimension < 2) add_to_groups(raw);
    check_boundaries();
    return std::move(mesh_);
  }

 private:
  void check_used() const {
    std::vector<bool> used(content_.nodes.size(), false);
    for (const RawElement& raw : content_.elements)
      for (const int n : raw.nodes) used[static_cast<std::size_t>(n)] = true;
    for (std::size_t i = 0; i < used.size(); ++i)
      if (!used[i])
        throw SceneError(
            content_.nodes[i].place, key_,
            fmt::format("node {} belongs to no element: remove it from the mesh", content_.nodes[i].number));
  }

  void add_elements(const std::vector<std::string>& surfaces) {
    std::set<std::string> there, used;
    std::set<std::vector<int>> known;  // format 2.2 lists an element once per group
    for (const RawElement& raw : content_.elements) {
      if (!raw.type->shape) continue;
      bool wanted = surfaces.empty();
      for (const long tag : raw.physical) {
        const std::string name = content_.name(2, tag);
        there.insert(name);
        if (std::find(surfaces.begin(), surfaces.end(), name) == surfaces.end()) continue;
        wanted = true;
        used.insert(name);
      }
      std::vector<int> sorted = raw.nodes;
      std::sort(sorted.begin(), sorted.end());
      if (!wanted || !known.insert(std::move(sorted)).second) continue;
      PlaneMesh::Element element{*raw.type->shape, {}, raw.number, raw.place};
      for (const int n : raw.nodes) element.nodes.push_back(index_of(n));
      mesh_.elements.push_back(std::move(element));
    }
    for (const std::string& name : surfaces)
      if (!used.contains(name)) {
        std::string all;
        for (const std::string& have : there) all += (all.empty() ? "" : ", ") + have;
        throw SceneError(
            {file_, 0, 0}, key_,
            fmt::format("no physical surface is named \"{}\"; known: {}", name, all.empty() ? "none" : all));
      }
    if (mesh_.elements.empty())
      throw SceneError({file_, 0, 0}, key_, "found no triangles or quadrilaterals, expected a plane mesh");
  }

  int index_of(int node) {
    int& own = index_[static_cast<std::size_t>(node)];
    if (own < 0) {
      own = static_cast<int>(mesh_.nodes.size());
      mesh_.nodes.push_back(content_.nodes[static_cast<std::size_t>(node)]);
    }
    return own;
  }

  PlaneMesh::Group& group(const std::string& name) {
    for (PlaneMesh::Group& g : mesh_.groups)
      if (g.name == name) return g;
    return mesh_.groups.emplace_back(PlaneMesh::Group{name, {}, {}});
  }

  void add_to_groups(const RawElement& raw) {
    std::vector<int> nodes;
    for (const int n : raw.nodes) {
      const int own = index_[static_cast<std::size_t>(n)];
      if (own < 0) return;  // the line or point belongs to another body
      nodes.push_back(own);
    }
    const SharedEdge* edge = nullptr;
    if (raw.type->dimension == 1) {
      const auto found = edges_.find(std::minmax(nodes[0], nodes[1]));
      if (found == edges_.end()) {
        check_is_edge(raw);
        return;
      }
      edge = &found->second;
    }
    for (const long tag : raw.physical) {
      const std::string name = content_.name(raw.type->dimension, tag);
      PlaneMesh::Group& g = group(name);
      if (edge && edge->elements > 1)
        inner_lines_.try_emplace(name, &raw);
      else if (edge && taken_.insert({name, edge}).second)  // format 2.2 lists a line once per group
        g.edges.push_back({edge->nodes});
      for (const int n : edge ? edge->nodes : nodes)
        if (in_group_.insert({name, n}).second) g.nodes.push_back(n);
    }
  }

  /// Errors: SceneError if a line of a physical curve is not an edge of an element; the boundary would have a hole there.
  void check_is_edge(const RawElement& line) const {
    for (const RawElement& raw : content_.elements) {
      if (!raw.type->shape) continue;
      const PlaneMesh::Element element{*raw.type->shape, raw.nodes, raw.number, raw.place};
      for (std::size_t i = 0; i < corner_count(element.shape); ++i)
        if (const std::vector<int> ends = edge_nodes(element, i);
            std::minmax(ends[0], ends[1]) == std::minmax(line.nodes[0], line.nodes[1]))
          return;
    }
    const auto number = [&](std::size_t i) {
      return content_.nodes[static_cast<std::size_t>(line.nodes[i])].number;
    };
    throw SceneError(line.place, key_,
                     fmt::format("line {} from node {} to node {} is not an edge of an element: expected "
                                 "lines along edges of the mesh",
                                 line.number, number(0), number(1)));
  }

  /// Errors: SceneError if a physical curve lies partly on the boundary and partly inside the body. Inside the body, a curve
  /// only selects nodes.
  void check_boundaries() const {
    for (const PlaneMesh::Group& g : mesh_.groups)
      if (const auto inside = inner_lines_.find(g.name); !g.edges.empty() && inside != inner_lines_.end())
        throw SceneError(inside->second->place, key_,
                         fmt::format("line {} of the physical curve \"{}\" has elements on both sides, but "
                                     "other lines of this curve bound the body: give each part its own group",
                                     inside->second->number, g.name));
  }

  const GmshContent& content_;
  const std::string &file_, &key_;
  std::vector<int> index_;
  PlaneMesh mesh_;
  SharedEdges edges_;
  std::set<std::pair<std::string, const SharedEdge*>> taken_;
  std::set<std::pair<std::string, int>> in_group_;
  std::map<std::string, const RawElement*> inner_lines_;  ///< per group: one of its lines inside the body
};

/// The smallest and the largest Jacobian determinant at nodes and integration points.
std::pair<double, double> determinants(const PlaneMesh& mesh, const PlaneMesh::Element& element) {
  std::pair<double, double> range{std::numeric_limits<double>::infinity(),
                                  -std::numeric_limits<double>::infinity()};
  const auto look = [&](double a, double b) {
    const ShapeValues shapes = shape_functions(element.shape, a, b);
    Eigen::Matrix2d j = Eigen::Matrix2d::Zero();
    for (std::size_t k = 0; k < element.nodes.size(); ++k) {
      const PlaneMesh::Node& node = mesh.nodes[static_cast<std::size_t>(element.nodes[k])];
      j += Eigen::Vector2d(node.x, node.y) * shapes.gradients.row(static_cast<Eigen::Index>(k));
    }
    const double det = j(0, 0) * j(1, 1) - j(0, 1) * j(1, 0);
    range = {std::min(range.first, det), std::max(range.second, det)};
  };
  for (const IntegrationPoint& p : integration_points(element.shape)) look(p.a, p.b);
  for (std::size_t i = 0; i < element.nodes.size(); ++i) {
    const auto [a, b] = node_coordinates(element.shape, i);
    look(a, b);
  }
  return range;
}

void reverse_orientation(PlaneMesh::Element& element) {
  const auto corners = static_cast<std::ptrdiff_t>(corner_count(element.shape));
  std::reverse(element.nodes.begin() + 1, element.nodes.begin() + corners);
  std::reverse(element.nodes.begin() + corners, element.nodes.end());
}

}  // namespace

void check_elements(PlaneMesh& mesh, const std::string& key) {
  const bool clockwise = std::all_of(mesh.elements.begin(), mesh.elements.end(), [&](const auto& element) {
    return determinants(mesh, element).second < 0.0;
  });
  for (PlaneMesh::Element& element : mesh.elements) {
    if (clockwise) reverse_orientation(element);
    const auto [least, most] = determinants(mesh, element);
    if (least > 0.0) continue;
    throw SceneError(
        element.place, key,
        fmt::format("element {} is {}: expected nodes that run counter-clockwise around a convex shape",
                    element.number,
                    most < 0.0 ? "inverted (its nodes run clockwise, those of other elements do not)"
                               : "folded or flat"));
  }
}

PlaneMesh read_gmsh(std::istream& in, const std::string& file, const std::string& key,
                    const std::vector<std::string>& surfaces) {
  const GmshContent content = GmshReader(in, file, key).read();
  return BodyBuilder(content, file, key).build(surfaces);
}

}  // namespace signorini::mesh
