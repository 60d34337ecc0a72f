// audit.hpp: how well a run satisfies its own conditions, and where its energy went.
//
//   (6)  g >= 0, N <= 0, g N = 0          g - N/kn in place of g for contact elements
//   (7)  |T| <= T_U, T p' >= 0            T_U static in stick, kinetic in slip
//   E_kin + E_el + E_contact + D_friction + D_damping + D_impact - W_loads - W_surface = const
//
// Contacts are observed after every step; works and dissipations are integrals of powers
// (motion/powers.hpp) that the engine takes with its own accuracy.
#pragma once

#include "run/landings.hpp"

namespace signorini {

/// There are degrees of freedom with neither mass nor damping.
[[nodiscard]] bool moves_at_once(const Model& model);

class Auditor {
 public:
  Auditor(const Model& model, const Structure& structure);

  /// Adds what a stretch of the motion has brought and lost.
  void add(const Works& works);

  /// first: the states that were guessed before the decision; point: its motion.
  void begin(const Decision& decision, const Mode& first, const Forcing& forcing, const Point& point);
  /// Contacts at the end of a step or after an event.
  void observe(const Forcing& forcing, double t, const Mode& mode, const Point& point);
  /// One contact; of the point what it touches.
  void observe(std::size_t contact, const Forcing& forcing, double t, const Mode& mode, const Point& point);
  void equilibrium(double t, double residual);
  /// What an instant dissipates: friction forces that drop, loads that jump on massless parts.
  void instant(double t, const Decision& decision, const Mode& old_mode, const Point& before,
               const Forcing& forcing, bool load_jumps);
  /// Energies now; also audits the balance. ahead: works that have been added and come after t.
  Energy energy(double t, const Mode& mode, const Point& point);
  Energy energy(double t, const Works& ahead, const Mode& mode, const Point& point);
  /// Energies at a point before these works, which have been added; audits nothing.
  [[nodiscard]] Energy energy_before(const Works& works, const Mode& mode, const Point& point) const;
  [[nodiscard]] ContactSample sample(std::size_t contact, const Forcing& forcing, double t,
                                     const ContactState& state, const Point& point) const;

  /// Work lost by friction so far, by contact.
  [[nodiscard]] const std::vector<double>& losses() const { return friction_; }

  void finish(Report& report, const Energy& last, double t, const Mode& mode) const;

 private:
  [[nodiscard]] ContactMotion motion(std::size_t k, const Forcing& forcing, double t,
                                     const Point& point) const {
    return motion_of(model_.contacts[k], k, forcing, t, point);
  }

  /// Force on a contact at t.
  void bears(std::size_t contact, double t, double N, double T);
  /// p, that of a rigid stick its anchor.
  [[nodiscard]] double slip(std::size_t contact, const ContactState& state, const ContactMotion& m) const;

  /// Of the loads on parts without mass, which jump under loads that stay: P . (u+ - u-).
  [[nodiscard]] double work_of_jump(const Forcing& forcing, double t, const Point& before,
                                    const Decision& decision) const;
  /// Audits the balance of these.
  Energy audited(double t, Energy e);
  /// Kinetic, elastic and contact energy.
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
  bool massless_;  // there are degrees of freedom that move at once
  bool begun_ = false;
};

}  // namespace signorini
