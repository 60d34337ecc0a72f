// local_derivatives.hpp: the motion for a decision of contact states, computed only near the contacts concerned.
//
//   M a = P - C v - K u - sum ( n N + t T )        everywhere, once; gives every guard's value and rate
//   |guard| > rounding + resolution |guard'|       decides the states of most contacts
//   derivatives of higher order                    for other contacts, each on a neighbourhood W
//   a - M^-1 (n dN + t dT)                         in other states with the same u and v: dN, dT of contacts
//                                                  whose state differs
//
// W: motion/neighbourhoods.hpp. The structure outside W acts on W with forces that are constant in time (order 0). The second
// of the two computations of a jet (motion/jet.hpp) omits these forces, so their effect is part of the noise. A guard that
// does not exceed the noise cannot be decided on the neighbourhood.
//
// Used for large structures, in states whose forces follow from displacements and velocities alone (linear/mass_factors.hpp).
#pragma once

#include <cstddef>
#include <memory>

#include "motion/jet.hpp"
#include "motion/neighbourhoods.hpp"
#include "motion/point.hpp"

namespace signorini::motion {

class LocalDerivatives {
 public:
  /// least: smallest number of degrees of freedom for which local jets are used. All arguments must outlive the object.
  explicit LocalDerivatives(StateSystems& systems, int least = large_structure);

  /// True if local jets can be computed for the model; false after M^-1 was found not to decay anywhere.
  [[nodiscard]] bool possible() const { return possible_; }
  struct LocalJet {
    Jet jet;                        ///< orders 0 to 2 of u, orders 0 and 1 of forces
    std::vector<std::size_t> open;  ///< contacts that order 0 of the motion does not decide
  };
  /// The last result at the same instant, under the same forcing and with the same criterion, possibly in other states.
  struct PreviousJet {
    const Jet& jet;
    const std::vector<std::size_t>& open;
  };
  /// Same as JetMaker::make(). nullopt: the jet must be computed on the whole structure. With `previous`, `motions` must
  /// still contain the motions of that jet. A motion is kept if the change of states affects neither the rows nor the
  /// accelerations of its contact.
  [[nodiscard]] std::optional<LocalJet> make(const StateSystemPtr& system, const Forcing& forcing, double t,
                                             const Vector& u, const Vector& v,
                                             std::vector<MotionJet>& motions,
                                             const JetMaker::StopCriterion& enough,
                                             const std::optional<PreviousJet>& previous = {});

 private:
  /// A contact with springs, without dashpot, acting on translations alone. The data for its motion and rounding errors are
  /// contiguous in memory.
  struct SpringContact {
    bool valid = false;
    std::size_t first = 0, middle = 0, end = 0;  // terms: normal [first, middle), tangent [middle, end)
    double gap = 0.0, normal_squared = 0.0, tangent_squared = 0.0;
  };
  /// Entries of M^-1 n and M^-1 t of a contact that are larger than rounding errors.
  struct Columns {
    bool known = false, few = false;  // few: the entries cover only a small part of the structure
    std::vector<std::pair<Eigen::Index, double>> by_N, by_T;
  };
  [[nodiscard]] const Columns& columns_of(std::size_t contact, const StateSystem& system);
  [[nodiscard]] Jet expand(const StateSystemPtr& system, const Forcing& forcing, double t, const Vector& u,
                           const Vector& v);
  [[nodiscard]] std::optional<Jet> update(const StateSystemPtr& system, const Forcing& forcing, double t,
                                          const PreviousJet& previous);
  void set_soft_motion(const Rows& rows, double surface, const Point& now, std::size_t contact,
                       MotionJet& motion) const;
  void set_rates(const StateSystem& system, const Forcing& forcing, std::size_t contact,
                 MotionJet& motion) const;
  void bound_rounding(const StateSystem& system, const Forcing& forcing, const Point& now,
                      std::size_t contact, MotionJet& motion) const;
  [[nodiscard]] bool is_unchanged(std::size_t contact, const Jet& jet, const PreviousJet& previous) const;
  [[nodiscard]] bool compute_locally(const StateSystemPtr& system, const Forcing& forcing, const Point& now,
                                     std::size_t contact, const JetMaker::StopCriterion& enough,
                                     MotionJet& motion);

  const Model& model_;
  bool possible_;
  Taylor taylor_;
  Series series_;
  std::vector<SpringContact> soft_;       // one entry per contact
  std::vector<Columns> columns_;          // one entry per contact
  std::vector<double> column_, scratch_;  // scratch for the computation of one column
  std::vector<std::pair<std::size_t, double>> terms_;
  std::optional<Neighbourhoods> neighbourhoods_;
  struct Work {  // memory for one neighbourhood
    explicit Work(StateSystems& systems) : jets(systems) {}
    JetMaker jets;
    std::vector<MotionJet> motions;
  };
  std::vector<std::unique_ptr<Work>> work_;
};

// The sum of two small dense products, computed in one pass by columns.
//
//   y_i = sum_j ( a_ij u_j + b_ij factor w_j ),      a, b: rows x columns, one column after the other
//
// Four rows are summed at a time, each in the order of j, so the results are bitwise those of a plain loop.

void fused_products(const double* a, const double* b, std::size_t rows, std::size_t columns, const double* u,
                    const double* w, double factor, double* y);

}  // namespace signorini::motion
