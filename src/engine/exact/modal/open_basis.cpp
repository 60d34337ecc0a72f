#include "engine/exact/modal/open_basis.hpp"

#include <algorithm>

#include "base/rounding.hpp"

namespace signorini {
namespace {

bool stands_still(const History& history) {
  return std::all_of(history.pieces().begin(), history.pieces().end(), [](const Piece& piece) {
    return !piece.function && piece.amplitude == 0.0 &&
           std::all_of(piece.coefficients.begin(), piece.coefficients.end(),
                       [&](const double& c) { return &c == piece.coefficients.data() || c == 0.0; });
  });
}

}  // namespace

bool is_symmetric(const SparseMatrix& a) {
  const SparseMatrix difference = a - SparseMatrix(a.transpose());
  return difference.norm() <= rounding::of_many * a.norm();
}

bool stands_still(const Model& model) {
  return std::all_of(model.loads.begin(), model.loads.end(),
                     [](const Load& load) { return stands_still(load.history); }) &&
         std::all_of(model.contacts.begin(), model.contacts.end(), [](const Contact& contact) {
           return stands_still(contact.normal_force) && stands_still(contact.surface_motion);
         });
}

OpenBasis::OpenBasis(const Model& model) {
  OpenModes modes = open_modes(model.mass, model.stiffness);
  failure_ = std::move(modes.failure);
  if (!failure_.empty()) return;
  square_ = std::move(modes.square);
  shapes_ = modes.shapes;
  projection_ = (model.mass * modes.shapes).transpose();
  const auto amplitudes_of = [&](const Combination& form) {
    Vector x = Vector::Zero(model.size());
    form.add_to(x, 1.0);
    return Vector(modes.shapes.transpose() * x);
  };
  for (const Contact& contact : model.contacts) {
    normal_.push_back(amplitudes_of(contact.normal));
    tangent_.push_back(amplitudes_of(contact.tangent));
  }
  for (const Load& load : model.loads) load_.push_back(amplitudes_of(load.direction));
}

}  // namespace signorini
