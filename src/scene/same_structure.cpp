#include "scene/same_structure.hpp"

namespace signorini {
namespace {

/// The table without keys of excitation.
toml::table undriven(toml::table table) {
  for (const char* key : {"motion", "acceleration", "surface_velocity", "normal_force", "initial_shear",
                          "temperature", "initial_strain"})
    table.erase(key);
  return table;
}

bool same(const toml::node* a, const toml::node* b) {
  if (!a || !b) return a == b;
  if (a->is_table() && b->is_table()) return *a->as_table() == *b->as_table();
  if (!a->is_array() || !b->is_array()) return false;
  const toml::array &x = *a->as_array(), &y = *b->as_array();
  if (!x.is_homogeneous(toml::node_type::table) || !y.is_homogeneous(toml::node_type::table)) return x == y;
  if (x.size() != y.size()) return false;
  for (std::size_t i = 0; i < x.size(); ++i)
    if (undriven(*x[i].as_table()) != undriven(*y[i].as_table())) return false;
  return true;
}

}  // namespace

bool same_units(const toml::table& a, const toml::table& b) { return same(a.get("units"), b.get("units")); }

std::string units_of(const toml::table& scene) {
  std::string text;
  for (const char* key : {"force", "mass", "length", "time"})
    text += (text.empty() ? "" : ", ") + scene["units"][key].value_or(std::string("?"));
  return text;
}

std::vector<std::string> differing_structure(const toml::table& a, const toml::table& b) {
  std::vector<std::string> tables;
  for (const char* key :
       {"nodes", "lines", "sections", "members", "bodies", "surfaces", "seams", "masses", "rigid", "springs",
        "damping", "supports", "contacts", "stops", "pendulums", "reduction", "matrices", "gravity"})
    if (!same(a.get(key), b.get(key))) tables.emplace_back(key);
  if (a["run"]["geometric"].value_or(false) != b["run"]["geometric"].value_or(false))
    tables.emplace_back("run.geometric");
  return tables;
}

}  // namespace signorini
