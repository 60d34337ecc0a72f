// orbit_runs.hpp: runs that start beside an orbit of a [matrices] scene.
//
//   z = (u, v, shears that the orbit begins with)
//   dz(T)/dz by central differences over h: the monodromy matrix
#pragma once

#include <fmt/core.h>

#include <Eigen/Core>
#include <algorithm>
#include <string>
#include <vector>

#include "behaviour/rates.hpp"
#include "signorini/orbit.hpp"
#include "signorini/simulate.hpp"

namespace signorini::tests {

/// Entries of SavedState::shears of contacts that hold one where the orbit begins.
inline std::vector<std::size_t> shears_of(const SavedState& start) {
  std::vector<std::size_t> shears;
  for (std::size_t c = 0; c < start.shears.size(); ++c)
    if (start.shears[c].second != 0.0 && start.slips[c].second == 0) shears.push_back(c);
  return shears;
}

/// z after 1, 2, ... `periods` periods, columns, of a run that starts at z0 + dz. n: degrees of freedom.
inline Eigen::MatrixXd states_beside(const std::string& text, const Orbit& orbit, int n,
                                     const Eigen::VectorXd& dz, int periods) {
  Scene moved = orbit_scene(reader_of_text(text), orbit);
  SavedState& saved = *moved.initial.saved;
  const std::vector<std::size_t> shears = shears_of(saved);
  for (std::size_t k = 0; k < shears.size(); ++k)
    saved.shears[shears[k]].second += dz[2 * n + static_cast<Eigen::Index>(k)];
  for (auto& [of, value] : saved.motions)
    for (int j = 0; j < 2 * n; ++j)
      if (of == fmt::format("d{}.{}", j % n, j < n ? "u" : "v")) value += dz[j];
  moved.run.t_end = periods * orbit.period;
  moved.run.output_dt.reset();
  moved.run.output_times.emplace();
  for (int k = 1; k <= periods; ++k)
    moved.run.output_times->push_back(k == periods ? moved.run.t_end : k * orbit.period);
  const auto contact_of = [&](std::size_t entry) {
    const auto at = std::find_if(moved.contacts.begin(), moved.contacts.end(),
                                 [&](const ContactSpec& c) { return c.name == saved.shears[entry].first; });
    return static_cast<std::size_t>(at - moved.contacts.begin());
  };
  const Result run = simulate(moved);
  Eigen::MatrixXd z(dz.size(), periods);
  for (int k = 0; k < periods; ++k) {
    const double t = (*moved.run.output_times)[static_cast<std::size_t>(k)];
    const auto row = std::find_if(run.rows.rbegin(), run.rows.rend(),
                                  [&](const auto& r) { return r.t <= t * (1.0 + 1e-12); });
    z.col(k).head(2 * n) << row->u, row->v;
    for (std::size_t c = 0; c < shears.size(); ++c)
      z(2 * n + static_cast<Eigen::Index>(c), k) = row->contacts[contact_of(shears[c])].T;
  }
  return z;
}

/// n: degrees of freedom. Phi is 2 n wide, and one wider for each contact that sticks at the section.
inline Eigen::MatrixXd monodromy_by_runs(const std::string& text, const Orbit& orbit, int n, double h) {
  const SavedState start = orbit_scene(reader_of_text(text), orbit).initial.saved.value();
  const Eigen::Index size = 2 * n + static_cast<Eigen::Index>(shears_of(start).size());
  Eigen::MatrixXd phi(size, size);
  for (Eigen::Index j = 0; j < size; ++j) {
    const Eigen::VectorXd dz = h * Eigen::VectorXd::Unit(size, j);
    phi.col(j) = (states_beside(text, orbit, n, dz, 1) - states_beside(text, orbit, n, -dz, 1)) / (2.0 * h);
  }
  return phi;
}

}  // namespace signorini::tests
