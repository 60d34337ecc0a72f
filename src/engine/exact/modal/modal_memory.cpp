#include "engine/exact/modal/modal_memory.hpp"

#include "model/same_states.hpp"

namespace signorini {
namespace {

constexpr double much_longer = 64.0;  // chosen: a search's transient is some 40 periods long

}  // namespace

std::shared_ptr<ModalMemory::Kept> ModalMemory::of(const Model& model, double t_end) {
  const bool serves = kept_ && t_end <= kept_->t_end && kept_->t_end <= much_longer * t_end &&
                      same_contact_states(model, kept_->model) && same_load_directions(model, kept_->model);
  if (!serves) kept_ = std::make_shared<Kept>(model, t_end);
  return kept_;
}

}  // namespace signorini
