#include "model/statics/free_motions.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>

#include "base/eigen_dense.hpp"
#include "base/rounding.hpp"
#include "base/text.hpp"
#include "model/assembly/dofs.hpp"
#include "model/assembly/parts.hpp"
#include "model/assembly/springs.hpp"
#include "model/statics/mechanisms.hpp"

namespace signorini::statics {
namespace {

constexpr double static_pivot_limit = 1e-3;  // smallest accepted pivot, relative to the row's largest entry
// A contact can fix a motion of size 1 only if the motion causes at least this slip at the contact.
constexpr double holds = 1e-6;
// If the slips of contacts differ by less than this factor, the first contact fixes a motion: rounding does not choose between
// equal ones.
constexpr double clearly_more = 1.0 + 1e-6;
// A smaller work, relative to the largest load times the motion, does not drive a free motion.
constexpr double undriven = 1e-9;
constexpr double no_reaction = 1e-9;  // relative to the largest load: smaller reactions drive no motion
// Degrees of freedom up to which a structure is solved as a whole; larger structures are solved part by part.
constexpr int together_up_to = 300;

/// Returns unit rows that complete `rows` (p x m, independent) to m independent rows. Each row takes the first column with a
/// sufficient pivot, so that a contact fixes the horizontal motion rather than a combination with a rotation.
Eigen::MatrixXd other_motions(Eigen::MatrixXd rows) {
  std::vector<bool> taken(static_cast<std::size_t>(rows.cols()), false);
  for (Eigen::Index i = 0; i < rows.rows(); ++i) {
    Eigen::Index pivot = 0;
    while (std::abs(rows(i, pivot)) < static_pivot_limit * rows.row(i).cwiseAbs().maxCoeff()) ++pivot;
    taken[static_cast<std::size_t>(pivot)] = true;
    for (Eigen::Index k = i + 1; k < rows.rows(); ++k) {
      rows.row(k) -= rows(k, pivot) / rows(i, pivot) * rows.row(i);
      rows(k, pivot) = 0.0;
    }
  }
  Eigen::MatrixXd others = Eigen::MatrixXd::Zero(rows.cols() - rows.rows(), rows.cols());
  Eigen::Index row = 0;
  for (Eigen::Index j = 0; j < rows.cols(); ++j)
    if (!taken[static_cast<std::size_t>(j)]) others(row++, j) = 1.0;
  return others;
}

double size_of(const Combination& form) {
  double size = 0.0;
  for (const auto& [i, a] : form.terms) size = std::max(size, std::abs(a));
  return size;
}

/// Slips of the forms (k x m), each divided by the largest factor of its form; zero for a form without terms.
Eigen::MatrixXd slips_of(const std::vector<const Combination*>& forms, const Eigen::MatrixXd& motions) {
  Eigen::MatrixXd slips = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(forms.size()), motions.cols());
  for (Eigen::Index i = 0; i < slips.rows(); ++i) {
    const Combination& form = *forms[static_cast<std::size_t>(i)];
    const double size = size_of(form);
    for (Eigen::Index j = 0; j < slips.cols() && size > 0.0; ++j)
      slips(i, j) = form.dot(motions.col(j)) / size;
  }
  return slips;
}

/// Independent rows of `rows`, each the largest one without its part along those before; entries above `least`.
/// Afterwards `rows` are the parts that the chosen rows do not span.
std::vector<std::size_t> independent_rows(Eigen::MatrixXd& rows, double least) {
  std::vector<std::size_t> chosen;
  while (static_cast<Eigen::Index>(chosen.size()) < rows.cols()) {
    Eigen::Index best = -1;
    double most = least;
    for (Eigen::Index i = 0; i < rows.rows(); ++i)
      if (const double norm = rows.row(i).norm(); norm > (best < 0 ? least : clearly_more * most))
        best = i, most = norm;
    if (best < 0) break;
    const Eigen::VectorXd along = rows.row(best).transpose() / most;
    rows -= (rows * along) * along.transpose();
    rows.row(best).setZero();
    chosen.push_back(static_cast<std::size_t>(best));
  }
  return chosen;
}

}  // namespace

std::vector<std::size_t> fixing_forms(const Eigen::MatrixXd& motions,
                                      const std::vector<const Combination*>& forms) {
  Eigen::MatrixXd scaled = motions;
  for (Eigen::Index j = 0; j < scaled.cols(); ++j) scaled.col(j) /= scaled.col(j).cwiseAbs().maxCoeff();
  Eigen::MatrixXd slips = slips_of(forms, scaled);
  return independent_rows(slips, holds);
}

std::string names_of_contacts(const std::vector<Contact>& contacts, const std::vector<std::size_t>& list) {
  constexpr std::size_t shown = 4;
  std::vector<std::string> names;
  for (const std::size_t k : list) names.push_back(contacts[k].name);
  return (list.size() == 1 ? "contact " : "contacts ") + base::join_quoted(names, shown);
}

namespace {

/// Motions that move no node (rotations of hinged ends) are separated from the other motions, since no contact acts on
/// them. In a combination with other motions, rounding would leave a translation that a contact would seem to fix.
struct Turning {
  Eigen::MatrixXd others;    ///< motions that move nodes
  std::vector<int> dofs;     ///< degrees of freedom that the rotations in `free` do not move
  std::vector<Vector> free;  ///< motions that move no node, scaled to 1 at their largest entry

  Turning(const Eigen::MatrixXd& motions, const std::vector<int>& all, const assembly::DofMap& map) {
    std::vector<Eigen::Index> moving;
    std::vector<bool> turns(static_cast<std::size_t>(motions.rows()), false);
    for (Eigen::Index j = 0; j < motions.cols(); ++j) {
      if (assembly::max_translation(motions.col(j), map) > 0.0) {
        moving.push_back(j);
        continue;
      }
      for (const int i : all)
        if (motions(i, j) != 0.0) turns[static_cast<std::size_t>(i)] = true;
      free.emplace_back(motions.col(j) / motions.col(j).cwiseAbs().maxCoeff());
    }
    others = motions(Eigen::all, moving);
    std::copy_if(all.begin(), all.end(), std::back_inserter(dofs),
                 [&](int i) { return !turns[static_cast<std::size_t>(i)]; });
  }
};

/// Two translations of a node have the same stiffness, the sum of theirs, which does not depend on the axes. Never zero.
Vector stiffness_of_dofs(const assembly::DofMap& map, const SparseMatrix& k) {
  const double largest = k.diagonal().cwiseAbs().maxCoeff();
  std::map<int, double> of_node;
  const auto node = [&](int i) { return map.locations[static_cast<std::size_t>(i)].first; };
  const auto translates = [&](int i) {
    return !map.is_matrix_scene() && !map.dofs[static_cast<std::size_t>(i)].rotation;
  };
  for (int i = 0; i < k.rows(); ++i)
    if (translates(i)) of_node[node(i)] += std::abs(k.coeff(i, i));
  Vector result(k.rows());
  for (int i = 0; i < k.rows(); ++i) {
    const double d = translates(i) ? of_node[node(i)] : std::abs(k.coeff(i, i));
    result[i] = d > 0.0 ? d : largest > 0.0 ? largest : 1.0;
  }
  return result;
}

/// Contacts by number, and their tangents.
struct Tangents {
  std::vector<std::size_t> contacts;
  std::vector<const Combination*> forms;
  Tangents(const StaticProblem& problem, std::vector<std::size_t> list) : contacts(std::move(list)) {
    for (const std::size_t k : contacts) forms.push_back(&problem.contacts[k].tangent);
  }
};

/// Pins the motions that no contact holds, `null` (n x m), each at the degree of freedom that has most of its energy.
void pin_loose(const Eigen::MatrixXd& null, const Vector& stiffness, std::vector<FreeMotion>& result) {
  Eigen::MatrixXd parts = stiffness.cwiseSqrt().asDiagonal() * null;
  for (Eigen::Index j = 0; j < parts.cols(); ++j) parts.col(j).normalize();
  const std::vector<std::size_t> dofs = independent_rows(parts, 0.0);
  for (Eigen::Index j = 0; j < null.cols(); ++j) {
    Combination pin;
    if (static_cast<std::size_t>(j) < dofs.size())
      pin.terms.emplace_back(static_cast<int>(dofs[static_cast<std::size_t>(j)]), 1.0);
    result.push_back({null.col(j), std::move(pin), {}});
  }
}

/// Free motions of one part of the structure, with the contacts that hold them.
std::vector<FreeMotion> free_motions_of_part(const StaticProblem& problem, const Eigen::MatrixXd& motions,
                                             const std::vector<int>& dofs,
                                             const std::vector<std::size_t>& contacts,
                                             const std::vector<bool>& closed, const Vector& stiffness,
                                             bool pressed_only) {
  const Turning turning(motions, dofs, problem.map);
  Eigen::MatrixXd null = simple_motions(turning.others, problem.map, turning.dofs);
  for (Eigen::Index j = 0; j < null.cols(); ++j) {
    const double size = assembly::max_translation(null.col(j), problem.map);
    null.col(j) /= size > 0.0 ? size : null.col(j).cwiseAbs().maxCoeff();
  }
  const Eigen::Index m = null.cols();
  std::vector<FreeMotion> result;
  Eigen::MatrixXd rows(0, m);  // slips of the contacts that fix the motions
  std::vector<const Combination*> pins;
  std::vector<std::size_t> phases;  // number of rows after each phase
  std::vector<Tangents> holders;
  for (const bool pressed : {true, false}) {
    std::vector<std::size_t> list;
    for (const std::size_t k : contacts)
      if ((!problem.is_support(k) || closed[k]) == pressed && (pressed || !pressed_only)) list.push_back(k);
    const Tangents& holding = holders.emplace_back(problem, std::move(list));
    const Eigen::MatrixXd slips = slips_of(holding.forms, null);
    Eigen::MatrixXd rest = slips;
    if (rows.rows() > 0) {
      const Eigen::MatrixXd basis = base::orthonormal(rows.transpose());
      rest -= (rest * basis) * basis.transpose();
    }
    for (const std::size_t i : independent_rows(rest, holds)) {
      if (rows.rows() == m) break;
      rows.conservativeResize(rows.rows() + 1, Eigen::NoChange);
      rows.bottomRows(1) = slips.row(static_cast<Eigen::Index>(i));
      pins.push_back(holding.forms[i]);
    }
    phases.push_back(pins.size());
  }
  Eigen::MatrixXd loose(motions.rows(), m - rows.rows() + static_cast<Eigen::Index>(turning.free.size()));
  if (m > 0) {
    Eigen::MatrixXd complete(m, m);
    complete << rows, other_motions(rows);
    const Eigen::MatrixXd separate = null * base::solve_dense(complete, Eigen::MatrixXd::Identity(m, m));
    for (std::size_t j = 0; j < pins.size(); ++j) {
      const Vector motion = separate.col(static_cast<Eigen::Index>(j));
      const Tangents& holding = holders[j < phases.front() ? 0 : 1];
      const Eigen::MatrixXd slips = slips_of(holding.forms, motion);
      std::vector<std::size_t> names;
      for (std::size_t i = 0; i < holding.contacts.size(); ++i)
        if (std::abs(slips(static_cast<Eigen::Index>(i), 0)) > holds) names.push_back(holding.contacts[i]);
      result.push_back({motion, *pins[j], std::move(names)});
    }
    loose.leftCols(m - rows.rows()) = separate.rightCols(m - rows.rows());
  }
  for (std::size_t j = 0; j < turning.free.size(); ++j)
    loose.col(m - rows.rows() + static_cast<Eigen::Index>(j)) = turning.free[j];
  pin_loose(loose, stiffness, result);
  return result;
}

}  // namespace

std::vector<FreeMotion> constrain_free_motions(const StaticProblem& problem, const Eigen::MatrixXd& motions,
                                               const std::vector<bool>& closed, bool pressed_only) {
  if (motions.cols() == 0) return {};
  std::vector<std::size_t> all(problem.contacts.size());
  std::iota(all.begin(), all.end(), std::size_t{0});
  const SparseMatrix k = problem.matrix(closed);
  const Vector stiffness = stiffness_of_dofs(problem.map, k);
  if (problem.size() <= together_up_to) {
    std::vector<int> dofs(static_cast<std::size_t>(problem.size()));
    std::iota(dofs.begin(), dofs.end(), 0);
    return free_motions_of_part(problem, motions, dofs, all, closed, stiffness, pressed_only);
  }
  std::vector<Combination> tangents;
  for (const Contact& c : problem.contacts) tangents.push_back(c.tangent);
  const assembly::Parts parts({&k}, tangents);
  std::vector<std::vector<Eigen::Index>> own_motions(parts.count());
  std::vector<std::vector<std::size_t>> own_contacts(parts.count());
  for (Eigen::Index j = 0; j < motions.cols(); ++j) {
    Eigen::Index dof = 0;  // a motion without resistance lies in one part
    motions.col(j).cwiseAbs().maxCoeff(&dof);
    own_motions[parts.part_of(static_cast<int>(dof))].push_back(j);
  }
  for (const std::size_t c : all)
    if (!tangents[c].terms.empty()) own_contacts[parts.part_of(tangents[c].terms.front().first)].push_back(c);
  std::vector<FreeMotion> result;
  std::size_t number = 0;
  for (const assembly::Part& part : parts) {
    const Eigen::MatrixXd own = motions(Eigen::all, own_motions[number]);
    std::vector<FreeMotion> held = free_motions_of_part(problem, own, part.dofs(), own_contacts[number++],
                                                        closed, stiffness, pressed_only);
    std::move(held.begin(), held.end(), std::back_inserter(result));
  }
  return result;
}

bool has_no_reaction(const StaticProblem& problem, std::size_t contact, double reaction) {
  const double greatest = problem.size() == 0 ? 0.0 : problem.load.cwiseAbs().maxCoeff();
  double squares = 0.0, sum = 0.0;
  for (const auto& [dof, factor] : problem.contacts[contact].normal.terms) {
    squares += factor * factor;
    sum += std::abs(factor);
  }
  return std::abs(reaction) * squares <= no_reaction * greatest * sum;
}

std::vector<double> holding_forces(const StaticProblem& problem, const std::vector<bool>& closed,
                                   const std::vector<double>& reactions) {
  std::vector<double> forces(problem.contacts.size(), 0.0);
  for (std::size_t k = 0; k < forces.size(); ++k)
    if (!problem.is_support(k))
      forces[k] = std::abs(problem.contacts[k].normal_force.value(0.0));
    else if (closed[k] && !has_no_reaction(problem, k, reactions[k]))
      forces[k] = std::max(0.0, reactions[k]);
  return forces;
}

namespace {

/// Groups of free motions without a common degree of freedom and without a common contact.
std::vector<std::vector<Eigen::Index>> groups_of_motions(const Eigen::MatrixXd& z,
                                                         const std::vector<Contact>& contacts) {
  std::vector<Eigen::Index> group(static_cast<std::size_t>(z.cols()));
  std::iota(group.begin(), group.end(), Eigen::Index{0});
  const auto root = [&](Eigen::Index j) {
    while (group[static_cast<std::size_t>(j)] != j) j = group[static_cast<std::size_t>(j)];
    return j;
  };
  const auto join = [&](const auto& moves) {
    Eigen::Index first = -1;
    for (Eigen::Index j = 0; j < z.cols(); ++j) {
      if (!moves(j)) continue;
      if (first < 0)
        first = root(j);
      else
        group[static_cast<std::size_t>(root(j))] = first;
    }
  };
  for (Eigen::Index i = 0; i < z.rows(); ++i) join([&](Eigen::Index j) { return z(i, j) != 0.0; });
  for (const Contact& c : contacts)
    if (!c.tangent.terms.empty())
      join([&](Eigen::Index j) {
        return std::any_of(c.tangent.terms.begin(), c.tangent.terms.end(),
                           [&](const auto& term) { return z(term.first, j) != 0.0; });
      });
  std::map<Eigen::Index, std::vector<Eigen::Index>> lists;
  for (Eigen::Index j = 0; j < z.cols(); ++j) lists[root(j)].push_back(j);
  std::vector<std::vector<Eigen::Index>> result;
  for (auto& [first, list] : lists) result.push_back(std::move(list));
  return result;
}

/// The free motions of one group are shared, level by level: u + Z c.
class SharedMotion {
 public:
  SharedMotion(Eigen::MatrixXd z, Vector& u)
      : z_(std::move(z)), u_(u), left_(Eigen::MatrixXd::Identity(z_.cols(), z_.cols())) {}

  /// Least sum of the squares of the slips, each times its weight, over the motions that are still free.
  void slip_least(const std::vector<const Combination*>& forms, const std::vector<double>& weights) {
    if (left_.cols() == 0 || forms.empty()) return;
    const Eigen::MatrixXd rows = slips_of(forms, z_) * left_;
    const base::EigenPairs squares = base::symmetric_eigen(rows.transpose() * rows);
    const Eigen::Index fixed = (squares.values.array() > holds * holds).count();
    if (fixed == 0) return;
    Eigen::VectorXd root(rows.rows()), slips(rows.rows());
    for (Eigen::Index i = 0; i < rows.rows(); ++i) {
      const Combination& form = *forms[static_cast<std::size_t>(i)];
      const double size = size_of(form);
      root[i] = size * std::sqrt(weights[static_cast<std::size_t>(i)]);
      slips[i] = size > 0.0 ? form.dot(u_) / size : 0.0;
    }
    move(root.asDiagonal() * rows * squares.vectors.rightCols(fixed), root.cwiseProduct(slips),
         left_ * squares.vectors.rightCols(fixed));
    left_ = left_ * squares.vectors.leftCols(left_.cols() - fixed).eval();
  }
  /// Least sum of D u^2 over the motions that are still free.
  void move_least(const Vector& stiffness) {
    if (left_.cols() == 0) return;
    const Vector root = stiffness.cwiseSqrt();
    move(root.asDiagonal() * z_ * left_, root.cwiseProduct(u_), left_);
  }

 private:
  void move(const Eigen::MatrixXd& rows, const Eigen::VectorXd& now, const Eigen::MatrixXd& motions) {
    Eigen::VectorXd size(rows.cols());
    for (Eigen::Index j = 0; j < size.size(); ++j) size[j] = rows.col(j).norm();
    const Eigen::MatrixXd scaled = rows * size.cwiseInverse().asDiagonal();
    u_ -= z_ * (motions * size.cwiseInverse().cwiseProduct(base::least_squares(scaled, now)));
  }

  Eigen::MatrixXd z_;
  Vector& u_;
  Eigen::MatrixXd left_;  // motions that are still free, as combinations of the columns of Z
};

/// Shares the free motions (free_motions.hpp). forces: holding_forces().
void share_motions(const StaticProblem& problem, const std::vector<FreeMotion>& free, const Vector& stiffness,
                   const std::vector<double>& forces, Vector& u) {
  Eigen::MatrixXd z(problem.size(), static_cast<Eigen::Index>(free.size()));
  for (std::size_t j = 0; j < free.size(); ++j) z.col(static_cast<Eigen::Index>(j)) = free[j].motion;
  for (const std::vector<Eigen::Index>& group : groups_of_motions(z, problem.contacts)) {
    SharedMotion shared(z(Eigen::all, group), u);
    for (const bool pressed : {true, false}) {
      std::vector<const Combination*> forms;
      std::vector<double> weights;
      for (std::size_t k = 0; k < forces.size(); ++k) {
        const Combination& tangent = problem.contacts[k].tangent;
        if ((forces[k] > 0.0) != pressed || tangent.terms.empty()) continue;
        if (std::none_of(tangent.terms.begin(), tangent.terms.end(),
                         [&](const auto& term) { return (z(term.first, group).array() != 0.0).any(); }))
          continue;
        forms.push_back(&tangent);
        weights.push_back(pressed ? forces[k] : 1.0);
      }
      shared.slip_least(forms, weights);
    }
    shared.move_least(stiffness);
  }
}

/// True if a motion has negative energy: it is a motion without resistance, but its forces do not vanish.
bool is_unstable(const SparseMatrix& k, const std::vector<FreeMotion>& free) {
  return std::any_of(free.begin(), free.end(), [&](const FreeMotion& f) {
    return f.motion.dot(k * f.motion) < -rounding::elimination * assembly::term_magnitude(k, f.motion);
  });
}

}  // namespace

ConstrainedState solve_constrained(const StaticProblem& problem, const std::vector<bool>& closed,
                                   const std::vector<FreeMotion>& free) {
  std::vector<ConstraintRow> rows;
  std::vector<double> places;
  std::vector<std::size_t> supports;
  for (std::size_t k = 0; k < problem.contacts.size(); ++k) {
    const Contact& c = problem.contacts[k];
    if (!problem.is_support(k) || !closed[k]) continue;
    supports.push_back(k);
    rows.push_back({c.normal, problem.normal_stiffness(k), c.takes_impulses()});
    places.push_back(-c.gap);
  }
  const SparseMatrix whole = problem.matrix(closed);
  const bool unstable = is_unstable(whole, free);
  std::vector<Combination> pins;
  for (const FreeMotion& f : free) {
    if (f.pin.terms.empty()) continue;
    if (!unstable) {
      pins.push_back(f.pin);
      continue;
    }
    // Another place on an unstable motion has other forces, so the motion stays at zero where its contact is.
    rows.push_back({f.pin, structural_stiffness(whole, f.pin), false});
    places.push_back(0.0);
  }
  const ConstraintRows held(problem.stiffness, std::move(rows), pins);
  const Vector at = Eigen::Map<const Vector>(places.data(), static_cast<Eigen::Index>(places.size()));
  auto [u, forces] = held.solve(problem.load, at);
  const auto reactions = [&] {
    std::vector<double> list(problem.contacts.size(), 0.0);
    for (std::size_t i = 0; i < supports.size(); ++i) {
      const double reaction = -forces[static_cast<Eigen::Index>(i)];
      list[supports[i]] = problem.contacts[supports[i]].takes_impulses() ? reaction : std::max(0.0, reaction);
    }
    return list;
  };
  if (!free.empty() && !unstable) {
    const Vector stiffness = stiffness_of_dofs(problem.map, whole);
    // The free motions are known to the rounding of K, so that the second round begins almost in equilibrium.
    for (int round = 0; round < 2; ++round) {
      share_motions(problem, free, stiffness, holding_forces(problem, closed, reactions()), u);
      held.refine(problem.load, at, u, forces);
    }
  }
  return {std::move(u), reactions()};
}

double driving_work(const StaticProblem& problem, const SparseMatrix& k, const Vector& p,
                    const Vector& motion, const Vector& u) {
  const double work = motion.dot(p - k * u);
  const double roundoff =
      rounding::many_operations * motion.cwiseAbs().dot(k.cwiseAbs() * u.cwiseAbs() + p.cwiseAbs());
  double motion_size[2]{0.0, 0.0}, load_size[2]{0.0, 0.0};  // translations, rotations
  for (int i = 0; i < problem.size(); ++i) {
    const std::size_t kind = problem.map.dofs[static_cast<std::size_t>(i)].rotation ? 1 : 0;
    motion_size[kind] = std::max(motion_size[kind], std::abs(motion[i]));
    load_size[kind] = std::max(load_size[kind], std::abs(p[i]));
  }
  const double all = undriven * (motion_size[0] * load_size[0] + motion_size[1] * load_size[1]);
  return std::abs(work) > roundoff + all ? work : 0.0;
}

}  // namespace signorini::statics
