// laws.hpp: functions that check the laws of an instant, one for each law, and their common data.
//
//   W_k = (n, t)^T M^-1 (n, t) of contact k: effect of its forces along n and t on its accelerations
//
// Every function appends the violations that it finds to `found`.
#pragma once

#include <array>
#include <optional>

#include "law_check/contact_kinematics.hpp"

namespace signorini::law_check {

/// Allowed error in units of the engine's tolerance: an engine activates a guard again at ten tolerances from its zero,
/// and a guard has two terms.
inline constexpr double tolerance_factor = 20.0;
/// If a contact can continue neither in stick nor in slip, slip rates up to this multiple of the rest speed are regarded
/// as rest (docs/theory.md, "Rigid contacts").
inline constexpr double slow_slip_factor = 16.0;
/// Allowed error in units of the uncertainty of a time: 1 for t_uncertainty, which is of first order, 1 for higher orders
/// of the motion, and 1 for a second guard at the same instant. Chosen value.
inline constexpr double uncertainty_factor = 3.0;

/// A violation larger than this fraction of a guard's terms ends the run, because an underestimated rounding error cannot
/// explain it. Chosen value. Example: a body on four rigid contacts, where three would support it, violates guards by the
/// whole size of their terms (test "coupled", seed 19).
inline constexpr double grave_fraction = 1e-3;

/// Accelerations due to unit forces along n and t of a contact whose degrees of freedom all have mass. by_n, by_t:
/// accelerations of the structure; nn, nt, tt: accelerations of the contact itself, W_k.
struct ContactResponse {
  Vector by_n, by_t;
  double nn = 0.0, nt = 0.0, tt = 0.0;
};

/// Weights w of the constraint forces N and T of a contact: forces f on the structure cause the contact force w . f.
/// Empty: this force of the contact is not a constraint force.
struct ConstraintForceWeights {
  Vector N, T;
};

/// Model, limits, and derived data of the model that the laws use.
class CheckContext {
 public:
  CheckContext(const Model& model, const LawLimits& limits);
  ~CheckContext();
  CheckContext(const CheckContext&) = delete;
  CheckContext& operator=(const CheckContext&) = delete;

  /// M^-1 x on degrees of freedom with mass, and 0 on the others. Empty: M is singular on degrees of freedom with mass.
  [[nodiscard]] Vector solve_mass(const Vector& x) const;
  /// Largest sqrt((M^-1)_ii), for translations and for rotations.
  [[nodiscard]] const std::array<double, 2>& inverse_mass_root() const;
  /// Response of contact k to its own forces; null if the contact acts on a massless degree of freedom.
  [[nodiscard]] const ContactResponse* contact_response(std::size_t k) const;
  /// Largest sum, over all rows, of the absolute terms of M a + C v + K u and of contact forces: constraint forces are
  /// differences of these terms.
  [[nodiscard]] double balance_terms(const CheckedSide& side) const;
  [[nodiscard]] bool has_mass(int dof) const { return massive_[static_cast<std::size_t>(dof)]; }
  /// Largest |x_i| of translations, and of rotations.
  [[nodiscard]] std::array<double, 2> max_entries(const Vector& x) const;
  /// Twice the elastic energy, u^T K u; K includes the springs of all contacts.
  [[nodiscard]] double twice_energy(const Vector& u) const;
  /// Massless degrees of freedom, contacts that act on a massless degree of freedom, and the transposes of K and C, for
  /// access by rows. All are empty if every degree of freedom has mass.
  [[nodiscard]] const std::vector<int>& massless() const { return massless_; }
  [[nodiscard]] const std::vector<std::size_t>& contacts_on_massless() const { return on_massless_; }
  [[nodiscard]] const SparseMatrix& stiffness_by_rows() const { return stiffness_by_rows_; }
  [[nodiscard]] const SparseMatrix& damping_by_rows() const { return damping_by_rows_; }
  /// Upper bound of the speed that capture impulses give to contact k.
  [[nodiscard]] double capture_speed(const Vector& captures, std::size_t k) const;
  /// Bound of |g''| of contact k, with and without its own normal force.
  [[nodiscard]] double max_gap_acceleration(const InstantRecord& record, std::size_t k) const;
  /// Bound of the acceleration of contact k along n or t before and after the instant, with and without its own force.
  [[nodiscard]] double max_contact_acceleration(const InstantRecord& record, std::size_t k) const;
  /// Accelerations due to dampers and the velocities that captures remove at the end of a step. Guards are located while
  /// these accelerations are still present. Empty: none.
  [[nodiscard]] Vector capture_accelerations(const InstantRecord& record) const;
  /// Velocities that captures remove at the end of a fixed step. Empty: none.
  [[nodiscard]] Vector capture_velocities(const InstantRecord& record) const;
  /// Weights of the constraint forces of contact k just before the instant, with all other constraint forces present.
  [[nodiscard]] ConstraintForceWeights constraint_force_weights(const InstantRecord& record,
                                                                std::size_t k) const;
  /// Bound of the difference between two computed values of w . f just before the instant (check_context.cpp).
  [[nodiscard]] double constraint_force_noise(const InstantRecord& record, const Vector& w) const;
  /// Speed below which contact k is regarded as at rest: capture velocity, rounding, tolerances, and the speed of flights
  /// that the engine does not resolve.
  [[nodiscard]] double rest_speed(const InstantRecord& record, std::size_t k) const;

  const Model& model;
  const LawLimits limits;

 private:
  struct Factor;
  void find_massless();
  [[nodiscard]] static SparseMatrix springs_of(const Model& model);
  [[nodiscard]] double damped(const InstantRecord& record, const Vector& w, const Vector& v) const;

  std::vector<bool> massive_;
  Vector rotation_mask_;  // 1 for rotations, otherwise 0
  SparseMatrix springs_;
  std::vector<int> massless_;
  std::vector<std::size_t> on_massless_;
  SparseMatrix stiffness_by_rows_, damping_by_rows_;
  std::unique_ptr<Factor> factor_;
  mutable std::vector<std::optional<ContactResponse>> responses_;
  mutable std::optional<std::array<double, 2>> lightness_;
};

/// Checks the motion between two instants from its two ends: `from` just after one instant, `to` just before the next one,
/// at t.
[[nodiscard]] std::vector<Violation> stretch_laws(const CheckContext& context, double t,
                                                  const CheckedSide& from, const CheckedSide& to);
/// Checks the equation of motion in rows with mass just after an instant. Returns only the row whose residual exceeds its
/// limit by the largest factor; empty: all rows satisfy their limits. load: P.
[[nodiscard]] std::vector<Violation> equilibrium_law(const CheckContext& context, double t,
                                                     const CheckedSide& side, const Vector& load);

/// A massless degree of freedom on which forces, or rates of forces, are not balanced.
struct MasslessImbalance {
  int dof = 0;
  const char* law = "";
  double value = 0.0, limit = 0.0;
  int order = 0;  ///< 0: forces; 1, 2: their first or second rates
};
/// Massless degrees of freedom that are not balanced, at most one per order. orders: 1: forces; 2: also their rates;
/// 3: also their second rates.
[[nodiscard]] std::vector<MasslessImbalance> massless_balance(const CheckContext& context,
                                                              const CheckedSide& side, int orders);
/// Rounding error of the forces on each massless degree of freedom (order 0), or of their first rates (order 1); the
/// vector has the model's size. Errors due to the engine's tolerances are not included.
[[nodiscard]] Vector massless_noise(const CheckContext& context, const CheckedSide& side, int order);

/// Checks the laws at one instant.
class InstantLawChecker {
 public:
  InstantLawChecker(const CheckContext& context, const InstantRecord& record, std::vector<Violation>& found)
      : context_(context), model_(context.model), record_(record), found_(found) {}
  void momentum();
  void captures();
  void restitution();
  void states();
  void transitions();
  void continuity();
  void releases();
  void continuation();
  void event_rows();
  void balance();

 private:
  [[nodiscard]] bool is_struck() const;
  void add(int contact, const char* law, double value, double limit, const Unit& unit, bool unexplained);
  /// Velocities g' and ut' of a contact before and after one impact.
  struct ImpactVelocities {
    double dg_before = 0.0, dg_after = 0.0, dut_after = 0.0;
    double uncertainty = 0.0;  // speed due to captures, which may act before or after the impact
  };
  [[nodiscard]] ImpactVelocities impact_velocities(const RecordedImpulse& p, const ContactKinematics& before,
                                                   const ContactKinematics& after) const;
  void restitution_of(const RecordedImpulse& p, const ImpactVelocities& strike, double greatest);
  void friction_impulse(const RecordedImpulse& p, const ImpactVelocities& strike, double greatest);
  void state_of(std::size_t k);
  void friction_of(std::size_t k, const ContactKinematics& m);
  void old_rows(std::size_t k);
  void necessity(std::size_t k);
  [[nodiscard]] bool old_guard_is_zero(std::size_t k, const ContactState& old,
                                       const ContactKinematics& before) const;
  void guard_of(const RecordedEvent& event);
  [[nodiscard]] bool shear_stays(std::size_t k) const;
  void friction_continuity(std::size_t k);
  [[nodiscard]] bool friction_follows_drop(std::size_t k, const ContactKinematics& before,
                                           const ContactKinematics& after, double off_N, double off_T) const;
  [[nodiscard]] Vector closing() const;
  [[nodiscard]] double massless_dof_uncertainty(int dof) const;
  [[nodiscard]] ContactKinematics touching(std::size_t k, const CheckedSide& side) const;
  void event_row(const RecordedEvent& event);
  void row_before(const RecordedEvent& event, const ContactKinematics& before,
                  const ContactKinematics& after);
  void row_gap(const RecordedEvent& event, const ContactKinematics& after);
  void row_check(const RecordedEvent& event, double off, double limit, const Unit& unit);
  [[nodiscard]] double spring_noise_before(std::size_t k, const ContactKinematics& before) const;
  [[nodiscard]] double held_noise_before(std::size_t k) const;
  [[nodiscard]] double step_error(std::size_t k, double of_u, double of_v) const;
  [[nodiscard]] double settled(const RecordedEvent& event) const;
  [[nodiscard]] bool is_released(std::size_t k) const;
  [[nodiscard]] double continued_position_scale(const Contact& c) const;
  /// Motion that a contact would have in its old state, and the uncertainty of its forces due to rounding of accelerations.
  struct OldStateMotion {
    ContactKinematics m;
    double uncertainty_N = 0.0, uncertainty_T = 0.0;
  };
  [[nodiscard]] std::optional<OldStateMotion> motion_in_old_state(std::size_t k) const;
  [[nodiscard]] bool is_pushed_off(std::size_t k, const ContactState& old,
                                   const ContactKinematics& after) const;
  [[nodiscard]] bool jumps(std::size_t k) const;
  [[nodiscard]] bool moves_instantaneously(std::size_t k) const;
  [[nodiscard]] double zero_of(const GuardValue& guard, const Contact& contact) const;
  [[nodiscard]] const RecordedEvent* event_of(std::size_t k) const;
  /// True if displacements of massless parts may jump at this instant.
  [[nodiscard]] bool lets_massless_jump() const;
  [[nodiscard]] bool body_follows(std::size_t k) const;
  [[nodiscard]] bool lets_go(std::size_t k) const;
  void instantaneous_slide(std::size_t k);
  /// Rounding error of constraint forces just after the instant.
  [[nodiscard]] double force_noise() const;

  const CheckContext& context_;
  const Model& model_;
  const InstantRecord& record_;
  std::vector<Violation>& found_;
  mutable std::optional<double> force_noise_;
  mutable std::optional<bool> massless_jump_;
};

}  // namespace signorini::law_check
