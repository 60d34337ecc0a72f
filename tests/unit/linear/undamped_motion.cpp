// Motions without mass that dashpots do not resist.
#include "linear/undamped_motion.hpp"
#include "contact/contact_states.hpp"

#include <doctest/doctest.h>

#include <cmath>

using namespace signorini;

namespace {

/// Three degrees of freedom without mass, and contacts with dashpots along these normals.
Model massless_model(const std::vector<Combination>& normals) {
  Model model;
  for (int i = 0; i < 3; ++i) {
    Dof dof;
    dof.massless = true;
    model.dofs.push_back(dof);
  }
  for (const Combination& normal : normals) {
    Contact contact;
    contact.normal = normal;
    contact.normal_damping = 1.0;
    model.contacts.push_back(contact);
    model.layout = contact::layout_of(model.contacts);
  }
  return model;
}

Combination form_of(std::initializer_list<std::pair<int, double>> terms) {
  Combination form;
  form.terms.assign(terms.begin(), terms.end());
  return form;
}

Rows dashpot_row(bool closed) {
  Rows rows;
  rows.normal.N = rows.tangent.T = 1.0;
  if (closed) rows.normal.vn = -1.0;
  return rows;
}

}  // namespace

TEST_SUITE_BEGIN("unit/linear/undamped_motion");

TEST_CASE(
    "as many degrees of freedom are damped as dashpots are independent, and no motion that is left meets "
    "one") {
  const std::vector<Combination> normals{form_of({{0, 0.6}, {1, 0.8}}), form_of({{1, -0.8}, {2, 0.6}}),
                                         form_of({{0, 0.6}, {2, 0.6}})};  // the third is the sum of both
  const Model model = massless_model(normals);
  const std::vector<linear::DofKind> own(3, linear::DofKind::algebraic);
  for (unsigned set = 0; set < 8; ++set) {
    CAPTURE(set);
    std::vector<Rows> rows;
    for (unsigned k = 0; k < 3; ++k) rows.push_back(dashpot_row((set >> k & 1U) != 0));
    const linear::MotionKinds found = linear::kinds_in_states(own, model, rows);
    const int closed = __builtin_popcount(set), independent = std::min(closed, 2);
    CHECK(std::count(found.kinds.begin(), found.kinds.end(), linear::DofKind::damped) == independent);
    CHECK(found.undamped.size() == (closed == 0 ? 0U : 1U));
    for (const linear::UndampedMotion& motion : found.undamped) {
      Vector z = Vector::Zero(3);
      z[motion.dof] = 1.0;
      CHECK(found.kinds[static_cast<std::size_t>(motion.dof)] == linear::DofKind::algebraic);
      for (const auto& [dof, value] : motion.others) {
        CHECK(found.kinds[static_cast<std::size_t>(dof)] == linear::DofKind::damped);
        z[dof] = value;
      }
      for (unsigned k = 0; k < 3; ++k)
        if ((set >> k & 1U) != 0) CHECK(std::abs(normals[k].dot(z)) < 1e-15);
    }
  }
  CHECK(linear::joint_undamped_dofs(own, model).size() == 1);
}

TEST_CASE("dashpots along single degrees of freedom leave all as they are") {
  const Model model = massless_model({form_of({{0, -1.0}}), form_of({{2, 1.0}})});
  const std::vector<linear::DofKind> own{linear::DofKind::algebraic, linear::DofKind::algebraic,
                                         linear::DofKind::damped};
  const linear::MotionKinds found =
      linear::kinds_in_states(own, model, {dashpot_row(true), dashpot_row(true)});
  CHECK(found.kinds == std::vector<linear::DofKind>{linear::DofKind::damped, linear::DofKind::algebraic,
                                                    linear::DofKind::damped});
  CHECK(found.undamped.empty());
  CHECK(linear::joint_undamped_dofs(own, model).empty());
}

TEST_SUITE_END();
