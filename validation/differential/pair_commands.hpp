// pair_commands.hpp: commands that compute, each beside the same by another way.
//
//   derivatives  D = (8 (f(p+h) - f(p-h)) - (f(p+2h) - f(p-2h))) / 12h;  |s - D_h/4| <= 20 |D_h - D_h/4| + 1e-5 max |s| + noise / h
//   orbit        |u(T) - u(0)| <= 1e-5 of the amplitude by another engine; the same multipliers in another order of tables
//   sweep        a row has the events and peaks of a related run
//   verify       its verdict
#pragma once

#include "differential/pair_checks.hpp"
#include "signorini/sensitivity.hpp"

namespace signorini::differential {

/// path: the parameter. Errors: as of sensitivities().
[[nodiscard]] Checked by_derivatives(const SceneReader& read, const std::string& path);
[[nodiscard]] Checked by_orbit(const SceneReader& read, std::uint64_t seed);
/// path: of the amplitude of the load "push", of which the row has nine tenths.
[[nodiscard]] Checked by_sweep(const CheckRequest& request, const std::string& path);
[[nodiscard]] Checked by_verify(const Scene& scene);

}  // namespace signorini::differential
