// audit.hpp: residuals of a run's own conditions, and its energy balance.
//
//   (6)  g >= 0, N <= 0, g N = 0          g - N/kn in place of g for contact elements
//   (7)  |T| <= T_U, T p' >= 0            T_U static in stick, kinetic in slip
//   E_kin + E_el + E_contact + D_friction + D_damping + D_impact - W_loads - W_surface = const
//
// Contacts are checked after every step; works and dissipations are integrals of powers (motion/point.hpp) that the
// engine computes with its own accuracy.
#pragma once

#include "run/touch_tracker.hpp"

namespace signorini::run {

/// True if there are degrees of freedom with neither mass nor damping; they respond instantaneously.
[[nodiscard]] bool has_instantaneous_parts(const Model& model);

class Auditor {
 public:
  Auditor(const Model& model, const linear::SystemMatrices& structure);

  /// Adds works and losses since the last call.
  void add(const motion::WorkIntegrals& works);

  /// Starts the audit. first: the states guessed before the decision; point: the motion after the decision.
  void begin(const decide::Decision& decision, const contact::ContactStates& first,
             const motion::Forcing& forcing, const motion::Point& point);
  /// Checks contacts at the end of a step or after an event.
  void observe(const motion::Forcing& forcing, double t, const contact::ContactStates& states,
               const motion::Point& point);
  /// Checks one contact; only the entries of the point that it depends on are read.
  void observe(std::size_t contact, const motion::Forcing& forcing, double t,
               const contact::ContactStates& states, const motion::Point& point);
  void equilibrium(double t, double residual);
  /// Adds the dissipation of an instant, where friction forces drop or loads on massless parts jump.
  void instant(double t, const decide::Decision& decision, const contact::ContactStates& old_states,
               const motion::Point& before, const motion::Forcing& forcing, bool load_jumps);
  /// Returns the energies at t, and audits their balance. ahead: works already added, for times after t.
  Energy energy(double t, const contact::ContactStates& states, const motion::Point& point);
  Energy energy(double t, const motion::WorkIntegrals& ahead, const contact::ContactStates& states,
                const motion::Point& point);
  /// Energies at a point before these works, which have been added already; the balance is not audited.
  [[nodiscard]] Energy energy_before(const motion::WorkIntegrals& works, const contact::ContactStates& states,
                                     const motion::Point& point) const;
  [[nodiscard]] ContactSample sample(std::size_t contact, const motion::Forcing& forcing, double t,
                                     const ContactState& state, const motion::Point& point) const;

  /// Energy dissipated by friction so far, by contact.
  [[nodiscard]] const std::vector<double>& friction_losses() const { return friction_; }

  void finish(Report& report, const Energy& last, double t, const contact::ContactStates& states) const;

 private:
  [[nodiscard]] ContactMotion motion(std::size_t k, const motion::Forcing& forcing, double t,
                                     const motion::Point& point) const {
    return motion::motion_of(model_.contacts[k], k, forcing, t, point);
  }

  /// Updates the extreme forces of a contact at t.
  void update_peak_forces(std::size_t contact, double t, double N, double T);
  /// Position p of the sliding point; for rigid stick the anchor.
  [[nodiscard]] double slip(std::size_t contact, const ContactState& state, const ContactMotion& m) const;

  /// Work P . (u+ - u-) of constant loads on massless parts that jump.
  [[nodiscard]] double work_of_jump(const motion::Forcing& forcing, double t, const motion::Point& before,
                                    const decide::Decision& decision) const;
  /// Audits the balance of these energies.
  Energy audit_balance(double t, Energy e);
  /// Kinetic, elastic and contact energies.
  [[nodiscard]] Energy stored(const contact::ContactStates& states, const motion::Point& point) const;

  const Model& model_;
  const linear::SystemMatrices& structure_;
  Audit audit_;
  Energy work_;  // dissipations and works so far
  std::vector<double> friction_;
  struct Place {
    double normal = 0.0, ut = 0.0;
  };
  [[nodiscard]] Place place_of(std::size_t contact, const motion::Forcing& forcing, double t, State state,
                               const motion::Point& point) const;
  std::vector<Place> at_start_;
  double seen_at_start_ = 0.0;  ///< Model::correction_energy
  std::vector<Peak> peaks_;
  std::vector<SupportLoad> supports_;
  LandingTracker landings_;
  bool massless_;  // has_instantaneous_parts()
  bool begun_ = false;
};

}  // namespace signorini::run
