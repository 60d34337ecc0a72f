// result_made_up.hpp: a small run that nobody computed, for the tests of what is written to disk.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

#include "contact/contact_states.hpp"
#include "signorini/result.hpp"
#include "signorini/scene.hpp"

namespace signorini::made_up {

/// A folder of its own, gone with its owner.
class Folder {
 public:
  Folder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "signorini-test-XXXXXX").string();
    path_ = mkdtemp(pattern.data());
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const { return path_ / name; }

 private:
  std::filesystem::path path_;
};

inline std::string slurp(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

inline void spill(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

inline Scene scene() {
  Scene s;
  s.file = "made-up.toml";
  s.title = "Made up";
  s.units = {"kN", "t", "m", "s"};
  s.run.t_end = 1.0;
  s.resolved = "schema = 1\n";
  return s;
}

/// Two degrees of freedom; a compliant contact "foot" and a slider "pad, left".
inline Model model() {
  Model m;
  m.units = {"kN", "t", "m", "s"};
  m.dofs = {{"A.ux", "A.vx", false, false}, {"A.uy", "A.vy", false, false}};
  m.columns = {{"A.ux", 0, false}, {"A.uy", 1, false}, {"A.vx", 0, true}, {"A.vy", 1, true}};
  Contact foot;
  foot.name = "foot";
  foot.normal_stiffness = 1e6;
  foot.tangential_stiffness = 1e6;
  foot.friction.static_ = foot.friction.kinetic = 0.3;
  Contact pad;
  pad.name = "pad, left";
  pad.law = Law::slider;
  pad.friction.static_ = 0.4;
  pad.friction.kinetic = 0.3;
  m.contacts = {foot, pad};
  m.layout = contact::layout_of(m.contacts);
  m.static_start = true;
  m.statics.reactions = {58.86, 0.0};
  m.statics.free_motions = {"horizontal motion held at contact 'foot'"};
  m.alpha = 17.8;
  m.omega1 = 89.0;
  m.omega_max = 6e4;
  return m;
}

inline Report report(Outcome::Kind kind = Outcome::Kind::done) {
  Report r;
  r.outcome.kind = kind;
  r.outcome.t = 1.0;
  r.method.engine = Engine::ida;
  r.method.accuracy = 1e-8;
  r.events_by_type = {{"slip", 2}, {"time", 1}};
  r.peaks.resize(2);
  r.audit.friction_work = {0.5, 0.25};
  r.audit.friction = {1e-9, 0.5, 1};
  r.audit.force_scale = 100.0;
  r.counters.steps_by_order = {{1, 10}, {5, 90}};
  return r;
}

/// Feeds one sample at t.
inline void feed(Recorder& recorder, double t, double u = 0.25) {
  Vector displacement(2), velocity(2);
  displacement << u, -0.5;
  velocity << 1.0, 0.0;
  Sample s;
  s.t = t;
  s.u = &displacement;
  s.v = &velocity;
  s.contacts = {{State::stick, 1e-3, u, 0.0, 0.0, -58.86, 3.0},
                {State::slip_minus, 0.0, u, 1.0, u, -1.0, -0.3}};
  s.energy.kinetic = 0.5;
  recorder.sample(s);
}

inline Event slip(double t) {
  Event e;
  e.t = t;
  e.contact = 0;
  e.type = EventType::slip;
  e.from = State::stick;
  e.to = State::slip_minus;
  e.gap = 0.0;
  e.N = e.N_after = -58.86;
  e.T = e.T_after = -17.658;
  return e;
}

}  // namespace signorini::made_up
