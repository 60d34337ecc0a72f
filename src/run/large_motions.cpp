#include "run/large_motions.hpp"

#include <fmt/core.h>

#include <cmath>

#include "model/said.hpp"

namespace signorini {
namespace {

constexpr double large = 0.25;  // rad; 1 - cos is 3 %: chosen value

}  // namespace

LargeMotions::LargeMotions(const Model& model) : model_(model) {
  if (model.reduction) return;
  for (std::size_t i = 0; i < model.dofs.size(); ++i)
    if (model.dofs[i].rotation) rotations_.push_back(i);
  for (std::size_t k = 0; k < model.contacts.size(); ++k)
    if (model.contacts[k].curved_surface()) pendulums_.push_back(k);
}

void LargeMotions::note(double t, double angle, const std::string& what) {
  if (!(angle > large)) return;
  if (!first_) first_ = Large{what, t, angle};
  if (angle <= greatest_) return;
  greatest_ = angle;
  of_greatest_ = what;
}

void LargeMotions::see(double t, const Forcing& forcing, const Point& now) {
  for (const std::size_t i : rotations_)
    note(t, std::abs(now.u[static_cast<Eigen::Index>(i)]), model_.dofs[i].displacement);
  for (const std::size_t k : pendulums_) {
    const Contact& contact = model_.contacts[k];
    note(t, std::abs(slide_of(contact, k, forcing, t, now.u, now.v).ut) / contact.curved_surface()->radius,
         "ut / R of contact '" + contact.name + "'");
  }
}

std::optional<std::string> LargeMotions::warning() const {
  if (!first_) return std::nullopt;
  return fmt::format(
      "{} is {:.3g} rad at t = {:.6g}, and {} reaches {:.3g} rad: rotations are computed as small ones, so "
      "that from there on "
      "results are far from those of the real structure",
      first_->what, first_->angle, said_time(model_, first_->t), of_greatest_, greatest_);
}

}  // namespace signorini
