// contact_rates.hpp: derivatives of what a contact feels, by a parameter at fixed time, and of its whole
// path.
//
//   g_p = n . w + n_p . u + g0_p,   ut_p = t . w + t_p . u - s_p,   N_p and T_p as they are
//   Dx = x_p + x' dt/dp             of x at an instant that moves
#pragma once

#include "motion/point.hpp"
#include "sensitivity/tangent_series.hpp"

namespace signorini {

/// Of a surface and a compression: order 0, 1 and 2.
struct DrivenRates {
  double surface[3] = {0.0, 0.0, 0.0}, pressing[2] = {0.0, 0.0};
};
/// At x of series of this scale.
[[nodiscard]] DrivenRates driven_rates(const ForcingRatesSeries& series, double scale, std::size_t contact,
                                       double x);

/// Degrees of freedom that contacts, or their derivatives by any of the parameters, show.
[[nodiscard]] std::vector<Eigen::Index> contact_dofs(const Model& model,
                                                     const std::vector<const ModelDerivative*>& rates);

/// The motion itself.
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

/// What peaks are of, and how it changes: N, T, and the body from where it was at the start along n and t.
struct WatchedMotion {
  std::array<double, 4> values{}, slopes{}, bends{};
};
[[nodiscard]] WatchedMotion watched(const Contact& contact, const ForceLayout& layout, std::size_t k,
                                    const Vector& u0, const SeriesPoint& point, const Vector& force_bends);

/// The body's own ut and ut': those of the motion unless there is a shear element.
[[nodiscard]] BodySlide slide_rate(const Contact& contact, const ContactRates& rates,
                                   const SeriesPoint& point, const SeriesPoint& tangent,
                                   const DrivenRates& driven);

}  // namespace signorini
