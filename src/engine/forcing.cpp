#include "engine/forcing.hpp"

#include <algorithm>

namespace signorini {
namespace {

const Piece* piece(const History& history, double t, Side side) {
  return side == Side::after ? &history.piece(t) : &history.piece_before(t);
}

bool varies(const Piece& piece) {
  return piece.amplitude != 0.0 ||
         std::any_of(piece.coefficients.begin(), piece.coefficients.end(),
                     [&](const double& c) { return &c != piece.coefficients.data() && c != 0.0; });
}

bool vanishes(const Piece& piece) {
  return !varies(piece) && (piece.coefficients.empty() || piece.coefficients[0] == 0.0);
}

}  // namespace

Forcing::Forcing(const Model& model, double t, Side side)
    : model_(&model), constant_(Vector::Zero(model.size())) {
  for (std::size_t i = 0; i < model.loads.size(); ++i) {
    const Piece* p = piece(model.loads[i].history, t, side);
    if (varies(*p))
      varying_.emplace_back(i, p);
    else if (!vanishes(*p))
      model.loads[i].direction.add_to(constant_, p->coefficients[0]);
  }
  for (const Contact& contact : model.contacts) {
    pressing_.push_back(piece(contact.normal_force, t, side));
    surface_.push_back(piece(contact.surface_motion, t, side));
    lifted_.push_back(contact.law == Law::slider && vanishes(*pressing_.back()));
  }
}

void Forcing::add_load(double t, int order, double* P) const {
  if (order == 0)
    for (Eigen::Index i = 0; i < constant_.size(); ++i) P[i] += constant_[i];
  for (const auto& [load, p] : varying_) model_->loads[load].direction.add_to(P, p->value(t, order));
}

}  // namespace signorini
