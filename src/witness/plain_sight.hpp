// plain_sight.hpp: quick check of guards and rows, without an allowance for the rounding of their terms.
//
//   g >= 0          -N >= 0,  fs |N| - |T| >= 0          s p' >= 0
//   |N - kn g - cn g'| <= c eps |N|      |T - kt (ut - p)| <= c eps (|T| + kt |p|)      |T + s fk N| <= c eps |T|
//
// Limits of the laws (sight.hpp, laws.hpp) grow with the sizes of all terms, which are sums over degrees of freedom.
// This check omits these sums, so its limits never exceed those of the laws: a contact that passes here passes there.
#pragma once

#include "witness/witness.hpp"

namespace signorini {

/// True if no guard of the state is negative. False also if these few data do not decide it.
[[nodiscard]] bool guards_stand(const Contact& contact, std::size_t k, const ContactState& state,
                                const WitnessedSide& side);
/// True if N and T satisfy the state's rows. rest: speed up to which a contact counts as at rest.
[[nodiscard]] bool rows_stand(const Contact& contact, std::size_t k, const ContactState& state,
                              const WitnessedSide& side, double rest);

}  // namespace signorini
