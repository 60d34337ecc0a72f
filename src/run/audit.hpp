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

namespace signorini {

/// True if there are degrees of freedom with neither mass nor damping.
[[nodiscard]] bool moves_at_once(const Model& model);

class Auditor {
 public:
  Auditor(const Model& model, const Structure& structure);

  /// Adds the works and losses of a stretch of the motion.
  void add(const Works& works);

  /// Starts the audit. first: the states that were guessed before the decision; point: its motion.
  void begin(const Decision& decision, const Mode& first, const Forcing& forcing, const Point& point);
  /// Checks contacts at the end of a step or after an event.
  void observe(const Forcing& forcing, double t, const Mode& mode, const Point& point);
  /// Checks one contact; only the entries of the point that it depends on are read.
  void observe(std::size_t contact, const Forcing& forcing, double t, const Mode& mode, const Point& point);
  void equilibrium(double t, double residual);
  /// Adds the dissipation of an instant: friction forces that drop, loads that jump on massless parts.
  void instant(double t, const Decision& decision, const Mode& old_mode, const Point& before,
               const Forcing& forcing, bool load_jumps);
  /// Energies at t; also audits the balance. ahead: works that have been added and belong to times after t.
  Energy energy(double t, const Mode& mode, const Point& point);
  Energy energy(double t, const Works& ahead, const Mode& mode, const Point& point);
  /// Energies at a point before these works, which have been added; without an audit.
  [[nodiscard]] Energy energy_before(const Works& works, const Mode& mode, const Point& point) const;
  [[nodiscard]] ContactSample sample(std::size_t contact, const Forcing& forcing, double t,
                                     const ContactState& state, const Point& point) const;

  /// Energy dissipated by friction so far, by contact.
  [[nodiscard]] const std::vector<double>& losses() const { return friction_; }

  void finish(Report& report, const Energy& last, double t, const Mode& mode) const;

 private:
  [[nodiscard]] ContactMotion motion(std::size_t k, const Forcing& forcing, double t,
                                     const Point& point) const {
    return motion_of(model_.contacts[k], k, forcing, t, point);
  }

  /// Updates the extreme forces of a contact at t.
  void bears(std::size_t contact, double t, double N, double T);
  /// Slip p; for rigid stick the anchor.
  [[nodiscard]] double slip(std::size_t contact, const ContactState& state, const ContactMotion& m) const;

  /// Work P . (u+ - u-) of constant loads on massless parts that jump.
  [[nodiscard]] double work_of_jump(const Forcing& forcing, double t, const Point& before,
                                    const Decision& decision) const;
  /// Audits the balance of these energies.
  Energy audited(double t, Energy e);
  /// Kinetic, elastic and contact energies.
  [[nodiscard]] Energy stored(const Mode& mode, const Point& point) const;

  const Model& model_;
  const Structure& structure_;
  Audit audit_;
  Energy work_;  // dissipations and works so far
  std::vector<double> friction_;
  struct Place {
    double normal = 0.0, ut = 0.0;
  };
  [[nodiscard]] Place place_of(std::size_t contact, const Forcing& forcing, double t, State state,
                               const Point& point) const;
  std::vector<Place> at_start_;
  double seen_at_start_ = 0.0;  ///< Model::seen_energy
  std::vector<Peak> peaks_;
  std::vector<SupportLoad> supports_;
  Landings landings_;
  bool massless_;  // there are degrees of freedom that move instantaneously
  bool begun_ = false;
};

}  // namespace signorini
