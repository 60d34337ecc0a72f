#include "model/statics/mechanism_check.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <string>

#include "model/assembly/motion_names.hpp"
#include "model/assembly/parts.hpp"
#include "model/assembly/springs.hpp"
#include "model/statics/mechanisms.hpp"

namespace signorini::statics {
namespace {

/// Motions without stiffness of one uncoupled part, in the simplest basis.
struct PartMotions {
  const assembly::Part* part;
  Eigen::MatrixXd motions;
};

/// Sorts the columns of `null`, each of which moves one part only.
std::vector<PartMotions> motions_by_part(const Eigen::MatrixXd& null, const assembly::Parts& parts,
                                         const assembly::DofMap& map) {
  std::vector<PartMotions> result;
  for (const assembly::Part& part : parts) {
    std::vector<Eigen::Index> own;
    for (Eigen::Index j = 0; j < null.cols(); ++j)
      if (std::any_of(part.dofs().begin(), part.dofs().end(), [&](int i) { return null(i, j) != 0.0; }))
        own.push_back(j);
    if (own.empty()) continue;
    Eigen::MatrixXd columns(null.rows(), static_cast<Eigen::Index>(own.size()));
    for (Eigen::Index j = 0; j < columns.cols(); ++j)
      columns.col(j) = null.col(own[static_cast<std::size_t>(j)]);
    result.push_back({&part, simple_motions(columns, map, part.dofs())});
  }
  return result;
}

/// Errors: SceneError if a part has so many elements that K may lose all digits: EI / h^3 exceeds EI / L^3 by a factor above
/// 1e16. A motion that seems to be free may then be a slow bending motion. A rigid motion of a part is not.
void refuse_roundoff(const std::vector<PartMotions>& found, const assembly::DofMap& map,
                     const SourcePlace& place, const char* key) {
  constexpr int few = 10000;  // unknowns of beams, the most sensitive elements
  for (const PartMotions& part : found) {
    if (3 * part.part->size() <= 2 * few) continue;  // bending of a beam: two thirds of its unknowns
    for (Eigen::Index j = 0; j < part.motions.cols(); ++j) {
      const Vector motion = part.motions.col(j);
      if (assembly::is_rigid(motion, map, part.part->dofs())) continue;
      throw SceneError(
          place, key,
          fmt::format(
              "a static start is impossible: with {} degrees of freedom the stiffness is so "
              "ill-conditioned that roundoff hides whether anything restrains the {}; if nothing does, add a "
              "support, a spring or a contact, otherwise use fewer elements, or give the initial state",
              map.size(), assembly::describe_motion(motion, map)));
    }
  }
}

/// Names of at most three motions: of the whole structure if it is free as a whole, otherwise of its parts.
std::string names_of(const Eigen::MatrixXd& null, const std::vector<PartMotions>& found, std::size_t parts,
                     const assembly::DofMap& map) {
  std::vector<std::string> names;
  const Eigen::MatrixXd whole = simple_motions(null, map);
  if (parts == 1 || assembly::is_rigid(whole.col(0), map)) {
    for (Eigen::Index j = 0; j < whole.cols(); ++j)
      names.push_back(assembly::describe_motion(whole.col(j), map));
  } else {
    for (const PartMotions& part : found)
      for (Eigen::Index j = 0; j < part.motions.cols(); ++j)
        names.push_back(assembly::describe_motion_of_part(part.motions.col(j), map, part.part->dofs()));
  }
  std::string text = names.front();
  for (std::size_t j = 1; j < std::min<std::size_t>(names.size(), 3); ++j) text += ", " + names[j];
  if (names.size() > 3) text += fmt::format(" and {} more", names.size() - 3);
  return text;
}

}  // namespace

void refuse_mechanisms(const StaticProblem& problem, const std::vector<bool>& all, const SourcePlace& place,
                       const char* key) {
  std::vector<assembly::LineSpring> grips;
  const SparseMatrix k = problem.matrix(all);
  for (const Contact& c : problem.contacts)
    if (!c.tangent.terms.empty()) grips.push_back({c.tangent, structural_stiffness(k, c.tangent)});
  const SparseMatrix held = assembly::with_springs(k, grips);
  const Eigen::MatrixXd null = null_motions(held);
  if (null.cols() == 0) return;
  const assembly::Parts parts({&held});
  const std::vector<PartMotions> found = motions_by_part(null, parts, problem.map);
  refuse_roundoff(found, problem.map, place, key);
  throw SceneError(
      place, key,
      fmt::format("a static start is impossible, the structure is a mechanism: nothing restrains the {}; add "
                  "a support, a spring or a contact, or give the initial state",
                  names_of(null, found, parts.count(), problem.map)));
}

}  // namespace signorini::statics
