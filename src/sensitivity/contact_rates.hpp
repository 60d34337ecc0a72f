// contact_rates.hpp: derivatives of a contact's motion by a parameter, at fixed time and along a moving instant.
//
//   g_p = n . w + n_p . u + g0_p,   ut_p = t . w + t_p . u - s_p,   N_p and T_p directly
//   Dx = x_p + x' dt/dp             of x at a moving instant
#pragma once

#include "motion/point.hpp"
#include "sensitivity/tangent_series.hpp"

namespace signorini {

/// Derivatives of a surface motion and a normal force: orders 0, 1 and 2.
struct DrivenRates {
  double surface[3] = {0.0, 0.0, 0.0}, pressing[2] = {0.0, 0.0};
};
/// Evaluated at x of series with this scale.
[[nodiscard]] DrivenRates driven_rates(const ForcingRatesSeries& series, double scale, std::size_t contact,
                                       double x);

/// Degrees of freedom on which contacts, or their derivatives by any parameter, depend.
[[nodiscard]] std::vector<Eigen::Index> contact_dofs(const Model& model,
                                                     const std::vector<const ModelDerivative*>& rates);

/// Motion of a contact.
[[nodiscard]] ContactMotion motion_of(const Contact& contact, std::size_t k, const Forcing& forcing, double t,
                                      const SeriesPoint& point);
/// Its derivative by time; those of g'' and ut'' are left at zero.
[[nodiscard]] ContactMotion time_rate(const ForceLayout& layout, std::size_t k, const ContactMotion& motion,
                                      const SeriesPoint& point);
/// Its derivative by the parameter at fixed time.
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
[[nodiscard]] WatchedMotion watched(const Contact& contact, const ForceLayout& layout, std::size_t k,
                                    const Vector& u0, const SeriesPoint& point, const Vector& force_bends);

/// The body's own ut and ut'; equal to those of the motion unless there is a shear element.
[[nodiscard]] BodySlide slide_rate(const Contact& contact, const ContactRates& rates,
                                   const SeriesPoint& point, const SeriesPoint& tangent,
                                   const DrivenRates& driven);

}  // namespace signorini
