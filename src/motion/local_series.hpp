// local_series.hpp: the Taylor series of a motion after an event, updated only near the contacts whose states have changed.
//
//   M a_k + C v_k + K u_k + contacts on W = P_k - ( M a_k + C v_k + K u_k + contacts across )_outside       on W
//
// Outside W (motion/neighbourhoods.hpp) the motion keeps its series, because the effect of the change is below rounding
// there. This is checked: at the boundary of W the new series must equal the old one up to rounding.
//
// Used for large structures, in states whose forces follow from displacements and velocities alone (linear/mass_factors.hpp).
#pragma once

#include <functional>
#include <memory>

#include "motion/neighbourhoods.hpp"
#include "motion/taylor.hpp"

namespace signorini::motion {

class LocalSeries {
 public:
  /// `systems` must outlive the object.
  explicit LocalSeries(StateSystems& systems);

  /// True if local series can be computed; false after M^-1 was found not to decay anywhere.
  [[nodiscard]] bool possible() const { return !neighbourhoods_.found_none(); }

  /// Functions that write the Taylor coefficients of the motion before the event, expanded about the time of the event:
  /// levels + 3 numbers for a degree of freedom, levels + 1 numbers for a force.
  struct PreviousSeries {
    std::function<void(int dof, double* out)> u;
    std::function<void(std::size_t slot, double* out)> force;
  };
  /// Magnitudes of motions. weights: factors that make degrees of freedom comparable. least: smallest weighted magnitude that
  /// is assumed for any degree of freedom; differences up to the rounding error of `least` are treated as zero.
  struct Sizes {
    const std::vector<double>& weights;
    double least;
  };
  struct LocalExpansion {
    const Neighbourhood* where;
    const Series* series;  ///< series on `where`, valid until the next expansion on the same neighbourhood
  };
  /// Expands the motion from u and v at t up to `levels`. changed: contacts whose states have changed. reach: length of the
  /// interval on which the series is used, in units of `scale`. nullopt: no single W contains all changed contacts, or the
  /// effect of the change extends beyond W.
  [[nodiscard]] std::optional<LocalExpansion> expand(const std::vector<std::size_t>& changed,
                                                     const StateSystemPtr& system, const Forcing& forcing,
                                                     double t, const Vector& u, const Vector& v, int levels,
                                                     double scale, double reach, const Sizes& sizes,
                                                     const PreviousSeries& previous);

 private:
  struct Work {  // memory for one neighbourhood
    explicit Work(Neighbourhood& near);
    Taylor taylor;
    Series series;
    std::vector<int> ring, boundary;  // ring: dofs of the whole model next to W; boundary: dofs of W
    std::vector<Eigen::Index> place_of_coupling;  // index in `ring` of each coupling
    std::vector<std::size_t> place_of_crossing;   // index in `across` of each crossing force
    std::vector<std::size_t> across;              // forces of contacts that act inside and outside W
    Eigen::MatrixXd outside, forces;  // coefficients by columns: outside for `ring`, forces for `across`
  };
  [[nodiscard]] bool decays(const Neighbourhood& near, const Work& work, double reach, const Sizes& sizes,
                            const PreviousSeries& previous) const;

  Neighbourhoods neighbourhoods_;
  std::vector<std::unique_ptr<Work>> work_;
};

}  // namespace signorini::motion
