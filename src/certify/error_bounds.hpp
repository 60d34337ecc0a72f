// error_bounds.hpp: error bounds of displacements, velocities, peaks and landings, from the differences between a run and
// its companions.
//
//   bound = c max over the last five rows of |x - x'| + tol(x)       x' : value of the companion
//
// tol(x): the local tolerance of the engine; for engines without a tolerance, rounding. If a row is closer to an event
// than the error of the event's time, the true velocity may be that of the other side of the event: the changes to the
// neighbouring rows are then added.
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
  double factor = 1.0;          ///< factor c of the error bounds
  engine::Tolerance tolerance;  ///< tolerance of the run; rtol = 0: the engine has none
};

/// Error bounds of the rows of history.csv.
[[nodiscard]] HistoryErrors bound_history(const Model& model, const RecordedRun& run,
                                          const std::vector<RecordedRun>& companions,
                                          const BoundSettings& settings,
                                          const std::vector<TimedEvent>& events, const MatchResult& verdict);

/// Adds error bounds of the peaks, if the whole run is certified, and of landings that end in the certified part.
void bound_extremes(Certificate& certificate, const RecordedRun& run,
                    const std::vector<RecordedRun>& companions, const BoundSettings& settings);

// Truncation error of a reduced model: estimated effect of the omitted modes on displacements and forces of contacts.
//
//   f_d = (omitted compliance in direction d of a contact) * (largest force of the contact along d)
//   off = ringing + the larger f_d of the contact's two directions
//   displacement = largest off of all contacts
//   force = largest off * (stiffness of the contact spring along d); without a spring, off / (compliance in d)
//
// ringing: amplitude of the omitted modes after jumps of loads. The larger f_d applies to both directions, because an
// error along the normal of a contact also moves it along its tangent if its axis is bent. The force of a contact spring
// follows the error of its gap immediately, before the structure yields (measured with the full pipeline model: errors of
// forces are kn times those of displacements). The estimates do not include events that a change of force may shift.

/// Truncation error of a reduced model, by the equations above. peaks: largest displacements and forces of the run.
[[nodiscard]] Truncation truncation_of(const Model& model, const Reduction& reduction,
                                       const std::vector<Peak>& peaks);

// Grazing impacts that a run and its companion may both have missed because of accumulated errors.
//
//   g: local minimum of the companion's gap, at time t;   e = c max |g - g'| at rows around t
//   undecided if g <= e, from the time t' < t on at which the gap was g + e:   half_curvature (t' - t)^2 = e

/// The earliest undecided impact, with its time t' and a sentence. near: minima of the companion's gaps; factor: c.
[[nodiscard]] std::optional<EventSequence::FirstViolation> first_undecided_impact(
    const Model& model, const RecordedRun& run, const RecordedRun& companion,
    const std::vector<events::NearHit>& near, double factor);

}  // namespace signorini::certify
