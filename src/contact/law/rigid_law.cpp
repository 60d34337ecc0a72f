// Constraint along the normal: g'' = 0 while closed. If the contact closes with g' < 0, an impact occurs (decide/impact.hpp).
#include <cmath>

#include "contact/law.hpp"
#include "contact/law/built_in.hpp"
#include "contact/law/coulomb_law.hpp"

namespace signorini {
namespace {

class RigidLaw final : public CoulombLaw {
 public:
  RigidLaw() : CoulombLaw(Law::rigid) {}

 private:
  [[nodiscard]] Form closed_normal_row(const Contact& /*contact*/) const override { return {.an = 1.0}; }
  void add_normal_rate(const Contact& /*contact*/, double factor, Form& form) const override {
    form.applied_normal_force_rate = -factor;  // never used: a rigid contact has no kt
  }
  [[nodiscard]] Violations violations(const Contact& contact, State state,
                                      const ContactMotion& m) const override {
    Violations v = CoulombLaw::violations(contact, state, m);
    v.penetration = !is_open(state) ? std::abs(m.gap) : -m.gap;
    v.product = std::abs(m.gap * m.N);
    return v;
  }
};

}  // namespace

const ContactLaw& rigid_law() {
  static const RigidLaw law;
  return law;
}

}  // namespace signorini
