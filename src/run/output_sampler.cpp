#include "run/output_sampler.hpp"

#include <algorithm>
#include <limits>

namespace signorini::run {

double OutputSampler::next() const {
  constexpr double never = std::numeric_limits<double>::infinity();
  return std::min(next_row_ < grid_->size() ? (*grid_)[next_row_] : never,
                  next_frame_ < frames_.size() ? frames_[next_frame_] : never);
}

void OutputSampler::emit(double t, const motion::WorkIntegrals& ahead, const motion::Forcing& forcing,
                         const contact::ContactStates& states, const motion::Point& point) {
  const Sample now = sample(t, ahead, forcing, states, point);
  if (next_row_ < grid_->size() && (*grid_)[next_row_] == t) {
    recorder_.sample(now);
    ++next_row_;
  }
  if (next_frame_ < frames_.size() && frames_[next_frame_] == t) {
    recorder_.frame(now);
    ++next_frame_;
  }
}

Sample OutputSampler::sample(double t, const motion::WorkIntegrals& ahead, const motion::Forcing& forcing,
                             const contact::ContactStates& states, const motion::Point& point) {
  Sample result;
  result.t = t;
  result.u = &point.u;
  result.v = &point.v;
  if (!model_.is_physical()) {
    physical_u_ = model_.physical(point.u, t, 0);
    physical_v_ = model_.physical(point.v, t, 1);
    result.u = &physical_u_;
    result.v = &physical_v_;
  }
  for (std::size_t k = 0; k < model_.contacts.size(); ++k)
    result.contacts.push_back(auditor_.sample(k, forcing, t, states[k], point));
  result.energy = auditor_.energy(t, ahead, states, point);
  return result;
}

}  // namespace signorini::run
