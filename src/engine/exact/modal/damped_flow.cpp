#include "engine/exact/modal/damped_flow.hpp"

#include "engine/exact/modal/passage_turns.hpp"

namespace signorini {

std::string DampedFlow::start(const Segment& segment, const Vector& q, const Vector& rate, ModalPoint& now) {
  if (std::string why = motion_.start(segment, q, rate, now); !why.empty()) return why;
  proof_.start();
  works_.start();
  return {};
}

void DampedFlow::find_turns(const ModalPoint& from, double begin, double length, bool observed,
                            TurningPoints& turning, LastTurns& turns) {
  const auto advance = [&](const ModalPoint& at, double step, ModalPoint& to) {
    motion_.advance(at, step, to);
  };
  find_passage_turns(proof_, advance, from, begin, length, observed, turning, turns);
}

void DampedFlow::forces(const ModalPoint& at, Point& point) const {
  const ForceLayout& layout = motion_.model().layout;
  double* const forces = point.forces.data();
  for (std::size_t c = 0; c < motion_.model().contacts.size(); ++c) {
    forces[layout.normal(c)] = motion_.value(motion_.contact(c).N, at);
    forces[layout.tangent(c)] = motion_.value(motion_.contact(c).T, at);
  }
}

}  // namespace signorini
