// What generality costs: Signorini beside a hand-coded IDA loop, one-mass scenes, minimum of repeats in one
// run.
//
//   build/release/signorini_overhead [repeats]
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <functional>

#include "hand_coded.hpp"
#include "signorini/simulate.hpp"

namespace {

using namespace signorini;

class Count : public Recorder {
 public:
  void event(const Event&) override { ++events; }
  void sample(const Sample& s) override { u_end = (*s.u)[0]; }
  long events = 0;
  double u_end = 0.0;
};

double seconds(const std::function<void()>& f) {
  const auto start = std::chrono::steady_clock::now();
  f();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

void compare(const char* name, const overhead::Slider& s, double rtol, int repeats) {
  const std::string text = fmt::format(
      "schema = 1\nunits = {{ force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }}\n"
      "[run]\nt_end = {}\nrtol = {}\noutput_times = [{}]\ninitial = {{ u = [{}], v = [{}] }}\n"
      "[matrices]\nmass = [[{}]]\ndamping = [[{}]]\nstiffness = [[{}]]\n"
      "[[contacts]]\nname = \"c\"\nlaw = \"slider\"\ntangent = {{ d0 = 1.0 }}\nnormal_force = 1.0\nfriction "
      "= {}\n"
      "[[loads]]\ndirection = {{ d0 = 1.0 }}\namplitude = {}\nhistory = {{ type = \"harmonic\", omega = {} "
      "}}\n",
      s.t_end, rtol, s.t_end, s.u0, s.v0, s.m, s.c, s.k, s.friction, s.amplitude, s.omega);
  const Scene scene = parse_scene(text, name);
  const Model model = build_model(scene);
  double ours = 1e9, theirs = 1e9;
  Report report;
  overhead::Outcome hand{};
  Count count;
  for (int i = 0; i < repeats; ++i) {
    ours = std::min(ours, seconds([&] {
                      count = Count();
                      report = simulate(model, scene.run, count);
                    }));
    theirs = std::min(theirs, seconds([&] {
                        hand = overhead::run_by_hand(s, rtol, rtol * model.scales.displacement,
                                                     rtol * model.scales.velocity, rtol * model.scales.force);
                      }));
  }
  fmt::print("{:<12} {:>8.0e}  {:>6} {:>6}  {:>7} {:>7}  {:>9.3f} {:>9.3f}  {:>6.2f}  {:.1e}\n", name, rtol,
             count.events, hand.events, report.counters.steps, hand.steps, 1e3 * ours, 1e3 * theirs,
             ours / theirs, std::abs(count.u_end - hand.u_end));
}

}  // namespace

int main(int argc, char** argv) {
  const int repeats = argc > 1 ? std::atoi(argv[1]) : 20;
  fmt::print(
      "scene            rtol  events   hand    steps    hand    time/ms      hand   ratio  difference\n");
  for (double rtol : {1e-6, 1e-8, 1e-10}) {
    compare("decay", {1.0, 0.0, 4.0, 0.0, 1.0, 0.4, 1.03, 0.0, 12.0}, rtol, repeats);
    compare("den-hartog", {1.0, 0.0, 1.0, 1.0, 0.5, 0.8, 0.0, 0.0, 100.0}, rtol, repeats);
  }
}
