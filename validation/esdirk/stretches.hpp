// stretches.hpp: a reference run cut at its events, and at a grid of restarts where one is asked for.
//
//   begin, u0, v0, mode  --no state changes-->  end, u1, v1, the guard that falls there and its rate
//
//   const auto stretches = cut(scene, model, 0.0);
#pragma once

#include <optional>

#include "contact/contact_states.hpp"
#include "contact/law.hpp"
#include "signorini/simulate.hpp"

namespace signorini::esdirk {

/// What ends a stretch: value of `form` at its end is zero, its rate there is `rate`.
struct Ending {
  std::size_t contact = 0;
  Form form;
  double rate = 0.0;
};

/// u, v of length n; times in the scene's unit.
struct Stretch {
  double begin = 0.0, end = 0.0;
  Vector u0, v0, u1, v1;
  contact::ContactStates states;
  std::optional<Ending> ending;  ///< empty: the end of the run, a load's jump, several events, a cut
};

struct Cut {
  std::vector<Stretch> stretches;
  long events = 0;
  double seconds = 0.0;  ///< of the reference run without output and cuts, least of three
};

/// Seconds of this process on a processor: other processes do not count.
[[nodiscard]] double processor_time();

/// Runs the scene with its engine; restart > 0 cuts at its multiples, too. Displacements and velocities must
/// be continuous at events. Errors: std::runtime_error if the run does not reach its end.
[[nodiscard]] Cut cut(Scene scene, const Model& model, double restart);

}  // namespace signorini::esdirk
