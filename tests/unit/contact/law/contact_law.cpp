#include "signorini/contact_law.hpp"

#include <doctest/doctest.h>

#include "contact/constants.hpp"
#include "contact/law.hpp"
#include "contact/law/data_laws.hpp"
#include "contact/law/user_law.hpp"
#include "contact/work.hpp"
#include "scene/keys.hpp"
#include "scene/quantities.hpp"

using namespace signorini;

namespace {

Contact contact_of(ContactLawPtr law) {
  Contact c;
  c.law = std::move(law);
  c.gap = 0.25;
  c.normal_stiffness = 1000.0;
  c.normal_damping = 3.0;
  c.tangential_stiffness = 700.0;
  c.friction = {0.5, 0.25};
  return c;
}

/// Each law, and the states that it may take.
std::vector<std::pair<Contact, std::vector<State>>> all() {
  const std::vector<State> built_in = {State::open,  State::inside,    State::closed,
                                       State::stick, State::slip_plus, State::slip_minus};
  std::vector<std::pair<Contact, std::vector<State>>> contacts;
  for (const Law law : {Law::compliant, Law::slider}) contacts.emplace_back(contact_of(law), built_in);
  contacts.emplace_back(contact_of(Law::rigid), built_in);
  contacts.back().first.tangential_stiffness.reset();
  contacts.back().first.normal_stiffness =
      1.0;  // a guard of `inside` divides by it, which no rigid contact is
  contacts.emplace_back(contact_of(compliance_split_law()), built_in);
  for (const DataLaw* data : data_laws()) {
    const std::vector<double> constants(data->constants.size(), 20.0);
    Contact c = contact_of(std::make_shared<const UserContactLaw>(data->make(1000.0, constants)));
    const std::vector<State> own = c.law->user_law_states();
    contacts.emplace_back(std::move(c), own);
  }
  // R^2 + c N - N^2 - T^2 and a memory: the linear part of a guard has the unit of its products.
  UserContactLaw round;
  round.states = {{"on",
                   State::stick,
                   {{.N = 1.0, .gap = -50.0}},
                   {{.T = 1.0, .ut = -20.0}},
                   {{{{.N = 3.0, .constant = 25.0}, 4.0},
                     0,
                     {},
                     {{{.N = -1.0}, {.N = 1.0}}, {{.T = -1.0}, {.T = 1.0}}}}}}};
  Contact c = contact_of(std::make_shared<const UserContactLaw>(std::move(round)));
  const std::vector<State> own = c.law->user_law_states();
  contacts.emplace_back(std::move(c), own);
  return contacts;
}

ContactMotion in_other_units(ContactMotion m, const Factors& factors) {
  for (double* x : {&m.N, &m.T, &m.applied_normal_force, &m.limit})
    *x *= scene::factor_of(unit::force, factors);
  for (double* x : {&m.gap, &m.ut}) *x *= scene::factor_of(unit::length, factors);
  for (double* x : {&m.vn, &m.vt}) *x *= scene::factor_of(unit::velocity, factors);
  for (double* x : {&m.an, &m.at}) *x *= scene::factor_of(unit::acceleration, factors);
  for (double* x : {&m.applied_normal_force_rate, &m.limit_rate}) *x *= scene::factor_of({1, 0, -1}, factors);
  return m;
}

}  // namespace

TEST_SUITE_BEGIN("unit/contact/law/contact_law");

TEST_CASE("rows, guards and energies of every law follow its constants into other units") {
  const Factors factors{8.0, 0.25, 2.0};  // powers of two: no rounding
  ContactMotion m;
  m.N = -3.0, m.T = 1.5, m.gap = -0.003, m.ut = 0.01, m.vn = -0.2, m.vt = 0.4, m.an = 7.0, m.at = -5.0;
  m.applied_normal_force = 2.5, m.applied_normal_force_rate = 0.75;
  const ContactMotion moved = in_other_units(m, factors);
  for (const auto& [contact, states] : all()) {
    CAPTURE(contact.law->name());
    Contact other = contact;
    contact::visit_constants(other, [&](double& x, const Unit& of) { x *= scene::factor_of(of, factors); });
    for (const State state : states) {
      const ContactState here{state, -0.125}, there{state, -0.125 * factors.length};
      const Rows a = contact::rows(contact, here), b = contact::rows(other, there);
      CHECK(b.normal.value(moved) ==
            scene::factor_of(contact::unit_of(a.normal), factors) * a.normal.value(m));
      CHECK(b.tangent.value(moved) ==
            scene::factor_of(contact::unit_of(a.tangent), factors) * a.tangent.value(m));
      const auto before = contact::guards(contact, here), after = contact::guards(other, there);
      for (std::size_t i = 0; i < before.size(); ++i) {
        CHECK(after[i].kind == before[i].kind);
        const double factor = scene::factor_of(contact::unit_of(before[i]), factors);
        CHECK(after[i].value(moved) == doctest::Approx(factor * before[i].value(m)).epsilon(1e-14));
      }
      const double energy = scene::factor_of(unit::energy, factors);
      CHECK(contact::stored_energy(other, state, moved) ==
            energy * contact::stored_energy(contact, state, m));
      CHECK(contact::violations(other, state, moved).product ==
            energy * contact::violations(contact, state, m).product);
    }
  }
}

TEST_CASE("what a law can do") {
  const Contact compliant = contact_of(Law::compliant), rigid = contact_of(Law::rigid),
                slider = contact_of(Law::slider), split = contact_of(compliance_split_law());
  CHECK(compliant.normal_spring() == 1000.0);
  CHECK_FALSE(rigid.normal_spring());
  CHECK_FALSE(slider.normal_spring());
  CHECK(split.normal_spring() == 1000.0);
  CHECK(rigid.takes_impulses());
  CHECK_FALSE(split.takes_impulses());
  CHECK(slider.normal_force_given());
  CHECK_FALSE(slider.optional_gap(0.5));
  CHECK(rigid.optional_gap(0.5) == 0.5);
  CHECK(split.law->name() == rigid.law->name());
  CHECK(compliant.resting_force(std::vector<double>{}) == 0.0);  // its gap is open
}

TEST_CASE("a law made of data has states and a memory of its own, and no other conditions than its guards") {
  for (const DataLaw* data : data_laws()) {
    const std::vector<double> constants(data->constants.size(), 20.0);
    const auto law = std::make_shared<const UserContactLaw>(data->make(1000.0, constants));
    CHECK(validation_error(*law).empty());
    const Contact c = contact_of(law), twin = contact_of(law);
    CHECK(c.law == twin.law);
    CHECK(c.law->user_law_states().size() == law->states.size());
    CHECK_FALSE(c.obeys_coulomb());
    CHECK_FALSE(c.anchor_spring());
    CHECK(c.law->candidates(c, {c.law->user_law_states()[0], -0.5}, {}).size() == law->states.size());
    for (const DataLawConstant& constant : data->constants)
      CHECK(scene::find_key("contacts[]", constant.key));
  }
}
