// lively_row.hpp: the row of rubbing_row.hpp in motion, under loads that swing, on surfaces that move.
#pragma once

#include <cmath>
#include <utility>

#include "unit/linear/rubbing_row.hpp"

namespace signorini {

inline History wave(double amplitude, double omega, double phase) {
  Piece piece;
  piece.amplitude = amplitude;
  piece.omega = omega;
  piece.phase = phase;
  return History(std::move(piece));
}

/// The row with places and velocities that vary along it, a load that swings at three of its masses, and a surface that moves.
inline Model lively_row(int masses) {
  Model model = rubbing_row(masses);
  for (Eigen::Index i = 0; i < model.u0.size(); ++i) {
    const auto x = static_cast<double>(i);
    model.u0[i] = 0.03 * std::sin(0.37 * x + 0.2) + 0.01 * std::cos(1.9 * x);
    model.v0[i] = 0.5 * std::sin(0.83 * x) - 0.2;
  }
  for (const int at : {masses / 5, masses / 2, masses / 2 + 3}) {
    Load load;
    load.direction.terms = {{2 * at, 0.6}, {2 * at + 1, -0.8}};
    load.history = wave(2.0, 3.0, 0.4);
    model.loads.push_back(load);
    model.contacts[static_cast<std::size_t>(at)].surface_motion = wave(0.01, 5.0, 0.1);
  }
  return model;
}

}  // namespace signorini
