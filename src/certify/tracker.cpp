#include "certify/tracker.hpp"

namespace signorini {

void Tracker::event(const Event& event) {
  events.push_back(timed(event));
  if (next_ != nullptr) next_->event(event);
}

void Tracker::sample(const Sample& sample) {
  rows.t.push_back(sample.t);
  for (const Column& column : model_.columns) {
    const Vector& vector = column.velocity ? *sample.v : *sample.u;
    rows.values.push_back(column.dof < 0 ? 0.0 : vector[column.dof]);
  }
  if (forces_)
    for (const ContactSample& contact : sample.contacts)
      rows.values.insert(rows.values.end(), {contact.N, contact.T});
  if (next_ != nullptr) next_->sample(sample);
}

void Tracker::frame(const Sample& sample) {
  if (next_ != nullptr) next_->frame(sample);
}

void Tracker::motion(int contact, const std::vector<MotionRow>& motion_rows) {
  if (next_ != nullptr) next_->motion(contact, motion_rows);
}

bool Tracker::progress(double t) {
  if (next_ != nullptr) return next_->progress(t);
  too_long = ++steps_ > most_steps;
  return !too_long && (leash == nullptr || leash->allows(t));
}

}  // namespace signorini
