// scenes.hpp: structures of any size, for measuring how cost grows.
//
//   bedded pipe   o--o--o--o--o--o--o--o   beams of 1.5 m on springs at every tenth node, contacts spread
//                 ^     s     s     s  ^   evenly, pushed in the middle; frequencies do not depend on n
//   chain         m-/\-m-/\-m-/\-m         masses in a row on a moving belt, some of them rubbing on it
//
// Units kN, t, m, s.
#pragma once

#include <string>

namespace signorini::benchmarks {

/// A scene file's text. unknowns: about that many degrees of freedom; contacts >= 2.
[[nodiscard]] std::string bedded_pipe(int unknowns, int contacts, double t_end);
/// unknowns: exactly that many; contacts <= unknowns.
[[nodiscard]] std::string chain(int unknowns, int contacts, double t_end);

}  // namespace signorini::benchmarks
