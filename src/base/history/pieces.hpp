// pieces.hpp: rounding errors, bounds and time resolution of a history.
//
//   |computed f(t) - f(t)| <= 64 eps ( sum_j |c_j s^j| + |a| (1 + |w s + phi|) + (|t| + |t0|) |f'|~ )
//   s = t - t0
//
// |f'|~: the derivative with the magnitude of each term. This term is needed because the time t is rounded, too.
#pragma once

#include "signorini/history.hpp"

namespace signorini::history {

/// Bound of the rounding error of the piece's value at t; unit of f.
[[nodiscard]] double roundoff(const Piece& piece, double t);
/// Bound of the rounding error of the piece's first derivative at t; unit of f per time.
[[nodiscard]] double roundoff_of_rate(const Piece& piece, double t);

/// Upper estimate of max |f| on [0, t_end]: exact for constants, straight lines, steps and pulses, otherwise sampled. Units
/// of f.
[[nodiscard]] double magnitude(const History& f, double t_end);

/// Upper estimate of the largest integral of |f| over an interval of this width that begins in [0, t_end]. Each piece
/// contributes with its largest |f|. Units of f times time.
[[nodiscard]] double max_impulse(const History& f, double t_end, double width);

/// A time in [0, t_end] at which f is negative by more than its rounding error; -1: there is none. The result is proved with
/// minima of sines and bounds of polynomials; only user-defined functions are sampled. Each piece is examined up to and
/// including the start of the next piece.
[[nodiscard]] double find_negative_time(const History& f, double t_end);

// Merges starts of pieces that are closer than the time resolution of a run.
//
//   starts s_i, s_j of pieces with 0 <= s_j - s_i <= 100 eps (s_i + t_end)  ->  one start, at the last such s_j
//   starts in [0, 100 eps t_end]                                            ->  one start, at 0
//
// Pieces shorter than the time resolution are dropped, because each engine would treat such pieces differently.

/// Index after the last start of the group that begins at index `from` and is treated as one instant.
[[nodiscard]] std::size_t end_of_instant(const History& f, std::size_t from, double t_end);
/// Copy of the history with merged starts.
[[nodiscard]] History resolved(const History& f, double t_end);

}  // namespace signorini::history
