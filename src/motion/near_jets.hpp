// near_jets.hpp: what a decision asks of the motion, computed near the contacts that it concerns.
//
//   M a = P - C v - K u - sum ( n N + t T )        everywhere, once; with it every guard's value and rate
//   |guard| > rounding + resolution |guard'|       most contacts are told by that
//   derivatives of higher order                    of the others each on a neighbourhood W of its own (motion/jet.hpp)
//   a - M^-1 (n dN + t dT)                         of other states at the same place, for contacts that have others
//
// W: motion/neighbourhoods.hpp. Of what lies beyond, it is given what that does at order 0, and its noise the difference that this
// makes: the second time a jet is made (motion/jet.hpp) without. Where the noise then does not tell, nothing here tells.
//
// For states whose forces follow from places and velocities alone (linear/mass_factors.hpp), in large structures.
#pragma once

#include <memory>

#include "motion/jet.hpp"
#include "motion/neighbourhoods.hpp"
#include "motion/point.hpp"

namespace signorini {

class NearJets {
 public:
  /// least: fewest degrees of freedom for which it is worth while. All must outlive it.
  explicit NearJets(ModeSystems& systems, int least = large_structure);

  /// Whether the model is one for this, as far as is known: where M^-1 is seen to decay nowhere, it is not.
  [[nodiscard]] bool possible() const { return possible_; }
  struct Made {
    Jet jet;                        ///< the orders 0 to 2 of u, of forces 0 and 1
    std::vector<std::size_t> open;  ///< contacts that order 0 does not tell
  };
  /// What was made last at the same instant, under the same forcing, for the same question, in other states perhaps.
  struct Beside {
    const Jet& jet;
    const std::vector<std::size_t>& open;
  };
  /// As JetMaker::make. Nothing: it takes the whole structure. beside: `motions` are still those of it, and stay where other
  /// states change neither row nor acceleration.
  [[nodiscard]] std::optional<Made> make(const ModeSystemPtr& system, const Forcing& forcing, double t,
                                         const Vector& u, const Vector& v, std::vector<MotionJet>& motions,
                                         const JetMaker::Told& told,
                                         const std::optional<Beside>& beside = {});

 private:
  /// Soft, without a dashpot, on translations alone: what of it makes its motion and the rounding of that, close together.
  struct Soft {
    bool is = false;
    std::size_t first = 0, middle = 0, end = 0;  // its normal's terms, its tangent's
    double gap = 0.0, normal_squared = 0.0, tangent_squared = 0.0;
  };
  /// M^-1 n and M^-1 t of a contact, where they are more than rounding.
  struct Columns {
    bool known = false, few = false;  // few: of small part of the structure
    std::vector<std::pair<Eigen::Index, double>> by_N, by_T;
  };
  [[nodiscard]] const Columns& columns_of(std::size_t contact, const ModeSystem& system);
  [[nodiscard]] Jet expand(const ModeSystemPtr& system, const Forcing& forcing, double t, const Vector& u,
                           const Vector& v);
  [[nodiscard]] std::optional<Jet> follow(const ModeSystemPtr& system, const Forcing& forcing, double t,
                                          const Beside& beside);
  void tell_soft(const Rows& rows, double surface, const Point& now, std::size_t contact,
                 MotionJet& motion) const;
  void order_one(const ModeSystem& system, const Forcing& forcing, std::size_t contact,
                 MotionJet& motion) const;
  void bound_rounding(const ModeSystem& system, const Forcing& forcing, const Point& now, std::size_t contact,
                      MotionJet& motion) const;
  [[nodiscard]] bool stays(std::size_t contact, const Jet& jet, const Beside& beside) const;
  [[nodiscard]] bool look_near(const ModeSystemPtr& system, const Forcing& forcing, const Point& now,
                               std::size_t contact, const JetMaker::Told& told, MotionJet& motion);

  const Model& model_;
  bool possible_;
  Taylor taylor_;
  Series series_;
  std::vector<Soft> soft_;             // one a contact
  std::vector<Columns> columns_;       // the same
  std::vector<double> column_, room_;  // of one of them
  std::vector<std::pair<std::size_t, double>> terms_;
  std::optional<Neighbourhoods> near_;
  struct Work {  // at one of them
    explicit Work(ModeSystems& systems) : jets(systems) {}
    JetMaker jets;
    std::vector<MotionJet> motions;
  };
  std::vector<std::unique_ptr<Work>> work_;
};

}  // namespace signorini
