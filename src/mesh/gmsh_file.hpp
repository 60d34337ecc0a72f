// gmsh_file.hpp: plane meshes of Gmsh, .msh 4.1 and 2.2, ASCII.
//
//   $PhysicalNames   dimension tag "name"        names of groups of surfaces, curves and points
//   elements         1 line2  8 line3  15 point  2 t3  9 t6  3 q4  16 q8; others are refused
//
// A body consists of the elements of some or of all physical surfaces. Its groups are the physical curves
// and points with nodes of these elements. Nodes that the body does not use are omitted; a node that no
// element of the file uses is refused. If all elements run clockwise, they are reversed. If only some of them run
// clockwise, or a Jacobian is not positive at a node, the mesh folds and is refused.
// Source: Gmsh reference manual, sections "MSH file format version 4.1" and "version 2 (Legacy)".
#pragma once

#include <iosfwd>
#include <istream>
#include <string>
#include <vector>

#include "signorini/error.hpp"
#include "signorini/plane_mesh.hpp"

namespace signorini::mesh {

// Reads the words of a mesh file one by one, with their line numbers.
//
//   GmshTokenizer words(in, file, key);   while (words.next_section(name)) ... words.integer() ... words.number()

/// Splits a mesh file into words. Argument `what` of its functions: description of the expected word, for messages. key: the
/// key of the scene that names the mesh file.
class GmshTokenizer {
 public:
  GmshTokenizer(std::istream& in, std::string file, std::string key)
      : in_(in), file_(std::move(file)), key_(std::move(key)) {}

  /// Reads the next "$Name"; returns false at the end of the file.
  bool next_section(std::string& name);
  /// Skips all words up to and including "$EndName".
  void skip_section(const std::string& name);
  /// Reads "$EndName"; any other word is an error.
  void end_section(const std::string& name);

  /// Reads the next word as an integer. All functions that read throw a SceneError at the line of the file.
  [[nodiscard]] long integer(const char* what);
  /// Reads the next word as an integer from 0 to 10 million.
  [[nodiscard]] long count(const char* what);
  [[nodiscard]] double number(const char* what);
  /// Reads the next text in quotes; returns it without the quotes.
  [[nodiscard]] std::string quoted(const char* what);

  [[nodiscard]] SourcePlace place() const { return {file_, line_, 0}; }
  [[noreturn]] void fail(const std::string& message) const { throw SceneError(place(), key_, message); }

 private:
  /// Reads the next word; returns "" at the end of the file.
  std::string token();

  std::istream& in_;
  std::string file_, key_;
  int line_ = 1;
};

/// Reads the mesh of a body. surfaces: names of the physical surfaces that form the body; empty: all surfaces. Errors:
/// SceneError at the line of the file, with a message that begins with `key`.
[[nodiscard]] PlaneMesh read_gmsh(std::istream& in, const std::string& file, const std::string& key,
                                  const std::vector<std::string>& surfaces);

/// Throws a SceneError at the element's place unless all determinants of the Jacobian at nodes and
/// integration points are > 0. Reverses the elements first if all run clockwise.
void check_elements(PlaneMesh& mesh, const std::string& key);

}  // namespace signorini::mesh
