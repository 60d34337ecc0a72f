// history_rates.hpp: derivative of a history's piece by a parameter, as a series in time.
//
//   f = sum c_j s^j + a sin(w s + phi),   s = t - t0
//   f_p = sum c_j,p s^j - t0,p f' + a_p sin(w s + phi) + a cos(w s + phi) (w_p s + phi_p)
#pragma once

#include "sensitivity/model_derivative.hpp"

namespace signorini {

/// out[k] += factor scale^k / k! (d/dt)^k f_p at t, 0 <= k < count.
void add_rate_series(const Piece& piece, const Piece& rates, double t, double scale, std::size_t count,
                     double factor, double* out);

}  // namespace signorini
