// resting_forces.hpp: states of rigid feet and sliders that hold a body at rest, from the forces of least norm.
//
//   min sum ( N_i^2 + T_i^2 )   over   A x = r(t),   |T_i| <= -fs N_i           x = P(z), z = A' y
//                                                    |T_i| <= fs q_i(t)         sliders; N_i = -q_i does not count
//
//   z_i inside its cone     stick               the force is z_i
//   z_i beyond an edge      slip+ or slip-      the force lies on the edge: the foot bears its limit
//   z_i in the polar cone   open                the foot bears nothing
//
// x_i = (-N_i, -T_i), of a contact without friction -N_i, of a slider -T_i.
//
// r: the forces needed at rest. A: they do not change the motion where A x is kept. The body rests as long as there is
// such an x. Just after an instant the states follow from r and its derivatives, each the right-hand side of a problem
// of the same kind on the critical cones of the one before (base/least_norm.hpp).
//
// While the states last, x and z depend linearly on each other's forces,
//
//   z = A' (A D A')^-1 A x                      D: projection onto the span of the face of each foot
//
// so that z_i also gives the time at which a foot is released: when it returns into its cone, or leaves the polar cone. The force
// of a slider at its limit is given; the formula is that of the other forces.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "base/least_norm.hpp"
#include "decide/guard_signs.hpp"
#include "decide/instant.hpp"
#include "motion/jet.hpp"

namespace signorini::decide {

/// The feet of one body, and the forces that do not change its motion.
class RestingFeet {
 public:
  /// system: in which all these contacts stick, and no other one of their group presses. nullopt: their forces are
  /// unique.
  [[nodiscard]] static std::optional<RestingFeet> make(const Model& model, const motion::StateSystem& system,
                                                       const std::vector<std::size_t>& contacts);

  [[nodiscard]] const std::vector<std::size_t>& contacts() const { return contacts_; }

  /// False if no forces within the cones hold the body. jets: motion of all contacts while these stick.
  [[nodiscard]] bool may_rest(const motion::Forcing& forcing, double t,
                              const std::vector<MotionJet>& jets) const;
  /// Sets the states of these contacts just after the instant, and the known signs of their guards. False: the body
  /// begins to move.
  [[nodiscard]] bool decide(const Instant& instant, const motion::Forcing& forcing,
                            const std::vector<MotionJet>& jets, contact::ContactStates& states,
                            std::vector<KnownGuards>& known) const;

  /// One condition of a foot that bears its limit or nothing: weights . forces > 0, forces: of all contacts, in the
  /// order of the model's layout. Unit: force.
  struct Release {
    TriggeredGuard guard;
    Eigen::VectorXd weights;
  };
  /// The conditions under which these states of the contacts last.
  [[nodiscard]] std::vector<Release> releases(const contact::ContactStates& states) const;

 private:
  RestingFeet(const Model& model, std::vector<std::size_t> contacts);
  /// The sets at time t.
  [[nodiscard]] std::vector<base::ConvexSet> sets_at(const motion::Forcing& forcing, double t) const;
  /// Forces of the contacts: l and k in the order of rows_, derivative of this order.
  [[nodiscard]] Eigen::VectorXd forces(const std::vector<MotionJet>& jets, std::size_t order) const;
  [[nodiscard]] double zero_force(const Instant& instant, const std::vector<MotionJet>& jets,
                                  std::size_t order) const;

  [[nodiscard]] double set_offsets(const motion::Forcing& forcing, double t, std::size_t order,
                                   const std::vector<int>& sides, std::vector<base::ConvexSet>& sets) const;
  [[nodiscard]] bool is_degenerate(const std::vector<base::ConvexSet>& sets, const Eigen::VectorXd& x,
                                   double zero) const;
  [[nodiscard]] std::optional<base::LeastNorm> at_instant(const std::vector<base::ConvexSet>& sets,
                                                          const std::vector<MotionJet>& jets,
                                                          const Eigen::VectorXd& noise, double& zero) const;

  const Model* model_;
  std::vector<std::size_t> contacts_;
  std::vector<std::size_t>
      rows_;  // of the model's layout, contact by contact: N unless it is given, then T where there is friction
  std::vector<base::ConvexSet> sets_;  // of each contact; the radius of a disc is set at each instant
  std::vector<Eigen::Index> at_;       // first row of each contact
  Eigen::MatrixXd a_;
};

/// True if an open foot touches, to the rounding of displacements, and other feet of its body keep its gap.
[[nodiscard]] bool is_held_at_zero_gap(const motion::StateSystems& systems, std::size_t contact,
                                       const contact::ContactStates& states, const Vector& u);

/// The feet `feet`, if all of them can stick together, and their forces are then not unique. states: of all other
/// contacts.
[[nodiscard]] std::optional<RestingFeet> find_resting_feet(motion::StateSystems& systems,
                                                           const motion::Forcing& forcing, double t,
                                                           const std::vector<std::size_t>& feet,
                                                           contact::ContactStates states);

/// Conditions under which feet that bear their limit or nothing at rest keep these states. u: displacements.
[[nodiscard]] std::vector<RestingFeet::Release> releases(motion::StateSystems& systems,
                                                         const motion::Forcing& forcing, double t,
                                                         const contact::ContactStates& states,
                                                         const Vector& u);

}  // namespace signorini::decide
