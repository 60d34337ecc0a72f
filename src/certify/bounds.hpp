// bounds.hpp: error bounds of displacements, velocities, peaks and landings from the differences of run and companions.
//
//   bound = c max over the last five rows of |x - x'| + tol(x)
//
// tol(x): one local tolerance if the engine has one, else rounding. Within the error of an event a velocity may be the
// one on its other side: there the change to the neighbouring rows is added.
#pragma once

#include "certify/tracker.hpp"
#include "engine/tolerance.hpp"
#include "signorini/certify.hpp"

namespace signorini {

/// Recorded data of a run or of its companion.
struct Kept {
  const KeptRows* rows = nullptr;
  const Report* report = nullptr;
};

struct BoundSettings {
  double factor = 1.0;  ///< c
  Tolerance tolerance;  ///< tolerance of the run; rtol 0: rounding only
};

[[nodiscard]] HistoryErrors bound_history(const Model& model, const Kept& run,
                                          const std::vector<Kept>& companions, const BoundSettings& settings,
                                          const std::vector<TimedEvent>& events, const Verdict& verdict);

/// Bounds peaks and landings of the whole run; only landings that have ended before verdict.until.
void bound_extremes(Certificate& certificate, const Kept& run, const std::vector<Kept>& companions,
                    const BoundSettings& settings);

}  // namespace signorini
