#include "io/rexs.h"

#include <jsoncpp/json/json.h>

#include <algorithm>
#include <charconv>
#include <pugixml.hpp>
#include <sstream>

#include "base/error.h"
#include "base/tool.h"
#include "io/publish.h"
#include "io/rexs_archive.h"
#include "io/rexs_json.h"

namespace whine {
namespace {

void add_component(const std::string& path, std::map<int, RexsComponent>& components,
                   RexsComponent component) {
  const int id = component.id;
  if (!components.emplace(id, std::move(component)).second)
    reject_rexs(path, text("two components have the id ", id));
}

// --- XML: <model version><relations><relation id type><ref id role/>, <components><component id type name><attribute id unit>

RexsComponent component_of(const std::string& path, const pugi::xml_node& node) {
  RexsComponent out;
  out.id = rexs_id(path, node.attribute("id").value(), "component");
  out.type = node.attribute("type").value();
  out.name = node.attribute("name").value();
  for (const pugi::xml_node& attribute : node.children("attribute")) {
    RexsAttribute read{attribute.attribute("unit").value(), attribute.child_value(), false};
    read.list = attribute.first_child().type() == pugi::node_element;
    for (const pugi::xml_node& child : attribute.children())
      read.list = read.list || child.type() == pugi::node_element;
    out.attributes[attribute.attribute("id").value()] = read;
  }
  return out;
}

void read_xml(const std::string& bytes, RexsModel& model) {
  pugi::xml_document document;
  const pugi::xml_parse_result parsed = document.load_buffer(bytes.data(), bytes.size());
  if (!parsed) {
    const auto line =
        1 + std::count(bytes.begin(), bytes.begin() + std::min<long>(parsed.offset, bytes.size()), '\n');
    reject_rexs(model.path, text("its XML is broken in line ", line, ": ", parsed.description()));
  }
  const pugi::xml_node root = document.child("model");
  if (!root)
    reject_rexs(model.path,
                text("its XML begins with <", document.document_element().name(), ">, not <model>"));
  model.version = root.attribute("version").value();
  for (const pugi::xml_node& node : root.child("components").children("component"))
    add_component(model.path, model.components, component_of(model.path, node));
  for (const pugi::xml_node& node : root.child("relations").children("relation")) {
    RexsRelation relation{node.attribute("type").value(), {}};
    for (const pugi::xml_node& ref : node.children("ref"))
      relation.references.push_back(
          {ref.attribute("role").value(), rexs_id(model.path, ref.attribute("id").value(), "reference")});
    model.relations.push_back(std::move(relation));
  }
  for (const pugi::xml_node& node : root.child("load_spectrum").children("load_case")) {
    model.load_cases.emplace_back();
    for (const pugi::xml_node& part : node.children("component"))
      add_component(model.path, model.load_cases.back(), component_of(model.path, part));
  }
}

// --- JSON: the same names; the value of an attribute stands behind its kind ("floating_point": 2.5)

std::string word_of(const Json::Value& value) {
  return value.isString() || value.isNumeric() || value.isBool() ? value.asString() : "";
}

RexsComponent component_of(const std::string& path, const Json::Value& node) {
  RexsComponent out;
  out.id = rexs_id(path, word_of(node["id"]), "component");
  out.type = word_of(node["type"]);
  out.name = word_of(node["name"]);
  for (const Json::Value& attribute : node["attributes"]) {
    RexsAttribute read{word_of(attribute["unit"]), "", false};
    for (const std::string& kind : attribute.getMemberNames()) {
      if (kind == "id" || kind == "unit") continue;
      read.list =
          !attribute[kind].isNull() && word_of(attribute[kind]).empty() && !attribute[kind].isString();
      read.value = word_of(attribute[kind]);
    }
    out.attributes[word_of(attribute["id"])] = read;
  }
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
  for (const RexsRelation& relation : model.relations)
    for (const RexsRelation::Reference& reference : relation.references)
      if (!model.components.contains(reference.component))
        reject_rexs(path, text("a relation '", relation.type, "' names component ", reference.component,
                               ", which does not exist"));
  return model;
}

RexsModel read_rexs(const std::string& path) {
  return parse_rexs(path, rexs_text(path, read_bytes(path)));
}

}  // namespace whine
