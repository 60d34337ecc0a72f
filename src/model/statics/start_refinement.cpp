#include "model/statics/start_refinement.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "model/statics/free_motions.hpp"
#include "model/statics/mechanisms.hpp"
#include "model/statics/residual.hpp"
#include "model/statics/static_system.hpp"

namespace signorini::statics {
namespace {

// Friction couples T to N, so that steps shrink by a factor of the size of f. Chosen value: 0.5^50 is below rounding.
constexpr int most_steps = 50;

/// The rows of a start, and where the forces of each contact stand among them; -1: no row.
struct StartRows {
  std::vector<ConstraintRow> rows;
  std::vector<Eigen::Index> normal, tangent;

  StartRows(const SparseMatrix& k, const std::vector<Contact>& contacts,
            const std::vector<HeldContact>& held) {
    const auto add = [&](const Combination& form, const std::optional<double>& spring) {
      rows.push_back({form, spring ? *spring : structural_stiffness(k, form), !spring});
      return static_cast<Eigen::Index>(rows.size()) - 1;
    };
    for (std::size_t c = 0; c < contacts.size(); ++c) {
      const bool closed = held[c].normal == HeldContact::Normal::closed;
      const bool held_normal =
          held[c].normal != HeldContact::Normal::open && !contacts[c].normal_force_given();
      normal.push_back(
          held_normal ? add(contacts[c].normal, closed ? contacts[c].normal_spring() : std::nullopt) : -1);
      tangent.push_back(held[c].sticks ? add(contacts[c].body_tangent(), contacts[c].tangent_spring()) : -1);
    }
  }
};

/// The rows with pins for motions without resistance; nullopt if contacts do not fix all of these.
std::optional<ConstraintRows> regular_rows(const SparseMatrix& k, const std::vector<Contact>& contacts,
                                           const std::vector<ConstraintRow>& rows) {
  ConstraintRows found(k, rows);
  if (found.regular()) return found;
  const Eigen::MatrixXd motions = null_motions(found.matrix());
  std::vector<const Combination*> tangents;
  for (const Contact& c : contacts) tangents.push_back(&c.body_tangent());
  const std::vector<std::size_t> fixing = fixing_forms(motions, tangents);
  if (static_cast<Eigen::Index>(fixing.size()) < motions.cols()) return std::nullopt;
  std::vector<Combination> pins;
  for (const std::size_t c : fixing) pins.push_back(*tangents[c]);
  ConstraintRows pinned(k, rows, pins);
  if (!pinned.regular()) return std::nullopt;
  return pinned;
}

class StartRefinement {
 public:
  StartRefinement(const SparseMatrix& k, const Vector& load, const std::vector<Contact>& contacts,
                  const std::vector<HeldContact>& held)
      : k_(k), load_(load), contacts_(contacts), held_(held), rows_(k, contacts, held) {}

  bool run(StartForces& start) const {
    const std::optional<ConstraintRows> solver = regular_rows(k_, contacts_, rows_.rows);
    if (!solver) return false;
    StartForces now = start;
    double last = std::numeric_limits<double>::infinity();
    for (int step = 0; step < most_steps; ++step) {
      follow_laws(now);
      double size = 0.0;
      const Vector rest = unbalanced_forces(k_, load_, contacts_, now, size);
      const Vector miss = missing(now.u);
      const auto [du, forces] = solver->solve_once(rest, miss);
      const double work = rest.cwiseAbs().dot(du.cwiseAbs()) + miss.cwiseAbs().dot(forces.cwiseAbs());
      if (!(work < last)) break;
      last = work;
      now.u += du;
      for (std::size_t c = 0; c < contacts_.size(); ++c) {
        if (rows_.normal[c] >= 0 && rigid(rows_.normal[c])) now.N[c] += forces[rows_.normal[c]];
        if (rows_.tangent[c] >= 0) now.T[c] += forces[rows_.tangent[c]];
      }
    }
    if (!std::isfinite(last)) return false;
    follow_laws(now);
    start = std::move(now);
    return true;
  }

 private:
  [[nodiscard]] bool rigid(Eigen::Index row) const { return rows_.rows[static_cast<std::size_t>(row)].rigid; }

  /// N of contact springs and T of slipping contacts follow from u and N.
  void follow_laws(StartForces& now) const {
    for (std::size_t c = 0; c < contacts_.size(); ++c) {
      if (rows_.normal[c] >= 0 && !rigid(rows_.normal[c]))
        now.N[c] = static_cast<double>(contacts_[c].normal_stiffness * exact_gap(contacts_[c], now.u));
      if (held_[c].slips != 0) now.T[c] = held_[c].slips * held_[c].friction * std::abs(now.N[c]);
    }
  }
  /// -g of the rigid contacts that bear, 0 for all other rows.
  [[nodiscard]] Vector missing(const Vector& u) const {
    Vector miss = Vector::Zero(static_cast<Eigen::Index>(rows_.rows.size()));
    for (std::size_t c = 0; c < contacts_.size(); ++c)
      if (rows_.normal[c] >= 0 && rigid(rows_.normal[c]) && held_[c].normal == HeldContact::Normal::closed)
        miss[rows_.normal[c]] = -static_cast<double>(exact_gap(contacts_[c], u));
    return miss;
  }

  const SparseMatrix& k_;
  const Vector& load_;
  const std::vector<Contact>& contacts_;
  const std::vector<HeldContact>& held_;
  StartRows rows_;
};

}  // namespace

Vector unbalanced_forces(const SparseMatrix& k, const Vector& load, const std::vector<Contact>& contacts,
                         const StartForces& start, double& size) {
  Residual rest(load);
  rest.subtract(k, start.u);
  size = load.size() == 0 ? 0.0 : std::max(load.cwiseAbs().maxCoeff(), (k * start.u).cwiseAbs().maxCoeff());
  const auto add = [&](const Combination& form, double force) {
    rest.subtract(form, force);
    for (const auto& [dof, factor] : form.terms) size = std::max(size, std::abs(factor * force));
  };
  for (std::size_t c = 0; c < contacts.size(); ++c) {
    if (!contacts[c].normal_force_given()) add(contacts[c].normal, start.N[c]);
    add(contacts[c].body_tangent(), start.T[c]);
  }
  return rest.rounded();
}

bool refine_start(const SparseMatrix& k, const Vector& load, const std::vector<Contact>& contacts,
                  const std::vector<HeldContact>& held, StartForces& start) {
  return StartRefinement(k, load, contacts, held).run(start);
}

}  // namespace signorini::statics
