// user_law.hpp: a user-defined law made of data (signorini/user_contact_law.hpp), behind the interface of all laws.
#pragma once

#include <string>

#include "signorini/contact_law.hpp"
#include "signorini/user_contact_law.hpp"

namespace signorini {

/// Message about the first error in the data of a law; empty: the data are valid.
[[nodiscard]] std::string validation_error(const UserContactLaw& law);
/// True if the law acts along the tangent; otherwise its tangent rows are T = 0 and nothing depends on ut.
[[nodiscard]] bool acts_along_tangent(const UserContactLaw& law);
/// Copy of the law after `visit` was called for each of its constants, with its unit. The law itself stays
/// unchanged, because several scenes may share it.
[[nodiscard]] std::shared_ptr<const UserContactLaw> visit_law_constants(
    UserContactLaw law, const ContactLaw::VisitConstant& visit);

}  // namespace signorini
