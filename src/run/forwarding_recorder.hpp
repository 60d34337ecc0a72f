// forwarding_recorder.hpp: a recorder that forwards all data to another recorder, and stores the time reached. Derived
// classes read the data they need, or request a stop.
//
//   run -> this -> next,   reached = t of the last event, row or step that `next` has received
#pragma once

#include <vector>

#include "signorini/result.hpp"

namespace signorini::run {

class ForwardingRecorder : public Recorder {
 public:
  /// `next` must outlive the object. If it is null, nothing is forwarded and no data are requested.
  explicit ForwardingRecorder(Recorder* next = nullptr) : next_(next) {}

  void event(const Event& event) override {
    if (next_ != nullptr) next_->event(event);
    reached_ = event.t;
  }
  void sample(const Sample& sample) override {
    if (next_ != nullptr) next_->sample(sample);
    reached_ = sample.t;  // if writing a file fails within a step, the last row is later than the last step
  }
  void frame(const Sample& sample) override {
    if (next_ != nullptr) next_->frame(sample);
  }
  [[nodiscard]] bool wants_motion() const override { return next_ != nullptr && next_->wants_motion(); }
  void motion(int contact, const std::vector<MotionRow>& rows) override {
    if (next_ != nullptr) next_->motion(contact, rows);
  }
  void curves(const Curves& curves) override {
    if (next_ != nullptr) next_->curves(curves);
  }
  void response(double t, const std::vector<double>& values) override {
    if (next_ != nullptr) next_->response(t, values);
  }
  [[nodiscard]] bool wants_instants() const override { return next_ != nullptr && next_->wants_instants(); }
  void instant(const InstantRow& row) override {
    if (next_ != nullptr) next_->instant(row);
  }
  [[nodiscard]] bool steers() const override { return next_ != nullptr && next_->steers(); }
  bool steer(const Sample& now, Steering& run) override { return next_ == nullptr || next_->steer(now, run); }
  bool progress(double t) override {
    reached_ = t;
    return next_ == nullptr || next_->progress(t);
  }

  [[nodiscard]] double reached() const { return reached_; }

 private:
  Recorder* next_;
  double reached_ = 0.0;
};

}  // namespace signorini::run
