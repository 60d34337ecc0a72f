// hand_coded.hpp: one mass on a slider, written by hand for IDA: what a user would write for one scene.
//
//   u' = v,  m v' + c v + k u - a sin(w t) + T = 0,  stick: v' = 0, slip: T = s f
//
// The same unknowns u, v, N, T, guards, tolerances and kind of linear solver (KLU on the 4 x 4 system) as
// Signorini has for this scene; no other scene, no audit, no output.
#pragma once

namespace signorini::overhead {

struct Slider {
  double m, c, k, amplitude, omega, friction;
  double u0, v0, t_end;
};

struct Outcome {
  long events, steps;
  double u_end;
};

/// atol: of u, v and forces.
[[nodiscard]] Outcome run_by_hand(const Slider& slider, double rtol, double atol_u, double atol_v,
                                  double atol_f);

}  // namespace signorini::overhead
