// plain_sight.hpp: guards and rows that hold though nothing is allowed for the rounding of their terms.
//
//   g >= 0          -N >= 0,  fs |N| - |T| >= 0          s p' >= 0
//   |N - kn g - cn g'| <= c eps |N|      |T - kt (ut - p)| <= c eps (|T| + kt |p|)      |T + s fk N| <= c eps |T|
//
// Limits of the laws (sight.hpp, laws.hpp) grow with the sizes of all terms. Sizes are sums over degrees of freedom; they
// are left out here, so that no limit is above those of the laws: a contact that passes here passes there.
#pragma once

#include "witness/witness.hpp"

namespace signorini {

/// No guard of the state is negative. False also where it cannot be told from so little.
[[nodiscard]] bool guards_stand(const Contact& contact, std::size_t k, const ContactState& state,
                                const WitnessedSide& side);
/// N and T are those of the state's rows. rest: the least speed that counts as rest.
[[nodiscard]] bool rows_stand(const Contact& contact, std::size_t k, const ContactState& state,
                              const WitnessedSide& side, double rest);

}  // namespace signorini
