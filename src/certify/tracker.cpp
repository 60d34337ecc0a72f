#include "certify/tracker.hpp"

#include <algorithm>

namespace signorini {

void Tracker::event(const Event& event) {
  events.push_back(timed(event));
  events.back().t -= moved * events.back().t;
  ForwardingRecorder::event(event);
}

void Tracker::sample(const Sample& sample) {
  rows.t.push_back(sample.t);
  for (const Column& column : model_.columns) {
    rows.values.push_back(column.of(*sample.u, *sample.v));
  }
  if (all_) {
    for (const ContactSample& contact : sample.contacts)
      rows.values.insert(rows.values.end(), {contact.N, contact.T});
    // Outputs of a time come after its sample, unless they were the last ones received.
    if (last_time_ == sample.t)
      rows.values.insert(rows.values.end(), last_outputs_.begin(), last_outputs_.end());
    else
      rows.values.resize(rows.t.size() * rows.width, std::numeric_limits<double>::quiet_NaN());
  }
  ForwardingRecorder::sample(sample);
}

void Tracker::response(double t, const std::vector<double>& values) {
  if (all_ && values.size() == model_.outputs.size()) {
    last_time_ = t;
    last_outputs_ = values;
    if (!rows.t.empty() && rows.t.back() == t)
      std::copy(values.begin(), values.end(), rows.values.end() - static_cast<std::ptrdiff_t>(values.size()));
  }
  ForwardingRecorder::response(t, values);
}

bool Tracker::progress(double t) {
  if (!companion_) return ForwardingRecorder::progress(t);
  too_long = ++steps_ > most_steps;
  return !too_long && (leash == nullptr || leash->allows(t));
}

}  // namespace signorini
