#include "signorini/contact_law.hpp"

#include "contact/law.hpp"
#include "contact/law/built_in.hpp"

namespace signorini {
namespace {

const ContactLaw& built_in(Law law) {
  switch (law) {
    case Law::compliant:
      return compliant_law();
    case Law::rigid:
      return rigid_law();
    case Law::slider:
      break;
  }
  return slider_law();
}

}  // namespace

/// The pointer does not own the law, because built-in laws live as long as the program.
ContactLawPtr::ContactLawPtr(Law law) : law_(std::shared_ptr<const ContactLaw>(), &built_in(law)) {}

ContactLawPtr::ContactLawPtr(std::shared_ptr<const ContactLaw> law) : law_(std::move(law)) {
  if (!law_) *this = ContactLawPtr();
}

std::vector<ContactState> ContactLaw::candidates(const Contact& /*contact*/, const ContactState& now,
                                                 const ContactMotion& /*before*/) const {
  std::vector<ContactState> result;
  for (const State state : user_law_states()) result.push_back({state, now.anchor});
  return result;
}

Form ContactLaw::slip_rate(const Contact& /*contact*/, int /*s*/) const { return {.vt = 1.0}; }

double ContactLaw::working_slip_rate(const Contact& /*contact*/, State /*state*/,
                                     const ContactMotion& m) const {
  return m.vt;
}

ContactWork ContactLaw::work(const Contact& /*contact*/, State /*state*/, double N, double T,
                             const ContactIncrement& path) const {
  ContactWork work;
  work.friction = N * path.gap + T * path.slip;
  work.surface = -T * path.surface;
  work.applied_normal_force = -N * path.time;
  return work;
}

double ContactLaw::stored_energy(const Contact& /*contact*/, State /*state*/,
                                 const ContactMotion& /*m*/) const {
  return 0.0;
}

Violations ContactLaw::violations(const Contact& /*contact*/, State /*state*/,
                                  const ContactMotion& /*m*/) const {
  return {};
}

}  // namespace signorini
