#include "model/same_states.hpp"

#include <algorithm>
#include <tuple>

namespace signorini {
namespace {

bool same(const SparseMatrix& a, const SparseMatrix& b) {
  return a.rows() == b.rows() && a.nonZeros() == b.nonZeros() && (a - b).norm() == 0.0;
}

bool same(const Contact& a, const Contact& b) {
  const auto friction = [](const Friction& f) {
    return std::tuple{f.static_, f.kinetic, f.stribeck_velocity, f.velocity, f.force};
  };
  return a.law == b.law && a.normal.terms == b.normal.terms && a.tangent.terms == b.tangent.terms &&
         a.normal_stiffness == b.normal_stiffness && a.normal_damping == b.normal_damping &&
         a.tangential_stiffness == b.tangential_stiffness && friction(a.friction) == friction(b.friction);
}

}  // namespace

bool same_contact_states(const Model& a, const Model& b) {
  return same(a.mass, b.mass) && same(a.damping, b.damping) && same(a.stiffness, b.stiffness) &&
         std::equal(a.contacts.begin(), a.contacts.end(), b.contacts.begin(), b.contacts.end(),
                    [](const Contact& x, const Contact& y) { return same(x, y); });
}

bool same_load_directions(const Model& a, const Model& b) {
  return std::equal(a.loads.begin(), a.loads.end(), b.loads.begin(), b.loads.end(),
                    [](const Load& x, const Load& y) { return x.direction.terms == y.direction.terms; });
}

}  // namespace signorini
