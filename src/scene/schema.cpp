#include "scene/schema.hpp"

#include <toml++/toml.h>

#include "base/json.hpp"
#include "scene/keys.hpp"
#include "scene/toml_node.hpp"

namespace signorini::scene {

namespace {

base::Json default_json(const Key& key) {
  const toml::table parsed = toml::parse("value = " + std::string(key.default_value));
  return json_of(*parsed.get("value"));
}

/// Name of the definition of a table, valid in a $ref: "contacts[].friction" -> "contacts.friction".
std::string definition_name(std::string_view table) {
  std::string name;
  for (const char c : table) {
    if (c == '*') name += "NAME";
    if (c != '*' && c != '[' && c != ']') name += c;
  }
  return name;
}

base::Json reference(std::string_view table) { return {{"$ref", "#/definitions/" + definition_name(table)}}; }

base::Json any_of(base::Json first, base::Json second) {
  base::Json list = base::Json::array();
  list.push_back(std::move(first));
  list.push_back(std::move(second));
  return {{"anyOf", std::move(list)}};
}

base::Json array_of(base::Json item) { return {{"type", "array"}, {"items", std::move(item)}}; }

base::Json one_of_words(const std::vector<std::string>& words) {
  return {{"type", "string"}, {"enum", words}};
}

base::Json number_type(KeyType type) {
  base::Json json = {{"type", type == KeyType::count || type == KeyType::integer ? "integer" : "number"}};
  if (type == KeyType::positive) json["exclusiveMinimum"] = 0;
  if (type == KeyType::non_negative || type == KeyType::fraction) json["minimum"] = 0;
  if (type == KeyType::fraction) json["maximum"] = 1;
  if (type == KeyType::count) json["minimum"] = 1;
  if (type == KeyType::relative_tolerance) {
    json["minimum"] = 1e-14;
    json["exclusiveMaximum"] = 1;
  }
  return json;
}

/// Schema of an array [x, y].
base::Json plane_vector() {
  base::Json json = array_of(number_type(KeyType::number));
  json["minItems"] = 2;
  json["maxItems"] = 2;
  return json;
}

base::Json direction_type() {
  const base::Json by_dof = {{"type", "object"}, {"additionalProperties", number_type(KeyType::number)}};
  base::Json json = any_of(plane_vector(), by_dof);
  json["anyOf"].push_back({{"type", "string"}});
  return json;
}

/// Path of the table that is the value of a key.
std::string below(const Key& key) {
  return (key.table.empty() ? "" : std::string(key.table) + ".") + std::string(key.name);
}

/// Schema of the table `friction`, for all laws of friction.
base::Json friction_table(const std::string& path) {
  const base::Json falls = {{"required", base::Json::array({"static"})}};
  const base::Json rises = {{"required", base::Json::array({"slow", "fast", "velocity"})}};
  const base::Json by_load = {{"required", base::Json::array({"light", "heavy", "force"})}};
  return {{"allOf",
           base::Json::array({reference(path), {{"anyOf", base::Json::array({falls, rises, by_load})}}})}};
}

base::Json table_type(const Key& key) {
  switch (key.type) {
    case KeyType::tables:
      return array_of(reference(below(key) + "[]"));
    case KeyType::one_or_many:
      return any_of(reference(below(key)), array_of(reference(below(key))));
    case KeyType::initial:
      return any_of(one_of_words({"static", "frictional"}), reference(below(key)));
    case KeyType::friction:
      return any_of(number_type(KeyType::non_negative), friction_table(below(key)));
    case KeyType::term:
      return any_of(number_type(KeyType::number), reference(below(key)));
    case KeyType::history:
      return reference("history");
    case KeyType::number_or_history:
      return any_of(number_type(KeyType::number), reference("history"));
    default:
      return reference(below(key));
  }
}

base::Json value_type(const Key& key) {
  const base::Json text = {{"type", "string"}};
  switch (key.type) {
    case KeyType::text:
    case KeyType::name:
      return text;
    case KeyType::choice:
      return one_of_words(choices_of(key));
    case KeyType::flag:
      return {{"type", "boolean"}};
    case KeyType::automatic_flag:
      return any_of({{"type", "boolean"}}, one_of_words({"auto"}));
    case KeyType::tolerance_order: {
      base::Json order = number_type(KeyType::count);
      order["maximum"] = 5;
      return any_of(one_of_words({"auto"}), order);
    }
    case KeyType::texts:
      return array_of(text);
    case KeyType::vector:
      return plane_vector();
    case KeyType::numbers:
      return array_of(number_type(KeyType::number));
    case KeyType::numbers_or_file:
      return any_of(array_of(number_type(KeyType::number)), text);
    case KeyType::elements:
      return any_of(number_type(KeyType::count), array_of(number_type(KeyType::count)));
    case KeyType::place:
      return any_of(text, plane_vector());
    case KeyType::against: {
      base::Json two = array_of(text);
      two["minItems"] = 2;
      two["maxItems"] = 2;
      return any_of(text, two);
    }
    case KeyType::direction:
      return direction_type();
    case KeyType::matrix:
      return any_of(text, array_of(array_of(number_type(KeyType::number))));
    case KeyType::table:
    case KeyType::tables:
    case KeyType::one_or_many:
    case KeyType::initial:
    case KeyType::friction:
    case KeyType::history:
    case KeyType::number_or_history:
    case KeyType::term:
      return table_type(key);
    default:
      return number_type(key.type);
  }
}

base::Json key_schema(const Key& key) {
  base::Json json = value_type(key);
  if (key.table.empty() && key.name == "schema") json = {{"const", 1}};
  // Draft 7 ignores all other keywords of an object with a $ref.
  if (json.contains("$ref")) json = {{"allOf", base::Json::array({json})}};
  json["description"] =
      std::string(key.meaning) + (key.unit.empty() ? "" : " Unit: " + std::string(key.unit) + ".");
  if (!key.default_value.empty() && key.default_value != "required") json["default"] = default_json(key);
  return json;
}

base::Json table_schema(std::string_view table) {
  const Key* any = find_key(table, "*");
  base::Json properties = base::Json::object(), required = base::Json::array();
  for (const std::string& name : key_names(table)) {
    const Key& key = *find_key(table, name);
    properties[name] = key_schema(key);
    // A name chosen by the user may equal the name of a key.
    if (any) properties[name] = any_of(properties[name], value_type(*any));
    if (key.default_value == "required") required.push_back(name);
  }
  base::Json json = {{"type", "object"}, {"properties", properties}, {"additionalProperties", false}};
  if (any) json["additionalProperties"] = key_schema(*any);
  if (!required.empty()) json["required"] = required;
  return json;
}

}  // namespace

std::string scene_schema() {
  base::Json schema = {{"$schema", "http://json-schema.org/draft-07/schema#"},
                       {"title", "Signorini scene"},
                       {"description", "Structures on unilateral frictional contacts, event by event."}};
  schema.update(table_schema(""));
  base::Json definitions = base::Json::object();
  for (const Key& key : all_keys())
    if (const std::string name = definition_name(key.table); !name.empty() && !definitions.contains(name))
      definitions[name] = table_schema(key.table);
  schema["definitions"] = std::move(definitions);
  return base::json_text(schema);
}

}  // namespace signorini::scene
