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
