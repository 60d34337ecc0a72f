#include "run/run_limits.hpp"

#include <fmt/core.h>
#include <cmath>
#include <utility>

#include "model/internal_units.hpp"

namespace signorini::run {
namespace {

// Number of events between two checks of progress. A bouncing ball has 2000 events before rest if e = 0.99; with e = 0.999 it
// has 20000 events, but in a longer time.
constexpr int events_per_check = 10000;
constexpr double least_progress = 1e-5;  // least duration of events_per_check, as a fraction of the run
constexpr double resolutions_of_instant = 10.0;  // duration of one instant, in resolutions of the clock

}  // namespace

std::optional<std::string> StallDetector::count(double t, double resolution,
                                                const std::vector<std::size_t>& contacts) {
  contacts_since_check_.insert(contacts.begin(), contacts.end());
  if (auto reason = slow_progress(t)) return reason;
  if (events_in_cluster_ == 0 || t - cluster_ > resolutions_of_instant * resolution) {
    cluster_ = t;
    events_in_cluster_ = 0;
    in_cluster_.clear();
  }
  in_cluster_.insert(contacts.begin(), contacts.end());
  if (++events_in_cluster_ <= max_at_once_) return std::nullopt;
  contacts_ = in_cluster_;
  return fmt::format("{} events at one instant; time does not advance", max_at_once_);
}

std::optional<std::string> StallDetector::slow_progress(double t) {
  if (++events_since_check_ < events_per_check) return std::nullopt;
  const double advanced = t - last_check_t_;
  events_since_check_ = 0;
  last_check_t_ = t;
  contacts_ = std::exchange(contacts_since_check_, {});
  if (advanced >= least_progress * t_end_) return std::nullopt;
  return fmt::format("{} events within {:.3g} of time; the motion does not advance", events_per_check,
                     advanced * unit_);
}

namespace {

constexpr double large = 0.25;  // rad; cos differs from 1 by 3 %. Chosen value

}  // namespace

LargeMotionDetector::LargeMotionDetector(const Model& model) : model_(model) {
  if (model.reduction) return;
  for (std::size_t i = 0; i < model.dofs.size(); ++i)
    if (model.dofs[i].rotation) rotations_.push_back(i);
  for (std::size_t k = 0; k < model.contacts.size(); ++k)
    if (model.contacts[k].curved_surface()) pendulums_.push_back(k);
}

void LargeMotionDetector::record(double t, double angle, const std::string& what) {
  if (!(angle > large)) return;
  if (!first_) first_ = Large{what, t, angle};
  if (angle <= greatest_) return;
  greatest_ = angle;
  greatest_description_ = what;
}

void LargeMotionDetector::examine(double t, const motion::Forcing& forcing, const motion::Point& now) {
  for (const std::size_t i : rotations_)
    record(t, std::abs(now.u[static_cast<Eigen::Index>(i)]), model_.dofs[i].displacement);
  for (const std::size_t k : pendulums_) {
    const Contact& contact = model_.contacts[k];
    record(t,
           std::abs(motion::body_slide(contact, k, forcing, t, now.u, now.v).ut) /
               contact.curved_surface()->radius,
           "ut / R of contact '" + contact.name + "'");
  }
}

std::optional<std::string> LargeMotionDetector::warning() const {
  if (!first_) return std::nullopt;
  return fmt::format(
      "{} is {:.3g} rad at t = {:.6g}, and {} reaches {:.3g} rad: the model assumes small rotations, so "
      "results from this time on are wrong for the real structure",
      first_->description, first_->angle, model::time_in_scene_units(model_, first_->t),
      greatest_description_, greatest_);
}

}  // namespace signorini::run
