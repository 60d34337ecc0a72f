// user_law.hpp: a law made of data (signorini/own_law.hpp) behind the interface of all laws.
#pragma once

#include <string>

#include "signorini/contact_law.hpp"
#include "signorini/own_law.hpp"

namespace signorini {

/// The first mistake in the data of a law; empty: there is none.
[[nodiscard]] std::string refusal_of(const OwnLaw& law);
/// Does it take part along the tangent? Else its tangent rows say T = 0, and nothing depends on ut.
[[nodiscard]] bool acts_along_tangent(const OwnLaw& law);
/// A law whose numbers, with their units, were visited; the law itself may be that of other scenes, too.
[[nodiscard]] std::shared_ptr<const OwnLaw> visited(OwnLaw law, const ContactLaw::VisitConstant& visit);

}  // namespace signorini
