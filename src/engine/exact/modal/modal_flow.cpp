#include "engine/exact/modal/modal_flow.hpp"

#include "model/build.hpp"

namespace signorini::modal {
namespace {

// stored_length_factor: stored data are computed for this multiple of the first run's length. much_longer: a run may be shorter than the
// stored length by this factor. Chosen for orbit searches: a transient of about 40 periods, then many short runs without works.
constexpr double stored_length_factor = 8.0, much_longer = 1e4;

}  // namespace

std::shared_ptr<ModalCache::Entry> ModalCache::entry_for(const Model& model, double t_end) {
  const bool serves = kept_ && t_end <= kept_->t_end && kept_->t_end <= much_longer * t_end &&
                      model::same_contact_states(model, kept_->model) &&
                      model::same_load_directions(model, kept_->model);
  if (!serves) kept_ = std::make_shared<Entry>(model, stored_length_factor * t_end);
  return kept_;
}

}  // namespace signorini::modal
