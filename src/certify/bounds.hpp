// bounds.hpp: bounds of displacements, velocities, peaks and landings, from what run and companions differ
// by.
//
//   bound = c max over the last five rows of |x - x'| + tol(x)
//
// tol(x): one local tolerance where the engine has one, else roundings. Within the error of an event a
// velocity may be that on its other side: there the change to the rows before and after is added.
#pragma once

#include "certify/tracker.hpp"
#include "engine/tolerance.hpp"
#include "signorini/certify.hpp"

namespace signorini {

/// What was kept of a run and of its companions.
struct Kept {
  const KeptRows* rows = nullptr;
  const Report* report = nullptr;
};

struct BoundSettings {
  double factor = 1.0;  ///< c
  Tolerance tolerance;  ///< of the run; rtol 0: roundings only
};

[[nodiscard]] HistoryErrors bound_history(const Model& model, const Kept& run,
                                          const std::vector<Kept>& companions, const BoundSettings& settings,
                                          const std::vector<TimedEvent>& events, const Verdict& verdict);

/// Peaks and landings of the whole run; landings only as far as they have ended before verdict.until.
void bound_extremes(Certificate& certificate, const Kept& run, const std::vector<Kept>& companions,
                    const BoundSettings& settings);

}  // namespace signorini
