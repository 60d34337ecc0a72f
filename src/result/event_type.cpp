#include "signorini/result.hpp"

namespace signorini {

const char* to_string(EventType type) {
  switch (type) {
    case EventType::slip:
      return "slip";
    case EventType::stick:
      return "stick";
    case EventType::reversal:
      return "reversal";
    case EventType::separation:
      return "separation";
    case EventType::contact:
      return "contact";
    case EventType::impact:
      return "impact";
    case EventType::time:
      return "time";
  }
  return "?";
}

}  // namespace signorini
