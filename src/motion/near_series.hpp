// near_series.hpp: the series of a motion after an event, near the contacts whose states have changed.
//
//   M a_k + C v_k + K u_k + contacts on W = P_k - ( M a_k + C v_k + K u_k + contacts across )_outside       on W
//
// Outside of W (motion/neighbourhoods.hpp) the motion goes on with the series that it had: what the change does there is
// rounding. Is it? At the boundary of W the new series must be the old one but for that.
//
// For states whose forces follow from places and velocities alone (linear/mass_factors.hpp), in large structures.
#pragma once

#include <functional>
#include <memory>

#include "motion/neighbourhoods.hpp"
#include "motion/taylor.hpp"

namespace signorini {

class NearSeries {
 public:
  /// It must outlive it.
  explicit NearSeries(ModeSystems& systems);

  /// False: M^-1 is seen to decay nowhere.
  [[nodiscard]] bool possible() const { return !near_.hopeless(); }

  /// Coefficients of the motion as it was, about the instant: levels + 3 of a degree of freedom, levels + 1 of a force.
  struct AsItWas {
    std::function<void(int dof, double* out)> u;
    std::function<void(std::size_t slot, double* out)> force;
  };
  /// How great motions are: weights, one a degree of freedom, make them alike; least: the motion, by these, whose rounding is
  /// rounding anywhere.
  struct Sizes {
    const std::vector<double>& weights;
    double least;
  };
  struct Made {
    const Neighbourhood* where;
    const Series* series;  ///< on it, until the next one is made there
  };
  /// From u and v at t, to `levels`. changed: contacts. reach: of the series as it was, in units of `scale`. Nothing: one W
  /// does not hold all that has changed, or what the change does reaches beyond it.
  [[nodiscard]] std::optional<Made> expand(const std::vector<std::size_t>& changed,
                                           const ModeSystemPtr& system, const Forcing& forcing, double t,
                                           const Vector& u, const Vector& v, int levels, double scale,
                                           double reach, const Sizes& sizes, const AsItWas& as_it_was);

 private:
  struct Work {  // at one of the neighbourhoods
    explicit Work(Neighbourhood& near);
    Taylor taylor;
    Series series;
    std::vector<int> ring, boundary;         // next to it outside, in the whole; in it, next to outside
    std::vector<Eigen::Index> place_of_tie;  // of each tie in the ring
    std::vector<std::size_t> place_of_pull;  // of each pull in `across`
    std::vector<std::size_t> across;         // forces
    Eigen::MatrixXd outside, forces;         // coefficients: a column one of the ring; one of `across`
  };
  [[nodiscard]] bool dies_out(const Neighbourhood& near, const Work& work, double reach, const Sizes& sizes,
                              const AsItWas& as_it_was) const;

  Neighbourhoods near_;
  std::vector<std::unique_ptr<Work>> work_;
};

}  // namespace signorini
