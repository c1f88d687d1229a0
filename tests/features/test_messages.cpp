// What a scene's author is told: keys by their meaning, forms of numbers, diameters of a drawing.
#include <doctest/doctest.h>

#include <cmath>
#include <fstream>

#include "base/tool.h"
#include "base/visible.h"
#include "gear/involute.h"
#include "gear/scene_geometry.h"
#include "io/scene.h"
#include "io/variant.h"
#include "refusal.h"
#include "relative.h"
#include "report/gnuplot.h"
#include "report/html.h"
#include "scene_file.h"

using namespace whine;

TEST_CASE("an unknown key is rejected with the key that its word means") {
  SceneFile file;
  const auto rejection = [&](const std::string& line) {
    return file.rejection(scene_with("teeth = 50\n", "teeth = 50\n" + line + "\n"));
  };
  CHECK(names(rejection("width_mm = 20"), {"x.toml:3", "width_mm", "[gear.pinion]", "face_width_mm"}));
  CHECK(names(rejection("tip_releif = 10"), {"tip_relief_um", "[gear.<name>.modification]"}));
  CHECK(names(rejection("tip_releif_um = 10"), {"tip_relief_um", "[gear.<name>.modification]"}));
  CHECK(names(rejection("bore_diameter_mm = 20"), {"bore_radius_mm"}));
  CHECK(names(rejection("outside_diameter = 20"), {"tip_diameter_mm"}));
  CHECK(names(rejection("number_of_teeth = 20"), {"teeth"}));
  CHECK(names(rejection("Inertia = 20"), {"total_inertia_kgm2"}));
  CHECK(names(rejection("normal_module_mm = 3"), {"module_mm"}));
  CHECK(names(rejection("x = 3"), {"profile_shift"}));
  CHECK(names(rejection("torque = 3"), {"torque_Nm", "[operation]"}));
  CHECK(names(rejection("torque_Nmm = 3000"), {"torque_Nm", "[operation]", 1, 1000}));
  CHECK(names(rejection("bearing_stiffness = 3000"), {"stiffness_N_um", "[[bearing]]"}));
  CHECK(names(rejection("helix_angle = 15"), {"x.toml:3", "helix_angle_deg", "[gear.pinion]"}));
  CHECK(names(rejection("friction_coefficient = 0.05"), {"coefficient", "[friction]"}));
  // --set and studies take the same words.
  const auto set = [&](const std::string& change) -> std::string {
    return message_of([&] { scene_variant(file.path(kScene), {change}); });
  };
  CHECK(names(set("width_mm=20"), {"face_width_mm"}));
  CHECK(names(set("gear.pinion.bore_diameter_mm=20"), {"gear.pinion.bore_radius_mm"}));
  CHECK(names(set("helix_angle=20"), {"helix_angle_deg"}));
}

TEST_CASE("sentences.tsv: each change of a scene is refused with its sentence") {
  const SceneFile file;
  std::ifstream table("tests/features/sentences.tsv");
  int rows = 0;
  for (std::string line; std::getline(table, line);) {
    if (line.starts_with('#')) continue;
    std::vector<std::string> cells(1);
    for (size_t i = 0; i < line.size(); ++i)
      if (line[i] == '\t')
        cells.emplace_back();
      else if (cells.size() < 3 && line.compare(i, 2, "\\n") == 0)
        cells.back() += '\n', ++i;
      else
        cells.back() += line[i];
    REQUIRE(cells.size() == 3);
    CHECK(file.rejection(cells[0].empty() ? with_section(cells[1]) : scene_with(cells[0], cells[1])) ==
          cells[2]);
    ++rows;
  }
  CHECK(rows > 60);
}

TEST_CASE("a number may be written as a whole float; a decimal comma and a number in quotes are named") {
  SceneFile file;
  CHECK(file.read(scene_with("teeth = 50", "teeth = 50.0")).gears[0].design.teeth == 50);
  CHECK(file.read(scene_with("teeth = 50", "teeth = 5e1")).gears[0].design.teeth == 50);
  CHECK(body_parameters(file.read(scene_with("teeth = 50", "teeth = 50.0")), "pinion") ==
        body_parameters(file.read(kScene), "pinion"));
  const std::string comma = file.rejection(scene_with("module_mm = 3", "module_mm = 2,5"));
  CHECK(names(comma, {"x.toml:3"}));
  CHECK(names(comma, {"2.5", 2, 5}));
  const auto torques = [&](const std::string& list) {
    return scene_with("torque_Nm = [100, 150]", "torque_Nm = " + list);
  };
  CHECK(names(file.rejection(torques("[1624,77, 800]")), {1624, 77, "1624.77"}));
  for (const char* list :
       {"[1624, 77, 800]", "[1624,77,800]", "[1624.5,77, 800]", "[100,\n150,\n200]", "[1624,77]"}) {
    CAPTURE(list);
    CHECK_NOTHROW(file.read(torques(list)));
  }
  // Between brackets a comma parts numbers, and other mistakes get no such advice.
  CHECK(!contains(file.rejection(scene_with("[100, 150]", "[100,150")), "decimal"));
  CHECK(!contains(file.rejection(scene_with("module_mm = 3", "module_mm = ")), "decimal"));
  CHECK(!contains(file.rejection(scene_with("plane = \"stress\"", "plane = \"2,5\"")), "decimal"));
}

TEST_CASE("diameters of tip and root stand for addendum and dedendum") {
  SceneFile file;
  const std::string shifted = scene_with("teeth = 50\n", "teeth = 50\nprofile_shift = 0.25\n");
  const auto with = [&](const std::string& lines) {
    std::string scene = shifted;
    return scene.replace(scene.find("teeth = 50\n"), 11, "teeth = 50\n" + lines);
  };
  // r_tip = m (z / 2 + x + addendum), r_root = m (z / 2 + x - dedendum)
  CHECK(body_parameters(file.read(with("tip_diameter_mm = 157.5\nroot_diameter_mm = 144\n")), "pinion") ==
        body_parameters(file.read(with("addendum = 1.0\ndedendum = 1.25\n")), "pinion"));
  const GearDesign d =
      file.read(with("tip_diameter_mm = 157.1234\nroot_diameter_mm = 143.21\n")).gears[0].design;
  const ToothGeometry tooth(d);
  CHECK(2 * tooth.tip_radius() == relative(0.1571234, 1e-13));
  CHECK(2 * tooth.root_radius() == relative(0.14321, 1e-13));
  // A gear that is like another takes them over as it takes the heights over.
  CHECK(file.read(with("tip_diameter_mm = 157.5\n")).gears[1].design.addendum == 1.0);

  CHECK(names(file.rejection(with("tip_diameter_mm = 157.5\naddendum = 1.0\n")),
              {"tip_diameter_mm", "addendum"}));
  CHECK(names(file.rejection(with("root_diameter_mm = 144\ndedendum = 1.0\n")),
              {"root_diameter_mm", "dedendum"}));
  CHECK(names(file.rejection(with("tip_diameter_mm = 151.5\n")),
              {"x.toml:3", "tip_diameter_mm", "[gear.pinion]", "151.5", 50, "module_mm", 3, "profile_shift",
               "0.25", "169.5"}));
  CHECK(names(file.rejection(with("root_diameter_mm = 133.4\n")), {"133.5", "151.5"}));
  std::string other = with("tip_diameter_mm = 157.5\n");
  other.replace(other.find("like = \"pinion\""), 15, "like = \"pinion\"\nteeth = 51");
  CHECK(names(file.rejection(other), {"[gear.wheel]", "tip_diameter_mm", "157.5"}));
  other.replace(other.find("teeth = 51"), 10, "teeth = 51\naddendum = 0.9");
  CHECK(file.read(other).gears[1].design.addendum == 0.9);
}

TEST_CASE("texts of files are printed as whole characters of UTF-8, with hidden characters by their names") {
  CHECK(printable("Größe 3 µm: β → 𝛽") == "Größe 3 µm: β → 𝛽");
  CHECK(printable("a\tb\x1b[31m\x7f\xc2\x9b") == "a b<U+001B>[31m<U+007F><U+009B>");
  // What turns the order of letters or shows nothing, on terminals, pages and figures alike.
  const std::string turned = "gear\xe2\x80\xaeraeg\xe2\x81\xa6\xd8\x9c\xef\xbb\xbf",
                    shown = "gear<U+202E>raeg<U+2066><U+061C><U+FEFF>";
  CHECK(printable(turned) == shown);
  CHECK(html::escaped(turned + "<b>") ==
        "gear&lt;U+202E&gt;raeg&lt;U+2066&gt;&lt;U+061C&gt;&lt;U+FEFF&gt;&lt;b&gt;");
  CHECK(gnuplot_string(turned) == "'" + shown + "'");
  Figure figure;
  figure.title = turned;
  figure.blocks = {{"block", {"x [1]"}, {{1}}}};
  CHECK(tables(figure, {}).at(0).text.starts_with("# " + shown + "\n"));
  CHECK(visible("a\nb\tc \xd7\xa9 \xd8\xb4") == "a\nb\tc \xd7\xa9 \xd8\xb4");
  // Cut off, too long for its number, a surrogate, above U+10FFFF, no beginning.
  CHECK(printable("\xc3") == "?");
  CHECK(printable("\xe2\x82z") == "??z");
  CHECK(printable("\xc0\xaf\xe0\x80\xaf") == "?????");
  CHECK(printable("\xed\xa0\x80") == "???");
  CHECK(printable("\xf4\x90\x80\x80\xf9\x80\x80\x80") == "????????");
  CHECK(printable("\x80\xbf") == "??");
  CHECK(printable("\xed\x9f\xbf\xee\x80\x80\xf4\x8f\xbf\xbf") == "\xed\x9f\xbf\xee\x80\x80\xf4\x8f\xbf\xbf");
  // What is long loses its middle between characters.
  CHECK(printable("abcdefgh", 4) == "ab ... gh");
  for (size_t most = 1; most < 20; ++most) {
    const std::string cut = printable("xüüüü€€€𝛽𝛽𝛽", most);
    CHECK(printable(cut) == cut);
    CHECK(cut.size() <= most + 8);
  }
}
