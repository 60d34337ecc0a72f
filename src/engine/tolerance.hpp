// tolerance.hpp: how large an error of each quantity may be.
//
//   tol(x) = rtol |x| + atol,   atol = rtol * scale of the scene where the scene gives none
#pragma once

#include "contact/form.hpp"
#include "signorini/model.hpp"
#include "signorini/result.hpp"

namespace signorini {

[[nodiscard]] Settings settings_for(const Model& model, const RunSpec& run);

/// Tolerance of a form's value, from those of the motion's entries.
[[nodiscard]] double tolerance(const Form& form, const ContactMotion& motion, const Settings& settings);

}  // namespace signorini
