// neighbourhoods.hpp: a model of what is near to a contact.
//
//   W:   degrees of freedom up to where M^-1 n and M^-1 t of the contact are below rounding, and some elements more
//   M_WW a + C_WW v + K_WW u + contacts on W = P_W - ( M a + C v + K u + contacts across )_outside
//
// M^-1 decays with the distance, and so does what is done to a contact from far away at an instant. Contacts close to each
// other share W.
#pragma once

#include <memory>

#include "motion/mode_systems.hpp"

namespace signorini {

/// Forces of all contacts follow from places and velocities by rows that do not change with the motion, and there are masses
/// everywhere.
[[nodiscard]] bool follows_from_motion(const Model& model);
/// Degrees of freedom from which it is worth while to look near. Chosen.
inline constexpr int large_structure = 400;

struct Neighbourhood {
  Neighbourhood(Model part, std::vector<int> dofs_, std::vector<std::size_t> contacts_,
                std::vector<std::size_t> loads_)
      : model(std::move(part)),
        structure(model),
        systems(model, structure, few_modes),
        dofs(std::move(dofs_)),
        contacts(std::move(contacts_)),
        loads(std::move(loads_)) {}
  Neighbourhood(const Neighbourhood&) = delete;  // its parts know each other by address
  Neighbourhood& operator=(const Neighbourhood&) = delete;

  /// States share one factorisation of M_WW, so that to keep many saves nothing; there may be hundreds of neighbourhoods.
  static constexpr CacheBounds few_modes{8, std::size_t{1} << 18};
  Model model;
  Structure structure;
  ModeSystems systems;
  std::size_t number = 0;                    // in the order in which they are made
  std::vector<int> dofs;                     // in the whole, ascending
  std::vector<std::size_t> contacts, loads;  // the same
  /// Coupling of row `at` here to column `dof` outside.
  struct Tie {
    int at, dof;
    double m, c, k;
  };
  std::vector<Tie> ties;
  /// Contacts that reach across the boundary: their forces act on `at`.
  struct Pull {
    int at;
    std::size_t force;  // its slot
    double factor;
  };
  std::vector<Pull> pulls;

  [[nodiscard]] Mode mode_of(const Mode& whole) const {
    Mode mode;
    mode.reserve(contacts.size());
    for (const std::size_t c : contacts) mode.push_back(whole[c]);
    return mode;
  }
};

class Neighbourhoods {
 public:
  /// spread: elements beyond where M^-1 is below rounding. Both must outlive it.
  Neighbourhoods(ModeSystems& systems, int spread);

  /// Null: M^-1 does not decay within a quarter of the structure. system: of any state, with a factorisation of M.
  [[nodiscard]] Neighbourhood* around(std::size_t contact, const ModeSystem& system);
  /// Nothing is near to anything here: several have been looked for, and none is there.
  [[nodiscard]] bool hopeless() const { return made_.empty() && vain_ >= most_vain; }
  [[nodiscard]] std::size_t size() const { return made_.size(); }

 private:
  static constexpr int most_vain = 4;  // chosen
  [[nodiscard]] std::vector<int> distances(const std::vector<int>& from) const;
  [[nodiscard]] int reach(std::size_t contact, const ModeSystem& system,
                          const std::vector<int>& distance) const;
  [[nodiscard]] std::unique_ptr<Neighbourhood> make(const std::vector<int>& distance, int radius) const;

  const Model& model_;
  const Structure& structure_;
  const int spread_;
  std::vector<std::vector<int>> neighbours_;           // of a degree of freedom, by M, C, K or a contact
  std::vector<std::vector<std::size_t>> contacts_at_;  // of a degree of freedom
  std::vector<double> root_of_mass_;                   // of each degree of freedom alone
  std::vector<std::unique_ptr<Neighbourhood>> made_;
  std::vector<Neighbourhood*> of_contact_;  // once looked for
  std::vector<bool> looked_for_;
  int vain_ = 0;
};

}  // namespace signorini
