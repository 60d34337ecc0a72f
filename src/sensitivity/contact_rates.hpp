// contact_rates.hpp: derivatives of a contact's motion and forces with respect to a parameter, at fixed time and at a moving
// instant.
//
//   g_p = n . w + n_p . u + g0_p,   ut_p = t . w + t_p . u - s_p       w = u_p: tangent motion, computed with N_p and T_p
//   Dx = x_p + x' dt/dp             derivative of x at an instant whose time depends on the parameter
#pragma once

#include "decide/decision.hpp"
#include "engine/exact/modal/modal_system.hpp"
#include "motion/point.hpp"
#include "sensitivity/tangent_series.hpp"
#include "signorini/model.hpp"

namespace signorini::sensitivity {

/// Derivatives of a surface motion (orders 0 to 2 in time) and of an applied normal force (orders 0 and 1).
struct DrivenRates {
  double surface[3] = {0.0, 0.0, 0.0}, applied_normal_force[2] = {0.0, 0.0};
};
/// Derivatives of a contact's surface motion and applied normal force at position x of a series with this scale.
[[nodiscard]] DrivenRates driven_rates(const ForcingDerivatives& series, double scale, std::size_t contact,
                                       double x);

/// Degrees of freedom on which the contacts, or their derivatives with respect to any parameter, depend.
[[nodiscard]] std::vector<Eigen::Index> contact_dofs(const Model& model,
                                                     const std::vector<const ModelDerivative*>& rates);

/// Motion of contact k at time t, from the values of a series.
[[nodiscard]] ContactMotion motion_of(const Contact& contact, std::size_t k, const motion::Forcing& forcing,
                                      double t, const SeriesPoint& point);
/// Time derivative of a contact's motion; the derivatives of g'' and ut'' are not computed and stay zero.
[[nodiscard]] ContactMotion time_rate(const ForceLayout& layout, std::size_t k, const ContactMotion& motion,
                                      const SeriesPoint& point);
/// Derivative of a contact's motion with respect to the parameter, at fixed time.
[[nodiscard]] ContactMotion parameter_rate(const Contact& contact, const ContactRates& rates,
                                           const ForceLayout& layout, std::size_t k, const SeriesPoint& point,
                                           const SeriesPoint& tangent, const DrivenRates& driven);
/// The motion a + factor b.
[[nodiscard]] ContactMotion sum(const ContactMotion& a, const ContactMotion& b, double factor);

/// Quantities whose peaks are recorded (N, T, and the body's displacements along n and t since the start), with their first
/// and second time derivatives.
struct WatchedMotion {
  std::array<double, 4> values{}, slopes{}, bends{};
};
/// Watched quantities of contact k at a point. u0: displacements at the start; force_bends: second time derivatives of
/// forces.
[[nodiscard]] WatchedMotion watched(const Contact& contact, const ForceLayout& layout, std::size_t k,
                                    const Vector& u0, const SeriesPoint& point, const Vector& force_bends);

/// Derivatives of ut and ut' of the touching body. Without a shear element they are equal to ut and vt of parameter_rate().
[[nodiscard]] motion::BodySlide slide_rate(const Contact& contact, const ContactRates& rates,
                                           const SeriesPoint& point, const SeriesPoint& tangent,
                                           const DrivenRates& driven);

// Forces of a contact in its state, and their derivatives with respect to a parameter.
//
//   N = N_g g + N_c,   N_p = N_g g_p + N_g,p g + N_c,p
//   T = T_g g + T_u ut + T_c,   T_p = T_g g_p + T_g,p g + T_u ut_p + T_u,p ut + T_c,p
//
// Valid for constant forces and constant surface positions, as on a stretch in modes.

/// Data of one parameter for a stretch (the motion between two instants).
struct TangentSource {
  const Tangent* start = nullptr;  ///< tangent at the start of the stretch; nullptr: not computed
  ForcingDerivatives forcing;      ///< derivatives of the forcing, as a series with scale 1
};

/// Force law of one contact, and its derivatives with respect to one parameter.
struct LawRates {
  modal::ForceLaw law;
  modal::ForceLaw rates;             ///< derivatives of the coefficients in `law`
  double gap = 0.0, gap_rate = 0.0;  ///< g0 and g0_p
  double surface = 0.0, surface_rate = 0.0;

  /// N_p and T_p from g, ut and their derivatives with respect to the parameter. N_rate_derivative(), T_rate_derivative(): the same for N'_p,
  /// T'_p from g', ut'.
  [[nodiscard]] double N_derivative(double g, double g_by) const { return law.N_gap * g_by + rates.N(g); }
  [[nodiscard]] double T_derivative(double g, double g_by, double ut, double ut_by) const {
    return law.T_rate(g_by, ut_by) + rates.T(g, ut);
  }
  [[nodiscard]] double N_rate_derivative(double vn, double vn_by) const {
    return law.N_rate(vn_by) + rates.N_rate(vn);
  }
  [[nodiscard]] double T_rate_derivative(double vn, double vn_by, double vt, double vt_by) const {
    return law.T_rate(vn_by, vt_by) + rates.T_rate(vn, vt);
  }
};

/// Force law of contact c in this state from t on, and its derivatives with respect to one parameter.
[[nodiscard]] LawRates law_rates(const Contact& contact, std::size_t c, const ContactState& state,
                                 const ContactRates& rates, const motion::Forcing& forcing, double t,
                                 const TangentSource& source);

/// Checks that tangents are implemented for all contact laws. Errors: SceneError that names the law without tangents.
void check_tangent_laws(const Scene& scene, const Model& model);

}  // namespace signorini::sensitivity
