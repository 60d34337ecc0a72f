// rubbing_row.hpp: masses in a plane in a row, each pressed on a compliant contact with friction along its own direction.
//
//   M tridiagonal (consistent), K tridiagonal, C a part of both; contact i turned by 7 + 31 i degrees
#pragma once

#include <cmath>
#include <string>

#include "contact/contact_states.hpp"
#include "signorini/model.hpp"

namespace signorini {

inline Model rubbing_row(int masses) {
  const int n = 2 * masses;
  Model model;
  model.mass.resize(n, n);
  model.damping.resize(n, n);
  model.stiffness.resize(n, n);
  for (int i = 0; i < n; ++i) {
    model.mass.insert(i, i) = 1.0 + 0.03 * i;
    model.stiffness.insert(i, i) = 40.0 + i % 5;
    model.damping.insert(i, i) = 0.2;
    for (const int j : {i - 2, i + 2}) {
      if (j < 0 || j >= n) continue;
      model.mass.insert(i, j) = 0.2;
      model.stiffness.insert(i, j) = -9.0;
      model.damping.insert(i, j) = -0.04;
    }
    model.dofs.push_back({"d" + std::to_string(i), "v" + std::to_string(i), false, false});
  }
  for (int i = 0; i < masses; ++i) {
    const double angle = (7.0 + 31.0 * i) * M_PI / 180.0, c = std::cos(angle), s = std::sin(angle);
    Contact contact;
    contact.name = "c" + std::to_string(i);
    contact.law = Law::compliant;
    contact.normal.terms = {{2 * i, -s}, {2 * i + 1, c}};
    contact.tangent.terms = {{2 * i, c}, {2 * i + 1, s}};
    contact.gap = -0.01;
    contact.normal_stiffness = 300.0 + 10.0 * i;
    contact.normal_damping = i % 3 == 0 ? 0.7 : 0.0;
    contact.tangential_stiffness = 200.0;
    contact.friction.static_ = contact.friction.kinetic = 0.3;
    model.contacts.push_back(contact);
    model.layout = contact::layout_of(model.contacts);
  }
  model.u0 = Vector::LinSpaced(n, -0.03, 0.02);
  model.v0 = Vector::LinSpaced(n, 0.4, -0.3);
  return model;
}

/// Number i in a count to the base of four states.
inline contact::ContactStates rubbing_mode(const Model& model, int i) {
  constexpr State states[] = {State::stick, State::slip_plus, State::open, State::slip_minus};
  contact::ContactStates contact_states(model.contacts.size());
  for (ContactState& s : contact_states) {
    s = {states[i % 4], 0.001 * (i % 7)};
    i = i / 4 + 3;
  }
  return contact_states;
}

}  // namespace signorini
