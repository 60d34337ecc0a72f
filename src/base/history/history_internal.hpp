// history_internal.hpp: how exactly a Piece can be evaluated, and how large it gets.
//
//   |computed f(t) - f(t)| <= 64 eps ( sum_j |c_j s^j| + |a| (1 + |w s + phi|) + (|t| + |t0|) |f'|~ )
//   s = t - t0
//
// |f'|~ is the derivative with every term taken positive: times are themselves rounded, so that f is
// known no better than |f'| eps |t|.
#pragma once

#include "signorini/history.hpp"

namespace signorini {

/// Bound on the roundoff of evaluating the piece at t; units of f.
[[nodiscard]] double roundoff(const Piece& piece, double t);
/// The same of its first derivative.
[[nodiscard]] double roundoff_of_rate(const Piece& piece, double t);

/// An upper estimate of max |f| on [0, t_end]: exact for constants, lines, steps and pulses, sampled
/// otherwise. Units of f.
[[nodiscard]] double magnitude(const History& f, double t_end);

/// An upper estimate of the greatest integral of |f| over a time of this width that begins in [0, t_end]: of each piece its
/// greatest |f| counts while it is in force. Units of f times time.
[[nodiscard]] double greatest_impulse(const History& f, double t_end, double width);

/// A time in [0, t_end] at which f is negative beyond roundoff, -1 when it is nowhere: proved with the
/// troughs of sines and with bounds on polynomials, not sampled (but functions of one's own). Pieces count up to and including the time
/// at which the next one begins.
[[nodiscard]] double negative_at(const History& f, double t_end);

}  // namespace signorini
