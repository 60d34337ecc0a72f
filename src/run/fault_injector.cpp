#include "run/fault_injector.hpp"

#include <utility>

namespace signorini {

void FaultInjector::inject(Decider& decider, Instant now, const Forcing& forcing, Decision& decided) {
  Decision changed = decided;
  if (!change(now.mode, now.v, changed)) return;
  now.u = changed.u;
  now.v = changed.v;
  const Decision other = decider.adopt(now, changed.mode, forcing);
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
  changed.captures = other.captures;
  decided = std::move(changed);
}

}  // namespace signorini
