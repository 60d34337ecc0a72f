// modified_law.hpp: a built-in law with other guards, transitions or name.
//
//   rows             as those of the built-in law           constants: those of Contact
//   all the rest     as that of the built-in law, unless a derived class overrides it
//
// The law still obeys conditions (6) and (7), which the law checker checks: guards and transitions may state them in another
// way, but not change them. A derived class that adds products to guards sets `linear_guards` to false. Example: the friction
// limit as one guard, F^2 - T^2 > 0, in place of F - T > 0 and F + T > 0 (examples/disc_law.cpp).
#pragma once

#include "signorini/contact.hpp"

namespace signorini {

class ModifiedLaw : public ContactLaw {
 public:
  /// linear_guards, tangents: see LawCapabilities.
  explicit ModifiedLaw(Law base, bool linear_guards = true, std::uint32_t tangents = 1)
      : ContactLaw(capabilities_of(base, linear_guards, tangents)), base_(base) {}

  /// The built-in law.
  [[nodiscard]] const ContactLaw& base() const { return *base_; }

  [[nodiscard]] std::string name() const override { return base_->name(); }
  [[nodiscard]] Rows rows(const Contact& contact, const ContactState& state) const final {
    return base_->rows(contact, state);
  }
  [[nodiscard]] Guards guards(const Contact& contact, const ContactState& state) const override {
    return base_->guards(contact, state);
  }
  [[nodiscard]] ContactState next_state(const Contact& contact, const ContactState& now, Guard failed,
                                        const MotionJet& jet) const override {
    return base_->next_state(contact, now, failed, jet);
  }
  [[nodiscard]] std::vector<ContactState> candidates(const Contact& contact, const ContactState& now,
                                                     const ContactMotion& before) const override {
    return base_->candidates(contact, now, before);
  }
  [[nodiscard]] Form slip_rate(const Contact& contact, int s) const override {
    return base_->slip_rate(contact, s);
  }
  [[nodiscard]] double working_slip_rate(const Contact& contact, State state,
                                         const ContactMotion& m) const override {
    return base_->working_slip_rate(contact, state, m);
  }
  [[nodiscard]] ContactWork work(const Contact& contact, State state, double N, double T,
                                 const ContactIncrement& path) const override {
    return base_->work(contact, state, N, T, path);
  }
  [[nodiscard]] double stored_energy(const Contact& contact, State state,
                                     const ContactMotion& m) const override {
    return base_->stored_energy(contact, state, m);
  }
  [[nodiscard]] Violations violations(const Contact& contact, State state,
                                      const ContactMotion& m) const override {
    return base_->violations(contact, state, m);
  }
  /// nullptr: all constants are those of Contact. A derived class with constants overrides this function.
  [[nodiscard]] std::shared_ptr<const ContactLaw> with_constants(
      const VisitConstant& /*visit*/) const override {
    return nullptr;
  }

 private:
  [[nodiscard]] static LawCapabilities capabilities_of(Law base, bool linear_guards, std::uint32_t tangents) {
    LawCapabilities result = signorini::capabilities_of(base);
    result.linear_guards = linear_guards;
    result.tangents = tangents;
    return result;
  }

  ContactLawPtr base_;
};

}  // namespace signorini
