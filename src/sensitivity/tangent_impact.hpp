// tangent_impact.hpp: derivative of the velocities after an impact.
//
//   M (Dv+ - Dv-) - sum ( n DPn + t DPt ) = sum ( n_p Pn + t_p Pt ) - M_p (v+ - v-)      contacts with Pn > 0
//   n . Dv+ + n_p . v+ = -e (n . Dv- + n_p . v-) - e_p min(vn-, 0)       e = 0 if the contact comes to rest
//   sticks: t . Dv+ + t_p . v+ = Ds',      slides along s: DPt + s f DPn = -s f_p Pn
//
// D: along the moving instant. Touching contacts without impulse are not included, since they have none to first order.
#pragma once

#include "decide/decision.hpp"
#include "motion/mode_systems.hpp"
#include "sensitivity/model_derivative.hpp"

namespace signorini {

struct ImpactRates {
  bool known = false;
  Vector v;                             ///< Dv+
  std::vector<double> normal, tangent;  ///< DPn, DPt, one per contact
};

/// v, Dv: just before. surface: Ds' of every contact. mode: before the impact.
[[nodiscard]] ImpactRates impact_rates(ModeSystems& systems, const ModelDerivative& derivative, Mode mode,
                                       const Decision& after, const Vector& v_before, const Vector& Dv_before,
                                       const std::vector<double>& surface);

}  // namespace signorini
