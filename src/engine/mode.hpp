// mode.hpp: the states of all contacts together.
#pragma once

#include <vector>

#include "signorini/contact.hpp"

namespace signorini {

/// One entry a contact, in the order of Model::contacts.
using Mode = std::vector<ContactState>;

}  // namespace signorini
