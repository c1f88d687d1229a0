// What a scene's author is told: keys by their meaning, forms of numbers, diameters of a drawing.
#include <doctest/doctest.h>

#include <cmath>

#include "base/tool.h"
#include "base/visible.h"
#include "gear/involute.h"
#include "gear/scene_geometry.h"
#include "io/scene.h"
#include "io/variant.h"
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
  CHECK(contains(rejection("width_mm = 20"),
                 "x.toml:3: unknown key 'width_mm' in [gear.pinion]; did you mean 'face_width_mm'?"));
  CHECK(
      contains(rejection("tip_releif = 10"), "did you mean 'tip_relief_um' of [gear.<name>.modification]?"));
  CHECK(contains(rejection("tip_releif_um = 10"),
                 "did you mean 'tip_relief_um' of [gear.<name>.modification]?"));
  CHECK(
      contains(rejection("bore_diameter_mm = 20"), "did you mean 'bore_radius_mm' (half of the diameter)?"));
  CHECK(contains(rejection("outside_diameter = 20"), "did you mean 'tip_diameter_mm'?"));
  CHECK(contains(rejection("number_of_teeth = 20"), "did you mean 'teeth'?"));
  CHECK(contains(rejection("Inertia = 20"), "did you mean 'total_inertia_kgm2'?"));
  CHECK(contains(rejection("normal_module_mm = 3"), "did you mean 'module_mm'?"));
  CHECK(contains(rejection("x = 3"), "did you mean 'profile_shift' (in modules)?"));
  CHECK(contains(rejection("torque = 3"), "did you mean 'torque_Nm' of [operation]?"));
  CHECK(contains(
      file.rejection(with_section("[gear.wheel.modification]\ntip_releif = 10\n")),
      "x.toml:24: unknown key 'tip_releif' in [gear.wheel.modification]; did you mean 'tip_relief_um'?"));
  CHECK(contains(
      file.rejection(with_section("[gear.weel.modification]\ntip_relief_um = 10\n")),
      "x.toml:23: [gear.weel.modification]: there is no [gear.weel] with teeth; did you mean 'wheel'?"));
  CHECK(contains(rejection("torque_Nmm = 3000"),
                 "did you mean 'torque_Nm' of [operation] (1 N m is 1000 N mm)?"));
  CHECK(contains(rejection("bearing_stiffness = 3000"), "did you mean 'stiffness_N_um' of [[bearing]]?"));
  CHECK(contains(file.rejection(scene_with("[operation]\n", "[operation]\nspeed_rpm = 3000\n")),
                 "did you mean 'mesh_frequency_Hz' (teeth of the driver times its rpm, over 60)?"));
  // What there is no key for says why.
  CHECK(contains(rejection("helix_angle_deg = 15"),
                 "x.toml:3: unknown key 'helix_angle_deg' in [gear.pinion]: gears are spur gears for now"));
  CHECK(contains(rejection("friction_coefficient = 0.05"), "did you mean 'coefficient' of [friction]?"));
  // --set and studies take the same words.
  const auto set = [&](const std::string& change) -> std::string {
    try {
      scene_variant(file.path(kScene), {change});
    } catch (const Error& error) {
      return error.what();
    }
    return "";
  };
  CHECK(contains(set("width_mm=20"), "did you mean 'face_width_mm'?"));
  CHECK(contains(set("gear.pinion.bore_diameter_mm=20"),
                 "did you mean 'gear.pinion.bore_radius_mm' (half of the diameter)?"));
  CHECK(contains(set("helix_angle_deg=20"), "gears are spur gears for now"));
}

TEST_CASE("a number may be written as a whole float; a decimal comma and a number in quotes are named") {
  SceneFile file;
  CHECK(file.read(scene_with("teeth = 50", "teeth = 50.0")).gears[0].design.teeth == 50);
  CHECK(file.read(scene_with("teeth = 50", "teeth = 5e1")).gears[0].design.teeth == 50);
  CHECK(body_parameters(file.read(scene_with("teeth = 50", "teeth = 50.0")), "pinion") ==
        body_parameters(file.read(kScene), "pinion"));
  CHECK(contains(file.rejection(scene_with("teeth = 50", "teeth = 50.5")), "= 50.5: must be a whole number"));
  const std::string comma = file.rejection(scene_with("module_mm = 3", "module_mm = 2,5"));
  CHECK(contains(comma, "x.toml:3: is not valid TOML: "));
  CHECK(contains(comma, "; numbers have a decimal point: 2.5, not 2,5"));
  const auto torques = [&](const std::string& list) {
    return scene_with("torque_Nm = [100, 150]", "torque_Nm = " + list);
  };
  CHECK(contains(
      file.rejection(torques("[1624,77, 800]")),
      "holds 1624,77 without a blank and others with one: numbers have a decimal point, 1624.77; two numbers are written 1624, 77"));
  for (const char* list :
       {"[1624, 77, 800]", "[1624,77,800]", "[1624.5,77, 800]", "[100,\n150,\n200]", "[1624,77]"}) {
    CAPTURE(list);
    CHECK_NOTHROW(file.read(torques(list)));
  }
  CHECK(contains(file.rejection(scene_with("from = 600", "from = 600,5")), "600.5, not 600,5"));
  CHECK(contains(file.rejection(scene_with("module_mm = 3", "module_mm = \"2,5\"")),
                 "must be a number (in mm); write 2.5, with a decimal point and without quotes"));
  CHECK(contains(file.rejection(scene_with("module_mm = 3", "module_mm = \"2.5\"")),
                 "must be a number (in mm); write 2.5 without quotes"));
  // Between brackets a comma parts numbers, and other mistakes get no such advice.
  CHECK(file.rejection(scene_with("[100, 150]", "[100,150")).find("decimal") == std::string::npos);
  CHECK(file.rejection(scene_with("module_mm = 3", "module_mm = ")).find("decimal") == std::string::npos);
  CHECK(file.rejection(scene_with("plane = \"stress\"", "plane = \"2,5\"")).find("decimal") ==
        std::string::npos);
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

  CHECK(contains(file.rejection(with("tip_diameter_mm = 157.5\naddendum = 1.0\n")),
                 "gives 'tip_diameter_mm' and 'addendum', which say the same; give one of them"));
  CHECK(contains(file.rejection(with("root_diameter_mm = 144\ndedendum = 1.0\n")),
                 "gives 'root_diameter_mm' and 'dedendum'"));
  CHECK(contains(
      file.rejection(with("tip_diameter_mm = 151.5\n")),
      "x.toml:3: 'tip_diameter_mm' in [gear.pinion] = 151.5: with 50 teeth, module_mm = 3 and profile_shift = 0.25 it must be between 151.5 and 169.5 mm"));
  CHECK(
      contains(file.rejection(with("root_diameter_mm = 133.4\n")), "it must be between 133.5 and 151.5 mm"));
  std::string other = with("tip_diameter_mm = 157.5\n");
  other.replace(other.find("like = \"pinion\""), 15, "like = \"pinion\"\nteeth = 51");
  CHECK(contains(file.rejection(other),
                 "[gear.wheel] takes 'tip_diameter_mm' = 157.5 over from a gear of other teeth"));
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
