// tangent_event.hpp: the tangent motion across an instant, for one parameter.
//
//   dt/dp = - (G_p + grad G . w)/G'       of the guard that fell;  tau_p of a breakpoint;  0 at the start
//   w+ = w- + (u'- - u'+) dt/dp,   w'+ = Dv+ - u''+ dt/dp
//   p_p = D(ut - T/kt)                    an anchor that is dropped
//
// Where derivatives from both sides of p differ there is none: two guards that fall at one instant and part
// with the parameter, a guard that grazes, one that stands at zero afterwards and would fall for other
// values.
//
// Of a guard that grazes, dt/dp has no bound. Where the motion is as smooth after it as before,
//   u'- = u'+,  u''- = u''+        and no anchor is dropped whose place depends on the time,
// w does not depend on dt/dp: derivatives of states alone (orbits) can cross such a graze with dt/dp = 0.
#pragma once

#include <optional>

#include "run/run_listener.hpp"
#include "sensitivity/contact_rates.hpp"

namespace signorini {

/// What the motion has just before, and what the instant made of it.
struct InstantMotion {
  const RunInstant& instant;
  const SeriesPoint &before, &after;
  const Series& series_after;  ///< about the instant, of scale 1
  std::vector<ContactMotion> motion_before, rate_before, motion_after, rate_after;  ///< one a contact
};

/// The same of one parameter.
struct TangentBefore {
  Tangent start;  ///< anchors before
  SeriesPoint point;
  std::vector<DrivenRates> driven;
};

struct TangentAfter {
  Tangent start;
  SeriesPoint point;
  std::vector<DrivenRates> driven;
  double dt = 0.0;                           ///< of the instant
  std::vector<EventRates> rates;             ///< one a contact, machine's units
  std::vector<double> impulse_n, impulse_t;  ///< derivatives, one a contact; empty: there is no impact
  std::string reason;                        ///< not empty: there is no derivative after the instant
};

class TangentEvents {
 public:
  /// All must outlive it. size: of the parameter, for what is small.
  TangentEvents(const Model& model, ModeSystems& systems, const ModelDerivative& derivative, double size,
                double t_end)
      : model_(model),
        systems_(systems),
        derivative_(derivative),
        size_(size),
        least_(1e-13 * t_end / size) {}

  [[nodiscard]] TangentAfter pass(const InstantMotion& motion, const TangentBefore& before,
                                  TangentSeries& series) const;
  /// Grazes where nothing jumps are crossed; the times of their events have no derivative.
  void cross_smooth_grazes() { crosses_grazes_ = true; }

 private:
  struct Course;
  void find_times(Course& course) const;
  [[nodiscard]] std::optional<double> time_of(Course& course, std::size_t contact) const;
  [[nodiscard]] bool is_smooth(const Course& course) const;
  [[nodiscard]] bool drops_anchor(const Course& course, std::size_t contact) const;
  void move_state(Course& course) const;
  void move_anchors(Course& course) const;
  [[nodiscard]] bool vanishes(double rate, double terms, double scale) const;
  void look_at_holds(Course& course) const;
  void look_for_kinks(Course& course) const;
  void fill_rates(Course& course) const;

  const Model& model_;
  ModeSystems& systems_;
  const ModelDerivative& derivative_;
  double size_;   // of the parameter
  double least_;  // a rate of times that is nothing
  bool crosses_grazes_ = false;
};

}  // namespace signorini
