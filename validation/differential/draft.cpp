#include "differential/draft.hpp"

#include <algorithm>
#include <array>

#include "differential/scene_text.hpp"

namespace signorini::differential {

DraftTable& DraftTable::set(const char* key, const std::string& value) {
  for (auto& [name, old] : keys_)
    if (name == key) {
      old = value;
      return *this;
    }
  keys_.emplace_back(key, value);
  return *this;
}

bool DraftTable::has(const std::string& key) const {
  return std::any_of(keys_.begin(), keys_.end(), [&](const auto& k) { return k.first == key; });
}

std::string DraftTable::text() const {
  std::string text = header_.empty() ? "" : "\n" + header_ + "\n";
  for (const auto& [key, value] : keys_) text += fmt::format("{} = {}\n", key, value);
  return text;
}

Draft::Draft(std::uint64_t seed, Kit of) : draw(seed), kit(of) {
  top.set("schema", "1").set("units", "{ force = \"N\", mass = \"kg\", length = \"m\", time = \"s\" }");
  constexpr std::array builders = {&Draft::chain, &Draft::frame, &Draft::block, &Draft::mesh,
                                   &Draft::matrices};
  (this->*builders[static_cast<std::size_t>(kit)])();
}

DraftTable& Draft::table(const std::string& header) { return tables.emplace_back(header); }

DraftTable* Draft::find(const std::string& header) {
  const auto it =
      std::find_if(tables.begin(), tables.end(), [&](const DraftTable& t) { return t.header() == header; });
  return it == tables.end() ? nullptr : &*it;
}

void Draft::join(const std::string& node, double stiffness) {
  for (const char* direction : {"[1.0, 0.1]", "[-0.1, 1.0]"})
    table("[[springs]]")
        .name("node", node)
        .name("against", main)
        .set("direction", direction)
        .set("stiffness", rounded(stiffness * draw.real(0.7, 1.3), 1));
}

void Draft::chain() {
  t_end = 1.0;
  main = "b1";
  x = 1.0;
  nodes.set("b0", "[0.0, 0.0]").set("b1", "[1.0, 0.0]");
  for (const char* node : {"b0", "b1"}) {
    table("[[masses]]").name("node", node).set("mass", draw.rounded(0.8, 2.0, 2));
    table("[[springs]]")
        .name("node", node)
        .set("direction", "[0.1, 1.0]")
        .set("stiffness", draw.rounded(40.0, 150.0, 1));
  }
  table("[[springs]]")
      .name("node", "b0")
      .set("direction", "[1.0, 0.0]")
      .set("stiffness", draw.rounded(100.0, 400.0, 1));
  table("[[springs]]")
      .name("node", "b1")
      .name("against", "b0")
      .set("direction", "[1.0, 0.0]")
      .set("stiffness", draw.rounded(80.0, 300.0, 1));
  places_ = {{"b1", "[0.0, 1.0]", "[1.0, 0.0]"},
             {"b0", "[0.0, 1.0]", "[1.0, 0.0]"},
             {"b1", "[-1.0, 0.0]", "[0.0, 1.0]"},
             {"b0", "[1.0, 0.0]", "[0.0, -1.0]"}};
}

void Draft::frame() {
  t_end = 0.4;
  main = "C";
  x = 1.5;
  y = 1.2;
  nodes.set("A", "[0.0, 0.0]").set("B", "[0.0, 1.2]").set("C", "[1.5, 1.2]").set("D", "[1.5, 0.0]");
  table("[sections.line]")
      .set("EA", draw.rounded(3e4, 9e4, 0))
      .set("EI", draw.rounded(100.0, 300.0, 1))
      .set("mass_per_length", 1.0);
  table("[[members]]").set("nodes", "[\"A\", \"B\", \"C\", \"D\"]").name("section", "line");
  table("[[supports]]").name("node", "A").set("fix", "[\"ux\", \"uy\", \"rz\"]");
  damping.set("alpha", draw.rounded(0.5, 3.0, 2));
  places_ = {{"D", "[0.0, 1.0]", "[1.0, 0.0]"},
             {"B", "[1.0, 0.0]", "[0.0, -1.0]"},
             {"C", "[-1.0, 0.0]", "[0.0, 1.0]"},
             {"D", "[1.0, 0.0]", "[0.0, -1.0]"}};
}

void Draft::block() {
  t_end = 0.6;
  main = "T";
  x = 0.2;
  y = 1.0;
  table("[[rigid]]")
      .name("name", "block")
      .set("centre", "[0.0, 0.5]")
      .set("nodes", "[\"L\", \"R\", \"T\"]")
      .set("mass", draw.rounded(1.5, 3.0, 2))
      .set("inertia", draw.rounded(0.15, 0.4, 3));
  nodes.set("L", "[-0.3, 0.0]").set("R", "[0.3, 0.0]").set("T", "[0.2, 1.0]");
  for (const char* direction : {"[1.0, 0.0]", "[0.2, 1.0]"})
    table("[[springs]]")
        .name("node", "T")
        .set("direction", direction)
        .set("stiffness", draw.rounded(60.0, 300.0, 1));
  table("[[springs]]")
      .name("node", "L")
      .set("direction", "[0.1, 1.0]")
      .set("stiffness", draw.rounded(60.0, 300.0, 1));
  places_ = {{"R", "[0.0, 1.0]", "[1.0, 0.0]"},
             {"L", "[0.0, 1.0]", "[1.0, 0.0]"},
             {"T", "[-1.0, 0.0]", "[0.0, 1.0]"},
             {"T", "[1.0, 0.0]", "[0.0, -1.0]"}};
}

void Draft::body_at(double left, double bottom) {
  table("[[bodies]]")
      .name("name", "pad")
      .set("rectangle", fmt::format("{{ from = {}, size = [0.4, 0.2] }}", list({left, bottom})))
      .set("elements", "[2, 1]")
      .set("E", draw.rounded(5e4, 2e5, 0))
      .set("nu", 0.3)
      .set("density", 50.0)
      .set("thickness", 0.1)
      .name("plane", "stress")
      .set("points", fmt::format("{{ p0 = {}, p1 = {}, p2 = {}, p3 = {} }}", list({left, bottom}),
                                 list({left + 0.4, bottom}), list({left + 0.4, bottom + 0.2}),
                                 list({left, bottom + 0.2})));
}

void Draft::mesh() {
  t_end = 0.25;
  main = "p2";
  x = 0.4;
  y = 0.2;
  body_at(0.0, 0.0);
  for (const char* node : {"p2", "p3"})
    for (const char* direction : {"[1.0, 0.0]", "[0.1, 1.0]"})
      table("[[springs]]")
          .name("node", node)
          .set("direction", direction)
          .set("stiffness", draw.rounded(40.0, 200.0, 1));
  places_ = {{"p1", "[0.0, 1.0]", "[1.0, 0.0]"},
             {"p0", "[0.0, 1.0]", "[1.0, 0.0]"},
             {"p2", "[-1.0, 0.0]", "[0.0, 1.0]"},
             {"p3", "[1.0, 0.0]", "[0.0, -1.0]"}};
}

void Draft::matrices() {
  t_end = 1.0;
  const double a = draw.rounded(80.0, 300.0, 1), b = draw.rounded(50.0, 200.0, 1),
               c = draw.rounded(20.0, 80.0, 1);
  const double m = draw.one_of({0.0, 0.1});
  table("[matrices]")
      .set("mass", rows({{1.2, 0.0, m}, {0.0, 1.2, 0.0}, {m, 0.0, 0.8}}))
      .set("stiffness", rows({{rounded(a + b, 1), 0.0, -b}, {0.0, c, 0.0}, {-b, 0.0, b}}));
  places_ = {{"", "{ d1 = 1.0 }", "{ d0 = 1.0 }"},
             {"", "{ d2 = -1.0 }", "{ d1 = 1.0 }"},
             {"", "{ d1 = 1.0, d2 = 0.2 }", "{ d2 = 1.0 }"},
             {"", "{ d0 = 1.0 }", "{ d1 = 0.5, d2 = 0.5 }"}};
}

void Draft::body() {
  if (find("[[bodies]]") != nullptr) return;
  body_at(5.0, 0.0);
  join("p2", 200.0);
  join("p3", 200.0);
  put_first({"p1", "[0.0, 1.0]", "[1.0, 0.0]"});
}

DraftTable& Draft::beam() {
  for (DraftTable& t : tables)
    if (t.header() == "[[members]]" && t.text().find("\"far\"") != std::string::npos) return t;
  nodes.set("far", list({rounded(x + 0.9, 3), rounded(y + 0.4, 3)}));
  table("[[supports]]").name("node", "far").set("fix", "[\"ux\", \"uy\", \"rz\"]");
  table("[sections.light]")
      .set("EA", draw.rounded(400.0, 900.0, 1))
      .set("EI", draw.rounded(10.0, 30.0, 1))
      .set("mass_per_length", 0.4);
  if (!has_nodes()) main = "far2";
  return table("[[members]]").set("nodes", fmt::format("[\"far\", \"{}\"]", main)).name("section", "light");
}

DraftContact* Draft::contact(std::initializer_list<const char*> laws,
                             std::initializer_list<const char*> free) {
  const auto fits = [&](const DraftContact& c) {
    const bool known =
        c.law.empty() || std::any_of(laws.begin(), laws.end(), [&](const char* law) { return c.law == law; });
    return known && std::none_of(free.begin(), free.end(), [&](const char* key) { return c.keys.has(key); });
  };
  auto it = std::find_if(contacts_.begin(), contacts_.end(), fits);
  if (it == contacts_.end()) {
    if (places_.empty()) return nullptr;
    contacts_.push_back({fmt::format("c{}", contacts_.size() + 1), "", places_.front()});
    places_.pop_front();
    it = contacts_.end() - 1;
  }
  if (it->law.empty()) it->law = draw.one_of(laws);
  return &*it;
}

void Draft::finish(DraftContact& c) {
  DraftTable& keys = c.keys;
  keys.name("name", c.name).name("law", c.law);
  if (!c.place.node.empty()) keys.name("node", c.place.node);
  if (c.law == "slider") {
    keys.set("tangent", c.place.tangent);
    if (!keys.has("normal_force")) keys.set("normal_force", draw.rounded(4.0, 15.0, 1));
    if (!keys.has("friction")) keys.set("friction", draw.rounded(0.1, 0.5, 2));
    // What sticks rigidly needs mass.
    if (c.place.massless && !needs_ida) keys.set("tangential_stiffness", draw.rounded(800.0, 3e3, 0));
    return;
  }
  keys.set("normal", c.place.normal);
  if (!keys.has("friction") && c.law != "yielding" && draw.chance(0.6))
    keys.set("friction", draw.rounded(0.1, 0.5, 2));
  const bool rubs = keys.has("friction");
  if (rubs && c.place.node.empty()) keys.set("tangent", c.place.tangent);
  if (c.law == "rigid") {
    if (!keys.has("capture_velocity") && !c.place.massless) keys.set("capture_velocity", 1e-2);
    return;
  }
  if (!keys.has("normal_stiffness") && !keys.has("seam"))
    keys.set("normal_stiffness", draw.rounded(1e3, 6e3, 0));
  if (c.law == "yielding" && !keys.has("yield_force")) keys.set("yield_force", draw.rounded(8.0, 30.0, 1));
  if (rubs && !keys.has("tangential_stiffness") && !keys.has("seam"))
    keys.set("tangential_stiffness", draw.rounded(800.0, 3e3, 0));
}

std::string Draft::text() {
  if (contacts_.empty()) contact({"compliant", "rigid", "slider"}, {});
  for (DraftContact& c : contacts_) finish(c);
  if (has_nodes() && !top.has("gravity") && draw.chance(0.7)) top.set("gravity", "[0.0, -9.81]");
  run.set("t_end", t_end).set("output_dt", rounded(t_end / 100.0, 6));
  if (!run.has("engine")) run.name("engine", needs_ida ? "ida" : "exact");
  if (!run.has("rtol")) run.set("rtol", 1e-9);
  run.set("atol", "{ displacement = 1e-11, velocity = 1e-10, force = 1e-8 }");
  if (!run.has("initial")) {
    const double v = draw.rounded(-0.6, 0.6, 2);
    if (!has_nodes())
      run.set("initial", fmt::format("{{ v = [{}, -0.2, 0.1] }}", v));
    else if (kit == Kit::block)
      run.set("initial",
              fmt::format("{{ block = {{ vx = {}, vy = -0.1, wz = {} }} }}", v, draw.rounded(-0.3, 0.3, 2)));
    else
      run.set("initial",
              fmt::format("{{ {} = {{ vx = {}, vy = {} }} }}", main, v, draw.rounded(-0.4, 0.2, 2)));
  }
  if (!load.has("direction") && !load.has("moment")) {
    if (has_nodes())
      load.name("node", main).set("direction", "[1.0, -0.4]");
    else
      load.set("direction", "{ d0 = 1.0, d1 = -0.4 }");
  }
  load.name("name", "push");
  if (!load.has("amplitude")) load.set("amplitude", draw.rounded(10.0, 40.0, 1));
  if (history.empty()) history = fmt::format("{{ type = \"harmonic\", omega = {} }}", omega(2, 9));
  load.set("history", history);
  std::string all = top.text() + run.text();
  if (!stages.empty()) {
    std::string names;
    for (const std::string& stage : stages) names += (names.empty() ? "\"" : ", \"") + stage + "\"";
    all += "\n[[run.stages]]\nname = \"all\"\nloads = [" + names + "]\n";
  }
  for (const DraftTable* t : {&damping, &reduction, &nodes})
    if (!t->empty()) all += t->text();
  for (const DraftTable& t : tables) all += t.text();
  for (const DraftContact& c : contacts_) all += c.keys.text();
  return all + load.text();
}

}  // namespace signorini::differential
