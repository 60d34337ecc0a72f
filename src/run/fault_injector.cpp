#include "run/fault_injector.hpp"

#include <utility>

namespace signorini::run {

void FaultInjector::inject(decide::ContactStateSolver& decider, decide::Instant now,
                           const motion::Forcing& forcing, decide::Decision& decided) {
  decide::Decision changed = decided;
  if (!change(now.states, now.v, changed)) return;
  now.u = changed.u;
  now.v = changed.v;
  const decide::Decision other = decider.adopt(now, changed.states, forcing);
  changed.consistent = other.consistent;
  changed.refusal = other.refusal;
  changed.system = other.system;
  changed.u = other.u;
  changed.v = other.v;
  changed.jet = other.jet;
  changed.after = other.after;
  changed.slides_after = other.slides_after;
  changed.guards = other.guards;
  changed.forms = other.forms;
  changed.capture_impulses = other.capture_impulses;
  decided = std::move(changed);
}

}  // namespace signorini::run
