// `verify` on scenes as they are, and with an error of 1e-4 planted in IDA's model alone (README.md).
//
//   signorini_verified SCENE...
//
// A planted error is to be found where the exact flow moves by more than ten of newmark's bars. Exit code 1
// if a scene as it is differs, or such an error is not found.
#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "signorini/error.hpp"
#include "study/verify/verify.hpp"

namespace {

using namespace signorini;

constexpr double planted = 1.0001, bars = 10.0;

struct Planted {
  const char* what;
  void (*plant)(Model&);
};

constexpr Planted errors[] = {
    {"friction",
     [](Model& m) {
       for (Contact& c : m.contacts) {
         c.friction.static_ *= planted;
         c.friction.kinetic *= planted;
       }
     }},
    {"kt",
     [](Model& m) {
       for (Contact& c : m.contacts)
         if (c.tangential_stiffness) *c.tangential_stiffness *= planted;
     }},
    {"mass", [](Model& m) { m.mass *= planted; }},
};

verify::VerifyRequest request_of(const Scene& scene, double seconds) {
  verify::VerifyRequest request;
  request.run = scene.run;
  request.dt = scene.run.dt;
  request.max_seconds = seconds;
  return request;
}

/// By how many bars the exact flow moves with the error: the greatest over the events that both have.
double moved(const Model& model, const Model& off, const Scene& scene, const verify::Verification& v) {
  RunSpec run = scene.run;
  run.engine = Engine::exact;
  const Result right = simulate(model, run), wrong = simulate(off, run);
  double greatest = 0.0;
  for (const verify::VerifiedEvent& event : v.events) {
    const auto near = [&](const Result& result) {
      double best = INFINITY;
      for (const Event& e : result.events)
        if (e.contact == event.contact && e.type == event.type && e.to == event.to &&
            std::abs(e.t - event.time.ida) < std::abs(best - event.time.ida))
          best = e.t;
      return best;
    };
    const double off_by = std::abs(near(right) - near(wrong));
    if (std::isfinite(off_by) && event.time.bar > 0.0) greatest = std::max(greatest, off_by / event.time.bar);
  }
  return greatest;
}

std::string orders_of(const verify::Verification& v) {
  std::string text;
  for (const verify::VerifiedKind& kind : v.kinds)
    if (kind.order) text += fmt::format("{}{} {:.2f}", text.empty() ? "" : ", ", kind.name, *kind.order);
  return text;
}

/// True: nothing is wrong with the verdicts.
bool examine(const std::string& path, double seconds) {
  const Scene scene = read_scene(path, {{"run.engine", "ida"}});
  const Model model = build_model(scene);
  const verify::Verification v = verify::verify(model, model, request_of(scene, seconds));
  fmt::print("| {} | {} | {:.4g} | {:.2g} | {} | ", std::filesystem::path(path).stem().string(),
             verify::to_string(v.verdict), v.until, v.dt.empty() ? 0.0 : v.dt.front(), orders_of(v));
  bool good = v.verdict != verify::Agreement::differ;
  for (const Planted& error : errors) {
    Model off = model;
    error.plant(off);
    verify::VerifyRequest request = request_of(scene, seconds);
    if (!v.dt.empty()) request.dt = v.dt.front();
    const verify::Verification found = verify::verify(model, off, request);
    const double by = moved(model, off, scene, v);
    fmt::print("{} ({:.2g}) | ", found.verdict == verify::Agreement::differ ? "found" : "-", by);
    if (by > bars && v.verdict == verify::Agreement::agree)
      good = good && found.verdict == verify::Agreement::differ;
  }
  fmt::print("{} |\n", v.verdict == verify::Agreement::agree ? "" : v.sentence);
  std::fflush(stdout);
  return good;
}

}  // namespace

int main(int argc, char** argv) {
  std::vector<std::string> scenes;
  double seconds = 5.0;
  CLI::App app{"verify on scenes, and on planted errors", "signorini_verified"};
  app.add_option("SCENE", scenes, "scene files")->required();
  app.add_option("--seconds", seconds, "expected, of the finest run of newmark");
  CLI11_PARSE(app, argc, argv);
  fmt::print("| scene | verdict | until | dt | orders | friction: (bars) | kt | mass | why |\n");
  fmt::print("|---|---|---|---|---|---|---|---|---|\n");
  bool good = true;
  for (const std::string& scene : scenes) {
    try {
      good = examine(scene, seconds) && good;
    } catch (const Error& error) {
      fmt::print("| {} | refused | | | | | | | {} |\n", std::filesystem::path(scene).stem().string(),
                 error.what());
    }
  }
  return good ? 0 : 1;
}
