// Results beside a REXS model: what is written, what of the model stays, and what is not exported.
#include <doctest/doctest.h>

#include <limits>
#include <numbers>

#include "io/publish.h"
#include "io/rexs/results.h"
#include "refusal.h"
#include "rexs_models.h"

using namespace whine;

namespace {

constexpr double kAngle = 20 * std::numbers::pi / 180;
const RexsPair kPair{{30, 45}, {2.5e-3, 2.5e-3}, 94.5e-3, {kAngle, kAngle}, {0.25, 0.05}};

void replace_all(std::string& in, const std::string& what, const std::string& with) {
  for (size_t at = in.find(what); at != std::string::npos; at = in.find(what, at + with.size()))
    in.replace(at, what.size(), with);
}

std::vector<RexsResult> some_results(double stiffness = 420.5) {
  return {{"version", "none", {}, false, "a \"quoted\" <word> & more"},
          {"contact_ratio", "none", {1.619}},
          {"mesh_stiffness_mean", "N / mm", {stiffness, 1.0 / 3}, true},
          {"jumps", "Hz", {}, true}};
}

// Three stages: as handed on, driven by its second gear with a relief, and one of three of a gear unit with other names.
std::vector<std::pair<Gearbox, std::string>> stages() {
  Gearbox relieved = first_pair(), several = first_pair();
  set_stage_gear_data(relieved, 50, 11);
  set(relieved, 50, "is_driving_gear", "", "true");
  add_tip_relief(relieved, 51, "12.3", "79.1", {20, 21});
  for (const int id : {60, 61}) {
    several.parts.push_back({id, "cylindrical_stage", "Stage &amp; more", {}});
    several.links.push_back({"stage", {{"stage", id}, {"gear_1", 10}, {"gear_2", 11}}});
  }
  several.version = "2.0";
  for (ModelPart& part : several.parts)
    if (part.id == 11) part.name = "Rad größer";
  return {{first_pair(), ""}, {relieved, ""}, {several, "12"}};
}

std::string exported(const Folder& folder, const std::string& path, const std::string& name,
                     const std::string& stage, double stiffness = 420.5) {
  return folder.file(name, with_results(path, read_bytes(path), stage, kPair, some_results(stiffness)));
}

RexsPair pair_of(const RexsScene& scene) {
  return !contains(scene.text, "driver = \"wheel_b\"")
             ? kPair
             : RexsPair{{45, 30}, kPair.module, kPair.centre_distance, kPair.pressure_angle, {0.05, 0.25}};
}

}  // namespace

TEST_CASE("REXS: import, results, export and import again give the same scene, byte for byte, in all forms") {
  const Folder folder;
  for (const auto& [box, stage] : stages()) {
    const std::string as_xml = xml(box), as_json = json(box);
    for (const std::string& path :
         {folder.file("m.rexs", as_xml), folder.file("bom.rexs", "\xef\xbb\xbf" + as_xml),
          folder.file("m.rexsj", as_json),
          folder.zipped("m.rexsz", {{"a/m.rexs", as_xml}, {"picture.png", "?"}}),
          folder.zipped("j.rexsz", {{"m.rexsj", as_json}}, ZIP_CM_STORE)}) {
      CAPTURE(path);
      const std::string before = read_bytes(path);
      const RexsScene scene = scene_of_rexs(read_rexs(path), stage, 1);
      const std::string with =
          folder.file("with", with_results(path, before, stage, pair_of(scene), some_results()));
      CHECK(read_bytes(path) == before);
      CHECK(!holds_results(path));
      CHECK(holds_results(with));
      const RexsScene again = scene_of_rexs(read_rexs(with), stage, 1);
      CHECK(again.text == scene.text);
      CHECK(again.assumed == scene.assumed);
      CHECK(again.ignored == scene.ignored);
      // A second export replaces the first: the same bytes, whatever stood there.
      const std::string other =
          folder.file("other", with_results(path, before, stage, pair_of(scene), some_results(999)));
      CHECK(read_bytes(other) != read_bytes(with));
      CHECK(with_results(other, read_bytes(other), stage, pair_of(scene), some_results()) ==
            read_bytes(with));
    }
  }
}

TEST_CASE("REXS: results stand at the stage, with unit and nine digits; nothing else of the model changes") {
  const Folder folder;
  const Gearbox box = stages()[2].first;
  for (const std::string& path : {folder.file("m.rexs", xml(box)), folder.file("m.rexsj", json(box)),
                                  folder.zipped("m.rexsz", {{"m.rexs", xml(box)}, {"b.png", "picture"}})}) {
    CAPTURE(path);
    RexsModel before = read_rexs(path), after = read_rexs(exported(folder, path, "with", "12"));
    auto& results = after.components.at(12).attributes;
    CHECK(results.at("custom_whine_contact_ratio").value == "1.619");
    CHECK(results.at("custom_whine_contact_ratio").unit == "none");
    CHECK(results.at("custom_whine_version").value == "a \"quoted\" <word> & more");
    CHECK(results.at("custom_whine_mesh_stiffness_mean").list);
    CHECK(results.at("custom_whine_mesh_stiffness_mean").unit == "N / mm");
    CHECK(results.at("custom_whine_jumps").list);
    std::erase_if(results, [](const auto& a) { return a.first.starts_with(kRexsResult); });
    REQUIRE(after.components.size() == before.components.size());
    for (const auto& [id, component] : before.components) {
      const RexsComponent& same = after.components.at(id);
      CHECK(same.type == component.type);
      CHECK(same.name == component.name);
      REQUIRE(same.attributes.size() == component.attributes.size());
      for (const auto& [name, attribute] : component.attributes) {
        CHECK(same.attributes.at(name).value == attribute.value);
        CHECK(same.attributes.at(name).unit == attribute.unit);
      }
    }
    CHECK(after.relations.size() == before.relations.size());
    CHECK(after.load_cases.size() == before.load_cases.size());
  }
  // JSON keeps its bytes; of an archive the other entries stay.
  const std::string text = json(box), path = folder.file("m.rexsj", text),
                    with = read_bytes(exported(folder, path, "with", "12"));
  CHECK(!contains(with, "0.333333333, "));
  CHECK(contains(with, "[420.5, 0.333333333]"));
  // The attributes of the stage are put together anew: but for blanks within them the rest is one insertion.
  size_t begin = 0, end = 0;
  while (with[begin] == text[begin]) ++begin;
  while (end < text.size() && with[with.size() - 1 - end] == text[text.size() - 1 - end]) ++end;
  CHECK(begin + end > text.size() - 200);
  // XML: lines of the component keep their indentation.
  const std::string lines = read_bytes(exported(folder, folder.file("m.rexs", xml(box)), "with", "12"));
  CHECK(contains(lines, "\n<attribute id=\"custom_whine_contact_ratio\" unit=\"none\">1.619</attribute>\n"));
  CHECK(contains(lines, "<array><c>420.5</c><c>0.333333333</c></array>"));
}

TEST_CASE("REXS: exported JSON has no key twice, also where the stage's attributes are null or missing") {
  const Folder folder;
  Gearbox box = first_pair();
  unset(box, 12, "center_distance");
  for (const auto& [id, v] : {std::pair{10, "0"}, std::pair{11, "94.5"}})
    set(box, id, "support_vector", "mm", std::string("<array><c>0</c><c>") + v + "</c><c>0</c></array>");
  // The writer of tests knows no lists: of the XML's in place.
  std::string text = json(box);
  for (const char* v : {"0", "94.5"})
    replace_all(text, std::string("\"enum\" : \"<array><c>0</c><c>") + v + "</c><c>0</c></array>\"",
                std::string("\"floating_point_array\": [0, ") + v + ", 0]");
  const size_t stage = text.find("\"First stage\""), begin = text.rfind("\"attributes\"", stage),
               end = text.find(',', begin);
  REQUIRE(stage != std::string::npos);
  for (const char* attributes : {"\"attributes\" : null,", "\"attributes\" : [],", ""}) {
    CAPTURE(attributes);
    std::string changed = text;
    changed.replace(begin, end + 1 - begin, attributes);
    const std::string with = exported(folder, folder.file("m.rexsj", changed), "with", "");
    CHECK(holds_results(with));  // read_rexs rejects keys that stand twice
  }
}

TEST_CASE("REXS: results of another pair, of no stage, or that are no numbers are not exported") {
  const Folder folder;
  const Gearbox box = stages()[2].first;
  const std::string path = folder.file("m.rexs", xml(box));
  const auto said = [&](const std::string& stage, const RexsPair& pair) {
    return message_of_input([&] { with_results(path, read_bytes(path), stage, pair, some_results()); });
  };
  const auto changed = [](auto&& change) {
    RexsPair pair = kPair;
    change(pair);
    return pair;
  };
  CHECK(said("12", kPair) == "");
  CHECK(names(said("12", changed([](RexsPair& p) { p.teeth[1] = 46; })),
              {30, 45, "2.5", "94.5", 20, "0.25", "0.05", 46}));
  CHECK(names(said("12", changed([](RexsPair& p) { p.module[1] = 2e-3; })),
              {"2.5 and 2 mm", "2.5 mm", "results"}));
  CHECK(names(said("12", changed([](RexsPair& p) { p.centre_distance = 94.6e-3; })), {"94.5 mm", "94.6 mm"}));
  // The same teeth of the same module at the same distance, with the sum of the shifts shared otherwise.
  CHECK(names(said("12", changed([](RexsPair& p) { p.profile_shift = {0.15, 0.15}; })), {"0.15", "profile"}));
  CHECK(names(said("12", changed([](RexsPair& p) {
                     p.pressure_angle = {kAngle * 1.125, kAngle * 1.125};
                   })),
              {"22.5", "pressure"}));
  CHECK(names(said("", kPair), {"m.rexs", "--stage"}));
  CHECK(names(said("Ninth", kPair), {"Ninth"}));
  CHECK(names(said("60", kPair), {"center_distance"}));
  const std::string archive = folder.zipped("m.rexsz", {{"m.rexs", xml(box)}});
  std::string bytes = read_bytes(archive);
  bytes[60] = static_cast<char>(bytes[60] ^ 1);
  CHECK(names(message_of_input([&] { with_results(archive, bytes, "12", kPair, some_results()); }),
              {"encrypted", "damaged"}));
  CHECK(names(message_of_input([&] { with_results(path, "", "12", kPair, some_results()); }), {"empty"}));
  CHECK(failure_of([&] {
          with_results(path, read_bytes(path), "12", kPair,
                       {{"x", "none", {std::numeric_limits<double>::quiet_NaN()}}});
        }) == Failure::numerical);
}

TEST_CASE("REXS: the stage is found by the number of its id, however it is written") {
  const Folder folder;
  std::string as_xml = xml(first_pair()), as_json = json(first_pair());
  replace_all(as_xml, "id=\"12\"", "id=\"012\"");
  // Two spellings of one number: that of the component and that of the reference.
  const size_t at = as_json.rfind("\"id\"", as_json.find("\"cylindrical_stage\""));
  const size_t begin = as_json.find("12", at);
  REQUIRE(begin < as_json.find("\n", at));
  as_json.replace(begin, 2, "\"0012\"");
  for (const std::string& path : {folder.file("m.rexs", as_xml), folder.file("m.rexsj", as_json)}) {
    CAPTURE(path);
    const std::string with = exported(folder, path, "with", "");
    CHECK(holds_results(with));
    CHECK(read_rexs(with).components.at(12).attributes.contains("custom_whine_contact_ratio"));
  }
}

TEST_CASE("REXS: XML of an encoding that is not converted, or with entities, is not written anew") {
  const Folder folder;
  const auto with_head = [&](const std::string& head, const std::string& name) {
    std::string out = xml(first_pair());
    replace_all(out, "<?xml version=\"1.0\" encoding=\"UTF-8\"?>", head);
    replace_all(out, "First stage", name);
    return folder.file("m.rexs", out);
  };
  const auto said = [&](const std::string& path) {
    return message_of_input([&] { with_results(path, read_bytes(path), "", kPair, some_results()); });
  };
  const auto declared = [](const std::string& encoding) {
    return "<?xml version=\"1.0\" encoding=\"" + encoding + "\"?>";
  };
  CHECK(names(said(with_head(declared("windows-1252"),
                             "R\xe4"
                             "der")),
              {"windows-1252", "characters"}));
  CHECK(names(said(with_head(declared("US-ASCII"),
                             "R\xe4"
                             "der")),
              {"model", "UTF-8"}));
  const std::string ascii = with_head(declared("windows-1252"), "Wheels");
  CHECK(contains(read_bytes(exported(folder, ascii, "with", "")), "encoding=\"UTF-8\""));
  const std::string latin = with_head(declared("ISO-8859-1"),
                                      "R\xe4"
                                      "der");
  const std::string with = read_bytes(exported(folder, latin, "with", ""));
  CHECK(contains(with, "encoding=\"UTF-8\""));
  CHECK(contains(with,
                 "R\xc3\xa4"
                 "der"));
  CHECK(names(said(with_head(declared("UTF-8") + "<!DOCTYPE model [<!ENTITY unit \"mm\">]>", "Wheels")),
              {"entities", "defines"}));
  CHECK(said(with_head(declared("UTF-8") + "<!DOCTYPE model>", "Wheels")) == "");
}
