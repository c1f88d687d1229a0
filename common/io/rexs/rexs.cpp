#include "io/rexs/rexs.h"

#include <jsoncpp/json/json.h>

#include <algorithm>
#include <charconv>
#include <pugixml.hpp>
#include <sstream>

#include "base/error.h"
#include "base/tool.h"
#include "io/publish.h"
#include "io/rexs/archive.h"
#include "io/rexs/json.h"

namespace whine {
namespace {

// Types and names are texts of the file.
std::string quoted(const RexsComponent& c) {
  return text(printable(c.type, 80), " ", c.id, c.name.empty() ? "" : " '" + printable(c.name, 80) + "'");
}

void add_component(const std::string& path, std::map<int, RexsComponent>& components,
                   RexsComponent component) {
  const auto [at, added] = components.emplace(component.id, component);
  if (!added)
    reject_rexs(path, text("two components have the id ", component.id, ": ", quoted(at->second), " and ",
                           quoted(component), "; take one out"));
}

void add_attribute(const std::string& path, RexsComponent& component, const std::string& name,
                   const RexsAttribute& attribute) {
  const auto words = [](const RexsAttribute& a) {
    return a.list ? "a list of " + std::to_string(a.values.size()) : "'" + printable(a.value, 40) + "'";
  };
  const auto [at, added] = component.attributes.emplace(name, attribute);
  if (!added)
    reject_rexs(path, text("'", printable(name, 80), "' of ", quoted(component), " stands twice: ",
                           words(at->second), " and ", words(attribute), "; take one out"));
}

// --- XML: <model version><relations><relation id type><ref id role/>, <components><component id type name><attribute id unit>

// Walks without recursion. pugixml takes an attribute twice and gives the first.
void check_xml(const std::string& path, const pugi::xml_document& document) {
  constexpr size_t kMostAttributes = 64;
  size_t depth = 1;
  for (pugi::xml_node node = document.first_child(); node;) {
    std::map<std::string, std::string> said;
    for (const pugi::xml_attribute& a : node.attributes()) {
      const auto [at, added] = said.emplace(a.name(), a.value());
      if (!added)
        reject_rexs(path, text("<", node.name(), "> has '", a.name(), "' twice: '", at->second, "' and '",
                               a.value(), "'"));
      if (said.size() > kMostAttributes)
        reject_rexs(path, text("<", node.name(), "> has more than ", kMostAttributes, " attributes"));
    }
    if (node.first_child()) {
      if (++depth > kMostRexsDepth) reject_rexs(path, text("its XML is nested deeper than ", kMostRexsDepth));
      node = node.first_child();
      continue;
    }
    while (node && !node.next_sibling() && depth > 1) {
      node = node.parent();
      --depth;
    }
    node = node.next_sibling();
  }
}

RexsComponent component_of(const std::string& path, const pugi::xml_node& node) {
  RexsComponent out;
  out.id = rexs_id(path, node.attribute("id").value(), "component");
  out.type = node.attribute("type").value();
  out.name = node.attribute("name").value();
  for (const pugi::xml_node& attribute : node.children("attribute")) {
    RexsAttribute read{attribute.attribute("unit").value(), attribute.child_value(), false};
    for (const pugi::xml_node& child : attribute.children())
      read.list = read.list || child.type() == pugi::node_element;
    for (const pugi::xml_node& entry : attribute.child("array").children("c"))
      read.values.emplace_back(entry.child_value());
    add_attribute(path, out, attribute.attribute("id").value(), read);
  }
  return out;
}

// The only child of a name; a second one would be passed over.
pugi::xml_node only_child(const std::string& path, const pugi::xml_node& of, const char* name) {
  const pugi::xml_node found = of.child(name);
  if (found.next_sibling(name)) reject_rexs(path, text("<", of.name(), "> holds <", name, "> twice"));
  return found;
}

void read_xml(const std::string& bytes, RexsModel& model) {
  pugi::xml_document document;
  const pugi::xml_parse_result parsed = document.load_buffer(bytes.data(), bytes.size());
  if (!parsed) {
    const auto line =
        1 + std::count(bytes.begin(), bytes.begin() + std::min<long>(parsed.offset, bytes.size()), '\n');
    reject_rexs(model.path, text("its XML is broken in line ", line, ": ", parsed.description()));
  }
  check_xml(model.path, document);
  const pugi::xml_node root = only_child(model.path, document, "model");
  if (!root)
    reject_rexs(model.path,
                text("its XML begins with <", document.document_element().name(), ">, not <model>"));
  model.version = root.attribute("version").value();
  for (const pugi::xml_node& node : only_child(model.path, root, "components").children("component"))
    add_component(model.path, model.components, component_of(model.path, node));
  for (const pugi::xml_node& node : only_child(model.path, root, "relations").children("relation")) {
    RexsRelation relation{node.attribute("type").value(), {}};
    if (node.attribute("id")) relation.id = rexs_id(model.path, node.attribute("id").value(), "relation");
    for (const pugi::xml_node& ref : node.children("ref"))
      relation.references.push_back(
          {ref.attribute("role").value(), rexs_id(model.path, ref.attribute("id").value(), "reference")});
    model.relations.push_back(std::move(relation));
  }
  for (const pugi::xml_node& node : only_child(model.path, root, "load_spectrum").children("load_case")) {
    model.load_cases.emplace_back();
    for (const pugi::xml_node& part : node.children("component"))
      add_component(model.path, model.load_cases.back(), component_of(model.path, part));
  }
}

// --- JSON: the same names; the value of an attribute stands behind its kind ("floating_point": 2.5)

std::string word_of(const Json::Value& value) {
  return value.isString() || value.isNumeric() || value.isBool() ? value.asString() : "";
}

RexsAttribute attribute_of(const std::string& path, const RexsComponent& component,
                           const Json::Value& attribute) {
  RexsAttribute read{word_of(attribute["unit"]), "", false};
  std::string said;
  for (const std::string& kind : attribute.getMemberNames()) {
    if (kind == "id" || kind == "unit") continue;
    const Json::Value& value = attribute[kind];
    if (!said.empty())
      reject_rexs(path, text("'", printable(word_of(attribute["id"]), 80), "' of ", quoted(component),
                             " has two values: ", said, " = '", printable(read.value, 40), "' and ", kind,
                             " = '", printable(word_of(value), 40), "'; take one out"));
    said = printable(kind, 40);
    read.list = !value.isNull() && word_of(value).empty() && !value.isString();
    read.value = word_of(value);
    if (!value.isArray()) continue;
    for (const Json::Value& entry : value) {
      if (entry.isArray() || entry.isObject()) break;
      read.values.push_back(word_of(entry));
    }
  }
  return read;
}

RexsComponent component_of(const std::string& path, const Json::Value& node) {
  RexsComponent out;
  out.id = rexs_id(path, word_of(node["id"]), "component");
  out.type = word_of(node["type"]);
  out.name = word_of(node["name"]);
  const Json::Value& attributes = node["attributes"];
  if (!attributes.isNull() && !attributes.isArray())
    reject_rexs(path, text("\"attributes\" of ", quoted(out), " is no list"));
  for (const Json::Value& attribute : attributes)
    add_attribute(path, out, word_of(attribute["id"]), attribute_of(path, out, attribute));
  return out;
}

void read_json(const std::string& bytes, RexsModel& model) {
  const Json::Value document = rexs_json(model.path, bytes);
  const Json::Value& root = document["model"];
  model.version = word_of(root["version"]);
  for (const Json::Value& node : root["components"])
    add_component(model.path, model.components, component_of(model.path, node));
  for (const Json::Value& node : root["relations"]) {
    RexsRelation relation{word_of(node["type"]), {}};
    if (node.isMember("id")) relation.id = rexs_id(model.path, word_of(node["id"]), "relation");
    for (const Json::Value& ref : node["refs"])
      relation.references.push_back(
          {word_of(ref["role"]), rexs_id(model.path, word_of(ref["id"]), "reference")});
    model.relations.push_back(std::move(relation));
  }
  for (const Json::Value& node : root["load_spectrum"]["load_cases"]) {
    model.load_cases.emplace_back();
    for (const Json::Value& part : node["components"])
      add_component(model.path, model.load_cases.back(), component_of(model.path, part));
  }
}

// --- Relations of both

std::string words_of(const RexsModel& model, const RexsRelation& relation) {
  std::string out;
  for (const RexsRelation::Reference& ref : relation.references)
    out += (out.empty() ? "" : ", ") + printable(ref.role, 40) + " = " +
           quoted(model.components.at(ref.component));
  return out;
}

// What a relation alone may say; empty: any number of relations may say the same.
std::string subject_of(const RexsRelation& relation) {
  const auto role = [&](const char* name) { return std::to_string(relation.in_role(name)); };
  if (relation.type == "stage") return "stage " + role("stage");
  if (relation.type == "flank") return "flank " + role("gear");
  if (relation.type == "stage_gear_data") return "data " + role("stage") + " " + role("gear");
  return "";
}

void check_relations(const RexsModel& model) {
  std::map<std::string, const RexsRelation*> said;
  for (const RexsRelation& relation : model.relations) {
    std::map<std::string, int> roles;
    for (const RexsRelation::Reference& reference : relation.references) {
      if (!model.components.contains(reference.component))
        reject_rexs(model.path, text("a relation '", relation.type, "' names component ", reference.component,
                                     ", which does not exist"));
      const auto [at, added] = roles.emplace(reference.role, reference.component);
      if (!added)
        reject_rexs(model.path, text("a relation '", relation.type, "' has the role '", reference.role,
                                     "' twice: ", quoted(model.components.at(at->second)), " and ",
                                     quoted(model.components.at(reference.component)), "; take one out"));
    }
    if (relation.type == "stage" && relation.in_role("gear_1") >= 0 &&
        relation.in_role("gear_1") == relation.in_role("gear_2"))
      reject_rexs(model.path,
                  text("a relation 'stage' pairs a gear with itself: ", words_of(model, relation)));
    std::vector<std::string> names;
    if (relation.id >= 0) names.push_back("relation " + std::to_string(relation.id));
    if (const std::string subject = subject_of(relation); !subject.empty()) names.push_back(subject);
    for (const std::string& name : names) {
      const auto [at, added] = said.emplace(name, &relation);
      if (!added)
        reject_rexs(model.path, text(name.starts_with("relation") ? "two relations have the id of one: '"
                                                                  : "two relations say one thing: '",
                                     at->second->type, "' (", words_of(model, *at->second), ") and '",
                                     relation.type, "' (", words_of(model, relation), "); take one out"));
    }
  }
}

void check_version(const RexsModel& model) {
  const std::string& v = model.version;
  const bool numbers =
      v.size() >= 3 && v[1] == '.' && v.find_first_not_of("0123456789.") == std::string::npos;
  if (!numbers || !(v[0] == '1' || v.starts_with("2.0")))
    reject_rexs(model.path, v.empty() ? "it names no version" : "its version is " + v);
}

}  // namespace

int rexs_id(const std::string& path, const std::string& word, const char* what) {
  int id = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), id);
  if (error != std::errc() || end != word.data() + word.size() || id < 0)
    reject_rexs(path, text("the id '", word, "' of a ", what, " is no number from 0 on"));
  return id;
}

int RexsRelation::in_role(const std::string& role) const {
  for (const Reference& reference : references)
    if (reference.role == role) return reference.component;
  return -1;
}

bool RexsRelation::holds(int component) const {
  return std::any_of(references.begin(), references.end(),
                     [&](const Reference& reference) { return reference.component == component; });
}

RexsModel parse_rexs(const std::string& path, const std::string& bytes) {
  RexsModel model;
  model.path = path;
  const size_t first = bytes.find_first_not_of(" \t\r\n");
  if (first == std::string::npos) reject_rexs(path, "it is empty");
  try {
    if (bytes[first] == '<')
      read_xml(bytes, model);
    else if (bytes[first] == '{')
      read_json(bytes, model);
    else
      reject_rexs(path, "it is neither XML nor JSON nor a zip archive");
  } catch (const Json::Exception& e) {
    reject_rexs(path, std::string("its JSON is not that of a model: ") + e.what());
  }
  check_version(model);
  check_relations(model);
  return model;
}

RexsModel read_rexs(const std::string& path) {
  return parse_rexs(path, rexs_text(path, read_bytes(path)));
}

}  // namespace whine
