// load_table.hpp: loads over time, as a table for pictures (docs/output.md).
//
//   loads.csv  t,NAME,...   f_i(t) of every load that is not constant, amplitude included,
//                           and the acceleration of the base; both sides of breakpoints
#pragma once

#include <string>

#include "signorini/model.hpp"

namespace signorini {

/// Table from 0 to t_end; empty if no load varies.
[[nodiscard]] std::string load_table(const Model& model, double t_end);

}  // namespace signorini
