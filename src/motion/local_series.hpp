// local_series.hpp: the series of a motion after an event, updated near the contacts whose states have changed.
//
//   M a_k + C v_k + K u_k + contacts on W = P_k - ( M a_k + C v_k + K u_k + contacts across )_outside       on W
//
// Outside W (motion/neighbourhoods.hpp) the motion keeps its series, because the effect of the change there
// is below rounding. This is checked: at the boundary of W the new series must equal the old one up to
// rounding.
//
// For large structures and states whose forces follow from displacements and velocities alone
// (linear/mass_factors.hpp).
#pragma once

#include <functional>
#include <memory>

#include "motion/neighbourhoods.hpp"
#include "motion/taylor.hpp"

namespace signorini::motion {

class LocalSeries {
 public:
  /// The argument must outlive the object.
  explicit LocalSeries(StateSystems& systems);

  /// False: M^-1 was found to decay nowhere.
  [[nodiscard]] bool possible() const { return !neighbourhoods_.has_given_up(); }

  /// Coefficients of the earlier motion about the instant: levels + 3 for a degree of freedom, levels + 1 for a force.
  struct PreviousSeries {
    std::function<void(int dof, double* out)> u;
    std::function<void(std::size_t slot, double* out)> force;
  };
  /// Sizes of motions: weights make degrees of freedom comparable. least: size of a weighted motion;
  /// differences up to its rounding error count as zero everywhere.
  struct Sizes {
    const std::vector<double>& weights;
    double least;
  };
  struct LocalExpansion {
    const Neighbourhood* where;
    const Series* series;  ///< series on that neighbourhood, valid until the next one is made there
  };
  /// Expands from u and v at t to `levels`. changed: contacts whose states have changed. reach: length of the
  /// interval on which the earlier series is used, in units of `scale`. nullopt: no single W contains all
  /// changes, or their effect extends beyond it.
  [[nodiscard]] std::optional<LocalExpansion> expand(const std::vector<std::size_t>& changed,
                                                     const StateSystemPtr& system, const Forcing& forcing,
                                                     double t, const Vector& u, const Vector& v, int levels,
                                                     double scale, double reach, const Sizes& sizes,
                                                     const PreviousSeries& previous);

 private:
  struct Work {  // scratch for one neighbourhood
    explicit Work(Neighbourhood& near);
    Taylor taylor;
    Series series;
    std::vector<int> ring, boundary;              // neighbours outside, in the whole; places inside
    std::vector<Eigen::Index> place_of_coupling;  // place in the ring of each coupling
    std::vector<std::size_t> place_of_crossing;   // place in `across` of each crossing force
    std::vector<std::size_t> across;              // forces
    Eigen::MatrixXd outside, forces;              // coefficients: columns for the ring; for `across`
  };
  [[nodiscard]] bool decays(const Neighbourhood& near, const Work& work, double reach, const Sizes& sizes,
                            const PreviousSeries& previous) const;

  Neighbourhoods neighbourhoods_;
  std::vector<std::unique_ptr<Work>> work_;
};

}  // namespace signorini::motion
