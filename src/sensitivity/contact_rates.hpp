// contact_rates.hpp: derivatives of a contact's motion and forces by a parameter, at fixed time and along a
// moving instant.
//
//   g_p = n . w + n_p . u + g0_p,   ut_p = t . w + t_p . u - s_p,   N_p and T_p directly
//   Dx = x_p + x' dt/dp             of x at a moving instant
#pragma once

#include "decide/decision.hpp"
#include "engine/exact/modal/modal_system.hpp"
#include "motion/point.hpp"
#include "sensitivity/tangent_series.hpp"
#include "signorini/model.hpp"

namespace signorini::sensitivity {

/// Derivatives of a surface motion and a normal force: orders 0, 1 and 2.
struct DrivenRates {
  double surface[3] = {0.0, 0.0, 0.0}, applied_normal_force[2] = {0.0, 0.0};
};
/// Derivatives of a contact's surface motion and normal force at x of a series with this scale.
[[nodiscard]] DrivenRates driven_rates(const ForcingRatesSeries& series, double scale, std::size_t contact,
                                       double x);

/// Degrees of freedom on which contacts, or their derivatives by any parameter, depend.
[[nodiscard]] std::vector<Eigen::Index> contact_dofs(const Model& model,
                                                     const std::vector<const ModelDerivative*>& rates);

/// Motion of contact k at t, from the values of a series.
[[nodiscard]] ContactMotion motion_of(const Contact& contact, std::size_t k, const motion::Forcing& forcing,
                                      double t, const SeriesPoint& point);
/// Time derivative of a contact's motion; the derivatives of g'' and ut'' are left at zero.
[[nodiscard]] ContactMotion time_rate(const ForceLayout& layout, std::size_t k, const ContactMotion& motion,
                                      const SeriesPoint& point);
/// Derivative of a contact's motion by the parameter at fixed time.
[[nodiscard]] ContactMotion parameter_rate(const Contact& contact, const ContactRates& rates,
                                           const ForceLayout& layout, std::size_t k, const SeriesPoint& point,
                                           const SeriesPoint& tangent, const DrivenRates& driven);
/// a + factor b
[[nodiscard]] ContactMotion sum(const ContactMotion& a, const ContactMotion& b, double factor);

/// Quantities whose peaks are recorded, with their rates: N, T, and the body's displacement along n and t since the
/// start.
struct WatchedMotion {
  std::array<double, 4> values{}, slopes{}, bends{};
};
/// These quantities of contact k at a point. u0: displacements at the start; force_bends: second derivatives
/// of forces.
[[nodiscard]] WatchedMotion watched(const Contact& contact, const ForceLayout& layout, std::size_t k,
                                    const Vector& u0, const SeriesPoint& point, const Vector& force_bends);

/// Derivatives of the body's own ut and ut'; they are those of parameter_rate() unless there is a shear
/// element.
[[nodiscard]] motion::BodySlide slide_rate(const Contact& contact, const ContactRates& rates,
                                           const SeriesPoint& point, const SeriesPoint& tangent,
                                           const DrivenRates& driven);

// Forces of a contact in its state, and their derivatives by a parameter.
//
//   N = N_g g + N_c,   N_p = N_g g_p + N_g,p g + N_c,p
//   T = T_g g + T_u ut + T_c,   T_p = T_g g_p + T_g,p g + T_u ut_p + T_u,p ut + T_c,p
//
// Valid for constant forces and surfaces, as in a modal stretch.

/// Data of one parameter for a stretch.
struct TangentSource {
  const Tangent* start = nullptr;  ///< null: not followed
  ForcingRatesSeries forcing;      ///< with scale 1
};

/// Derivatives for one contact and one parameter.
struct LawRates {
  modal::ForceLaw law;
  modal::ForceLaw rates;             ///< derivatives of the law's numbers
  double gap = 0.0, gap_rate = 0.0;  ///< g0 and g0_p
  double surface = 0.0, surface_rate = 0.0;

  /// N_p and T_p from g, ut and their derivatives by the parameter; likewise N'_p and T'_p from g' and ut'.
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

/// Forces of contact c in this state, and their derivatives by one parameter, from t on.
[[nodiscard]] LawRates law_rates(const Contact& contact, std::size_t c, const ContactState& state,
                                 const ContactRates& rates, const motion::Forcing& forcing, double t,
                                 const TangentSource& source);

/// Checks that tangents are implemented for all contact laws. Errors: SceneError at a law without tangents.
void check_tangent_laws(const Scene& scene, const Model& model);

}  // namespace signorini::sensitivity
