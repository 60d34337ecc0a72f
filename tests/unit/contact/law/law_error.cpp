#include "contact/law/law_error.hpp"

#include <doctest/doctest.h>

#include <functional>

#include "contact/law.hpp"
#include "signorini/modified_law.hpp"

using namespace signorini;

namespace {

/// Two states that are right: without force, and a spring; each test spoils one of the answers.
class OwnLaw final : public ContactLaw {
 public:
  explicit OwnLaw(const LawCapabilities& can = {.normal_spring = true, .signorini_coulomb = false})
      : ContactLaw(can) {}
  std::vector<State> states = {user_law_state(0, State::open), user_law_state(1, State::stick)};
  std::function<void(Rows&)> spoil_rows = [](Rows&) {};
  std::function<void(Guards&)> spoil_guards = [](Guards&) {};

  [[nodiscard]] std::string name() const override { return "own"; }
  [[nodiscard]] std::vector<State> user_law_states() const override { return states; }
  [[nodiscard]] Rows rows(const Contact& /*contact*/, const ContactState& now) const override {
    Rows rows{{.N = 1.0}, {.T = 1.0}};
    if (now.state == user_law_state(1, State::stick)) rows.normal.gap = -20.0;
    spoil_rows(rows);
    return rows;
  }
  [[nodiscard]] Guards guards(const Contact& /*contact*/, const ContactState& now) const override {
    Guards guards;
    guards[0] = {Guard::user_1, now.is_open() ? Form{.gap = 1.0} : Form{.N = -1.0}};
    spoil_guards(guards);
    return guards;
  }
  [[nodiscard]] ContactState next_state(const Contact& /*contact*/, const ContactState& now, Guard /*failed*/,
                                        const MotionJet& /*jet*/) const override {
    return {states[now.is_open() ? 1 : 0]};
  }
  [[nodiscard]] std::shared_ptr<const ContactLaw> with_constants(
      const VisitConstant& /*visit*/) const override {
    return nullptr;
  }
};

/// The error of a contact with this law after it has been spoiled.
template <class Spoil>
std::string error_of(const Spoil& spoil, Law named = Law::compliant) {
  auto law = std::make_shared<OwnLaw>();
  spoil(*law);
  Contact contact;
  contact.normal_stiffness = 20.0;
  contact.law = std::shared_ptr<const ContactLaw>(law);
  return law_error(contact, named);
}

std::string error_of(const LawCapabilities& can, Law named = Law::compliant) {
  Contact contact;
  contact.normal_stiffness = 20.0;
  contact.law = std::make_shared<const OwnLaw>(can);
  return law_error(contact, named);
}

/// A built-in law with spoiled guards in stick.
class Guarded final : public ModifiedLaw {
 public:
  Guarded(Law base, bool linear, std::function<void(Guards&)> spoil)
      : ModifiedLaw(base, linear), spoil_(std::move(spoil)) {}
  [[nodiscard]] Guards guards(const Contact& contact, const ContactState& now) const override {
    Guards guards = base().guards(contact, now);
    if (now.state == State::stick) spoil_(guards);
    return guards;
  }

 private:
  std::function<void(Guards&)> spoil_;
};

std::string guard_error_of(bool linear, std::function<void(ContactLaw::Guards&)> spoil) {
  Contact contact;
  contact.friction = {0.5, 0.25};
  contact.tangential_stiffness = 30.0;
  contact.law = std::make_shared<const Guarded>(Law::slider, linear, std::move(spoil));
  return law_error(contact, Law::slider);
}

std::shared_ptr<const std::vector<FormProduct>> product(const Form& a, const Form& b) {
  return std::make_shared<const std::vector<FormProduct>>(std::vector<FormProduct>{{a, b}});
}

bool has(const std::string& text, const char* part) { return text.find(part) != std::string::npos; }

}  // namespace

TEST_SUITE_BEGIN("unit/contact/law/law_error");

TEST_CASE("a law with its own states is refused for what engines do not expect") {
  CHECK(error_of([](OwnLaw&) {}).empty());
  CHECK(
      has(error_of([](OwnLaw&) {}, Law::slider), "spring, together with law = \"slider\", whose N is given"));
  CHECK(has(error_of([](OwnLaw&) {}, Law::rigid), "whose N is that of a constraint"));
  CHECK(has(error_of([](OwnLaw& l) { l.states.clear(); }), "found no states of its own"));
  CHECK(has(error_of([](OwnLaw& l) { l.states[1] = State::stick; }),
            "state 1: expected user_law_state(1, kind)"));
  CHECK(has(error_of([](OwnLaw& l) { std::swap(l.states[0], l.states[1]); }), "state 0: expected"));
  CHECK(
      has(error_of([](OwnLaw& l) { l.states[0] = user_law_state(0, State::inside); }), "state 0: expected"));
  CHECK(has(error_of([](OwnLaw& l) { l.spoil_rows = [](Rows& r) { r.tangent = {.at = 1.0}; }; }),
            "state 0 (open): expected N in its normal row and T in its tangent row"));
  CHECK(has(error_of([](OwnLaw& l) { l.spoil_rows = [](Rows& r) { r.tangent.at = 1.0; }; }),
            "expected rows that depend only on"));
  CHECK(has(error_of([](OwnLaw& l) { l.spoil_rows = [](Rows& r) { r.normal.applied_normal_force = 1.0; }; }),
            "found a row that depends on normal_force(t)"));
  const auto guards = [](std::function<void(ContactLaw::Guards&)> spoil) {
    return error_of([&](OwnLaw& l) { l.spoil_guards = spoil; });
  };
  CHECK(has(guards([](auto& g) { g[0].kind = Guard::closing; }),
            "expected guards of the kinds user_1 to user_3"));
  CHECK(has(guards([](auto& g) { g[1] = g[0]; }), "found two guards of the kind"));
  CHECK(has(guards([](auto& g) { g[0].form.an = 1.0; }), "depends on accelerations"));
  CHECK(has(guards([](auto& g) { g[0].form.applied_normal_force_rate = 1.0; }), "normal_force(t)"));
  CHECK(has(guards([](auto& g) { g[0].form.limit = 1.0; }), "friction of the contact"));
  CHECK(has(guards([](auto& g) { g[0].products = product({.N = 1.0}, {.N = 1.0}); }), "but linear_guards"));
}

TEST_CASE("capabilities that contradict the law are refused") {
  CHECK(has(error_of(LawCapabilities{.normal_spring = true}), "but signorini_coulomb in the capabilities"));
  CHECK(has(error_of(LawCapabilities{.takes_impulses = true, .signorini_coulomb = false}, Law::rigid),
            "impacts know the built-in states only"));
  CHECK(has(error_of(LawCapabilities{.normal_force_given = true, .signorini_coulomb = false}, Law::slider),
            "expected the normal row N + q = 0"));
  CHECK(has(error_of(LawCapabilities{.normal_spring = true, .signorini_coulomb = false, .tangents = 2}),
            "found 2 tangents"));
  CHECK(error_of(LawCapabilities{.normal_spring = true, .signorini_coulomb = false, .tangents = 0}).empty());
  CHECK(has(error_of(LawCapabilities{.normal_spring = true, .signorini_coulomb = false, .guards = 4}),
            "found 4 guards"));
  CHECK(has(error_of(LawCapabilities{.normal_spring = true, .signorini_coulomb = false, .guards = 0}),
            "found guard 1, expected at most 0"));
}

TEST_CASE("a built-in law with other guards is refused for what engines do not expect") {
  using Guards = ContactLaw::Guards;
  CHECK(guard_error_of(true, [](Guards&) {}).empty());
  const Form margin{.T = -1.0, .applied_normal_force = 0.5}, other{.T = 1.0, .applied_normal_force = 0.5};
  const auto disc = [&](Guards& g) { g[1] = {Guard::friction_limit, {}, product(margin, other)}; };
  CHECK(guard_error_of(false, disc).empty());
  CHECK(has(guard_error_of(true, disc), "state stick: found a guard with products"));
  CHECK(has(guard_error_of(false,
                           [&](Guards& g) {
                             g[1] = {Guard::friction_limit, {}, product(margin, {.ut = 1.0})};
                           }),
            "expected products of two forces"));
  CHECK(has(guard_error_of(true, [](Guards& g) { g[1].kind = Guard::user_1; }),
            "expected guards of the built-in"));
  CHECK(has(guard_error_of(true, [](Guards& g) { g[1].form.at = 1.0; }), "depends on accelerations"));
}

TEST_SUITE_END();
