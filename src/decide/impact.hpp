// impact.hpp: what happens to velocities where rigid contacts close.
//
//   M (v+ - v-) = sum_k ( n_k Pn_k + t_k Pt_k )      over all rigid contacts with g = 0
//   0 <= Pn  _|_  vn+ + e min(vn-, 0) >= 0           Newton's restitution
//   |Pt| <= f Pn,  Pt = -f Pn sign(vt+) where vt+ is not 0      Coulomb's law on the impulse
//   loss = -sum ( Pn (vn- + vn+) + Pt (vt- + vt+) )/2           vt relative to the surface
//
// M couples all contacts, so they are solved together (decide/coulomb_problem.hpp). A rebound slower than
// capture_velocity is solved again with e = 0 for that contact: it rests, and a ball that would bounce for
// ever comes to its end. Sliders and contact elements take no impulse.
// Source: Newton 1687; Moreau 1988 for the simultaneous problem; Glocker 2001, chapter 8.
#pragma once

#include <limits>

#include "decide/coulomb_problem.hpp"
#include "decide/delassus.hpp"
#include "motion/forcing.hpp"
#include "motion/mode_systems.hpp"
#include "signorini/trace.hpp"

namespace signorini {

/// What an impact does at one contact. Unit: force * time.
struct Impulse {
  bool hit = false;  ///< it was open and takes an impulse; closed contacts may take one too
  double normal = 0.0, tangent = 0.0;
  bool rests = false, sticks = false;  ///< vn+ = 0, vt+ = 0 by the solution
  /// Its rebound over capture_velocity; less than one: it was captured. NaN: it has none.
  double rebound = std::numeric_limits<double>::quiet_NaN();
};

/// What one contact that touches takes of one impact. Impacts of an instant come one after the other: turn 1, 2, ...
struct Blow {
  std::size_t contact = 0;
  int turn = 1;
  double normal = 0.0, tangent = 0.0;
};

struct Impact {
  Refusal refusal;                ///< why there is none
  Vector v;                       ///< after
  std::vector<Impulse> impulses;  ///< one a contact of the model
  double loss = 0.0;              ///< energy that it dissipates
  double surface_work = 0.0;      ///< work of moving surfaces
  bool gains = false;             ///< the loss is negative: Newton's law with friction does that at times
  /// Impulses that make known velocities exact, rows as those of Delassus; empty: none.
  Eigen::VectorXd settled = {};
};

class Impacts {
 public:
  Impacts(ModeSystems& systems, double capture_velocity)
      : model_(systems.model()), systems_(systems), capture_velocity_(capture_velocity) {}

  /// u with the gaps of all that touch closed, by the smallest change in the norm of M; mode: of all others.
  [[nodiscard]] Vector close(const Mode& mode, const std::vector<std::size_t>& touching, Vector u);
  /// v: before; touching: contacts with g = 0, rigid ones; mode: of all others.
  [[nodiscard]] Impact solve(const Forcing& forcing, double t, const Mode& mode,
                             const std::vector<std::size_t>& touching, const Vector& v);

 private:
  /// What all that touch bring along, and what becomes of it; rows as those of Delassus.
  struct Hit {
    Delassus d;
    CoulombProblem problem;
    Eigen::VectorXd before, size, after, restitution;  // size: sum of the terms of `before`
    Eigen::VectorXd rebound;                           // Impulse::rebound, one a contact that touches
    std::optional<CoulombSolution> solution;
  };
  [[nodiscard]] Hit meet(const Forcing& forcing, double t, const ModeSystem& system,
                         const std::vector<std::size_t>& touching, const Vector& v) const;
  [[nodiscard]] bool rebound(const std::vector<std::size_t>& touching, Hit& hit) const;
  void come_to_rest(const Forcing& forcing, double t, const std::vector<std::size_t>& touching, Hit& hit,
                    Impact& impact) const;
  void balance(const Forcing& forcing, double t, const Mode& mode, const std::vector<std::size_t>& touching,
               const Hit& hit, Impact& impact) const;

  const Model& model_;
  ModeSystems& systems_;
  double capture_velocity_;  // where a contact has none of its own
};

/// States during an impact: whoever takes an impulse is closed, sticks or slides by it; of the contacts with impulses
/// nobody else holds anything. impulses: one a contact.
[[nodiscard]] Mode mode_of_impact(const Model& model, Mode mode, const std::vector<Impulse>& impulses);

}  // namespace signorini
