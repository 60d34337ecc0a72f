// forwarding_recorder.hpp: a recorder in front of another one. It passes all on, and knows how far the run has come; who derives from
// it looks at what it wants to, or asks for a stop.
//
//   run -> this -> next,   reached = t of the last event, row or step that `next` has taken
#pragma once

#include <vector>

#include "signorini/result.hpp"

namespace signorini {

class ForwardingRecorder : public Recorder {
 public:
  /// `next` must outlive it; without one nothing is passed on, and nothing is wanted.
  explicit ForwardingRecorder(Recorder* next = nullptr) : next_(next) {}

  void event(const Event& event) override {
    if (next_ != nullptr) next_->event(event);
    reached_ = event.t;
  }
  void sample(const Sample& sample) override {
    if (next_ != nullptr) next_->sample(sample);
    reached_ = sample.t;  // a file that fails within a step leaves rows beyond the step before
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

}  // namespace signorini
