// law_rates.hpp: forces of a contact in its state, and their derivatives by a parameter.
//
//   N = N_g g + N_c,   N_p = N_g g_p + N_g,p g + N_c,p
//   T = T_g g + T_u ut + T_c,   T_p = T_g g_p + T_g,p g + T_u ut_p + T_u,p ut + T_c,p
//
// Valid for constant forces and surfaces, as in a modal stretch.
#pragma once

#include "decide/decision.hpp"
#include "engine/exact/modal/modal_system.hpp"
#include "sensitivity/contact_rates.hpp"

namespace signorini {

/// Data of one parameter for a stretch.
struct TangentSource {
  const Tangent* start = nullptr;  ///< null: not followed
  ForcingRatesSeries forcing;      ///< with scale 1
};

/// Derivatives for one contact and one parameter.
struct LawRates {
  ForceLaw law;
  ForceLaw rates;                    ///< derivatives of the law's numbers
  double gap = 0.0, gap_rate = 0.0;  ///< g0 and g0_p
  double surface = 0.0, surface_rate = 0.0;

  /// From g, ut and their derivatives by the parameter; likewise for rates from g' and ut'.
  [[nodiscard]] double N_by(double g, double g_by) const { return law.N_gap * g_by + rates.N(g); }
  [[nodiscard]] double T_by(double g, double g_by, double ut, double ut_by) const {
    return law.T_rate(g_by, ut_by) + rates.T(g, ut);
  }
  [[nodiscard]] double N_rate_by(double vn, double vn_by) const {
    return law.N_rate(vn_by) + rates.N_rate(vn);
  }
  [[nodiscard]] double T_rate_by(double vn, double vn_by, double vt, double vt_by) const {
    return law.T_rate(vn_by, vt_by) + rates.T_rate(vn, vt);
  }
};

[[nodiscard]] LawRates law_rates(const Contact& contact, std::size_t c, const ContactState& state,
                                 const ContactRates& rates, const Forcing& forcing, double t,
                                 const TangentSource& source);

}  // namespace signorini
