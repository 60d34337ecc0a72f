#include "decide/decision.hpp"

#include "contact/law.hpp"
#include "signorini/trace.hpp"

namespace signorini {

const char* to_string(Refusal::Kind kind) {
  switch (kind) {
    case Refusal::Kind::none:
      return "none";
    case Refusal::Kind::dependent:
      return "dependent";
    case Refusal::Kind::singular:
      return "singular";
    case Refusal::Kind::paradox:
      return "paradox";
    case Refusal::Kind::ambiguous:
      return "ambiguous";
    case Refusal::Kind::impact:
      return "impact";
    case Refusal::Kind::endless:
      return "endless";
    case Refusal::Kind::standstill:
      return "standstill";
  }
  return "?";
}

}  // namespace signorini

namespace signorini::decide {

std::vector<TriggeredGuard> find_resting_limits(const Decision& decision) {
  std::vector<TriggeredGuard> result;
  for (std::size_t i = 0; i < decision.guards.size(); ++i) {
    const GuardStart& guard = decision.guards[i];
    const bool limit = contact::is_friction_limit(guard.kind);
    if (limit && guard.at_zero && guard.leading_order < 0)
      result.push_back({decision.layout.contact_of_guard(i), guard.kind});
  }
  return result;
}

}  // namespace signorini::decide
