#include "model/statics/statics.hpp"

#include <fmt/core.h>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "base/eigen_dense.hpp"
#include "linear/sparse_cholesky.hpp"
#include "model/assembly/motion_names.hpp"
#include "model/assembly/springs.hpp"
#include "model/statics/free_motions.hpp"
#include "model/statics/mechanism_check.hpp"
#include "model/statics/mechanisms.hpp"
#include "model/statics/static_system.hpp"

namespace signorini::statics {
namespace {

constexpr double only_touches =
    1e-13;  // smaller gaps, relative to the largest translation, are rounding errors

struct Trial {
  std::vector<FreeMotion> held;
  Vector u;
  std::vector<double> reactions = {};
  int driven = -1;     ///< index into held, -1: none
  double force = 0.0;  ///< force along the driven motion

  [[nodiscard]] const FreeMotion& driven_motion() const { return held[static_cast<std::size_t>(driven)]; }
};

Trial attempt(const StaticProblem& problem, const std::vector<bool>& closed) {
  Trial trial;
  trial.held = constrain_free_motions(problem, null_motions(problem.matrix(closed)), closed);
  ConstrainedState state = solve_constrained(problem, closed, trial.held);
  trial.u = std::move(state.u);
  trial.reactions = std::move(state.reactions);
  // Motions that no contact fixes come first: their message is more specific than that of a motion fixed by friction.
  std::vector<std::size_t> order(trial.held.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_partition(order.begin(), order.end(),
                        [&](std::size_t j) { return trial.held[j].contacts.empty(); });
  const SparseMatrix k = problem.matrix(closed);
  const Vector p = problem.right_side(closed);
  for (const std::size_t j : order) {
    if (trial.driven >= 0) break;
    const Vector& motion = trial.held[j].motion;
    const double work = driving_work(problem, k, p, motion, trial.u);
    if (work == 0.0) continue;
    const double size = assembly::max_translation(motion, problem.map);
    trial.driven = static_cast<int>(j);
    trial.force = size > 0.0 ? std::abs(work) / size : std::abs(work);
  }
  return trial;
}

[[noreturn]] void refuse_driven(const StaticProblem& problem, const std::vector<bool>& all,
                                const Trial& found, const SourcePlace& place, const std::string& unit,
                                const char* key) {
  const Trial gripped = attempt(problem, all);
  if (gripped.driven >= 0) {
    const std::string name = assembly::describe_motion(gripped.driven_motion().motion, problem.map);
    const std::vector<std::size_t>& holders = gripped.driven_motion().contacts;
    const std::string hold = holders.empty()
                                 ? "nothing restrains this motion"
                                 : fmt::format(
                                       "only friction at {} could prevent this motion, and initial "
                                       "= \"static\" has no friction; use initial = \"frictional\"",
                                       names_of_contacts(problem.contacts, holders));
    throw SceneError(place, key,
                     fmt::format("no static equilibrium: the static loads drive the {} with {:.4g} {}; {}",
                                 name, gripped.force, unit, hold));
  }
  std::string pulls;
  for (std::size_t k = 0; k < problem.contacts.size(); ++k) {
    const Contact& c = problem.contacts[k];
    const double pull =
        c.takes_impulses() ? -gripped.reactions[k] : problem.normal_stiffness(k) * problem.gap(k, gripped.u);
    if (!problem.is_support(k) || !(pull > 0.0)) continue;
    pulls += fmt::format("{}contact '{}' would have to pull with {:.4g} {}", pulls.empty() ? "" : ", ",
                         c.name, pull, unit);
  }
  throw SceneError(place, key,
                   fmt::format("no static equilibrium: {}; contacts cannot pull, so the static loads drive "
                               "the {}. Check the directions of gravity and of constant loads",
                               pulls.empty() ? "the closed contacts do not restrain the structure" : pulls,
                               assembly::describe_motion(found.driven_motion().motion, problem.map)));
}

/// Returns a factor for the springs of rigid contacts. If only these contacts prevent a motion of negative energy, their
/// springs must be stiff. Motions of negative energy that only friction prevents may remain.
double find_rigid_stiffness_factor(StaticProblem problem, const std::vector<bool>& closed) {
  double best = 1.0;
  Eigen::Index least = null_motions(problem.matrix(closed)).cols();
  for (const double firmness : {1e2, 1e4, 1e6}) {
    if (least == 0) break;
    problem.rigid_stiffness_factor = firmness;
    const Eigen::Index left = null_motions(problem.matrix(closed)).cols();
    if (left < least) best = firmness;
    least = std::min(least, left);
  }
  return best;
}

/// Diagonal of the rectangle around the nodes; 0 in matrix scenes.
double size_of_structure(const assembly::DofMap& map) {
  double low[2] = {0.0, 0.0}, high[2] = {0.0, 0.0};
  bool first = true;
  for (const element::MeshNode& node : map.mesh.nodes) {
    const double at[2] = {node.x, node.y};
    for (int i = 0; i < 2; ++i) {
      low[i] = first ? at[i] : std::min(low[i], at[i]);
      high[i] = first ? at[i] : std::max(high[i], at[i]);
    }
    first = false;
  }
  return std::hypot(high[0] - low[0], high[1] - low[1]);
}

/// Part of u along the motions (n x m), least squares of the displacements; size: length that rotations are multiplied with.
Vector part_along(const Eigen::MatrixXd& motions, const Vector& u, const assembly::DofMap& map, double size) {
  Vector lengths(u.size());
  for (int i = 0; i < u.size(); ++i) lengths[i] = map.dofs[static_cast<std::size_t>(i)].rotation ? size : 1.0;
  return motions * base::least_squares(Eigen::MatrixXd(lengths.asDiagonal() * motions),
                                       Eigen::VectorXd(lengths.cwiseProduct(u)));
}

/// Errors: SceneError if a motion that only contacts without force resist goes farther than the structure is large. Such a
/// motion is a mechanism: a contact closes its gap by a lever that may be short, and no force says how far the motion goes.
void refuse_far_motion(const StaticProblem& problem, const std::vector<bool>& closed, const Trial& trial,
                       const SourcePlace& place, const std::string& unit, const char* key) {
  double size = size_of_structure(problem.map);
  if (!(size > 0.0)) return;
  for (const Contact& c : problem.contacts) size = std::max(size, std::abs(c.gap));
  if (assembly::max_translation(trial.u, problem.map) <= size) return;
  std::vector<bool> loaded = closed;
  for (std::size_t k = 0; k < loaded.size(); ++k)
    loaded[k] = closed[k] && !has_no_reaction(problem, k, trial.reactions[k]);
  const Eigen::MatrixXd motions = null_motions(problem.matrix(loaded));
  if (motions.cols() == 0) return;
  const Vector motion = part_along(motions, trial.u, problem.map, size);
  const double way = assembly::max_translation(motion, problem.map);
  if (way <= size) return;
  throw SceneError(
      place, key,
      fmt::format("a static start is impossible, the structure is a mechanism: no force restrains the {}, "
                  "which would move a node by {:.4g} {}, but the structure and its gaps are only {:.4g} {} "
                  "large; add a support, a spring or a contact, or give the initial state",
                  assembly::describe_motion(motion, problem.map), way, unit, size, unit));
}

std::string motion_name(const StaticProblem& problem, const FreeMotion& f) {
  const std::string name = assembly::describe_motion(f.motion, problem.map);
  if (f.contacts.empty()) return name + ", which no contact restrains, set to zero at the start";
  return fmt::format("{} held at {}", name, names_of_contacts(problem.contacts, f.contacts));
}

}  // namespace

Equilibrium find_equilibrium(const SparseMatrix& stiffness, const Vector& load,
                             const std::vector<Contact>& contacts, const assembly::DofMap& map,
                             const SourcePlace& place, const Units& units, const EquilibriumSearch& search) {
  StaticProblem problem{stiffness, load, contacts, map, 1.0};
  std::vector<bool> all(contacts.size(), false);
  for (std::size_t k = 0; k < all.size(); ++k) all[k] = problem.is_support(k);
  if (!search.mechanisms) refuse_mechanisms(problem, all, place, search.key);

  std::vector<bool> closed = search.closed ? *search.closed : closed_supports(problem);
  if (search.closed) problem.rigid_stiffness_factor = find_rigid_stiffness_factor(problem, closed);
  // A closed contact without force could displace a free motion, so the contact opens, once. If its gap is then
  // negative, it closes again and stays closed.
  std::vector<bool> opened(contacts.size(), false);
  // The weak support of closed_supports() is absent here, so a contact that barely touches may change its state in every
  // round; after 20 rounds either state is acceptable.
  for (int round = 0;; ++round) {
    const Trial trial = attempt(problem, closed);
    if (trial.driven >= 0) refuse_driven(problem, all, trial, place, units.force, search.key);
    std::vector<bool> next = closed;
    const double size = trial.u.size() == 0 ? 0.0 : assembly::max_translation(trial.u, map);
    for (std::size_t k = 0; k < next.size(); ++k) {
      if (!problem.is_support(k)) continue;
      const double g = problem.gap(k, trial.u);
      // A contact that barely touches may have either state.
      if (closed[k] && has_no_reaction(problem, k, trial.reactions[k])) {
        next[k] = opened[k];
        opened[k] = true;
      } else if (closed[k] && contacts[k].takes_impulses()) {
        next[k] = trial.reactions[k] > 0.0;
      } else if (std::abs(g) > only_touches * (size + std::abs(contacts[k].gap))) {
        next[k] = g < 0.0;
      }
    }
    if (next == closed || round == 20) {
      refuse_far_motion(problem, closed, trial, place, units.length, search.key);
      Equilibrium result{trial.u, {}, closed};
      for (std::size_t k = 0; k < contacts.size(); ++k)
        result.start.reactions.push_back(std::max(0.0, trial.reactions[k]));
      for (const FreeMotion& f : trial.held) result.start.free_motions.push_back(motion_name(problem, f));
      return result;
    }
    closed = next;
  }
}

namespace {

// Weak support, relative to the diagonal: makes the matrix regular, and is negligible relative to contact springs.
constexpr double no_stiffness = 1e-12;

std::vector<bool> closed_at(const StaticProblem& problem, const Vector& u) {
  std::vector<bool> closed(problem.contacts.size(), false);
  for (std::size_t k = 0; k < closed.size(); ++k)
    closed[k] = problem.is_support(k) && problem.gap(k, u) < 0.0;
  return closed;
}

/// Slope of the energy at u along d; k0 is the matrix without contacts.
double slope(const StaticProblem& problem, const SparseMatrix& k0, const Vector& u, const Vector& d) {
  double s = d.dot(k0 * u - problem.load);
  for (std::size_t k = 0; k < problem.contacts.size(); ++k)
    if (problem.is_support(k))
      s += problem.normal_stiffness(k) * std::min(problem.gap(k, u), 0.0) * problem.contacts[k].normal.dot(d);
  return s;
}

/// The step a > 0 that minimises the energy along d. The slope is piecewise linear in a and increasing, with kinks
/// where a contact opens or closes.
double best_step(const StaticProblem& problem, const SparseMatrix& k0, const Vector& u, const Vector& d) {
  std::vector<double> bends;
  for (std::size_t k = 0; k < problem.contacts.size(); ++k) {
    if (!problem.is_support(k)) continue;
    const double rate = problem.contacts[k].normal.dot(d);
    const double a = rate == 0.0 ? 0.0 : -problem.gap(k, u) / rate;
    if (a > 0.0 && std::isfinite(a)) bends.push_back(a);
  }
  std::sort(bends.begin(), bends.end());
  bends.push_back(std::max(1.0, bends.empty() ? 0.0 : 2.0 * bends.back()));
  double left = 0.0, left_slope = slope(problem, k0, u, d);
  for (std::size_t i = 0; i < bends.size(); ++i) {
    const double right_slope = slope(problem, k0, u + bends[i] * d, d);
    const bool last = i + 1 == bends.size();
    if (right_slope >= 0.0 || last) {
      const double bend = right_slope - left_slope;
      return bend > 0.0 ? left - left_slope * (bends[i] - left) / bend : bends[i];
    }
    left = bends[i];
    left_slope = right_slope;
  }
  return 1.0;
}

/// Weak springs on all degrees of freedom. No contact acts on a degree of freedom with a zero row, so any stiffness is
/// suitable there.
SparseMatrix weak_support(const SparseMatrix& k) {
  const Vector d = k.diagonal().cwiseAbs();
  SparseMatrix weak(k.rows(), k.cols());
  weak.reserve(Eigen::VectorXi::Constant(k.cols(), 1));
  for (int i = 0; i < d.size(); ++i) weak.insert(i, i) = no_stiffness * (d[i] > 0.0 ? d[i] : 1.0);
  return weak;
}

}  // namespace

std::vector<bool> closed_supports(const StaticProblem& problem) {
  std::vector<bool> closed(problem.contacts.size(), false);
  for (std::size_t k = 0; k < closed.size(); ++k) closed[k] = problem.is_support(k);
  const SparseMatrix weak = weak_support(problem.matrix(closed));
  const SparseMatrix k0 = problem.stiffness + weak;
  Vector u = Vector::Zero(problem.size());
  const std::size_t rounds = 100 + 10 * closed.size();
  for (std::size_t round = 0; round < rounds; ++round) {
    const Vector target =
        linear::SymmetricSolver(problem.matrix(closed) + weak).solve(problem.right_side(closed));
    const std::vector<bool> next = closed_at(problem, target);
    if (next == closed) return closed;
    if (round == 0) {  // the first u is the equilibrium with all contacts closed
      u = target;
    } else {
      const Vector d = target - u;
      u += best_step(problem, k0, u, d) * d;
    }
    const std::vector<bool> reached = closed_at(problem, u);
    if (reached == closed) return closed;  // the energy is minimal: only contacts that barely touch differ
    closed = reached;
  }
  return closed;  // only contacts that barely touch differ: the caller tries both states
}

}  // namespace signorini::statics
