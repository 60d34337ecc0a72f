// neighbourhoods.hpp: models of the neighbourhoods of contacts, for local computations.
//
//   W:   degrees of freedom where M^-1 n and M^-1 t exceed rounding, and some elements around them
//   M_WW a + C_WW v + K_WW u + contacts on W = P_W - ( M a + C v + K u + contacts across )_outside
//
// M^-1 decays with the distance, and so does the instantaneous effect of distant forces on a contact. Contacts that are close
// to each other share one W.
#pragma once

#include <memory>

#include "motion/state_systems.hpp"

namespace signorini::motion {

/// True if all degrees of freedom have mass, and the forces of all contacts follow from displacements and velocities by rows
/// with constant coefficients.
[[nodiscard]] bool follows_from_motion(const Model& model);
/// Smallest number of degrees of freedom for which local expansions save time. Chosen value.
inline constexpr int large_structure = 400;

struct Neighbourhood {
  Neighbourhood(Model part, std::vector<int> dofs_, std::vector<std::size_t> contacts_,
                std::vector<std::size_t> loads_)
      : model(std::move(part)),
        structure(model),
        systems(model, structure, few_states),
        dofs(std::move(dofs_)),
        contacts(std::move(contacts_)),
        loads(std::move(loads_)) {}
  Neighbourhood(const Neighbourhood&) = delete;  // members refer to each other by address
  Neighbourhood& operator=(const Neighbourhood&) = delete;

  /// Limits of the cache of contact states. They are low because all states share one factorisation of M_WW, and because
  /// there may be hundreds of neighbourhoods.
  static constexpr base::CacheLimits few_states{8, std::size_t{1} << 18};
  Model model;
  linear::SystemMatrices structure;
  StateSystems systems;
  std::size_t number = 0;                    // index of the neighbourhood, in the order of creation
  std::vector<int> dofs;                     // degrees of freedom in the whole model, ascending
  std::vector<std::size_t> contacts, loads;  // indices in the whole model, ascending
  /// Coupling of row `at` in the neighbourhood to column `dof` outside.
  struct Coupling {
    int at, dof;
    double m, c, k;
  };
  std::vector<Coupling> couplings;
  /// Force of a contact that acts inside and outside the neighbourhood. at: degree of freedom inside on which the force acts.
  struct CrossingForce {
    int at;
    std::size_t force;  // place of the force in the layout of the whole model
    double factor;
  };
  std::vector<CrossingForce> crossing_forces;

  /// States of the contacts in the neighbourhood, taken from the states of all contacts.
  [[nodiscard]] contact::ContactStates local_states(const contact::ContactStates& whole) const {
    contact::ContactStates states;
    states.reserve(contacts.size());
    for (const std::size_t c : contacts) states.push_back(whole[c]);
    return states;
  }
};

class Neighbourhoods {
 public:
  /// spread: number of elements by which W extends beyond the region where M^-1 is above rounding. `systems` must outlive the
  /// object.
  Neighbourhoods(StateSystems& systems, int spread);

  /// Neighbourhood of a contact; nullptr: M^-1 does not decay within a quarter of the structure. system: the system of any
  /// contact state, with a factorisation of M.
  [[nodiscard]] Neighbourhood* around(std::size_t contact, const StateSystem& system);
  /// True if several searches have failed and no neighbourhood was found.
  [[nodiscard]] bool found_none() const { return made_.empty() && failures_ >= max_failures; }
  [[nodiscard]] std::size_t size() const { return made_.size(); }

 private:
  static constexpr int max_failures = 4;  // chosen value
  [[nodiscard]] std::vector<int> distances(const std::vector<int>& from) const;
  [[nodiscard]] int reach(std::size_t contact, const StateSystem& system,
                          const std::vector<int>& distance) const;
  [[nodiscard]] std::unique_ptr<Neighbourhood> make(const std::vector<int>& distance, int radius) const;

  const Model& model_;
  const linear::SystemMatrices& structure_;
  const int spread_;
  std::vector<std::vector<int>> neighbours_;           // by dof: dofs that M, C, K or a contact couples
  std::vector<std::vector<std::size_t>> contacts_at_;  // contacts that act on each degree of freedom
  std::vector<double> root_of_mass_;                   // sqrt(m_ii) of each degree of freedom
  std::vector<std::unique_ptr<Neighbourhood>> made_;
  std::vector<Neighbourhood*>
      of_contact_;  // neighbourhood of each contact; valid if searched_ is true for the contact
  std::vector<bool> searched_;
  int failures_ = 0;
};

}  // namespace signorini::motion
