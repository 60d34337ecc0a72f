// user_law.hpp: makes a ContactLaw from the data of a user-defined law (signorini/user_contact_law.hpp).
#pragma once

#include <string>

#include "signorini/contact_law.hpp"
#include "signorini/user_contact_law.hpp"

namespace signorini {

/// Message about the first error in the data of a law; empty: there is no error.
[[nodiscard]] std::string validation_error(const UserContactLaw& law);
/// True if the law acts along the tangent. False: its tangent rows are T = 0, and no row and no guard depends on ut or T.
[[nodiscard]] bool acts_along_tangent(const UserContactLaw& law);
/// Copy of the law in which `visit`(constant, unit) may change each constant. The law is copied because several scenes may
/// share it.
[[nodiscard]] std::shared_ptr<const UserContactLaw> visit_law_constants(
    UserContactLaw law, const ContactLaw::VisitConstant& visit);

}  // namespace signorini
