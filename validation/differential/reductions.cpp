#include "differential/reductions.hpp"

#include <cmath>
#include <cstdlib>
#include <string>

namespace signorini::differential {
namespace {

/// "d3" -> 3, else -1.
int number_of(std::string_view name) {
  if (name.size() < 2 || name[0] != 'd') return -1;
  int number = 0;
  for (const char c : name.substr(1)) {
    if (c < '0' || c > '9') return -1;
    number = 10 * number + (c - '0');
  }
  return number;
}

/// A form without degree of freedom i, the later ones one lower.
void drop_from_form(toml::table& form, int i) {
  toml::table rest;
  for (auto&& [key, value] : form) {
    const int dof = number_of(key.str());
    if (dof < 0)
      rest.insert(key.str(), value);
    else if (dof != i)
      rest.insert("d" + std::to_string(dof > i ? dof - 1 : dof), value);
  }
  form = rest;
}

void drop_from_array(toml::node* list, int i) {
  if (toml::array* a = list != nullptr ? list->as_array() : nullptr;
      a && a->size() > static_cast<std::size_t>(i))
    a->erase(a->cbegin() + i);
}

toml::table without_dof(const toml::table& scene, int i) {
  toml::table copy = scene;
  for (auto&& [key, matrix] : *copy["matrices"].as_table()) {
    if (!matrix.is_array()) continue;
    for (toml::node& row : *matrix.as_array()) drop_from_array(&row, i);
    drop_from_array(&matrix, i);
  }
  if (toml::table* run = copy["run"].as_table())
    for (const char* key : {"u", "v"}) drop_from_array((*run)["initial"][key].node(), i);
  for (const char* kind : {"contacts", "loads"})
    if (toml::array* items = copy[kind].as_array())
      for (toml::node& item : *items)
        for (const char* key : {"normal", "tangent", "direction"})
          if (toml::table* form = (*item.as_table())[key].as_table()) drop_from_form(*form, i);
  if (toml::table* form = copy["base_motion"]["direction"].as_table()) drop_from_form(*form, i);
  return copy;
}

void collect_numbers(toml::node& node, std::vector<toml::value<double>*>& numbers) {
  if (toml::value<double>* number = node.as_floating_point()) numbers.push_back(number);
  if (toml::array* list = node.as_array())
    for (toml::node& item : *list) collect_numbers(item, numbers);
  if (toml::table* table = node.as_table())
    for (auto&& [key, value] : *table) collect_numbers(value, numbers);
}

double with_digits(double x, int digits) {
  if (x == 0.0 || !std::isfinite(x)) return x;
  char text[32];
  std::snprintf(text, sizeof text, "%.*e", digits - 1, x);
  return std::strtod(text, nullptr);
}

}  // namespace

Tables without_parts(const toml::table& scene) {
  Tables list;
  for (const char* kind : {"contacts", "loads", "springs", "members", "masses", "supports"})
    if (const toml::array* items = scene[kind].as_array())
      for (std::size_t i = 0; i < items->size(); ++i) {
        list.push_back(scene);
        toml::array& rest = *list.back()[kind].as_array();
        rest.erase(rest.cbegin() + static_cast<std::ptrdiff_t>(i));
        if (rest.empty()) list.back().erase(kind);
      }
  for (const char* kind : {"base_motion", "damping", "gravity"})
    if (scene.contains(kind)) {
      list.push_back(scene);
      list.back().erase(kind);
    }
  return list;
}

Tables without_dofs(const toml::table& scene) {
  Tables list;
  const toml::array* mass = scene["matrices"]["mass"].as_array();
  for (int i = 0; mass != nullptr && mass->size() > 1 && i < static_cast<int>(mass->size()); ++i)
    list.push_back(without_dof(scene, i));
  return list;
}

Tables without_options(const toml::table& scene) {
  Tables list;
  for (const char* kind : {"contacts", "loads"}) {
    const toml::array* items = scene[kind].as_array();
    for (std::size_t i = 0; items != nullptr && i < items->size(); ++i)
      for (auto&& [key, value] : *(*items)[i].as_table()) {
        const std::string name(key.str());
        if (name == "name" || name == "law" || name == "node") continue;
        list.push_back(scene);
        toml::table& item = *(*list.back()[kind].as_array())[i].as_table();
        item.erase(name);
        if (const toml::table* table = value.as_table())
          for (const char* plain : {"static", "offset"})
            if (table->contains(plain)) {
              list.push_back(scene);
              (*list.back()[kind].as_array())[i].as_table()->insert_or_assign(name,
                                                                              *table->get_as<double>(plain));
            }
      }
  }
  return list;
}

Tables shorter(const toml::table& scene) {
  Tables list;
  const double t_end = scene["run"]["t_end"].value_or(0.0);
  const double output_dt = scene["run"]["output_dt"].value_or(t_end);
  for (const double part : {0.25, 0.5, 0.75, 0.9}) {
    list.push_back(scene);
    toml::table& run = *list.back()["run"].as_table();
    run.insert_or_assign("t_end", with_digits(part * t_end, 4));
    run.insert_or_assign("output_dt", with_digits(part * t_end, 4) / std::round(t_end / output_dt));
  }
  return list;
}

Tables plainer_pairs(const toml::table& scene) {
  Tables list;
  for (const char* kind : {"mass", "damping", "stiffness"}) {
    const toml::array* matrix = scene["matrices"][kind].as_array();
    if (matrix == nullptr) continue;
    const std::size_t n = matrix->size();
    const auto changed = [&](const auto& change) {
      toml::table copy = scene;
      toml::array& rows = *copy["matrices"][kind].as_array();
      bool any = false;
      for (std::size_t i = 0; i < n; ++i)
        for (std::size_t j = 0; j < n; ++j) {
          toml::value<double>* x = (*rows[i].as_array())[j].as_floating_point();
          if (x == nullptr || i == j) continue;
          const double plain = change(i, j, x->get());
          any = any || plain != x->get();
          *x = plain;
        }
      if (any) list.push_back(std::move(copy));
    };
    changed([](std::size_t, std::size_t, double) { return 0.0; });
    for (std::size_t p = 0; p < n; ++p)
      for (std::size_t q = 0; q < p; ++q)
        for (const int digits : {0, 1, 2})
          changed([&](std::size_t i, std::size_t j, double x) {
            const bool here = (i == p && j == q) || (i == q && j == p);
            return !here ? x : digits == 0 ? 0.0 : with_digits(x, digits);
          });
  }
  return list;
}

Tables plainer_numbers(const toml::table& scene) {
  Tables list;
  toml::table first = scene;
  first.erase("run");
  std::vector<toml::value<double>*> numbers;
  collect_numbers(first, numbers);
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double x = numbers[i]->get();
    double last = x;
    for (const double plain : {0.0, with_digits(x, 1), with_digits(x, 2), with_digits(x, 3)}) {
      if (x == 0.0 || plain == x || plain == last) continue;
      last = plain;
      toml::table copy = first;
      std::vector<toml::value<double>*> copied;
      collect_numbers(copy, copied);
      *copied[i] = plain;
      copy.insert("run", *scene["run"].as_table());
      list.push_back(std::move(copy));
    }
  }
  return list;
}

}  // namespace signorini::differential
