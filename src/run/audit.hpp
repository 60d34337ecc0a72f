// audit.hpp: residuals of the contact conditions during a run, and its energy balance.
//
//   (6)  g >= 0, N <= 0, g N = 0          g - N/kn in place of g for contact elements
//   (7)  |T| <= T_U, T p' >= 0            T_U static in stick, kinetic in slip
//   E_kin + E_el + E_contact + D_friction + D_damping + D_impact - W_loads - W_surface = const
//
// Contacts are checked after every step. The work of forces and the dissipated energies are integrals of power
// (motion/point.hpp); the engine computes them as accurately as the motion.
#pragma once

#include "run/touch_tracker.hpp"

namespace signorini::run {

/// True if there are degrees of freedom with neither mass nor damping; they respond instantaneously.
[[nodiscard]] bool has_instantaneous_parts(const Model& model);

class Auditor {
 public:
  Auditor(const Model& model, const linear::SystemMatrices& structure);

  /// Adds the work and the dissipated energies since the last call.
  void add(const motion::WorkIntegrals& works);

  /// Starts the audit. first: contact states guessed before the decision at t = 0; point: the motion after this decision.
  void begin(const decide::Decision& decision, const contact::ContactStates& first,
             const motion::Forcing& forcing, const motion::Point& point);
  /// Checks contacts at the end of a step or after an event.
  void observe(const motion::Forcing& forcing, double t, const contact::ContactStates& states,
               const motion::Point& point);
  /// Checks one contact; reads only those entries of the point that affect this contact.
  void observe(std::size_t contact, const motion::Forcing& forcing, double t,
               const contact::ContactStates& states, const motion::Point& point);
  /// Updates the largest residual of the equation of motion; `residual` is a force.
  void equilibrium(double t, double residual);
  /// Adds the work and the dissipated energies of an instant: impacts, drops of friction forces, and jumps of massless parts.
  void instant(double t, const decide::Decision& decision, const contact::ContactStates& old_states,
               const motion::Point& before, const motion::Forcing& forcing, bool load_jumps);
  /// Returns the energies at t, and audits their balance. ahead: the work done after t, which add() has received already.
  Energy energy(double t, const contact::ContactStates& states, const motion::Point& point);
  Energy energy(double t, const motion::WorkIntegrals& ahead, const contact::ContactStates& states,
                const motion::Point& point);
  /// Energies at an earlier point; the balance is not audited. works: the work done after this point, which add() has received
  /// already.
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

  /// Notes the contacts that rest at their friction limit from a decision at t on.
  void update_limits(double t, const decide::Decision& decision);
  /// Updates the extremes of N and T of a contact with their values at t.
  void update_peak_forces(std::size_t contact, double t, double N, double T);
  /// Position p of the sliding point; while a contact with tangential_stiffness sticks: its anchor.
  [[nodiscard]] double slip(std::size_t contact, const ContactState& state, const ContactMotion& m) const;

  /// Work P . (u+ - u-) of loads P on massless parts that jump while P stays constant.
  [[nodiscard]] double work_of_jump(const motion::Forcing& forcing, double t, const motion::Point& before,
                                    const decide::Decision& decision) const;
  /// Updates the largest error of the balance; returns e without Model::correction_energy.
  Energy audit_balance(double t, Energy e);
  /// Kinetic, elastic and contact energies; work and dissipated energies are zero.
  [[nodiscard]] Energy stored(const contact::ContactStates& states, const motion::Point& point) const;

  const Model& model_;
  const linear::SystemMatrices& structure_;
  Audit audit_;
  Energy work_;  // work and dissipated energies since t = 0
  std::vector<double> friction_;
  struct Place {
    double normal = 0.0, ut = 0.0;
  };
  [[nodiscard]] Place place_of(std::size_t contact, const motion::Forcing& forcing, double t, State state,
                               const motion::Point& point) const;
  std::vector<Place> at_start_;
  double correction_energy_at_start_ = 0.0;  ///< Model::correction_energy at t = 0
  std::vector<Peak> peaks_;
  std::vector<SupportLoad> supports_;
  std::vector<bool> rested_at_limit_;  // one entry per contact
  LandingTracker landings_;
  bool massless_;  // has_instantaneous_parts(model)
  bool begun_ = false;
};

}  // namespace signorini::run
