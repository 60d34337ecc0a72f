// laws.hpp: the laws of an instant, one function each; what they share.
//
//   W_k = (n, t)^T M^-1 (n, t) of one contact: what its own forces do to its own accelerations
//
// Every function adds what it finds to `found`.
#pragma once

#include <array>
#include <optional>

#include "witness/sight.hpp"

namespace signorini {

/// Engines re-arm a guard ten tolerances from its zero, and its terms are two. Times a tolerance.
inline constexpr double of_tolerance = 20.0;
/// Where no motion goes on, slip rates up to sixteen times the speeds that count as rest are taken as rest, too
/// (docs/theory.md, "Rigid contacts").
inline constexpr double with_slow_slips = 16.0;
/// A time is uncertain by t_uncertainty to first order; the rest of the motion's series, and a second guard at the same
/// instant, are given as much again. Chosen.
inline constexpr double of_uncertainty = 3.0;

/// States that fail, and changes without a reason, by more than this part of a guard's terms are no rounding that was
/// taken for too small: they are grave. Chosen; four rigid contacts on a body that three hold (coupled seed 19) fail by all.
inline constexpr double gross = 1e-3;

/// Accelerations by unit forces of a contact, where all its degrees of freedom have mass: of the structure, and its own.
struct OwnResponse {
  Vector by_n, by_t;
  double nn = 0.0, nt = 0.0, tt = 0.0;
};

/// Of a contact whose forces hold accelerations: what the structure's forces f make of them is w . f. Empty: it holds none.
struct HeldForce {
  Vector N, T;
};

/// What laws know of the model.
class Bench {
 public:
  Bench(const Model& model, const WitnessLimits& limits);
  ~Bench();
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;

  /// M^-1 x on degrees of freedom with mass, 0 elsewhere. Empty: M is not regular there.
  [[nodiscard]] Vector per_mass(const Vector& x) const;
  /// The greatest sqrt((M^-1)_ii), of translations and of rotations.
  [[nodiscard]] const std::array<double, 2>& lightness() const;
  /// Null: contact k acts where there is no mass.
  [[nodiscard]] const OwnResponse* own_response(std::size_t k) const;
  /// The greatest sum of the terms of M a + C v + K u and of contact forces: what forces that hold accelerations are differences of.
  [[nodiscard]] double balance(const WitnessedSide& side) const;
  [[nodiscard]] bool has_mass(int dof) const { return massive_[static_cast<std::size_t>(dof)]; }
  /// The greatest |x_i| of translations and of rotations.
  [[nodiscard]] std::array<double, 2> greatest(const Vector& x) const;
  /// u^T K u, springs of contacts in K.
  [[nodiscard]] double twice_energy(const Vector& u) const;
  /// Degrees of freedom without mass, contacts that act on one, and rows of K and C as columns; empty: all have mass.
  [[nodiscard]] const std::vector<int>& massless() const { return massless_; }
  [[nodiscard]] const std::vector<std::size_t>& on_massless() const { return on_massless_; }
  [[nodiscard]] const SparseMatrix& stiffness_by_rows() const { return stiffness_by_rows_; }
  [[nodiscard]] const SparseMatrix& damping_by_rows() const { return damping_by_rows_; }
  /// The speed at most by which captures move contact k.
  [[nodiscard]] double moved_by(const Vector& captures, std::size_t k) const;
  /// An acceleration of its gap that its forces may have held.
  [[nodiscard]] double pull(const InstantRecord& record, std::size_t k) const;
  /// The same along both directions, of the motions before and after.
  [[nodiscard]] double swing(const InstantRecord& record, std::size_t k) const;
  /// What dampers make of the velocities that captures take out of steps: guards are located with these. Empty: nothing.
  [[nodiscard]] Vector swung(const InstantRecord& record) const;
  /// The velocities that captures take out of steps. Empty: none.
  [[nodiscard]] Vector captured(const InstantRecord& record) const;
  /// The forces of contact k just before, among all that hold accelerations there.
  [[nodiscard]] HeldForce held_force(const InstantRecord& record, std::size_t k) const;
  /// What w . f is known to just before, summed twice.
  [[nodiscard]] double held_noise(const InstantRecord& record, const Vector& w) const;
  /// Slower than this a contact that leaves may be taken as rest.
  [[nodiscard]] double slowest(const InstantRecord& record, std::size_t k) const;

  const Model& model;
  const WitnessLimits limits;

 private:
  struct Factor;
  void note_massless();
  [[nodiscard]] static SparseMatrix springs_of(const Model& model);
  [[nodiscard]] double damped(const InstantRecord& record, const Vector& w, const Vector& v) const;

  std::vector<bool> massive_;
  Vector turns_;  // 1 of rotations, else 0
  SparseMatrix springs_;
  std::vector<int> massless_;
  std::vector<std::size_t> on_massless_;
  SparseMatrix stiffness_by_rows_, damping_by_rows_;
  std::unique_ptr<Factor> factor_;
  mutable std::vector<std::optional<OwnResponse>> responses_;
  mutable std::optional<std::array<double, 2>> lightness_;
};

/// Of a stretch, by its ends: just after one instant, just before the next, at t.
[[nodiscard]] std::vector<Violation> stretch_laws(const Bench& bench, double t, const WitnessedSide& from,
                                                  const WitnessedSide& to);
/// Rows with mass just after an instant; the worst one. load: P.
[[nodiscard]] std::vector<Violation> equilibrium_law(const Bench& bench, double t, const WitnessedSide& side,
                                                     const Vector& load);

/// A row without mass whose forces, or their rates, do not balance.
struct Unbalanced {
  int dof = 0;
  const char* law = "";
  double value = 0.0, limit = 0.0;
  int order = 0;  ///< of the derivative
};
/// orders: 1 forces, 2 their rates, too, 3 and the rates of these. At most one row an order.
[[nodiscard]] std::vector<Unbalanced> massless_balance(const Bench& bench, const WitnessedSide& side,
                                                       int orders);
/// Rounding of the forces of each row without mass, or of their first derivatives (order 1), n; what tolerances leave is
/// not in it.
[[nodiscard]] Vector massless_noise(const Bench& bench, const WitnessedSide& side, int order);

/// The laws at one instant.
class Finder {
 public:
  Finder(const Bench& bench, const InstantRecord& record, std::vector<Violation>& found)
      : bench_(bench), model_(bench.model), record_(record), found_(found) {}
  void momentum();
  void captures();
  void restitution();
  void states();
  void transitions();
  void continuity();
  void releases();
  void continuation();
  void rows();
  void balance();

 private:
  [[nodiscard]] bool is_struck() const;
  void add(int contact, const char* law, double value, double limit, const Unit& unit, bool grave);
  /// Velocities along n and t of a contact where an impact began and where it ended.
  struct Strike {
    double dg_before = 0.0, dg_after = 0.0, dut_after = 0.0;
    double unsure = 0.0;  // what captures have moved, before or after
  };
  [[nodiscard]] Strike strike_of(const RecordedImpulse& p, const Sight& before, const Sight& after) const;
  void restitution_of(const RecordedImpulse& p, const Strike& strike, double greatest);
  void friction_impulse(const RecordedImpulse& p, const Strike& strike, double greatest);
  void state_of(std::size_t k);
  void friction_of(std::size_t k, const Sight& m);
  void old_rows(std::size_t k);
  void necessity(std::size_t k);
  [[nodiscard]] bool its_own_falls(std::size_t k, const ContactState& old, const Sight& before) const;
  void guard_of(const RecordedEvent& event);
  [[nodiscard]] bool shear_stays(std::size_t k) const;
  void friction_continuity(std::size_t k);
  [[nodiscard]] bool falls_with_it(std::size_t k, const Sight& before, const Sight& after, double off_N,
                                   double off_T) const;
  [[nodiscard]] Vector closing() const;
  [[nodiscard]] double unsure_without_mass(int dof) const;
  [[nodiscard]] Sight touching(std::size_t k, const WitnessedSide& side) const;
  void row_of(const RecordedEvent& event);
  void row_before(const RecordedEvent& event, const Sight& before, const Sight& after);
  void row_gap(const RecordedEvent& event, const Sight& after);
  void row_check(const RecordedEvent& event, double off, double limit, const Unit& unit);
  [[nodiscard]] double spring_noise_before(std::size_t k, const Sight& before) const;
  [[nodiscard]] double held_noise_before(std::size_t k) const;
  [[nodiscard]] double step_error(std::size_t k, double of_u, double of_v) const;
  [[nodiscard]] double settled(const RecordedEvent& event) const;
  [[nodiscard]] bool is_released(std::size_t k) const;
  [[nodiscard]] double left_terms(const Contact& c) const;
  /// A contact in its old state, and by how much rounding of accelerations moves its forces.
  struct Old {
    Sight m;
    double unsure_N = 0.0, unsure_T = 0.0;
  };
  [[nodiscard]] std::optional<Old> as_before(std::size_t k) const;
  [[nodiscard]] bool is_pushed_off(std::size_t k, const ContactState& old, const Sight& after) const;
  [[nodiscard]] bool jumps(std::size_t k) const;
  [[nodiscard]] bool moves_at_once(std::size_t k) const;
  [[nodiscard]] double zero_of(const SeenGuard& guard, const Contact& contact) const;
  [[nodiscard]] const RecordedEvent* event_of(std::size_t k) const;
  /// Displacements without mass may jump.
  [[nodiscard]] bool lets_massless_jump() const;
  [[nodiscard]] bool body_follows(std::size_t k) const;
  [[nodiscard]] bool lets_go(std::size_t k) const;
  void slide_at_once(std::size_t k);
  /// Rounding of forces that hold accelerations.
  [[nodiscard]] double force_noise() const;

  const Bench& bench_;
  const Model& model_;
  const InstantRecord& record_;
  std::vector<Violation>& found_;
  mutable std::optional<double> force_noise_;
  mutable std::optional<bool> massless_jump_;
};

}  // namespace signorini
