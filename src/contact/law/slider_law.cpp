// Given compression: N = -q(t) in every state. There is no gap; the contact is open while q = 0.
#include "contact/law/built_in.hpp"
#include "contact/law/coulomb_law.hpp"

namespace signorini {
namespace {

class SliderLaw final : public CoulombLaw {
 public:
  SliderLaw() : CoulombLaw(Law::slider) {}

 private:
  [[nodiscard]] Form closed_normal_row(const Contact& /*contact*/) const override {
    return {.N = 1.0, .applied_normal_force = 1.0};
  }
  void set_normal_guards(const Contact& /*contact*/, const ContactState& /*state*/,
                         Guards& /*result*/) const override {}
  void add_normal_rate(const Contact& /*contact*/, double factor, Form& form) const override {
    form.applied_normal_force_rate = -factor;
  }
};

}  // namespace

const ContactLaw& slider_law() {
  static const SliderLaw law;
  return law;
}

}  // namespace signorini
