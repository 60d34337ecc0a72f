#include "contact/conditions.hpp"

namespace signorini {

Violations violations(const Contact& contact, State state, const ContactMotion& m) {
  return contact.law->violations(contact, state, m);
}

}  // namespace signorini
