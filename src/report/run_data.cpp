#include "report/run_data.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>
#include <map>
#include <optional>

#include "base/curves.hpp"
#include "model/element/element_kinds.hpp"
#include "report/mesh_motion.hpp"
#include "result/csv.hpp"
#include "result/plot_parts.hpp"
#include "scene/components.hpp"
#include "scene/outlines.hpp"
#include "signorini/result.hpp"

namespace signorini::report {

namespace fs = std::filesystem;

namespace {

// Limit of the number of displacements on a page: 1 MB with their times.
constexpr std::size_t most_values = 60'000;
constexpr std::size_t max_motion = 16'000;  // limit of the number of rows of all contacts on a page
constexpr std::size_t max_events = 5'000;

double rounded(double value, int digits) {
  return std::strtod(fmt::format("{:.{}g}", value, digits).c_str(), nullptr);
}

base::Json number(double value) {
  return std::isfinite(value) ? base::Json(rounded(value, 6)) : base::Json(nullptr);
}

bool is_file(const fs::path& path) {
  std::error_code error;
  return fs::is_regular_file(path, error);
}

/// Indices of the rows that are kept: about `most` rows, evenly selected; both sides of each jump; the last row.
std::vector<std::size_t> kept_rows(const std::vector<double>& t, std::size_t most) {
  const std::size_t step = std::max<std::size_t>(1, (t.size() + most - 1) / std::max<std::size_t>(most, 1));
  std::vector<std::size_t> kept;
  for (std::size_t i = 0; i < t.size(); ++i) {
    const bool jump = (i > 0 && t[i] == t[i - 1]) || (i + 1 < t.size() && t[i] == t[i + 1]);
    if (i % step == 0 || i + 1 == t.size() || jump) kept.push_back(i);
  }
  return kept;
}

/// Displacement curves of a run, with names as in history.csv; several curves may share one list of times.
struct Displacements {
  struct Curve {
    std::size_t times = 0;
    std::vector<double> u;
  };
  std::vector<std::string> names;
  std::vector<std::vector<double>> times;
  std::vector<Curve> curves;
};

/// Displacements of history.csv, with rows dropped evenly.
Displacements evenly(result::CsvReader& reader) {
  Displacements all;
  std::vector<std::size_t> index;
  for (std::size_t k = 1; k < reader.header().size(); ++k) {
    if (!scene::is_displacement(reader.header()[k])) continue;
    all.names.push_back(reader.header()[k]);
    index.push_back(k);
  }
  std::vector<double> t;
  std::vector<std::vector<double>> columns(index.size());
  while (reader.next()) {
    t.push_back(reader.t());
    for (std::size_t i = 0; i < index.size(); ++i) columns[i].push_back(reader.number(index[i]));
  }
  const std::vector<std::size_t> rows = kept_rows(t, most_values / std::max<std::size_t>(1, index.size()));
  all.times.emplace_back();
  for (const std::size_t i : rows) all.times[0].push_back(t[i]);
  for (const std::vector<double>& column : columns) {
    all.curves.push_back({});
    for (const std::size_t i : rows) all.curves.back().u.push_back(column[i]);
  }
  return all;
}

struct ValueOf {
  std::array<double, 1> operator()(const CurvePoint& point) const { return {point.value}; }
};

/// Displacements of curves.csv, each with its own times; empty if one of `names` has no curve.
Displacements each(const fs::path& file, const std::vector<std::string>& names, double t_end) {
  std::map<std::string, std::vector<CurvePoint>> points;
  result::CsvReader reader(file);
  const std::size_t name = reader.column("curve"), t = reader.column("t"), value = reader.column("value");
  while (reader.next())
    if (scene::is_displacement(reader.cell(name)))
      points[reader.cell(name)].push_back({reader.number(t), reader.number(value)});
  Displacements all;
  const std::size_t most = std::max<std::size_t>(50, most_values / names.size());
  for (const std::string& column : names) {
    const auto found = points.find(column);
    if (found == points.end()) return {};
    base::Downsampled<CurvePoint, 1, ValueOf> thinned(t_end, {.max_rows = most, .limits_rows = true});
    for (const CurvePoint& point : found->second) thinned.add(point);
    all.names.push_back(column);
    all.curves.push_back({all.times.size(), {}});
    all.times.emplace_back();
    for (const CurvePoint& point : thinned.rows()) {
      all.times.back().push_back(point.t);
      all.curves.back().u.push_back(point.value);
    }
  }
  return all;
}

Displacements displacements(const fs::path& directory, double t_end) {
  result::CsvReader history(directory / "history.csv");
  std::vector<std::string> names;
  for (const std::string& column : history.header())
    if (scene::is_displacement(column)) names.push_back(column);
  if (!names.empty() && is_file(directory / "curves.csv"))
    if (Displacements curves = each(directory / "curves.csv", names, t_end); !curves.names.empty())
      return curves;
  return evenly(history);
}

base::Json curve_json(const Displacements& all) {
  base::Json times = base::Json::array(), columns = base::Json::array();
  for (const std::vector<double>& t : all.times) {
    base::Json rounded_times = base::Json::array();
    for (const double value : t) rounded_times.push_back(rounded(value, 9));
    times.push_back(std::move(rounded_times));
  }
  for (const Displacements::Curve& curve : all.curves) {
    base::Json u = base::Json::array();
    for (const double value : curve.u) u.push_back(number(value));
    columns.push_back({{"t", curve.times}, {"u", std::move(u)}});
  }
  return {{"times", std::move(times)}, {"columns", std::move(columns)}};
}

/// Positions by name: nodes of the scene, or degrees of freedom in a row.
class Places {
 public:
  Places(const Scene& scene, const std::vector<std::string>& columns) {
    if (scene.matrices) {
      for (const std::string& dof : scene.matrices->dofs) {
        const auto x = static_cast<double>(index_.size());
        add(dof, {{"name", dof}, {"x", x}, {"y", 0.0}, {"u", {-1, column(columns, dof + ".u"), -1}}});
      }
      return;
    }
    for (const Node& node : scene.nodes)
      add(node.name, {{"name", node.name},
                      {"mesh", node.is_mesh_node},
                      {"x", number(node.x)},
                      {"y", number(node.y)},
                      {"u",
                       {column(columns, node.name + ".ux"), column(columns, node.name + ".uy"),
                        column(columns, node.name + ".rz")}}});
  }
  [[nodiscard]] int of(const std::string& name) const {
    const auto found = index_.find(name);
    return found == index_.end() ? -1 : found->second;
  }
  [[nodiscard]] const base::Json& json() const { return json_; }

 private:
  std::map<std::string, int> index_;
  base::Json json_ = base::Json::array();

  void add(const std::string& name, base::Json node) {
    index_.emplace(name, static_cast<int>(index_.size()));
    json_.push_back(std::move(node));
  }
  static int column(const std::vector<std::string>& columns, const std::string& name) {
    const auto found = std::find(columns.begin(), columns.end(), name);
    return found == columns.end() ? -1 : static_cast<int>(found - columns.begin());
  }
};

base::Json pieces_json(const Scene& scene, const Places& places) {
  base::Json pieces = base::Json::array();
  for (const Member& member : scene.members)
    for (const element::MemberLine& drawn : element::lines_of(member))
      pieces.push_back({{"a", places.of(drawn.from)},
                        {"b", places.of(drawn.to)},
                        {"bar", !drawn.bends},
                        {"shape", shape_of(drawn)}});
  for (const RigidBody& body : scene.rigid)
    for (const auto& [from, to] : scene::outline_of(scene, body))
      pieces.push_back(
          {{"a", places.of(from)}, {"b", places.of(to)}, {"bar", true}, {"rigid", true}, {"shape", 0}});
  return pieces;
}

/// Lines of the meshes as pairs of indices of nodes.
base::Json mesh_json(const Scene& scene) {
  base::Json mesh = base::Json::array();
  for (const auto& ends : scene::mesh_lines(scene)) mesh.push_back(ends);
  return mesh;
}

base::Json springs_json(const Scene& scene, const Places& places) {
  base::Json springs = base::Json::array();
  for (const Spring& spring : scene.springs)
    if (spring.stiffness > 0.0 || spring.damping > 0.0)
      springs.push_back({{"a", places.of(spring.node)},
                         {"b", spring.against.empty() ? -1 : places.of(spring.against)},
                         {"dx", number(spring.direction[0])},
                         {"dy", number(spring.direction[1])}});
  return springs;
}

base::Json supports_json(const Scene& scene, const Places& places) {
  base::Json supports = base::Json::array();
  for (const Support& support : scene.supports)
    supports.push_back(
        {{"node", places.of(support.node)}, {"ux", support.ux}, {"uy", support.uy}, {"rz", support.rz}});
  return supports;
}

/// The histories of loads.csv, by column name.
std::map<std::string, base::Json> load_histories(const fs::path& directory) {
  std::map<std::string, base::Json> histories;
  if (!is_file(directory / "loads.csv")) return histories;
  result::CsvReader reader(directory / "loads.csv");
  std::vector<double> t;
  std::vector<std::vector<double>> columns(reader.header().size());
  while (reader.next()) {
    t.push_back(reader.t());
    for (std::size_t k = 1; k < columns.size(); ++k) columns[k].push_back(reader.number(k));
  }
  for (std::size_t k = 1; k < columns.size(); ++k) {
    base::Json times = base::Json::array(), values = base::Json::array();
    for (const std::size_t i : kept_rows(t, 2000)) {
      times.push_back(t[i]);
      values.push_back(number(columns[k][i]));
    }
    histories[reader.header()[k]] = {{"t", std::move(times)}, {"f", std::move(values)}};
  }
  return histories;
}

base::Json loads_json(const Scene& scene, const Places& places, const fs::path& directory) {
  const std::map<std::string, base::Json> histories = load_histories(directory);
  base::Json loads = base::Json::array();
  for (std::size_t k = 0; k < scene.loads.size(); ++k) {
    const LoadSpec& load = scene.loads[k];
    const std::string name = load.name.empty() ? fmt::format("load {}", k + 1) : load.name;
    if (scene.matrices || load.type != LoadType::force || places.of(load.direction.node) < 0) continue;
    base::Json json = {{"name", name},
                       {"node", places.of(load.direction.node)},
                       {"dx", number(load.direction.vector[0])},
                       {"dy", number(load.direction.vector[1])}};
    const auto found = histories.find(name);
    json["t"] = found == histories.end() ? base::Json{0.0} : found->second["t"];
    json["f"] = found == histories.end() ? base::Json{number(load.amplitude)} : found->second["f"];
    loads.push_back(std::move(json));
  }
  return loads;
}

/// Index of the place where a direction acts: its node, or with [matrices] the degree of freedom with the largest factor.
int place_of_direction(const Direction& direction, const Places& places) {
  if (!direction.node.empty()) return places.of(direction.node);
  int place = -1;
  double greatest = 0.0;
  for (const auto& [dof, factor] : direction.dofs) {
    if (std::abs(factor) <= greatest) continue;
    greatest = std::abs(factor);
    place = places.of(dof);
  }
  return place;
}

base::Json contact_json(const ContactSpec& contact, const Scene& scene, const Places& places) {
  // The tangent is (ny, -nx), so for a slider n = (-ty, tx). Degrees of freedom are drawn as moving upwards.
  std::array<double, 2> n{0.0, 1.0};
  const Direction& direction = contact.normal ? *contact.normal : *contact.tangent;
  if (!scene.matrices)
    n = contact.normal ? direction.vector : std::array{-direction.vector[1], direction.vector[0]};
  if (scene.matrices && contact.normal && !direction.dofs.empty() && direction.dofs[0].second < 0.0)
    n[1] = -1.0;
  base::Json touched = base::Json::array();
  for (const auto& [node, part] : direction.against) touched.push_back({places.of(node), number(part)});
  return {{"name", contact.name},      {"node", place_of_direction(direction, places)},
          {"nx", number(n[0])},        {"ny", number(n[1])},
          {"against", touched},        {"slider", !contact.normal.has_value()},
          {"gap", number(contact.gap)}};
}

/// A row of motion.csv or contacts.csv.
struct ContactRow {
  double t = 0.0, N = 0.0, T = 0.0, gap = 0.0;  // gap: NaN for sliders
  std::ptrdiff_t state = 0;
};
struct DrawnValues {
  std::array<double, 4> operator()(const ContactRow& row) const {
    return {row.N, row.T, std::isfinite(row.gap) ? row.gap : 0.0, static_cast<double>(row.state)};
  }
};

std::map<std::string, std::vector<ContactRow>> read_motion(const fs::path& directory) {
  const bool record = is_file(directory / "motion.csv");
  result::CsvReader reader(directory / (record ? "motion.csv" : "contacts.csv"));
  const std::size_t t = reader.column("t"), contact_column = reader.column("contact"),
                    state = reader.column("state"), gap = reader.column("gap"), N = reader.column("N"),
                    T = reader.column("T");
  const std::vector<std::string>& names = result::state_names();
  std::map<std::string, std::vector<ContactRow>> all;
  while (reader.next())
    all[reader.cell(contact_column)].push_back(
        {reader.number(t), reader.number(N), reader.number(T),
         reader.cell(gap).empty() ? std::nan("") : reader.number(gap),
         std::find(names.begin(), names.end(), reader.cell(state)) - names.begin()});
  return all;
}

base::Json motion_json(const std::vector<ContactRow>& rows, std::size_t most, double t_end) {
  base::Downsampled<ContactRow, 4, DrawnValues, 3> thinned(t_end, {.max_rows = most, .limits_rows = true});
  for (const ContactRow& row : rows) thinned.add(row);
  base::Json t = base::Json::array(), state = base::Json::array(), N = base::Json::array(),
             T = base::Json::array(), gap = base::Json::array();
  for (const ContactRow& row : thinned.rows()) {
    t.push_back(row.t);
    state.push_back(row.state);
    N.push_back(number(row.N));
    T.push_back(number(row.T));
    gap.push_back(number(row.gap));
  }
  return {{"t", std::move(t)},
          {"state", std::move(state)},
          {"N", std::move(N)},
          {"T", std::move(T)},
          {"gap", std::move(gap)}};
}

base::Json contacts_json(const Scene& scene, const Places& places, const fs::path& directory) {
  const std::map<std::string, std::vector<ContactRow>> motions = read_motion(directory);
  std::size_t rows = 0;
  for (const auto& [name, motion] : motions) rows += motion.size();
  base::Json contacts = base::Json::array();
  for (const ContactSpec& contact : scene.contacts) {
    base::Json json = contact_json(contact, scene, places);
    const auto found = motions.find(contact.name);
    const std::vector<ContactRow> motion = found == motions.end() ? std::vector<ContactRow>{} : found->second;
    const std::size_t share = rows <= max_motion ? motion.size() : motion.size() * max_motion / rows;
    json["motion"] = motion_json(motion, std::max<std::size_t>(share, 200), scene.run.t_end);
    contacts.push_back(std::move(json));
  }
  return contacts;
}

base::Json events_json(const Scene& scene, const fs::path& directory) {
  std::map<std::string, int> index;
  for (const ContactSpec& contact : scene.contacts)
    index.emplace(contact.name, static_cast<int>(index.size()));
  result::CsvReader reader(directory / "events.csv");
  const std::size_t t = reader.column("t"), contact_column = reader.column("contact"),
                    event = reader.column("event"), from = reader.column("from"), to = reader.column("to");
  base::Json events = base::Json::array();
  while (reader.next() && events.size() < max_events) {
    const auto found = index.find(reader.cell(contact_column));
    events.push_back({reader.number(t), found == index.end() ? -1 : found->second, reader.cell(event),
                      reader.cell(from), reader.cell(to)});
  }
  return events;
}

/// Columns of response.csv; rows are dropped evenly, but never the two sides of a jump.
base::Json responses_json(const fs::path& directory) {
  base::Json responses = base::Json::array();
  const fs::path file = directory / "response.csv";
  if (!is_file(file)) return responses;
  result::CsvReader reader(file);
  const std::vector<std::string> names = reader.header();
  std::vector<double> t;
  std::vector<std::vector<double>> columns(names.size());
  while (reader.next()) {
    t.push_back(reader.t());
    for (std::size_t k = 1; k < names.size(); ++k) columns[k].push_back(reader.number(k));
  }
  constexpr std::size_t most_rows_shown = 4000;
  const std::size_t most = std::min(most_rows_shown, most_values / names.size());
  const std::vector<std::size_t> rows = kept_rows(t, most);
  base::Json times = base::Json::array();
  for (const std::size_t i : rows) times.push_back(t[i]);
  for (std::size_t k = 1; k < names.size(); ++k) {
    base::Json values = base::Json::array();
    for (const std::size_t i : rows) values.push_back(number(columns[k][i]));
    responses.push_back({{"name", names[k]}, {"y", std::move(values)}});
  }
  return {{"t", std::move(times)}, {"columns", std::move(responses)}};
}

base::Json colours_json() {
  base::Json states = base::Json::array();
  for (const std::string& name : result::state_names()) states.push_back({name, result::state_colour(name)});
  return states;
}

}  // namespace

base::Json run_data(const Scene& scene, const fs::path& directory) {
  const Displacements all = displacements(directory, scene.run.t_end);
  const Places places(scene, all.names);
  base::Json curve = curve_json(all);
  const MeshMotion mesh = mesh_motion(scene, directory);
  const double magnification = fitting_magnification(places.json(), curve, mesh.greatest);
  return {{"t_end", number(scene.run.t_end)},
          {"units", {scene.units.force, scene.units.length, scene.units.time}},
          {"matrices", scene.matrices.has_value()},
          {"nodes", places.json()},
          {"pieces", pieces_json(scene, places)},
          {"mesh", mesh_json(scene)},
          {"mesh_motion", mesh_motion_json(mesh)},
          {"shapes", shapes_json()},
          {"magnification", magnification},
          {"springs", springs_json(scene, places)},
          {"supports", supports_json(scene, places)},
          {"loads", loads_json(scene, places, directory)},
          {"contacts", contacts_json(scene, places, directory)},
          {"curve", std::move(curve)},
          {"curve_names", all.names},
          {"responses", responses_json(directory)},
          {"events", events_json(scene, directory)},
          {"states", colours_json()}};
}

}  // namespace signorini::report
