// REXS models for tests, written here after the published schema, in each of their forms.
#pragma once
#include <doctest/doctest.h>
#include <jsoncpp/json/json.h>
#include <unistd.h>
#include <zip.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "base/error.h"
#include "io/rexs/rexs.h"
#include "io/rexs/scene.h"
#include "io/scene.h"
#include "own_folder.h"
#include "refusal.h"

namespace whine {

struct ModelPart {
  int id;
  std::string type, name;
  std::vector<std::array<std::string, 3>> attributes;  // id, unit, value
};
struct Link {
  std::string type;
  std::vector<std::pair<std::string, int>> refs;
};
struct Gearbox {
  std::string version = "1.4";
  std::vector<ModelPart> parts;
  std::vector<Link> links;
  std::vector<ModelPart> load;  // of one load case
};

// The pair of data/scenes/first-pair.toml, with the values that a model of a gearbox has.
inline Gearbox first_pair() {
  Gearbox box;
  const auto flank = [](int id, const char* shift) {
    return ModelPart{
        id,
        "cylindrical_gear_flank",
        "",
        {{"normal_pressure_angle", "deg", "20"}, {"addendum_modification_coefficient", "", shift}}};
  };
  box.parts = {{1, "gear_unit", "Unit", {}},
               {10,
                "cylindrical_gear",
                "Pinion A",
                {{"number_of_teeth", "", "30"},
                 {"normal_module", "mm", "2.5"},
                 {"face_width", "mm", "20"},
                 {"inner_diameter", "mm", "40"},
                 {"helix_angle_reference_diameter", "deg", "0"}}},
               {11,
                "cylindrical_gear",
                "Wheel B",
                {{"number_of_teeth", "none", "45"},
                 {"normal_module", "mm", "2.5"},
                 {"face_width", "mm", "20"},
                 {"inner_diameter", "mm", "60"}}},
               {12, "cylindrical_stage", "First stage", {{"center_distance", "mm", "94.5"}}},
               flank(20, "0.25"),
               flank(21, "0.25"),
               flank(22, "0.05"),
               flank(23, "0.05"),
               {30,
                "rack_shaped_tool",
                "Tool",
                {{"addendum_coefficient_reference_profile", "", "1.25"},
                 {"dedendum_coefficient_reference_profile", "", "1"},
                 {"tip_radius_factor", "", "0.38"}}},
               {31,
                "material",
                "Steel",
                {{"elastic_modulus", "N / mm^2", "206000"},
                 {"poisson_ratio", "", "0.3"},
                 {"density", "kg / dm^3", "7.85"}}},
               {40, "shaft", "Input", {}},
               {41, "external_load", "Load", {}}};
  box.links = {{"stage", {{"stage", 12}, {"gear_1", 10}, {"gear_2", 11}}},
               {"flank", {{"gear", 10}, {"left", 20}, {"right", 21}}},
               {"flank", {{"gear", 11}, {"left", 22}, {"right", 23}}},
               {"manufacturing_step", {{"workpiece", 10}, {"tool", 30}}},
               {"manufacturing_step", {{"workpiece", 11}, {"tool", 30}}},
               {"reference", {{"origin", 10}, {"referenced", 31}}},
               {"reference", {{"origin", 11}, {"referenced", 31}}},
               {"assembly", {{"assembly", 40}, {"part", 10}}},
               {"assembly", {{"assembly", 40}, {"part", 41}}}};
  box.load = {{40, "shaft", "Input", {{"rotational_speed", "1 / min", "6000"}}},
              {41, "external_load", "Load", {{"torque_around_u_axis", "N m", "-60"}}}};
  return box;
}

// Three planets of 28 teeth between a sun of 20 and a ring of 76, which a coupling holds in the casing; 300 N m and 1500 1/min at the
// sun. A mesh has 100 N m, and 1500 / 60 * 20 * 76 / 96 = 395.83 Hz against the carrier. As programs for gearboxes write it: no profile
// shifts of sun and ring, no tip diameters, a hob that is deeper than the teeth.
inline Gearbox planetary(int planets = 3, double first_angle_deg = 0) {
  Gearbox box;
  const auto gear = [&](int id, const std::string& type, const std::string& name, int teeth) {
    box.parts.push_back({id,
                         type,
                         name,
                         {{"number_of_teeth", "none", std::to_string(teeth)},
                          {"normal_module", "mm", "2.5"},
                          {"face_width", "mm", "20"}}});
    for (const int flank : {id + 500, id + 600})
      box.parts.push_back({flank, "cylindrical_gear_flank", "", {{"normal_pressure_angle", "deg", "20"}}});
    box.links.push_back({"flank", {{"gear", id}, {"left", id + 500}, {"right", id + 600}}});
  };
  const auto shaft = [&](int id, const std::string& name, int part) {
    box.parts.push_back({id, "shaft", name, {}});
    if (part > 0) box.links.push_back({"assembly", {{"assembly", id}, {"part", part}}});
  };
  box.parts = {{1, "gear_unit", "Unit", {}},
               {2, "gear_casing", "Casing", {}},
               {3, "planet_carrier", "Carrier", {}},
               {9, "planetary_stage", "Planetary stage", {}},
               {8, "switchable_coupling", "Brake", {}},
               {7, "external_load", "Motor", {{"torque_around_u_axis", "N m", "300"}}},
               {30,
                "rack_shaped_tool",
                "Hob",
                {{"addendum_coefficient_reference_profile", "", "1.25"},
                 {"dedendum_coefficient_reference_profile", "", "1.3"},
                 {"tip_radius_factor", "", "0.38"}}}};
  gear(10, "cylindrical_gear", "Sun", 20);
  gear(11, "ring_gear", "Ring", 76);
  shaft(40, "Sun shaft", 10);
  shaft(41, "Ring shaft", 11);
  shaft(42, "Carrier shaft", 0);
  box.parts[box.parts.size() - 3].attributes.push_back({"rotational_speed", "1 / min", "1500"});
  box.links.push_back({"assembly", {{"assembly", 40}, {"part", 7}}});
  box.links.push_back({"assembly", {{"assembly", 9}, {"part", 3}}});
  box.links.push_back({"planet_carrier_shaft", {{"planetary_stage", 9}, {"shaft", 42}}});
  box.links.push_back({"side", {{"outer_part", 2}, {"inner_part", 41}, {"assembly", 8}}});
  box.links.push_back({"manufacturing_step", {{"workpiece", 10}, {"tool", 30}}});
  for (int n = 0; n < planets; ++n) {
    const int planet = 20 + n, sun_mesh = 50 + n, ring_mesh = 60 + n;
    gear(planet, "cylindrical_gear", "Planet " + std::to_string(n), 28);
    shaft(43 + n, "", planet);
    box.parts.push_back({sun_mesh,
                         "cylindrical_stage",
                         "Sun " + std::to_string(n),
                         {{"center_distance", "mm", "60"},
                          {"rotating_angle_around_neg_u_axis", "deg",
                           std::to_string(first_angle_deg - 360.0 * n / planets)}}});
    box.parts.push_back(
        {ring_mesh, "cylindrical_stage", "Ring " + std::to_string(n), {{"center_distance", "mm", "60"}}});
    box.links.push_back({"stage", {{"stage", sun_mesh}, {"gear_1", 10}, {"gear_2", planet}}});
    box.links.push_back({"stage", {{"stage", ring_mesh}, {"gear_1", planet}, {"gear_2", 11}}});
    for (const int mesh : {sun_mesh, ring_mesh})
      box.links.push_back({"assembly", {{"assembly", 9}, {"part", mesh}}});
    box.links.push_back({"planet_shaft", {{"planetary_stage", 9}, {"shaft", 43 + n}}});
    box.links.push_back({"manufacturing_step", {{"workpiece", planet}, {"tool", 30}}});
    for (const int flank : {planet + 500, planet + 600})
      for (ModelPart& part : box.parts)
        if (part.id == flank) part.attributes.push_back({"addendum_modification_coefficient", "", "0"});
  }
  return box;
}

inline std::string xml_parts(const std::vector<ModelPart>& parts) {
  std::string out;
  for (const ModelPart& part : parts) {
    out += "<component id=\"" + std::to_string(part.id) + "\" type=\"" + part.type + "\" name=\"" +
           part.name + "\">\n";
    for (const auto& [id, unit, value] : part.attributes)
      out += "<attribute id=\"" + id + "\" unit=\"" + unit + "\">" + value + "</attribute>\n";
    out += "</component>\n";
  }
  return out;
}

inline std::string xml(const Gearbox& box) {
  std::string out =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<model version=\"" + box.version + "\">\n<relations>\n";
  for (size_t i = 0; i < box.links.size(); ++i) {
    out += "<relation id=\"" + std::to_string(100 + i) + "\" type=\"" + box.links[i].type + "\">";
    for (const auto& [role, id] : box.links[i].refs)
      out += "<ref id=\"" + std::to_string(id) + "\" role=\"" + role + "\"/>";
    out += "</relation>\n";
  }
  out += "</relations>\n<components>\n" + xml_parts(box.parts) + "</components>\n";
  if (!box.load.empty())
    out += "<load_spectrum id=\"1\"><load_case id=\"1\">" + xml_parts(box.load) +
           "</load_case></load_spectrum>\n";
  return out + "</model>\n";
}

inline Json::Value json_parts(const std::vector<ModelPart>& parts) {
  Json::Value out(Json::arrayValue);
  for (const ModelPart& part : parts) {
    Json::Value node;
    node["id"] = part.id;
    node["type"] = part.type;
    node["name"] = part.name;
    node["attributes"] = Json::Value(Json::arrayValue);
    for (const auto& [id, unit, value] : part.attributes) {
      Json::Value attribute;
      attribute["id"] = id;
      attribute["unit"] = unit;
      char* end = nullptr;
      const double number = std::strtod(value.c_str(), &end);
      if (*end == '\0')
        attribute["floating_point"] = number;
      else if (value == "true" || value == "false")
        attribute["boolean"] = value == "true";
      else
        attribute["enum"] = value;
      node["attributes"].append(attribute);
    }
    out.append(node);
  }
  return out;
}

inline std::string json(const Gearbox& box) {
  Json::Value root;
  Json::Value& model = root["model"];
  model["version"] = box.version;
  model["components"] = json_parts(box.parts);
  for (size_t i = 0; i < box.links.size(); ++i) {
    Json::Value relation;
    relation["id"] = static_cast<int>(100 + i);
    relation["type"] = box.links[i].type;
    for (const auto& [role, id] : box.links[i].refs) {
      Json::Value ref;
      ref["id"] = id;
      ref["role"] = role;
      relation["refs"].append(ref);
    }
    model["relations"].append(relation);
  }
  Json::Value load_case;
  load_case["id"] = 1;
  load_case["components"] = json_parts(box.load);
  model["load_spectrum"]["load_cases"].append(load_case);
  return Json::writeString(Json::StreamWriterBuilder(), root);
}

class Folder : public TemporaryFolder {
 public:
  std::string zipped(const std::string& name, const std::vector<std::pair<std::string, std::string>>& entries,
                     int method = ZIP_CM_DEFAULT) const {
    const std::string path = *this / name;
    zip_t* archive = zip_open(path.c_str(), ZIP_CREATE | ZIP_TRUNCATE, nullptr);
    REQUIRE(archive != nullptr);
    for (const auto& [entry, bytes] : entries) {
      const auto at =
          zip_file_add(archive, entry.c_str(), zip_source_buffer(archive, bytes.data(), bytes.size(), 0), 0);
      REQUIRE(at >= 0);
      zip_set_file_compression(archive, static_cast<zip_uint64_t>(at), method, 0);
    }
    REQUIRE(zip_close(archive) == 0);
    return path;
  }
};

inline Scene imported(const Folder& folder, const std::string& model, const std::string& stage = "") {
  return read_scene(folder.file("imported.toml", scene_of_rexs(read_rexs(model), stage, 1).text));
}

inline void set(Gearbox& box, int id, const std::string& attribute, const std::string& unit,
                const std::string& value) {
  for (ModelPart& part : box.parts) {
    if (part.id != id) continue;
    std::erase_if(part.attributes, [&](const auto& a) { return a[0] == attribute; });
    part.attributes.push_back({attribute, unit, value});
  }
}

// A component that says something of a gear within the stage.
inline void set_stage_gear_data(Gearbox& box, int id, int gear) {
  box.parts.push_back({id, "cylindrical_stage_gear_data", "", {}});
  box.links.push_back({"stage_gear_data", {{"stage", 12}, {"gear", gear}, {"stage_gear_data", id}}});
}

// In um and mm; of these flanks.
inline void add_tip_relief(Gearbox& box, int id, const std::string& depth, const std::string& diameter,
                           std::initializer_list<int> flanks) {
  box.parts.push_back({id,
                       "tip_relief",
                       "",
                       {{"tip_relief_depth", "mum", depth}, {"tip_relief_datum_diameter", "mm", diameter}}});
  for (const int flank : flanks) box.links.push_back({"reference", {{"origin", flank}, {"referenced", id}}});
}

inline bool says(const std::vector<std::string>& remarks, const std::string& words) {
  return std::any_of(remarks.begin(), remarks.end(),
                     [&](const std::string& remark) { return contains(remark, words); });
}

inline std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

inline void unset(Gearbox& box, int id, const std::string& attribute) {
  for (ModelPart& part : box.parts)
    if (part.id == id) std::erase_if(part.attributes, [&](const auto& a) { return a[0] == attribute; });
}

}  // namespace whine
