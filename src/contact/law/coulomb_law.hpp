// coulomb_law.hpp: Coulomb friction combined with any normal law; base class of the built-in laws.
//
//   tangent row   open, closed  T = 0
//                 stick         T - kt (ut - p) = 0;  without kt: ut'' = 0;  with a shear element: p' = 0
//                 slip s        T + s fk N = 0;  if friction depends on N: T - s F = 0
//                 limit s       T + s fs N = 0   (at the static limit in direction s, without slip)
//   guards        stick         fs |N| - T,  fs |N| + T
//                 slip s        s p',  p' = ut' - T'/kt
//
// A normal law provides its row, its guards and the rate of N (compliant_law.cpp, rigid_law.cpp, slider_law.cpp).
#pragma once

#include "contact/law.hpp"

namespace signorini {

class CoulombLaw : public ContactLaw {
 public:
  explicit CoulombLaw(Law law) : CoulombLaw(law, capabilities_of(law)) {}

  [[nodiscard]] std::string name() const override { return contact::to_string(law_); }
  [[nodiscard]] Rows rows(const Contact& contact, const ContactState& state) const override;
  [[nodiscard]] Guards guards(const Contact& contact, const ContactState& state) const override;
  [[nodiscard]] Form slip_rate(const Contact& contact, int s) const override;
  [[nodiscard]] ContactState next_state(const Contact& contact, const ContactState& now, Guard failed,
                                        const MotionJet& jet) const override;
  [[nodiscard]] std::vector<ContactState> candidates(const Contact& contact, const ContactState& now,
                                                     const ContactMotion& before) const override;
  [[nodiscard]] double working_slip_rate(const Contact& contact, State state,
                                         const ContactMotion& m) const override;
  [[nodiscard]] ContactWork work(const Contact& contact, State state, double N, double T,
                                 const ContactIncrement& path) const override;
  [[nodiscard]] double stored_energy(const Contact& contact, State state,
                                     const ContactMotion& m) const override;
  [[nodiscard]] std::shared_ptr<const ContactLaw> with_constants(
      const VisitConstant& /*visit*/) const override {
    return nullptr;
  }
  /// Violations of (7) and the tension. A normal law with a gap adds the violations of (6).
  [[nodiscard]] Violations violations(const Contact& contact, State state,
                                      const ContactMotion& m) const override;

 protected:
  CoulombLaw(Law named, const LawCapabilities& of) : ContactLaw(of), law_(named) {}
  /// Normal row of a closed contact. The row of an open contact is N = 0 for all laws with a gap.
  [[nodiscard]] virtual Form closed_normal_row(const Contact& contact) const = 0;
  /// Sets the guards of the normal direction: g > 0 if open, -N > 0 if closed.
  virtual void set_normal_guards(const Contact& contact, const ContactState& state, Guards& result) const;
  /// Adds `factor` times N' to `form`, the slip rate of a contact with a tangential spring.
  virtual void add_normal_rate(const Contact& contact, double factor, Form& form) const = 0;
  /// Energy stored by the normal force.
  [[nodiscard]] virtual double normal_energy(const Contact& contact, State state,
                                             const ContactMotion& m) const;

 private:
  Law law_;
};

}  // namespace signorini
