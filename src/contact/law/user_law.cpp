#include "contact/law/user_law.hpp"

#include <fmt/core.h>

#include <algorithm>

#include "base/unit.hpp"
#include "contact/law.hpp"
#include "contact/work.hpp"

namespace signorini {
namespace {

Form with_memory(const UserLawForm& own, double memory) {
  Form form = own.form;
  form.constant += own.memory * memory;
  return form;
}

/// True if no guard contains products of forms.
bool has_linear_guards(const UserContactLaw& law) {
  for (const UserLawState& state : law.states)
    for (const UserLawGuard& guard : state.guards)
      if (!guard.products.empty()) return false;
  return true;
}

class UserLaw final : public ContactLaw {
 public:
  explicit UserLaw(std::shared_ptr<const UserContactLaw> data)
      : ContactLaw({.normal_force_given = data->normal_force_given,
                    .normal_spring = !data->normal_force_given,
                    .signorini_coulomb = false,
                    .linear_guards = has_linear_guards(*data),
                    .tangents = acts_along_tangent(*data) ? 1U : 0U}),
        data_(std::move(data)) {}

  [[nodiscard]] std::string name() const override {
    return is_named() ? data_->name
                      : contact::to_string(data_->normal_force_given ? Law::slider : Law::compliant);
  }
  [[nodiscard]] bool is_named() const override { return !data_->name.empty(); }

  [[nodiscard]] Rows rows(const Contact& /*contact*/, const ContactState& state) const override {
    const UserLawState& in = at(state.state);
    return {with_memory(in.normal, state.anchor), with_memory(in.tangent, state.anchor)};
  }

  [[nodiscard]] Guards guards(const Contact& /*contact*/, const ContactState& state) const override {
    constexpr std::array kinds = {Guard::user_1, Guard::user_2, Guard::user_3};
    static_assert(kinds.size() == max_guards);
    Guards result;
    const UserLawState& in = at(state.state);
    for (std::size_t i = 0; i < in.guards.size(); ++i)
      result[i] = {kinds[i], with_memory(in.guards[i].positive, state.anchor), products_of(in.guards[i])};
    return result;
  }

  [[nodiscard]] ContactState next_state(const Contact& /*contact*/, const ContactState& now, Guard failed,
                                        const MotionJet& jet) const override {
    if (failed == Guard::none) return now;
    const auto i = static_cast<std::size_t>(failed) - static_cast<std::size_t>(Guard::user_1);
    const UserLawGuard& guard = at(now.state).guards[i];
    return in_state(guard.next, guard.memory ? guard.memory->value(jet.motion[0]) : now.anchor);
  }

  [[nodiscard]] std::vector<State> user_law_states() const override {
    std::vector<State> states;
    for (std::size_t i = 0; i < data_->states.size(); ++i) states.push_back(in_state(i, 0.0).state);
    return states;
  }
  [[nodiscard]] bool has_memory() const override {
    for (const UserLawState& state : data_->states)
      for (const UserLawGuard& guard : state.guards)
        if (guard.memory) return true;
    return false;
  }
  [[nodiscard]] std::shared_ptr<const ContactLaw> with_constants(const VisitConstant& visit) const override {
    return std::make_shared<const UserLaw>(visit_law_constants(*data_, visit));
  }
  [[nodiscard]] std::string validation_error() const override { return signorini::validation_error(*data_); }
  [[nodiscard]] bool equals(const ContactLaw& other) const override {
    const auto* user = dynamic_cast<const UserLaw*>(&other);
    return user != nullptr && user->data_ == data_;
  }

 private:
  [[nodiscard]] const UserLawState& at(State state) const {
    return data_->states[is_user_law_state(state) ? user_law_state_number(state) : 0];
  }
  [[nodiscard]] ContactState in_state(std::size_t i, double memory) const {
    return {user_law_state(i, data_->states[i].kind), memory};
  }

  /// Products of a guard as a pointer that keeps the data of the law alive.
  [[nodiscard]] std::shared_ptr<const std::vector<FormProduct>> products_of(const UserLawGuard& guard) const {
    if (guard.products.empty()) return nullptr;
    return {data_, &guard.products};
  }

  std::shared_ptr<const UserContactLaw> data_;
};

constexpr Unit force_rate{1, 0, -1};

/// Visits the coefficients of a form whose value has the unit `of`. Unit of a coefficient: `of` / unit of the quantity that
/// it multiplies.
void visit_form(Form& form, const Unit& of, const ContactLaw::VisitConstant& visit) {
  const auto per = [&](double& coefficient, const Unit& unit) {
    visit(coefficient, Unit{of.force - unit.force, of.length - unit.length, of.time - unit.time});
  };
  per(form.N, unit::force);
  per(form.T, unit::force);
  per(form.gap, unit::length);
  per(form.ut, unit::length);
  per(form.vn, unit::velocity);
  per(form.vt, unit::velocity);
  per(form.applied_normal_force, unit::force);
  per(form.applied_normal_force_rate, force_rate);
  visit(form.constant, of);
}

void visit_form(UserLawForm& own, const Unit& of, const ContactLaw::VisitConstant& visit) {
  visit_form(own.form, of, visit);
  visit(own.memory, Unit{of.force, of.length - 1, of.time});
}

Unit unit_of(const FormProduct& product) {
  const Unit a = contact::unit_of(product.a), b = contact::unit_of(product.b);
  return {a.force + b.force, a.length + b.length, a.time + b.time};
}

/// True if the form depends on the motion or on forces; the unit of a constant form cannot be determined.
bool has_unit(const Form& f) {
  return f.N != 0.0 || f.T != 0.0 || f.gap != 0.0 || f.ut != 0.0 || f.vn != 0.0 || f.vt != 0.0 ||
         f.applied_normal_force != 0.0 || f.applied_normal_force_rate != 0.0;
}

std::string validation_error(const UserLawState& state, std::size_t states, bool normal_force_given) {
  const auto refuse = [&](const std::string& what) {
    return fmt::format("state '{}': {}", state.name, what);
  };
  if (state.guards.size() > ContactLaw::max_guards)
    return refuse(
        fmt::format("found {} guards, expected at most {}", state.guards.size(), ContactLaw::max_guards));
  if (is_user_law_state(state.kind) || state.kind == State::inside)
    return refuse("expected the kind open, closed, stick or slip");
  std::vector<Form> forms = {state.normal.form, state.tangent.form};
  if (forms[0].N == 0.0 || forms[1].T == 0.0)
    return refuse("expected N in its normal row and T in its tangent row");
  if (normal_force_given &&
      (forms[0] != Form{.N = 1.0, .applied_normal_force = 1.0} || state.normal.memory != 0.0))
    return refuse("expected the normal row N + q = 0, because N is given");
  for (const UserLawGuard& guard : state.guards) {
    forms.push_back(guard.positive.form);
    if (guard.memory) forms.push_back(*guard.memory);
    for (const FormProduct& p : guard.products) {
      forms.insert(forms.end(), {p.a, p.b});
      if (!has_unit(p.a) || !has_unit(p.b))
        return refuse("expected that each factor of a product depends on N, T, g, ut or their rates");
      const Unit one = unit_of(guard.products.front()), other = unit_of(p);
      if (one.force != other.force || one.length != other.length || one.time != other.time)
        return refuse("expected the same unit for all products of a guard");
    }
    if (guard.next >= states)
      return refuse(fmt::format("found next state {}, expected 0 to {}", guard.next, states - 1));
  }
  for (const Form& f : forms) {
    if (f.an != 0.0 || f.at != 0.0 || f.limit != 0.0 || f.limit_rate != 0.0)
      return refuse("expected forms that depend only on N, T, g, ut and their rates");
    if (!normal_force_given && (f.applied_normal_force != 0.0 || f.applied_normal_force_rate != 0.0))
      return refuse("found a form that depends on normal_force(t), but N is not given");
    if (normal_force_given && (f.gap != 0.0 || f.vn != 0.0))
      return refuse("found a form that depends on the gap, but N is given, so there is no gap");
  }
  return {};
}

}  // namespace

std::string validation_error(const UserContactLaw& law) {
  if (law.states.empty() || law.states.size() > max_user_law_states)
    return fmt::format("found {} states, expected 1 to {}", law.states.size(), max_user_law_states);
  for (const UserLawState& state : law.states)
    if (std::string refusal = validation_error(state, law.states.size(), law.normal_force_given);
        !refusal.empty())
      return refusal;
  return {};
}

bool acts_along_tangent(const UserContactLaw& law) {
  const auto looks = [](const Form& f) { return f.ut != 0.0 || f.vt != 0.0; };
  const auto depends = [&](const Form& f) { return f.T != 0.0 || looks(f); };
  for (const UserLawState& state : law.states) {
    const Form& tangent = state.tangent.form;
    if (looks(tangent) || tangent.N != 0.0 || tangent.gap != 0.0 || tangent.vn != 0.0 ||
        tangent.constant != 0.0 || state.tangent.memory != 0.0 || depends(state.normal.form))
      return true;
    for (const UserLawGuard& guard : state.guards)
      if (depends(guard.positive.form) || (guard.memory && depends(*guard.memory)) ||
          std::any_of(guard.products.begin(), guard.products.end(),
                      [&](const FormProduct& p) { return depends(p.a) || depends(p.b); }))
        return true;
  }
  return false;
}

std::shared_ptr<const UserContactLaw> visit_law_constants(UserContactLaw law,
                                                          const ContactLaw::VisitConstant& visit) {
  for (UserLawState& state : law.states) {
    visit_form(state.normal, contact::unit_of(state.normal.form), visit);
    visit_form(state.tangent, contact::unit_of(state.tangent.form), visit);
    for (UserLawGuard& guard : state.guards) {
      const Unit of =
          guard.products.empty() ? contact::unit_of(guard.positive.form) : unit_of(guard.products.front());
      visit_form(guard.positive, of, visit);
      if (guard.memory) visit_form(*guard.memory, unit::length, visit);
      for (FormProduct& p : guard.products)
        for (Form* factor : {&p.a, &p.b}) visit_form(*factor, contact::unit_of(*factor), visit);
    }
  }
  return std::make_shared<const UserContactLaw>(std::move(law));
}

ContactLawPtr::ContactLawPtr(std::shared_ptr<const UserContactLaw> law)
    : ContactLawPtr(law ? std::make_shared<const UserLaw>(std::move(law))
                        : std::shared_ptr<const UserLaw>()) {}

}  // namespace signorini
