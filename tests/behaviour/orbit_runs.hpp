// orbit_runs.hpp: the monodromy matrix of an orbit of a [matrices] scene, by runs that start beside it.
//
//   dz(T)/dz by central differences over h, of u, v and the shears that a run begins with
#pragma once

#include <fmt/core.h>

#include <Eigen/Dense>
#include <string>
#include <vector>

#include "behaviour/rates.hpp"
#include "signorini/orbit.hpp"
#include "signorini/simulate.hpp"

namespace signorini::tests {

/// n: degrees of freedom. Phi is 2 n wide, and one wider for each contact that sticks at the section.
inline Eigen::MatrixXd monodromy_by_runs(const std::string& text, const Orbit& orbit, int n, double h) {
  std::vector<std::size_t> shears;
  const SavedState start = orbit_scene(reader_of_text(text), orbit).initial.saved.value();
  for (std::size_t c = 0; c < start.shears.size(); ++c)
    if (start.shears[c].second != 0.0 && start.slips[c].second == 0) shears.push_back(c);
  const Eigen::Index motions = 2 * n, size = motions + static_cast<Eigen::Index>(shears.size());
  Eigen::MatrixXd phi(size, size);
  for (Eigen::Index j = 0; j < size; ++j) {
    Eigen::VectorXd ends[2];
    for (int side = 0; side < 2; ++side) {
      Scene moved = orbit_scene(reader_of_text(text), orbit);
      SavedState& saved = *moved.initial.saved;
      const double step = side == 0 ? -h : h;
      if (j >= motions) saved.shears[shears[static_cast<std::size_t>(j - motions)]].second += step;
      for (auto& [of, value] : saved.motions)
        if (j < motions && of == fmt::format("d{}.{}", j % n, j < n ? "u" : "v")) value += step;
      const Result run = simulate(moved);
      ends[side].resize(size);
      ends[side].head(motions) << run.rows.back().u, run.rows.back().v;
      for (Eigen::Index c = motions; c < size; ++c)
        ends[side][c] = run.rows.back().contacts[shears[static_cast<std::size_t>(c - motions)]].T;
    }
    phi.col(j) = (ends[1] - ends[0]) / (2.0 * h);
  }
  return phi;
}

}  // namespace signorini::tests
