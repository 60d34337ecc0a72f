// built_in.hpp: the built-in laws that a scene can name; there is one object for each law.
#pragma once

#include "signorini/contact_law.hpp"

namespace signorini {

[[nodiscard]] const ContactLaw& compliant_law();
[[nodiscard]] const ContactLaw& rigid_law();
[[nodiscard]] const ContactLaw& slider_law();

}  // namespace signorini
