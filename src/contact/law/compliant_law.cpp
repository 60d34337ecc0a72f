// Spring and dashpot along the normal: N = kn g + cn g' while closed. The contact opens at N = 0, so that N is never tensile.
#include <cmath>

#include "contact/law.hpp"
#include "contact/law/built_in.hpp"
#include "contact/law/coulomb_law.hpp"

namespace signorini {
namespace {

class CompliantLaw : public CoulombLaw {
 public:
  CompliantLaw() : CoulombLaw(Law::compliant) {}

 protected:
  explicit CompliantLaw(const LawCapabilities& of) : CoulombLaw(Law::rigid, of) {}

 private:
  [[nodiscard]] Form closed_normal_row(const Contact& contact) const override {
    return {.N = 1.0, .gap = -contact.normal_stiffness, .vn = -contact.normal_damping};
  }
  void add_normal_rate(const Contact& contact, double factor, Form& form) const override {
    form.vn = factor * contact.normal_stiffness;
    form.an = factor * contact.normal_damping;
  }
  [[nodiscard]] double normal_energy(const Contact& contact, State state,
                                     const ContactMotion& m) const override {
    if (state == State::inside)
      return 0.5 * contact.normal_stiffness * m.gap * m.gap;  // dissipated by the dashpot until the gap opens
    if (is_open(state)) return 0.0;
    const double spring = m.N - contact.normal_damping * m.vn;
    return spring * spring / (2.0 * contact.normal_stiffness);
  }
  [[nodiscard]] Violations violations(const Contact& contact, State state,
                                      const ContactMotion& m) const override {
    Violations v = CoulombLaw::violations(contact, state, m);
    // Deformation of the normal spring. In state "inside" the deformation is still negative, because the dashpot delays its
    // return to zero.
    const double element = !is_open(state) ? (m.N - contact.normal_damping * m.vn) / contact.normal_stiffness
                           : state == State::inside ? m.gap
                                                    : 0.0;
    v.gap = -(m.gap - element);
    v.product = std::abs(v.gap * m.N);
    return v;
  }
};

/// Compliant law whose springs represent compliance of the structure. name() is "rigid", because
/// scenes name such a contact so.
class ComplianceSplitLaw final : public CompliantLaw {
 public:
  ComplianceSplitLaw() : CompliantLaw({.normal_spring = true, .compliance_split = true}) {}
};

}  // namespace

const ContactLaw& compliant_law() {
  static const CompliantLaw law;
  return law;
}

ContactLawPtr compliance_split_law() {
  static const std::shared_ptr<const ContactLaw> law = std::make_shared<const ComplianceSplitLaw>();
  return law;
}

}  // namespace signorini
