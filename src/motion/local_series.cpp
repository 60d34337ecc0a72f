#include "motion/local_series.hpp"

#include <algorithm>
#include <cmath>

#include "base/rounding.hpp"

namespace signorini::motion {
namespace {

/// Number of elements by which W extends beyond the region where M^-1 is above rounding. Each level of a series spreads a
/// change by one more element, with decreasing size. Chosen value; decays() checks it.
constexpr int series_spread = 20;

/// Sorts the elements in ascending order and removes duplicates.
template <class T>
void sort_unique(std::vector<T>& of) {
  std::sort(of.begin(), of.end());
  of.erase(std::unique(of.begin(), of.end()), of.end());
}

template <class T>
std::size_t place_in(const std::vector<T>& of, T what) {
  return static_cast<std::size_t>(std::lower_bound(of.begin(), of.end(), what) - of.begin());
}

}  // namespace

LocalSeries::LocalSeries(StateSystems& systems) : neighbourhoods_(systems, series_spread) {}

LocalSeries::Work::Work(Neighbourhood& near) : taylor(near.systems) {
  for (const Neighbourhood::Coupling& tie : near.couplings) {
    ring.push_back(tie.dof);
    boundary.push_back(tie.at);
  }
  for (const Neighbourhood::CrossingForce& pull : near.crossing_forces) {
    across.push_back(pull.force);
    boundary.push_back(pull.at);
  }
  sort_unique(ring);
  sort_unique(boundary);
  sort_unique(across);
  for (const Neighbourhood::Coupling& tie : near.couplings)
    place_of_coupling.push_back(static_cast<Eigen::Index>(place_in(ring, tie.dof)));
  for (const Neighbourhood::CrossingForce& pull : near.crossing_forces)
    place_of_crossing.push_back(place_in(across, pull.force));
}

/// True if the new series equals the old one at the boundary of W, up to a few rounding errors of the motion there and in the
/// adjacent elements.
bool LocalSeries::decays(const Neighbourhood& near, const Work& work, double reach, const Sizes& sizes,
                         const PreviousSeries& previous) const {
  const auto terms_of = [&](const double* a, std::size_t count, int dof) {
    double terms = 0.0, power = 1.0;
    for (std::size_t k = 0; k < count; ++k, power *= reach) terms += std::abs(a[k]) * power;
    return sizes.weights[static_cast<std::size_t>(dof)] * terms;
  };
  const auto count = static_cast<std::size_t>(work.series.u.cols());
  std::vector<double> moves(static_cast<std::size_t>(near.model.size()), sizes.least);
  for (std::size_t i = 0; i < near.couplings.size(); ++i) {
    double& greatest = moves[static_cast<std::size_t>(near.couplings[i].at)];
    greatest = std::max(
        greatest, terms_of(work.outside.col(work.place_of_coupling[i]).data(), count, near.couplings[i].dof));
  }
  std::vector<double> change(count);
  for (const int at : work.boundary) {
    const int dof = near.dofs[static_cast<std::size_t>(at)];
    previous.u(dof, change.data());
    const double moved = std::max(moves[static_cast<std::size_t>(at)], terms_of(change.data(), count, dof));
    for (std::size_t k = 0; k < count; ++k) change[k] -= work.series.u(at, static_cast<Eigen::Index>(k));
    if (!(terms_of(change.data(), count, dof) <= rounding::many_operations * moved)) return false;
  }
  return true;
}

std::optional<LocalSeries::LocalExpansion> LocalSeries::expand(const std::vector<std::size_t>& changed,
                                                               const StateSystemPtr& system,
                                                               const Forcing& forcing, double t,
                                                               const Vector& u, const Vector& v, int levels,
                                                               double scale, double reach, const Sizes& sizes,
                                                               const PreviousSeries& previous) {
  if (!possible() || !system->factorised().by_mass) return std::nullopt;
  Neighbourhood* near = neighbourhoods_.around(changed.front(), *system);
  for (const std::size_t c : changed)
    if (near == nullptr || neighbourhoods_.around(c, *system) != near) return std::nullopt;
  while (work_.size() < neighbourhoods_.size()) work_.emplace_back();
  std::unique_ptr<Work>& room = work_[near->number];
  if (!room) room = std::make_unique<Work>(*near);
  Work& work = *room;
  const StateSystemPtr own = near->systems.system_of(near->local_states(system->states()));
  if (!own) return std::nullopt;

  work.outside.resize(levels + 3, static_cast<Eigen::Index>(work.ring.size()));
  for (std::size_t i = 0; i < work.ring.size(); ++i)
    previous.u(work.ring[i], work.outside.col(static_cast<Eigen::Index>(i)).data());
  work.forces.resize(levels + 1, static_cast<Eigen::Index>(work.across.size()));
  for (std::size_t i = 0; i < work.across.size(); ++i)
    previous.force(work.across[i], work.forces.col(static_cast<Eigen::Index>(i)).data());
  const auto from_outside = [&](int order, double* P) {
    const double to_velocity = (order + 1) / scale, to_acceleration = to_velocity * (order + 2) / scale;
    for (std::size_t i = 0; i < near->couplings.size(); ++i) {
      const Neighbourhood::Coupling& tie = near->couplings[i];
      const double* x = work.outside.col(work.place_of_coupling[i]).data() + order;
      P[tie.at] -= tie.m * to_acceleration * x[2] + tie.c * to_velocity * x[1] + tie.k * x[0];
    }
    for (std::size_t i = 0; i < near->crossing_forces.size(); ++i)
      P[near->crossing_forces[i].at] -=
          near->crossing_forces[i].factor *
          work.forces(order, static_cast<Eigen::Index>(work.place_of_crossing[i]));
  };
  const Forcing own_forcing =
      forcing.on_part(near->model, near->dofs, near->loads, near->contacts, Vector::Zero(near->model.size()));
  work.taylor.set_additional_loads(from_outside);
  work.taylor.expand(own, own_forcing, t, u(near->dofs), v(near->dofs), levels, scale, work.series);
  if (!decays(*near, work, reach, sizes, previous)) return std::nullopt;
  return LocalExpansion{near, &work.series};
}

}  // namespace signorini::motion
