// error_bounds.hpp: error bounds of displacements, velocities, peaks and landings, from the differences
// between a run and its companions.
//
//   bound = c max over the last five rows of |x - x'| + tol(x)
//
// tol(x): one local tolerance if the engine has one, else rounding. Within the error of an event's time a
// velocity may be that of the event's other side: in these rows the change to the neighbouring rows is added.
#pragma once

#include "certify/companion.hpp"
#include "engine/events/graze.hpp"
#include "engine/tolerance.hpp"
#include "signorini/certify.hpp"
#include "signorini/model.hpp"

namespace signorini::certify {

/// Recorded data of a run or of its companion.
struct RecordedRun {
  const RecordedRows* rows = nullptr;
  const Report* report = nullptr;
};

struct BoundSettings {
  double factor = 1.0;          ///< c
  engine::Tolerance tolerance;  ///< tolerance of the run; rtol 0: rounding only
};

/// Error bounds of the rows of history.csv.
[[nodiscard]] HistoryErrors bound_history(const Model& model, const RecordedRun& run,
                                          const std::vector<RecordedRun>& companions,
                                          const BoundSettings& settings,
                                          const std::vector<TimedEvent>& events, const MatchResult& verdict);

/// Adds error bounds of the peaks of the whole run, and of landings that have ended in its certain part.
void bound_extremes(Certificate& certificate, const RecordedRun& run,
                    const std::vector<RecordedRun>& companions, const BoundSettings& settings);

// Possible effect of the modes left out on contacts of a reduced model, and on their forces.
//
//   f_d = compliance left out in direction d of a contact  x  the contact's largest force along d
//   off = ringing + the larger f of the contact's two directions
//   displacement = largest off
//   force = largest of off x the contact's spring along d, or off / compliance in d without a spring
//
// ringing: oscillation of the modes left out after jumps of loads. A displacement error across a contact also moves it
// along its tangent, as the deflection of a bent axis does: hence the larger of the two. A spring immediately converts
// an error of the gap to a force; the structure behind it yields later (measured: compared with the full pipeline,
// errors of forces are kn times those of displacements). These are estimates: a change of force may shift an event,
// which they do not include.

/// The estimates above for a reduced model. peaks: those of the run.
[[nodiscard]] Truncation truncation_of(const Model& model, const Reduction& reduction,
                                       const std::vector<Peak>& peaks);

// Impacts that a run and its companion may both have missed.
//
//   smallest gap g of the companion,   e = c max |g - g'| at rows around that time:   open if g <= e
//   starting time: g + bend (t' - t)^2 = g + e
//
// A run with accumulated step errors may miss a grazing impact, and so may its companion if its own error is no
// smaller.

/// The first of these near impacts that is undecided (open). factor: c.
[[nodiscard]] std::optional<EventSequence::FirstViolation> first_undecided_impact(
    const Model& model, const RecordedRun& run, const RecordedRun& companion,
    const std::vector<events::NearHit>& near, double factor);

}  // namespace signorini::certify
