// Looks at events as they come, and stops the run at the third slip.
#include <cstdio>
#include <signorini/simulate.hpp>

struct Watch : signorini::Result {
  int slips = 0;
  void event(const signorini::Event& event) override {
    if (event.type == signorini::EventType::slip) std::printf("slip %d at %.6f\n", ++slips, event.t);
  }
  bool progress(double) override {
    return slips < 3;
  }  // asked after every event, row and step; false ends the run
};

int main() {
  Watch watch;
  const auto report = simulate(signorini::read_scene("models/belt.toml"), watch);
  return report.outcome.kind == signorini::Outcome::Kind::interrupted && watch.slips == 3 ? 0 : 1;
}
