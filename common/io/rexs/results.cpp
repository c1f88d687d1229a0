#include "io/rexs/results.h"

#include <jsoncpp/json/json.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <cstdio>
#include <pugixml.hpp>
#include <sstream>

#include "base/error.h"
#include "base/tool.h"
#include "base/units.h"
#include "io/publish.h"
#include "io/rexs/archive.h"
#include "io/rexs/json.h"
#include "io/rexs/stage.h"

namespace whine {
namespace {

// Nine digits: fewer than round-off has, so that other machines write the same.
std::string nine_digits(const std::string& path, const RexsResult& result, double value) {
  if (!std::isfinite(value))
    fail(Failure::numerical, path, ": the result ", result.name, " is no finite number");
  char buffer[40];
  std::snprintf(buffer, sizeof buffer, "%.9g", value);
  return buffer;
}

void require_stage_of(const RexsModel& model, const std::string& wanted, const RexsPair& pair, int& id) {
  RexsReader reader(model, 1);
  id = chosen_stage(reader, wanted);
  if (reader.component(id).type != "cylindrical_stage")
    fail(Failure::input, model.path, ": ", quoted_name(reader.component(id)),
         " is a system, and results are exported of pairs; give one of its cylindrical stages");
  const RexsStage stage = stage_of(reader, id);
  constexpr double kSame = 1e-9;  // relative: what rounding to the digits of a file leaves
  const auto same = [](double a, double b) { return std::abs(a - b) <= kSame * std::abs(b); };
  const std::array<RexsNumber, 2> shifts = profile_shifts(reader, stage);
  const double distance = centre_distance(reader, stage).value * 1e-3;
  std::array<double, 2> teeth, module, angle, shift;
  for (size_t g = 0; g < 2; ++g) {
    const int gear = stage.gear[g];
    teeth[g] = teeth_of(reader, gear).value;
    module[g] = reader.required(reader.component(gear), "normal_module", kRexsMillimetre).value * 1e-3;
    angle[g] = pressure_angle_of(reader, gear).value * kOneDegree;
    shift[g] = shifts[g].value;
  }
  const auto fits = [&](size_t first, size_t second) {
    for (const auto& [g, of_pair] : {std::pair{first, size_t{0}}, std::pair{second, size_t{1}}})
      if (!same(teeth[g], pair.teeth[of_pair]) || !same(module[g], pair.module[of_pair]) ||
          !same(angle[g], pair.pressure_angle[of_pair]) ||
          !(std::abs(shift[g] - pair.profile_shift[of_pair]) <= kSame))
        return false;
    return true;
  };
  const auto words = [](const auto& z, const auto& m, double a, const auto& alpha, const auto& x) {
    return text(z[0], " and ", z[1], " teeth of module ", 1e3 * m[0],
                m[1] == m[0] ? "" : text(" and ", 1e3 * m[1]), " mm at ", 1e3 * a, " mm, pressure angles ",
                kInDegrees * alpha[0], " and ", kInDegrees * alpha[1], " deg, profile shifts ", x[0], " and ",
                x[1]);
  };
  if (!(fits(0, 1) || fits(1, 0)) || !same(distance, pair.centre_distance))
    fail(Failure::input, model.path, ": ", quoted_name(reader.component(id)), " has ",
         words(teeth, module, distance, angle, shift), "; the results are of ",
         words(pair.teeth, pair.module, pair.centre_distance, pair.pressure_angle, pair.profile_shift),
         ": give the model or the stage that the scene was imported from");
}

[[noreturn]] void reject_lost_stage(const std::string& path, int id) {
  fail(Failure::numerical, path, ": the component ", id,
       " of the stage is not found a second time; save the model anew with the program that wrote it");
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
    put(node, nine_digits(path, result, result.values.at(0)));
  } else {
    pugi::xml_node array = node.append_child("array");
    for (const double value : result.values) put(array.append_child("c"), nine_digits(path, result, value));
  }
}

// pugixml converts UTF-8 and ISO 8859-1 and takes all else for UTF-8.
void require_convertible(const std::string& path, const std::string& bytes, pugi::xml_document& document) {
  const bool ascii =
      std::all_of(bytes.begin(), bytes.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; });
  for (const pugi::xml_node& node : document.children()) {
    std::string encoding = node.attribute("encoding").value();
    for (char& c : encoding) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    constexpr std::array kConverted{"", "utf-8", "utf8", "iso-8859-1", "latin1"};
    if (node.type() == pugi::node_declaration && !ascii &&
        std::find(kConverted.begin(), kConverted.end(), encoding) == kConverted.end())
      fail(Failure::input, path, ": its XML is in ", printable(encoding, 40),
           " with characters beyond ASCII, which is not converted; save the model as UTF-8 and export again");
    if (node.type() == pugi::node_doctype && std::string(node.value()).find("<!ENTITY") != std::string::npos)
      fail(
          Failure::input, path,
          ": its XML defines entities (<!ENTITY), which would not stay as they are; save the model without a DOCTYPE and export again");
  }
}

std::string xml_with(const std::string& path, const std::string& bytes, int id,
                     const std::vector<RexsResult>& results) {
  pugi::xml_document document;
  document.load_buffer(bytes.data(), bytes.size(), pugi::parse_full | pugi::parse_ws_pcdata);
  require_convertible(path, bytes, document);
  bool found = false;
  for (pugi::xml_node& node : document.child("model").child("components").children("component")) {
    // By the number: "012" is 12.
    if (rexs_id(path, node.attribute("id").value(), "component") != id) continue;
    found = true;
    remove_results(node);
    const std::string indent = is_blank(node.first_child()) ? node.first_child().value() : "";
    for (const RexsResult& result : results) add_result(path, node, result, indent);
  }
  if (!found) reject_lost_stage(path, id);
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
  if (!result.list)
    return out + "\"floating_point\": " + nine_digits(path, result, result.values.at(0)) + "}";
  std::string list;
  for (const double value : result.values)
    list += (list.empty() ? "" : ", ") + nine_digits(path, result, value);
  return out + "\"floating_point_array\": [" + list + "]}";
}

std::string json_with(const std::string& path, const std::string& bytes, int id,
                      const std::vector<RexsResult>& results) {
  const Json::Value document = rexs_json(path, bytes);
  for (const Json::Value& node : document["model"]["components"]) {
    if (rexs_id(path, node["id"].asString(), "component") != id) continue;
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
    // Also a null, which is no list, is replaced: a key stands once.
    if (node.isMember("attributes")) {
      const auto from = static_cast<size_t>(attributes.getOffsetStart()),
                 to = static_cast<size_t>(attributes.getOffsetLimit());
      return bytes.substr(0, from) + "[" + inside + "]" + bytes.substr(to);
    }
    // Without attributes: behind all else of the component.
    const auto end = static_cast<size_t>(node.getOffsetLimit()) - 1;
    return bytes.substr(0, end) + ", \"attributes\": [" + inside + "]" + bytes.substr(end);
  }
  reject_lost_stage(path, id);
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
