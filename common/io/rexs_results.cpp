#include "io/rexs_results.h"

#include <jsoncpp/json/json.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <pugixml.hpp>
#include <sstream>

#include "base/error.h"
#include "io/publish.h"
#include "io/rexs_archive.h"
#include "io/rexs_stage.h"

namespace whine {
namespace {

constexpr RexsUnit kNumber{"", RexsDimension::number, 1}, kMetre{"m", RexsDimension::length, 1};

// Nine digits: fewer than round-off has, so that other machines write the same.
std::string digits(const std::string& path, const RexsResult& result, double value) {
  if (!std::isfinite(value))
    fail(Failure::numerical, path, ": the result ", result.name, " is no finite number");
  char buffer[40];
  std::snprintf(buffer, sizeof buffer, "%.9g", value);
  return buffer;
}

void require_stage_of(const RexsModel& model, const std::string& wanted, const RexsPair& pair, int& id) {
  RexsStage stage(model, wanted, 1);
  id = stage.stage().id;
  constexpr double kSame = 1e-9;  // relative: what rounding to the digits of a file leaves
  const auto same = [](double a, double b) { return std::abs(a - b) <= kSame * std::abs(b); };
  std::array<double, 2> teeth, module;
  for (int g : {0, 1}) {
    const auto at = static_cast<size_t>(g);
    teeth[at] = stage.required(&stage.gear(g), stage.gear(g), "number_of_teeth", kNumber).value;
    module[at] = stage.required(&stage.gear(g), stage.gear(g), "normal_module", kMetre).value;
  }
  const double distance = stage.required(&stage.stage(), stage.stage(), "center_distance", kMetre).value;
  const auto fits = [&](size_t first, size_t second) {
    return same(teeth[first], pair.teeth[0]) && same(teeth[second], pair.teeth[1]) &&
           same(module[first], pair.module[0]) && same(module[second], pair.module[1]);
  };
  if (!(fits(0, 1) || fits(1, 0)) || !same(distance, pair.centre_distance))
    fail(Failure::input, model.path, ": ", quoted_name(stage.stage()), " has ", teeth[0], " and ", teeth[1],
         " teeth of module ", 1e3 * module[0], " mm at ", 1e3 * distance, " mm; the results are of ",
         pair.teeth[0], " and ", pair.teeth[1], " teeth of module ", 1e3 * pair.module[0], " mm at ",
         1e3 * pair.centre_distance, " mm: give the model or the stage that the scene was imported from");
}

// --- XML: lines of the stage's component stay as they are

bool is_blank(const pugi::xml_node& node) {
  return node.type() == pugi::node_pcdata &&
         std::string(node.value()).find_first_not_of(" \t\r\n") == std::string::npos;
}

void remove_results(pugi::xml_node component) {
  for (pugi::xml_node node = component.first_child(); node;) {
    const pugi::xml_node next = node.next_sibling(), before = node.previous_sibling();
    if (std::string(node.name()) == "attribute" &&
        std::string(node.attribute("id").value()).starts_with(kRexsResult)) {
      if (is_blank(before)) component.remove_child(before);
      component.remove_child(node);
    }
    node = next;
  }
}

void add_result(const std::string& path, pugi::xml_node component, const RexsResult& result,
                const std::string& indent) {
  const pugi::xml_node last = component.last_child();
  const auto child = [&](pugi::xml_node_type type) {
    return is_blank(last) ? component.insert_child_before(type, last) : component.append_child(type);
  };
  if (!indent.empty()) child(pugi::node_pcdata).set_value(indent.c_str());
  pugi::xml_node node = child(pugi::node_element);
  node.set_name("attribute");
  node.append_attribute("id").set_value((kRexsResult + result.name).c_str());
  if (!result.unit.empty()) node.append_attribute("unit").set_value(result.unit.c_str());
  const auto put = [](pugi::xml_node in, const std::string& words) {
    in.append_child(pugi::node_pcdata).set_value(words.c_str());
  };
  if (!result.word.empty()) {
    put(node, result.word);
  } else if (!result.list) {
    put(node, digits(path, result, result.values.at(0)));
  } else {
    pugi::xml_node array = node.append_child("array");
    for (const double value : result.values) put(array.append_child("c"), digits(path, result, value));
  }
}

std::string xml_with(const std::string& path, const std::string& bytes, int id,
                     const std::vector<RexsResult>& results) {
  pugi::xml_document document;
  document.load_buffer(bytes.data(), bytes.size(), pugi::parse_full | pugi::parse_ws_pcdata);
  for (pugi::xml_node& node : document.child("model").child("components").children("component")) {
    if (node.attribute("id").value() != std::to_string(id)) continue;
    remove_results(node);
    const std::string indent = is_blank(node.first_child()) ? node.first_child().value() : "";
    for (const RexsResult& result : results) add_result(path, node, result, indent);
  }
  for (pugi::xml_node node : document.children())
    if (node.type() == pugi::node_declaration && node.attribute("encoding"))
      node.attribute("encoding").set_value("UTF-8");
  // Line ends between nodes of the document are not kept by the parser.
  std::ostringstream out;
  for (const pugi::xml_node& node : document.children()) {
    node.print(out, "", pugi::format_raw, pugi::encoding_utf8);
    out << "\n";
  }
  return out.str();
}

// --- JSON: the attributes of the stage's component are put together anew from the bytes of those that stay

std::string json_result(const std::string& path, const RexsResult& result) {
  std::string out = text(
      "{\"id\": ", Json::valueToQuotedString((kRexsResult + result.name).c_str()),
      ", \"unit\": ", Json::valueToQuotedString(result.unit.empty() ? "none" : result.unit.c_str()), ", ");
  if (!result.word.empty())
    return out + "\"string\": " + Json::valueToQuotedString(result.word.c_str()) + "}";
  if (!result.list) return out + "\"floating_point\": " + digits(path, result, result.values.at(0)) + "}";
  std::string list;
  for (const double value : result.values) list += (list.empty() ? "" : ", ") + digits(path, result, value);
  return out + "\"floating_point_array\": [" + list + "]}";
}

std::string json_with(const std::string& path, const std::string& bytes, int id,
                      const std::vector<RexsResult>& results) {
  Json::CharReaderBuilder builder;
  builder["collectComments"] = false;
  Json::Value document;
  std::string why;
  const std::unique_ptr<Json::CharReader> reader(builder.newCharReader());
  reader->parse(bytes.data(), bytes.data() + bytes.size(), &document, &why);
  for (const Json::Value& node : document["model"]["components"]) {
    if (!node["id"].isConvertibleTo(Json::stringValue) || node["id"].asString() != std::to_string(id))
      continue;
    const Json::Value& attributes = node["attributes"];
    std::string inside;
    const auto add = [&](const std::string& attribute) {
      inside += (inside.empty() ? "" : ",\n") + attribute;
    };
    for (const Json::Value& attribute : attributes)
      if (!attribute["id"].isString() || !attribute["id"].asString().starts_with(kRexsResult))
        add(bytes.substr(static_cast<size_t>(attribute.getOffsetStart()),
                         static_cast<size_t>(attribute.getOffsetLimit() - attribute.getOffsetStart())));
    for (const RexsResult& result : results) add(json_result(path, result));
    if (attributes.isArray()) {
      const auto from = static_cast<size_t>(attributes.getOffsetStart()),
                 to = static_cast<size_t>(attributes.getOffsetLimit());
      return bytes.substr(0, from) + "[" + inside + "]" + bytes.substr(to);
    }
    // Without attributes: behind all else of the component.
    const auto end = static_cast<size_t>(node.getOffsetLimit()) - 1;
    return bytes.substr(0, end) + ", \"attributes\": [" + inside + "]" + bytes.substr(end);
  }
  fail(Failure::numerical, path, ": the stage ", id, " is not found again");
}

}  // namespace

std::string with_results(const std::string& path, const std::string& bytes, const std::string& stage,
                         const RexsPair& pair, const std::vector<RexsResult>& results) {
  const std::string text = rexs_text(path, bytes);
  const RexsModel model = parse_rexs(path, text);
  int id = -1;
  require_stage_of(model, stage, pair, id);
  const bool xml = text[text.find_first_not_of(" \t\r\n")] == '<';
  const std::string with = xml ? xml_with(path, text, id, results) : json_with(path, text, id, results);
  if (is_rexs_archive(bytes)) return archive_with_model(path, bytes, with);
  return (bytes.starts_with(kByteOrderMark) ? kByteOrderMark : "") + with;
}

bool holds_results(const std::string& path) {
  const RexsModel model = read_rexs(path);
  return std::any_of(model.components.begin(), model.components.end(), [](const auto& entry) {
    return std::any_of(entry.second.attributes.begin(), entry.second.attributes.end(),
                       [](const auto& attribute) { return attribute.first.starts_with(kRexsResult); });
  });
}

}  // namespace whine
