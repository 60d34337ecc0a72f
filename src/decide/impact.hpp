// impact.hpp: velocities after an impact of rigid contacts.
//
//   M (v+ - v-) = sum_k ( n_k Pn_k + t_k Pt_k )      over all rigid contacts with g = 0
//   0 <= Pn  _|_  vn+ + e min(vn-, 0) >= 0           Newton's law of restitution
//   |Pt| <= f Pn,  Pt = -f Pn sign(vt+) where vt+ is not 0      Coulomb's law on the impulse
//   loss = -sum ( Pn (vn- + vn+) + Pt (vt- + vt+) )/2           vt relative to the surface
//
// M couples all contacts, so all impulses are computed together (decide/coulomb_problem.hpp). If a contact rebounds slower
// than capture_velocity, the impact is computed again with e = 0 for that contact. The contact then stays closed, so
// that the infinite sequence of rebounds of a ball ends after a finite number. Sliders and contacts with springs take no
// impulse.
// Source: Newton 1687; Moreau 1988 for the simultaneous problem; Glocker 2001, chapter 8.
#pragma once

#include <cstddef>
#include <limits>
#include <vector>

#include "decide/coulomb_problem.hpp"
#include "decide/delassus.hpp"
#include "motion/forcing.hpp"
#include "motion/state_systems.hpp"
#include "signorini/trace.hpp"

namespace signorini::decide {

/// Sum of the impulses on one contact at an instant. Unit: force * time.
struct Impulse {
  /// True: the contact was open and takes an impulse. False for an impulse on a closed contact.
  bool hit = false;
  double normal = 0.0, tangent = 0.0;
  bool rests = false, sticks = false;  ///< true: vn+ = 0 (rests), vt+ = 0 (sticks)
  /// Rebound velocity / capture_velocity; below 1: the contact was captured and stays closed. NaN: there is no rebound.
  double rebound = std::numeric_limits<double>::quiet_NaN();
};

/// Impulse on one touching contact in one impact. impact_number: number of the impact among the successive impacts at an
/// instant, from 1.
struct SingleImpact {
  std::size_t contact = 0;
  int impact_number = 1;
  double normal = 0.0, tangent = 0.0;
};

struct Impact {
  Refusal refusal;                ///< reason why there is no solution
  Vector v;                       ///< velocities after the impact
  std::vector<Impulse> impulses;  ///< one entry per contact of the model
  double loss = 0.0;              ///< dissipated energy
  double surface_work = 0.0;      ///< work of moving surfaces
  bool gains = false;  ///< true: the loss is negative, which Newton's law with friction makes possible
  /// Impulses that set known velocities to their exact values; rows as in Delassus. Empty: none.
  Eigen::VectorXd correction_impulses = {};
};

class ImpactSolver {
 public:
  ImpactSolver(motion::StateSystems& systems, double capture_velocity)
      : model_(systems.model()), systems_(systems), capture_velocity_(capture_velocity) {}

  /// Returns u with the gaps of all touching contacts closed, by the smallest change of u in the norm of M. states: states of
  /// all other contacts.
  [[nodiscard]] Vector close_gaps(const contact::ContactStates& states,
                                  const std::vector<std::size_t>& touching, Vector u);
  /// Computes an impact. v: velocities before the impact; touching: rigid contacts with g = 0; states: states of all other
  /// contacts.
  [[nodiscard]] Impact solve(const motion::Forcing& forcing, double t, const contact::ContactStates& states,
                             const std::vector<std::size_t>& touching, const Vector& v);

 private:
  /// Velocities of all touching contacts before and after the impact, and the problem that relates them; rows as in Delassus.
  struct ImpactProblem {
    Delassus d;
    CoulombProblem problem;
    Eigen::VectorXd before, size, after, restitution;  // size: magnitude of the terms of `before`
    Eigen::VectorXd rebound;                           // Impulse::rebound, one entry per touching contact
    std::optional<CoulombSolution> solution;
  };
  [[nodiscard]] ImpactProblem set_up(const motion::Forcing& forcing, double t,
                                     const motion::StateSystem& system,
                                     const std::vector<std::size_t>& touching, const Vector& v) const;
  [[nodiscard]] bool rebound(const std::vector<std::size_t>& touching, ImpactProblem& hit) const;
  void come_to_rest(const motion::Forcing& forcing, double t, const std::vector<std::size_t>& touching,
                    ImpactProblem& hit, Impact& impact) const;
  void balance(const motion::Forcing& forcing, double t, const contact::ContactStates& states,
               const std::vector<std::size_t>& touching, const ImpactProblem& hit, Impact& impact) const;

  const Model& model_;
  motion::StateSystems& systems_;
  double capture_velocity_;  // value for contacts without their own value
};

/// States during an impact. A contact with an impulse is closed, sticks or slips, according to the impulse. Other rigid
/// contacts, and other contacts that can stick rigidly, are open. impulses: one entry per contact.
[[nodiscard]] contact::ContactStates states_of_impact(const Model& model, contact::ContactStates states,
                                                      const std::vector<Impulse>& impulses);

// Order of the impacts of rigid contacts at one instant.
//
//   impact 1, 2, ...   closing contacts touch after the time g / |g'|; the first of them are hit, together with contacts
//                      that touch and are at rest
//
// A leaving contact (g' > 0) takes no impulse: an impact at another contact does not stop it, and an impulse on it would add
// energy. If a later impact makes it close again, the contact is hit again. Contacts that close at the same time are hit
// together.

/// A rigid contact at an instant with impacts. Units: length, length/time.
struct Approach {
  std::size_t contact = 0;
  double gap = 0.0;   ///< gap, >= 0; zero: the contact touches
  double rate = 0.0;  ///< g'
  double rest = 0.0;  ///< limit of g' above which the contact leaves
  double hit = 0.0;   ///< limit of -g' above which the contact is hit
  bool open = false;  ///< false: the contact is already closed, with a compressive force

  [[nodiscard]] bool is_closing() const { return open && rate < -hit; }
};

/// Advances all gaps to the time at which the next contact closes. Returns the contacts that are hit at that time; empty: no
/// contact closes.
[[nodiscard]] std::vector<std::size_t> next_impact(std::vector<Approach>& all);

}  // namespace signorini::decide
