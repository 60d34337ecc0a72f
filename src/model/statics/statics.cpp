#include "model/statics/statics.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "model/assembly/motion_names.hpp"
#include "model/assembly/springs.hpp"
#include "model/statics/null_motions.hpp"
#include "model/statics/simple_motions.hpp"
#include "model/statics/static_system.hpp"
#include "model/statics/unilateral.hpp"

namespace signorini {
namespace {

constexpr double only_touches = 1e-13;  // relative to the largest translation: rounding of a gap
constexpr double no_reaction = 1e-9;    // relative to the largest load: less drives no free motion

struct Trial {
  std::vector<FreeMotion> held;
  Vector u;
  std::vector<double> reactions = {};
  int driven = -1;     ///< index into held, -1: none
  double force = 0.0;  ///< force that drives it

  [[nodiscard]] const FreeMotion& driven_motion() const { return held[static_cast<std::size_t>(driven)]; }
};

Trial attempt(const StaticProblem& problem, const std::vector<bool>& closed) {
  Trial trial;
  trial.held = hold_motions(problem, null_motions(problem.matrix(closed)), closed);
  HeldState state = solve_held(problem, closed, trial.held);
  trial.u = std::move(state.u);
  trial.reactions = std::move(state.reactions);
  // Motions without a holding contact first: their message is more specific than that for one held by friction.
  std::vector<std::size_t> order(trial.held.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_partition(order.begin(), order.end(), [&](std::size_t j) { return trial.held[j].holder < 0; });
  const SparseMatrix k = problem.matrix(closed);
  const Vector p = problem.right_side(closed);
  for (const std::size_t j : order) {
    if (trial.driven >= 0) break;
    const Vector& motion = trial.held[j].motion;
    const double work = driving_work(problem, k, p, motion, trial.u);
    if (work == 0.0) continue;
    const double size = greatest_translation(motion, problem.map);
    trial.driven = static_cast<int>(j);
    trial.force = size > 0.0 ? std::abs(work) / size : std::abs(work);
  }
  return trial;
}

/// On extremely fine meshes K itself loses its digits: EI / h^3 over EI / L^3 exceeds 16 digits. A seemingly free
/// motion then is a slow bending, and naming it would mislead.
void refuse_roundoff(const StaticProblem& problem, const Eigen::MatrixXd& null, const SourcePlace& place,
                     const char* key) {
  if (problem.size() <= 10000) return;
  bool rigid = true;
  for (Eigen::Index j = 0; j < null.cols(); ++j) rigid = rigid && is_rigid(null.col(j), problem.map);
  if (rigid) return;
  throw SceneError(
      place, key,
      fmt::format("a static start is impossible: with {} degrees of freedom the stiffness is so "
                  "ill-conditioned that roundoff hides how the structure is held; use fewer elements, "
                  "or give the initial state (if the structure is a mechanism, fewer elements will "
                  "show which motion is unrestrained)",
                  problem.size()));
}

/// Refuses a motion that not even adhesive, sticking contacts could fix.
void refuse_mechanisms(const StaticProblem& problem, const std::vector<bool>& all, const SourcePlace& place,
                       const char* key) {
  std::vector<LineSpring> grips;
  const SparseMatrix k = problem.matrix(all);
  for (const Contact& c : problem.contacts)
    if (!c.tangent.terms.empty()) grips.push_back({c.tangent, own_stiffness(k, c.tangent)});
  const Eigen::MatrixXd null = simple_motions(null_motions(with_springs(k, grips)), problem.map);
  if (null.cols() == 0) return;
  refuse_roundoff(problem, null, place, key);
  std::string names = describe_motion(null.col(0), problem.map);
  for (Eigen::Index j = 1; j < std::min<Eigen::Index>(null.cols(), 3); ++j)
    names += ", " + describe_motion(null.col(j), problem.map);
  if (null.cols() > 3) names += fmt::format(" and {} more", null.cols() - 3);
  throw SceneError(
      place, key,
      fmt::format("a static start is impossible, the structure is a mechanism: nothing restrains the {}; add "
                  "a support, a spring or a contact, or give the initial state",
                  names));
}

[[noreturn]] void refuse_driven(const StaticProblem& problem, const std::vector<bool>& all,
                                const Trial& found, const SourcePlace& place, const std::string& unit,
                                const char* key) {
  const Trial gripped = attempt(problem, all);
  if (gripped.driven >= 0) {
    const std::string name = describe_motion(gripped.driven_motion().motion, problem.map);
    const int holder = gripped.driven_motion().holder;
    const std::string hold = holder < 0 ? "nothing restrains it"
                                        : fmt::format(
                                              "only friction at contact '{}' could prevent this, and initial "
                                              "= \"static\" has no friction; use initial = \"frictional\"",
                                              problem.contacts[static_cast<std::size_t>(holder)].name);
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
                   fmt::format("no static equilibrium: {}; without this pull the static loads drive the {}. "
                               "Check the directions of gravity and of constant loads",
                               pulls.empty() ? "the open contacts do not hold the structure" : pulls,
                               describe_motion(found.driven_motion().motion, problem.map)));
}

/// True if the work of the reaction along the contact's normal is below the limit.
bool carries_nothing(const StaticProblem& problem, std::size_t k, double reaction) {
  const double greatest = problem.size() == 0 ? 0.0 : problem.load.cwiseAbs().maxCoeff();
  double squares = 0.0, sum = 0.0;
  for (const auto& [dof, factor] : problem.contacts[k].normal.terms) {
    squares += factor * factor;
    sum += std::abs(factor);
  }
  return std::abs(reaction) * squares <= no_reaction * greatest * sum;
}

/// Rigid contacts are springs in the matrix. Negative energy that only they resist needs stiff springs; friction may
/// resist some of the remaining negative energy.
double firm_enough(StaticProblem problem, const std::vector<bool>& closed) {
  double best = 1.0;
  Eigen::Index least = null_motions(problem.matrix(closed)).cols();
  for (const double firmness : {1e2, 1e4, 1e6}) {
    if (least == 0) break;
    problem.firmness = firmness;
    const Eigen::Index left = null_motions(problem.matrix(closed)).cols();
    if (left < least) best = firmness;
    least = std::min(least, left);
  }
  return best;
}

std::string motion_name(const StaticProblem& problem, const FreeMotion& f) {
  const std::string name = describe_motion(f.motion, problem.map);
  if (f.holder < 0) return name + ", held by no contact, stays at zero";
  return fmt::format("{} held at contact '{}'", name,
                     problem.contacts[static_cast<std::size_t>(f.holder)].name);
}

}  // namespace

Equilibrium find_equilibrium(const SparseMatrix& stiffness, const Vector& load,
                             const std::vector<Contact>& contacts, const DofMap& map,
                             const SourcePlace& place, const Units& units, const EquilibriumSearch& search) {
  StaticProblem problem{stiffness, load, contacts, map, 1.0, search.mechanisms};
  std::vector<bool> all(contacts.size(), false);
  for (std::size_t k = 0; k < all.size(); ++k) all[k] = problem.is_support(k);
  if (!search.mechanisms) refuse_mechanisms(problem, all, place, search.key);

  std::vector<bool> closed = search.closed ? *search.closed : closed_supports(problem);
  if (search.closed) problem.firmness = firm_enough(problem, closed);
  // A contact without force may be closed only since Newton's method released rigid contacts, and would displace a free
  // motion: it opens, once. If its gap is negative without it, it closes for good.
  std::vector<bool> opened(contacts.size(), false);
  // Newton's method ended on a slightly supported structure; without that support a contact that barely touches may
  // change its state, and change back: after 20 rounds either state is acceptable.
  for (int round = 0;; ++round) {
    const Trial trial = attempt(problem, closed);
    if (trial.driven >= 0) refuse_driven(problem, all, trial, place, units.force, search.key);
    std::vector<bool> next = closed;
    const double size = trial.u.size() == 0 ? 0.0 : greatest_translation(trial.u, map);
    for (std::size_t k = 0; k < next.size(); ++k) {
      if (!problem.is_support(k)) continue;
      const double g = problem.gap(k, trial.u);
      // A contact that barely touches may have either state.
      if (closed[k] && carries_nothing(problem, k, trial.reactions[k])) {
        next[k] = opened[k];
        opened[k] = true;
      } else if (closed[k] && contacts[k].takes_impulses()) {
        next[k] = trial.reactions[k] > 0.0;
      } else if (std::abs(g) > only_touches * (size + std::abs(contacts[k].gap))) {
        next[k] = g < 0.0;
      }
    }
    if (next == closed || round == 20) {
      Equilibrium result{trial.u, {}, closed};
      for (std::size_t k = 0; k < contacts.size(); ++k)
        result.start.reactions.push_back(std::max(0.0, trial.reactions[k]));
      for (const FreeMotion& f : trial.held) result.start.free_motions.push_back(motion_name(problem, f));
      return result;
    }
    closed = next;
  }
}

}  // namespace signorini
