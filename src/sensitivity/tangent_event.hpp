// tangent_event.hpp: tangent motion across an instant, for one parameter.
//
//   dt/dp = - (G_p + grad G . w)/G'       for the triggered guard;  tau_p for a breakpoint;  0 at the start
//   w+ = w- + (u'- - u'+) dt/dp,   w'+ = Dv+ - u''+ dt/dp
//   D(ut - T/kt)                          derivative of the position of a new anchor
//
// There is no derivative if the one-sided derivatives differ. They differ if two guards reach zero at one instant and
// separate when the parameter changes, if a guard grazes zero, or if a guard is zero just after the instant and would be
// triggered for other values of the parameter.
//
// If a guard grazes zero, dt/dp is unbounded. But if u'- = u'+ and u''- = u''+, and no new anchor depends on the time, w does
// not depend on dt/dp. Derivatives of states alone (orbits) can cross such a graze with dt/dp = 0.
#pragma once

#include <optional>

#include "decide/decision.hpp"
#include "motion/state_systems.hpp"
#include "run/run_listener.hpp"
#include "sensitivity/contact_rates.hpp"
#include "sensitivity/model_derivative.hpp"

namespace signorini::sensitivity {

// Derivatives of the velocities after an impact.
//
//   M (Dv+ - Dv-) - sum ( n DPn + t DPt ) = sum ( n_p Pn + t_p Pt ) - M_p (v+ - v-)      contacts with Pn > 0
//   n . Dv+ + n_p . v+ = -e (n . Dv- + n_p . v-) - e_p min(vn-, 0)       e = 0 if the contact comes to rest
//   sticks: t . Dv+ + t_p . v+ = Ds',      slides along s: DPt + s f DPn = -s f_p Pn
//
// D: derivative along the moving instant. Touching contacts without an impulse are omitted, because to first order their
// impulse stays zero.

struct ImpactRates {
  bool known = false;
  Vector v;                             ///< Dv+
  std::vector<double> normal, tangent;  ///< DPn and DPt, one entry per contact
};

/// Derivatives of one impact. states, v_before, Dv_before: values just before the impact; surface: Ds' of every contact.
[[nodiscard]] ImpactRates impact_rates(motion::StateSystems& systems, const ModelDerivative& derivative,
                                       contact::ContactStates states, const decide::Decision& after,
                                       const Vector& v_before, const Vector& Dv_before,
                                       const std::vector<double>& surface);

/// The motion just before and just after an instant.
struct InstantMotion {
  const run::RunInstant& instant;
  const SeriesPoint &before, &after;
  const motion::Series& series_after;  ///< Taylor series about the instant, with scale 1
  std::vector<ContactMotion> motion_before, rate_before, motion_after, rate_after;  ///< one entry per contact
};

/// Tangent of one parameter just before an instant.
struct TangentBefore {
  Tangent start;  ///< with the derivatives of the anchors before the instant
  SeriesPoint point;
  std::vector<DrivenRates> driven;
};

/// Tangent of one parameter just after an instant.
struct TangentAfter {
  Tangent start;
  SeriesPoint point;
  std::vector<DrivenRates> driven;
  double dt = 0.0;                ///< dt/dp of the instant
  std::vector<EventRates> rates;  ///< one entry per contact, in internal units
  /// Derivatives of the impulses, one entry per contact; empty: no impact.
  std::vector<double> impulse_n, impulse_t;
  /// Reason why no derivative exists after the instant; empty: the derivative exists.
  std::string reason;
};

class TangentEvents {
 public:
  /// Model, systems and derivative must outlive the object. size: magnitude of the parameter, to which tests for zero are
  /// relative.
  TangentEvents(const Model& model, motion::StateSystems& systems, const ModelDerivative& derivative,
                double size, double t_end)
      : model_(model),
        systems_(systems),
        derivative_(derivative),
        size_(size),
        least_(1e-13 * t_end / size) {}

  [[nodiscard]] TangentAfter pass(const InstantMotion& motion, const TangentBefore& before,
                                  TangentSeries& series) const;
  /// After this call, grazes without jumps are crossed; the times of such events have no derivative.
  void cross_smooth_grazes() { crosses_grazes_ = true; }

 private:
  struct PassState;
  void find_times(PassState& course) const;
  [[nodiscard]] std::optional<double> time_of(PassState& course, std::size_t contact) const;
  [[nodiscard]] bool is_smooth(const PassState& course) const;
  [[nodiscard]] bool sets_moving_anchor(const PassState& course, std::size_t contact) const;
  void move_state(PassState& course) const;
  void move_anchors(PassState& course) const;
  [[nodiscard]] bool vanishes(double rate, double terms, double scale) const;
  void check_resting_guards(PassState& course) const;
  void check_kinks(PassState& course) const;
  void fill_rates(PassState& course) const;

  const Model& model_;
  motion::StateSystems& systems_;
  const ModelDerivative& derivative_;
  double size_;   // size of the parameter, to which tests for zero are relative
  double least_;  // differences of dt/dp below this limit are treated as zero
  bool crosses_grazes_ = false;
};

}  // namespace signorini::sensitivity
