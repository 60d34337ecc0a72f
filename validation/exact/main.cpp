// What the exact flow costs beside ida, and how that grows: ratios of minima of repeats, alternating, in one
// run. Prints Markdown.
//
//   build/release/signorini_exact_cost [repeats]
#include <fmt/core.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <string>

#include "signorini/simulate.hpp"

namespace {

using namespace signorini;

class Count : public Recorder {
 public:
  void event(const Event& e) override { events += e.type != EventType::time ? 1 : 0; }
  void sample(const Sample&) override {}
  long events = 0;
};

struct Timing {
  double seconds = 1e300;
  long events = 0, steps = 0;
};

/// A scene under one engine, without output but at its end.
class Subject {
 public:
  Subject(const std::string& file, std::vector<Override> changes, const char* engine, const char* rtol)
      : scene_(read(file, std::move(changes), engine, rtol)), model_(build_model(scene_)) {}
  void run() {
    Count count;
    const auto start = std::chrono::steady_clock::now();
    const Report report = simulate(model_, scene_.run, count);
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - start;
    timing.seconds = std::min(timing.seconds, passed.count());
    timing.events = count.events;
    timing.steps = report.counters.steps;
  }
  [[nodiscard]] int unknowns() const { return model_.size(); }
  [[nodiscard]] double omega_max() const { return model_.omega_max; }
  Timing timing;

 private:
  static Scene read(const std::string& file, std::vector<Override> changes, const char* engine,
                    const char* rtol) {
    changes.push_back({"run.engine", engine});
    changes.push_back({"run.rtol", rtol});
    Scene scene = read_scene(file, changes);
    scene.run.output_dt.reset();
    scene.run.output_times = std::vector<double>{scene.run.t_end};
    scene.run.frames.clear();
    return scene;
  }
  Scene scene_;
  Model model_;
};

void pair(const std::string& name, const std::string& file, const std::vector<Override>& changes,
          const char* rtol, int repeats) {
  Subject exact(file, changes, "exact", rtol), ida(file, changes, "ida", rtol);
  for (int i = 0; i < repeats; ++i) {
    exact.run();
    ida.run();
  }
  fmt::print("| {} | {} | {} | {} | {:.0f} | {:.0f} | {:.1f} |\n", name, exact.unknowns(), rtol,
             exact.timing.events, 1e6 * exact.timing.seconds, 1e6 * ida.timing.seconds,
             ida.timing.seconds / exact.timing.seconds);
  std::fflush(stdout);
}

void fineness(const char* elements, const char* t_end, double duration) {
  const std::string file = SIGNORINI_MODELS "/pipeline.toml";
  const std::vector<Override> changes{{"members.1.elements", elements}, {"run.t_end", t_end}};
  Subject exact(file, changes, "exact", "1e-6"), ida(file, changes, "ida", "1e-6");
  exact.run();
  ida.run();
  fmt::print("| {} | {:.3g} | {} | {} | {:.2g} | {:.2g} | {:.2g} | {:.2g} |\n", exact.unknowns(),
             exact.omega_max(), t_end, exact.timing.events,
             static_cast<double>(exact.timing.steps) / duration, exact.timing.seconds / duration,
             1e6 * exact.timing.seconds / static_cast<double>(exact.timing.steps),
             ida.timing.seconds / duration);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char** argv) {
  const int repeats = argc > 1 ? std::max(1, std::atoi(argv[1])) : 20;
  const std::string cases = SIGNORINI_CASES "/";
  fmt::print(
      "| scene | unknowns | rtol of ida | events | exact, us | ida, us | ratio "
      "|\n|---|---|---|---|---|---|---|\n");
  for (const char* name : {"01a_coulomb_decay_rigid", "01b_coulomb_decay_compliant", "02b_belt_fs_gt_fk",
                           "03b_den_hartog_2stop", "10a_bk_chain_20"})
    pair(name, cases + name + ".toml", {}, "1e-8", repeats);
  for (const char* rtol : {"1e-6", "1e-8"}) pair("pipeline", SIGNORINI_MODELS "/pipeline.toml", {}, rtol, 3);
  fmt::print(
      "\nPipeline, ever finer; per second of motion.\n\n"
      "| degrees of freedom | omega_max, rad/s | to t, s | events | steps | exact, s | exact, us a step | "
      "ida "
      "at 1e-6, s |\n|---|---|---|---|---|---|---|---|\n");
  fineness("8", "0.2", 0.2);
  fineness("16", "0.2", 0.2);
  fineness("33", "0.05", 0.05);
  fineness("66", "0.01", 0.01);
  fineness("133", "0.001", 0.001);
}
