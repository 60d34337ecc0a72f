#include "behaviour/reference.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>

namespace signorini::tests {
namespace {

constexpr double simultaneous = 1e-7;

void order(std::vector<EventRow>& events) {
  std::stable_sort(events.begin(), events.end(),
                   [](const EventRow& a, const EventRow& b) { return a.t < b.t; });
  for (std::size_t i = 0; i < events.size();) {
    std::size_t j = i + 1;
    while (j < events.size() && events[j].t - events[i].t < simultaneous) ++j;
    std::stable_sort(events.begin() + static_cast<std::ptrdiff_t>(i),
                     events.begin() + static_cast<std::ptrdiff_t>(j),
                     [](const EventRow& a, const EventRow& b) { return a.contact < b.contact; });
    i = j;
  }
}

std::string show(const std::vector<EventRow>& events, std::size_t i) {
  if (i >= events.size()) return "nothing";
  const EventRow& e = events[i];
  return fmt::format("t = {:.12g} {} {} -> {}", e.t, e.contact, e.from, e.to);
}

}  // namespace

double Table::number(const std::string& column, std::size_t row) const {
  return std::stod(text(column, row));
}

const std::string& Table::text(const std::string& column, std::size_t row) const {
  return columns.at(column).at(row);
}

Table read_csv(const std::string& path) {
  std::ifstream in(path);
  if (!in) throw std::runtime_error("cannot read " + path);
  Table table;
  std::vector<std::string> names;
  for (std::string line; std::getline(in, line);) {
    std::istringstream cells(line);
    std::vector<std::string> row;
    for (std::string cell; std::getline(cells, cell, ',');) row.push_back(cell);
    if (names.empty()) {
      names = row;
      continue;
    }
    row.resize(names.size());
    for (std::size_t i = 0; i < names.size(); ++i) table.columns[names[i]].push_back(row[i]);
    ++table.rows;
  }
  return table;
}

Vector moved_start(const Model& model, const Table& samples, const Result& result) {
  Vector moved = Vector::Zero(model.size());
  if (model.statics.free_motions.empty() || samples.rows == 0 || result.rows.empty()) return moved;
  for (const Column& column : model.columns)
    if (!column.velocity) moved[column.dof] = result.rows[0].u[column.dof] - samples.number(column.name, 0);
  const double resisted = (model.stiffness * moved).cwiseAbs().maxCoeff();
  const double terms = (model.stiffness.cwiseAbs() * moved.cwiseAbs()).maxCoeff();
  if (!(resisted <= 1e-9 * terms)) throw std::runtime_error("the start differs by a motion with stiffness");
  for (const Contact& contact : model.contacts)
    if (!(std::abs(contact.normal.dot(moved)) <= 1e-9 * moved.cwiseAbs().maxCoeff()))
      throw std::runtime_error("the start differs by a motion of gaps");
  return moved;
}

Comparison run_case(const std::string& name, const std::vector<Override>& overrides) {
  const std::string base = std::string(SIGNORINI_TEST_DATA) + "/cases/" + name;
  const Scene scene = read_scene(base + ".toml", overrides);
  const Model model = build_model(scene);
  Comparison c;
  c.result = simulate(model, scene.run);

  std::vector<EventRow> expected, found;
  const Table events = read_csv(base + ".events.csv");
  for (std::size_t i = 0; i < events.rows; ++i) {
    if (events.number("t", i) > scene.run.t_end) continue;
    expected.push_back(
        {events.number("t", i), events.text("contact", i), events.text("from", i), events.text("to", i)});
  }
  for (const Event& e : c.result.events)
    if (e.type != EventType::time)
      found.push_back({e.t, model.contacts[static_cast<std::size_t>(e.contact)].name, to_string(e.from),
                       to_string(e.to)});
  order(expected);
  order(found);
  c.expected = expected.size();
  c.found = found.size();
  const std::size_t both = std::min(expected.size(), found.size());
  for (; c.agreeing < both; ++c.agreeing) {
    const EventRow &a = expected[c.agreeing], &b = found[c.agreeing];
    if (a.contact != b.contact || a.from != b.from || a.to != b.to) break;
    c.event_time = std::max(c.event_time, std::abs(a.t - b.t));
  }
  if (c.agreeing < std::max(expected.size(), found.size()))
    c.first_difference = fmt::format("event {}: expected {}, found {}", c.agreeing + 1,
                                     show(expected, c.agreeing), show(found, c.agreeing));

  const Table samples = read_csv(base + ".samples.csv");
  double u_scale = 0.0, v_scale = 0.0;
  for (const Column& column : model.columns)
    for (std::size_t i = 0; i < samples.rows; ++i) {
      double& scale = column.velocity ? v_scale : u_scale;
      scale = std::max(scale, std::abs(samples.number(column.name, i)));
    }
  const Vector moved = moved_start(model, samples, c.result);
  for (std::size_t i = 0; i < std::min(samples.rows, c.result.rows.size()); ++i) {
    const Result::Row& row = c.result.rows[i];
    if (std::abs(samples.number("t", i) - row.t) > 1e-12) throw std::runtime_error("output times differ");
    for (const Column& column : model.columns) {
      const double value = column.velocity ? row.v[column.dof] : row.u[column.dof] - moved[column.dof];
      const double error = std::abs(value - samples.number(column.name, i));
      double& worst = column.velocity ? c.velocity : c.displacement;
      worst = std::max(worst, error / (column.velocity ? v_scale : u_scale));
    }
  }

  const Table contacts = read_csv(base + ".contacts.csv");
  double scale = 0.0;
  for (std::size_t i = 0; i < contacts.rows; ++i) scale = std::max(scale, std::abs(contacts.number("N", i)));
  for (std::size_t i = 0; i < contacts.rows; ++i) {
    const std::size_t k = i % model.contacts.size(), row = i / model.contacts.size();
    if (row >= c.result.rows.size()) break;
    const ContactSample& sample = c.result.rows[row].contacts[k];
    if (contacts.text("contact", i) != model.contacts[k].name)
      throw std::runtime_error("contacts in another order");
    c.N = std::max(c.N, std::abs(sample.N - contacts.number("N", i)) / scale);
    c.T = std::max(c.T, std::abs(sample.T - contacts.number("T", i)) / scale);
  }
  return c;
}

}  // namespace signorini::tests
