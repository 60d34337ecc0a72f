// law_error.hpp: errors of a user law, found before a run.
//
//   N           given, by a spring or by impulses, as by the law that the scene names
//   own states  user_law_state(i, kind);  rows with N and with T;  N + q = 0 if N is given;  guards user_1 to user_3
//   otherwise   rows of the built-in law;  guards of the built-in kinds
//   tangents    one or none; if none, tangent rows T = 0, and nothing depends on ut or T, and there are no impulses
//   guards      as many as the capabilities say, without accelerations;  products only without linear_guards
//
// Engines and decisions rely on these properties. Rows and guards are inspected for the memory p = 0.
#pragma once

#include <string>

#include "signorini/contact.hpp"

namespace signorini {

/// Message about the first error of the contact's law; empty: there is no error. named: the law that the scene names.
[[nodiscard]] std::string law_error(const Contact& contact, Law named);

}  // namespace signorini
