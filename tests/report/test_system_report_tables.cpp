// The page of a system: what it says of what is written and read, of motion, of odd names; natural modes by type.
#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <numbers>
#include <string>

#include "base/visible.h"
#include "gear/system_layout.h"
#include "io/artifacts.h"
#include "io/scene.h"
#include "refusal.h"
#include "relative.h"
#include "report/figure_list.h"
#include "report/figure_words.h"
#include "report/report.h"
#include "report/report_remarks.h"
#include "report/report_results.h"
#include "report/system_picture.h"
#include "report/teeth_page.h"
#include "report/text_width.h"
#include "results/modes.h"
#include "results/response.h"
#include "results/static.h"
#include "scene_file.h"
#include "small_system.h"
#include "system/natural_modes.h"
#include "system/system_rest.h"

using namespace whine;
using Eigen::Index;

namespace {

const Provenance kMade{"gear-test", "gear-test --output x.h5", {}};

// Sun driven, ring and carrier held, numbers that differ from mesh to mesh and from body to body.
SystemStaticResult varied(Scene scene = planetary_train(3)) {
  scene.drives = {{"sun", System::DriveKind::torque, 400, 0},
                  {"ring", System::DriveKind::held, 0, 0},
                  {"carrier", System::DriveKind::held, 0, 0}};
  SystemStaticResult a = small_system(scene);
  for (Index m = 0; m < a.mesh_force.cols(); ++m) {
    a.mesh_force.col(m).setConstant(1000 + 100 * static_cast<double>(m));
    StaticResult& mesh = a.mesh[static_cast<size_t>(m)];
    mesh.transmission_error << 1e-6, 1e-6 * static_cast<double>(m + 2);
    mesh.tooth_load.setConstant(500 + 10 * static_cast<double>(m));
    mesh.stiffness_tangent.setConstant(4e8 + 1e6 * static_cast<double>(m));
    for (size_t i = 0; i < 2; ++i) {
      a.mesh_stiffness[i](m, m) = 4e8 + 1e6 * static_cast<double>(m);
    }
  }
  a.torque.setZero();
  a.torque.col(0).setConstant(400);
  a.torque.col(4).setConstant(-1466.6);
  a.torque.col(5).setConstant(-1866.6);
  for (size_t i = 0; i < 2; ++i)
    for (Index b = 0; b < a.bearing_force[i].rows(); ++b)
      a.bearing_force[i].row(b) << 30 * static_cast<double>(b + 1), i == 0 ? 40 : -40;
  return a;
}

ReportContent report_of(const SystemStaticResult& rest) {
  ReportContent r;
  r.scene = "train.toml: A planetary train";
  r.statics = {rest};
  r.modes = elastic_modes(rest);
  r.pictures = {{"system", "png"}, {"load-sharing", "png"}, {"modes", "png"}};
  return r;
}

// Rising: planet 2 vibrates most at 2000 Hz, where it loses contact; at 1000 Hz the motion does not repeat. Falling: another
// motion at 2000 Hz.
std::vector<ResponseResult> sweeps_of(const SystemStaticResult& rest) {
  std::vector<ResponseResult> out{small_response(rest, Direction::up), small_response(rest, Direction::down)};
  for (ResponseResult& a : out) {
    a.dte_rms.setConstant(1e-6);
    a.separation_fraction.setZero();
    a.mesh_force_max.setConstant(1500);
    a.energy_imbalance.setConstant(1e-13);
  }
  ResponseResult& up = out.front();
  up.dte_rms(0, 1) = 3e-6;
  up.separation_fraction(0, 1) = 0.25;
  up.mesh_force_max(0, 1) = 2200;
  up.bearing_force_max(0, 2) = 777.5;
  return out;
}

// Whether "nan" or "inf" stands as a word of its own.
bool has_no_number(const std::string& page) {
  for (const std::string word : {"nan", "inf"})
    for (size_t at = page.find(word); at != std::string::npos; at = page.find(word, at + 1)) {
      const auto letter = [&](size_t i) {
        return i < page.size() && std::isalnum(static_cast<unsigned char>(page[i])) != 0;
      };
      if (!(at > 0 && letter(at - 1)) && !letter(at + word.size())) return true;
    }
  return false;
}

}  // namespace

TEST_CASE(
    "the page of a system: its sections, its numbers, and the same page of what is written and read back") {
  const SystemStaticResult rest = varied();
  ReportContent r = report_of(rest);
  r.sweeps = sweeps_of(rest);
  r.pictures.push_back({"system-sweep", "png"});
  const std::string page = report_html(r), table = report_tsv(r);
  for (const char* words :
       {"id=\"gears\"", "id=\"meshes\"", "id=\"rest\"", "id=\"modes-of-system\"", "id=\"motion\"",
        "id=\"provenance\"", "<figure id=\"load-sharing\">", "<figure id=\"system-sweep\">", "sun-planet1",
        "planet3-ring", "What the numbers mean", "tip_relief_um", "rayleigh_stiffness_s", "corner_contact",
        "The carrier has 3 planets."})
    CHECK_MESSAGE(contains(page, words), words);
  // Tip and root of the ring, 2.776 (99 -+ 2 x 0.8 or 1.15) mm: its tips lie inside.
  CHECK(contains(page, ">270.3824<"));
  CHECK(contains(page, ">281.2088<"));
  CHECK(!contains(page, ">279.2656<"));
  CHECK(!has_no_number(page));
  CHECK(!has_no_number(table));
  // part, quantity, value, unit, remark: of what is known.
  for (const char* row :
       {"sun\ttorque, mean\t400.00\tN m\tinput\t\n", "planet1\ttorque, mean\t0.00\tN m\tfree\t\n",
        "ring\ttorque, mean\t-1466.60\tN m\theld\t\n",
        "carrier\ttorque, mean\t-1866.60\tN m\theld (the frame)\t\n",
        "sun-planet2\tmesh force at rest, mean\t1100.0\tN\t\t\n",
        "planet1-ring\tstatic transmission error, peak to peak\t4.000\tµm\t\t\n",
        "planet3-ring\tmean mesh stiffness, contact frozen\t405\tN/µm\t\t\n",
        "planet2-ring\tstatic tooth load, largest\t540.0\tN\t\t\n",
        "planet1\tforce on the bearing, mean\t60.0\tN\t\t\n",
        "planet1\tforce on the bearing, largest\t72.1\tN\t\t\n",
        "planet1\tforce on the bearing, RMS of the oscillating part\t40.00\tN\t\t\n"})
    CHECK_MESSAGE(contains(table, row), row);

  const SceneFile place;
  const std::string file = place.path("");
  write(file + "s.h5", rest, kMade);
  write(file + "m.h5", *r.modes, kMade);
  write(file + "u.h5", r.sweeps[0], kMade);
  write(file + "d.h5", r.sweeps[1], kMade);
  ReportContent again = r;
  again.statics[0] = read<SystemStaticResult>(file + "s.h5");
  again.modes = read<ModesResult>(file + "m.h5");
  again.sweeps = {read<ResponseResult>(file + "u.h5"), read<ResponseResult>(file + "d.h5")};
  CHECK(report_html(again) == page);
  CHECK(report_tsv(again) == table);
  CHECK(plot_data(system_picture(again.statics[0])) == plot_data(system_picture(rest)));
  CHECK(plot_data(system_load_sharing_figure(again.statics[0])) ==
        plot_data(system_load_sharing_figure(rest)));
  CHECK(plot_data(system_sweep_figure(again.sweeps)) == plot_data(system_sweep_figure(r.sweeps)));

  ReportContent rigid;
  rigid.scene = "rigid.toml: Rigid";
  rigid.modes = natural_modes(layout_of(planetary_train(3)));
  const std::string of_rigid = report_html(rigid);
  CHECK(!contains(of_rigid, "id=\"rest\""));
  CHECK(!contains(of_rigid, "id=\"motion\""));
  CHECK(contains(of_rigid, "rotational"));
  // Whether a torque drives it, modes do not know.
  CHECK(!contains(of_rigid, "<td>free</td>"));

  const auto said = [](ReportContent changed, const auto& change) {
    change(changed);
    return message_of_input([&] { report_html(changed); });
  };
  CHECK(said(r, [](ReportContent& c) { c.modes.reset(); }).empty());
  CHECK(names(said(rigid, [](ReportContent& c) { c.modes.reset(); }), {"static.h5"}));
  CHECK(names(said(r, [](ReportContent& c) { c.pictures.push_back({"fig07", "png"}); }), {"fig07"}));
  CHECK(names(said(r, [](ReportContent& c) { c.pictures.push_back(c.pictures[0]); }), {"given", "twice"}));
  CHECK(names(said(r, [](ReportContent& c) { c.modes = natural_modes(layout_of(planetary_train(4))); }),
              {"static.h5", "modes.h5", "two systems"}));
  CHECK(names(said(r, [](ReportContent& c) { c.statics.clear(); }), {"no", "static.h5"}));
  CHECK(names(said(r, [](ReportContent& c) { c.sweeps[1] = c.sweeps[0]; }),
              {"response.h5", "up", 400, "twice"}));
  CHECK(names(said(r, [](ReportContent& c) { c.sweeps[1].drive[0] = 401; }), {"sun", 401}));
}

TEST_CASE(
    "the page of a system in motion: largest values with their speeds, contact loss, motions that differ or do not repeat") {
  const SystemStaticResult rest = varied();
  ReportContent r = report_of(rest);
  CHECK(motion_words(r).empty());
  r.sweeps = sweeps_of(rest);
  const std::string table = report_tsv(r), page = report_html(r);
  for (
      const char* row :
      {"400\tsun-planet2\tlargest RMS of the dynamic transmission error, speed rising\t3.000\tµm\t\t\n400\tsun-planet2\tmesh frequency of that RMS, speed rising\t2000\tHz\t\t\n",
       "sun-planet2\tlargest RMS of the dynamic transmission error, speed falling\t1.000\tµm\t",
       "sun-planet2\tlargest mesh force over its mean at rest, speed rising\t2.00\t1\t",
       "sun-planet2\tmesh frequency of that factor, speed rising\t2000\tHz\t",
       "sun-planet1\tdynamic factor: largest mesh force, sustained for 1/64 of a mesh period, over its mean at rest, speed falling\t1.50\t1\t",
       "sun-planet2\ttime without contact, largest, speed rising\t25.00\t%\t\t\n400\tsun-planet2\tmesh frequency of that time, speed rising\t2000\tHz\t",
       "sun-planet1\ttime without contact, largest, speed rising\t0.00\t%\t\t\n",
       "planet2\tlargest force on the bearing, speed rising\t777.5\tN\t\t\n400\tplanet2\tmesh frequency of that force, speed rising\t2000\tHz\t",
       "400\t\tspeeds whose motion is not periodic, speed rising\t1\t1\t1000\t\n"})
    CHECK_MESSAGE(contains(table, row), row);
  for (
      const char* words :
      {"the motion does not repeat at 1 of 2 speeds (1000 Hz (2222 rpm))",
       "teeth part at 2000 Hz (4444 rpm) (sun-planet2)",
       "rising and falling speed lead to different motions at 2000 Hz (4444 rpm)",
       "The largest vibration is an RMS of 3.00 µm of sun-planet2 at 2000 Hz (4444 rpm), speed rising",
       "for up to 25.0 % of the time",
       // The opening: of the meshes of each [[mesh]] together.
       "At 400 N m on sun the transmission error swings from peak to peak by 1.00 to 3.00 µm of sun-planet",
       "From 2222 to 4444 rpm (1000 to 2000 Hz) teeth part (sun-planet): with speed rising at 4444 rpm (2000 Hz). A drive "
       "that starts from rest gets there at 4444 rpm (2000 Hz).",
       "The mesh force reaches 2.00 times its mean at rest in sun-planet, at 4444 rpm (2000 Hz)",
       "Keep the speed of sun out of 4444 rpm (2000 Hz), where teeth part."})
    CHECK_MESSAGE(contains(page, words), words);
  r.sweeps[0].energy_imbalance[1] = 1e-3;
  CHECK(contains(report_html(r), "0.001 of the energy that goes through is not accounted for"));
}

TEST_CASE("the page of a system: measured errors of a mesh stand beside its numbers, and beside no others") {
  const SystemStaticResult rest = varied();
  ReportContent r = report_of(rest);
  r.sweeps = sweeps_of(rest);
  const ResponseResult& up = r.sweeps[0];
  SweepErrorsResult errors;
  static_cast<MotionSource&>(errors) = up;
  errors.direction = up.direction;
  errors.mesh_frequency = up.mesh_frequency;
  errors.compared = MatrixRMi::Ones(1, up.mesh_frequency.size());
  for (auto quantity :
       {&SweepErrorsResult::dte_rms, &SweepErrorsResult::dte_first_order, &SweepErrorsResult::tooth_load_max,
        &SweepErrorsResult::tooth_load_sustained, &SweepErrorsResult::mesh_force_max}) {
    (errors.*quantity).error = MatrixRM::Constant(up.mesh_frequency.size(), up.meshes(), 0.001);
    (errors.*quantity).error.col(1).setConstant(0.02);
  }
  r.errors = {errors};
  const auto error = [&](const std::string& mesh, const std::string& way) {
    for (const ReportNumber& n : report_numbers(r))
      if (n.part == mesh && n.quantity == "largest RMS of the dynamic transmission error, speed " + way)
        return n.error;
    return std::string("none");
  };
  CHECK(error("sun-planet2", "rising") == "0.06");    // 2 % of 3 um
  CHECK(error("sun-planet1", "rising") == "0.0010");  // 0.1 % of 1 um
  CHECK(error("sun-planet2", "falling").empty());
  CHECK(contains(report_html(r), "3.00 ± 0.06"));
  CHECK(contains(report_html(r), "Numbers in motion have it at 400 N m"));
}

TEST_CASE(
    "remarks on motion: peaks that are one speed wide, bearings without dampers, what a turning carrier leaves out") {
  const SystemStaticResult rest = varied();
  ReportContent r;
  r.sweeps = {small_response(rest, Direction::up)};
  ResponseResult& a = r.sweeps[0];
  const Index meshes = a.dte_rms.cols();
  a.mesh_frequency = Eigen::Vector4d(1000, 1100, 1200, 1300);
  a.dte_rms = MatrixRM::Constant(4, meshes, 1e-6);
  a.separation_fraction = MatrixRM::Zero(4, meshes);
  a.energy_imbalance = Eigen::VectorXd::Zero(4);
  a.period_multiple = Eigen::VectorXi::Ones(4);
  SweepResult sweep;
  sweep.mesh_frequency = a.mesh_frequency;
  sweep.mesh_force.assign(4, MatrixRM::Constant(2, meshes, 1000));
  for (System::Body& body : a.layout.bodies)
    if (body.bearing.elastic()) body.bearing.damping = 100;
  const auto said = [&](const std::string& words) {
    sweep.layout = a.layout;
    a.remarks = remarks_on_carriers(sweep);
    for (const Remark& one : remarks_on_sweep(r, a))
      if (contains(one.words, words)) return one.warning ? 2 : 1;
    return 0;
  };
  CHECK(said("one speed wide") == 0);
  CHECK(said("no damping_Ns_m") == 0);
  a.dte_rms(2, 1) = 2.1e-6;
  CHECK(said("peaks at 1200 Hz are one speed wide") == 2);
  a.dte_rms(1, 1) = 1.1e-6;
  CHECK(said("one speed wide") == 0);
  for (System::Body& body : a.layout.bodies)
    if (body.name == "planet2") body.bearing = {1e8, 0, 1};
  CHECK(said("no damping_Ns_m in the [[bearing]] of planet2:") == 1);
  // The ring is held, and the carrier; then the carrier is let go.
  CHECK(said("In a machine in which ring stands still") == 2);
  sweep.mesh_force.assign(4, MatrixRM::Constant(2, meshes, 1e9));
  CHECK(said("In a machine in which ring stands still") == 1);
  sweep.mesh_force.assign(4, MatrixRM::Constant(2, meshes, 1000));
  std::erase_if(a.layout.drives, [&](const System::Drive& drive) {
    return a.layout.bodies[static_cast<size_t>(drive.body)].kind == System::BodyKind::carrier;
  });
  CHECK(said("rpm at 1300 Hz, ring being held: centrifugal forces on its planets of") == 1);
}

TEST_CASE("figures of motion set only motions of one system beside each other, one sweep in a direction") {
  const SystemStaticResult rest = varied();
  const std::vector<ResponseResult> sweeps = sweeps_of(rest);
  BranchResult branch;
  static_cast<MotionSource&>(branch) = sweeps[0];
  branch.mesh_frequency = Eigen::Vector2d(1000, 1100);
  branch.dte_rms = MatrixRM::Constant(2, sweeps[0].dte_rms.cols(), 1e-6);
  branch.floquet_multiplier.assign(2, MatrixRM::Constant(1, 2, 0.5));
  branch.stable = Eigen::Vector2i(1, 1);
  branch.part = Eigen::Vector2i(0, 0);
  REQUIRE(system_sweep_figure(sweeps).blocks.size() == 6);
  REQUIRE(branch_figure(branch, sweeps).blocks.size() == 3);

  const auto said = [&](const auto& change, const std::vector<Field>& fields) {
    std::vector<ResponseResult> changed = sweeps;
    change(changed[1]);
    CHECK(names(message_of_input([&] { system_sweep_figure(changed); }), fields));
    CHECK(names(message_of_input([&] { branch_figure(branch, changed); }), fields));
  };
  said([](ResponseResult& c) { c.layout.bodies[0].teeth = 28; }, {"two", "systems"});
  said([](ResponseResult& c) { c.layout.bodies[0].name = "other"; }, {"two", "systems"});
  said([](ResponseResult& c) { c.drive[0] = 401; }, {"torque", "sun", 400, 401});
  said([](ResponseResult& c) { c.damping.rayleigh_stiffness = 3e-6; }, {"damping", "2e-06", "3e-06"});
  said([](ResponseResult& c) { c.direction = Direction::up; }, {"up"});
}

TEST_CASE("odd names in the figures of a system: marks of gnuplot, names that are long") {
  SystemStaticResult a = varied();
  const std::string lengthy(130, 'g');
  a.settings.layout.bodies[0].name = "sun_gear";
  a.settings.layout.bodies[4].name = lengthy;
  a.settings.mesh[1].gear[1] = lengthy;
  const auto words_of = [](const Figure& figure, const std::string& name) {
    for (const auto& [key, value] : figure.words)
      if (key == name) return value;
    return std::string();
  };
  for (const Figure& figure : {system_picture(a), system_static_figure(a), system_load_sharing_figure(a),
                               system_sweep_figure({small_response(a, Direction::up)})}) {
    CAPTURE(figure.title);
    CHECK(
        (figure.captions.empty() ? words_of(figure, "line1") : figure.captions[0]).starts_with("sun\\_gear"));
    for (const std::string& note : figure.notes) CHECK(note.size() < 180);
    CHECK(figure.notes.front().starts_with("sun_gear"));
    for (const FigureTable& one : tables(figure, {})) CHECK(one.name.size() < 40);
    CHECK(figure.height < 4000);
  }
  CHECK(system_static_figure(a).panels[1].curves[0].label == "sun\\_gear-planet1");
  CHECK(short_name("planet12") == "planet12");
  CHECK(short_name(lengthy).size() < 34);
  // Cut between characters: none is half of one.
  std::string accented;
  for (int n = 0; n < 30; ++n) {
    accented += n % 2 ? "é" : "a";
    CHECK(!contains(visible(short_name(accented)), "?"));
  }
  // A mark in front of a character that is not ASCII has no width, and the character its own.
  CHECK(text_width("\\é") == text_width("é"));
  // A tower of gears is no taller than wide pictures are, and says what it leaves out.
  Scene tower;
  for (int i = 0; i < 6; ++i) {
    SceneGear gear;
    gear.name = text("gear_", i);
    gear.design = rigid_gear(27);
    gear.equivalent_mass = 1;
    tower.gears.push_back(gear);
    if (i == 0) continue;
    Scene::Mesh mesh;
    mesh.spec.gear = {text("gear_", i - 1), text("gear_", i)};
    mesh.spec.centre_distance = 27 * 2.776e-3 + 20e-6;
    mesh.direction = 0.5 * std::numbers::pi;
    tower.meshes.push_back(mesh);
  }
  const Figure tall = system_picture(small_system(tower));
  CHECK(tall.height < 2000);
  CHECK(std::count(tall.notes.begin(), tall.notes.end(), "close-ups: the first 3 of 5 [[mesh]]") == 1);
}

TEST_CASE("types of modes: planets whose mean stiffnesses differ by 2 per cent have those of equal ones") {
  SystemStaticResult a = small_system(unequal_train());
  for (const double spread : {0.0, 0.002, 0.02}) {
    CAPTURE(spread);
    for (MatrixRM& k : a.mesh_stiffness) {
      k = MatrixRM::Identity(8, 8) * 5e8;
      for (Index m = 0; m < 4; ++m) {
        // Opposite planets differ, too.
        k(m, m) *= 1 + spread * std::array{0.5, -0.5, 0.3, 0.1}[static_cast<size_t>(m)];
        k(m + 4, m + 4) *= 1 + spread * std::array{-0.2, 0.5, -0.5, 0.0}[static_cast<size_t>(m)];
        // Each planet joins its meshes.
        k(m, m + 4) = k(m + 4, m) = -2e7;
      }
    }
    const ModesResult modes = elastic_modes(a);
    std::map<ModeType, int> count;
    for (const ModeType type : modes.type) ++count[type];
    CHECK(count[ModeType::rotational] == 6);
    CHECK(count[ModeType::translational] == 12);
    CHECK(count[ModeType::planet] == 3);
    CHECK(count[ModeType::mixed] == 0);
  }
}

TEST_CASE("teeth of a train: of each [[mesh]] the worst mesh at rest beside ISO 6336, all meshes in motion") {
  SystemStaticResult rest = varied();
  rest.mesh[2].root_stress_max = Eigen::Vector2d(90e6, 45e6);
  ReportContent r = report_of(rest);
  const std::vector<WordTable> still = teeth_tables(r);
  REQUIRE(still.size() == 2);
  CHECK(contains(still[0].caption, "sun-planet3 at rest"));
  CHECK(still[0].head[2] == "sun (driver)");
  CHECK(still[0].rows[0] == std::vector<std::string>{"largest root stress", "MPa", "90.0", "45.0"});
  CHECK(still[0].rows[6].front() == "root stress over sigma_F0");
  CHECK(std::stod(still[0].rows[6][2]) > 0);
  // The ring's mesh: ISO 6336 has no formulas for it.
  CHECK(contains(still[1].caption, "planet1-ring at rest"));
  CHECK(contains(still[1].caption, "Left out: Y_F"));
  r.sweeps = sweeps_of(rest);
  const std::vector<WordTable> moving = teeth_tables(r);
  REQUIRE(moving.size() == 3);
  REQUIRE(moving[2].rows.size() == 24);
  // The mean force of mesh 1 at rest is 1100 N; K_v is of pairs.
  CHECK(moving[2].rows[4] == std::vector<std::string>{"sun-planet2: mesh force", "rising", "2200 N",
                                                      "2000; 4444", "–", "2.00", "–"});
  const std::string page = teeth_html(r);
  for (const char* id : {"remarks", "rest", "motion", "limits", "gears", "provenance"})
    CHECK(contains(page, text("<section id=\"", id, "\">")));
  CHECK_FALSE(has_no_number(page));
  for (StaticResult& mesh : r.statics[0].mesh) mesh.root_stress_max.resize(0);
  CHECK(names(message_of([&] { teeth_tables(r); }), {"teeth", "root stress"}));
}

TEST_CASE("masses on bearings: one that was read off the page, with four digits, is that of the body") {
  const SystemStaticResult a = varied();
  std::vector<ReducedBody> bodies(a.settings.body.size());
  for (ReducedBody& body : bodies) {
    body.mass = 0.74134;
    body.inertia = 1e-3;
  }
  const auto taken = [&](double mass) {
    System layout = a.settings.layout;
    for (System::Body& body : layout.bodies) body.bearing.mass = mass;
    return message_of_input([&] { take_masses(a.settings, bodies, layout); });
  };
  CHECK(taken(0.7413).empty());
  CHECK(taken(2).empty());
  CHECK(contains(taken(0.74), "lies below the mass of its own body"));
}

TEST_CASE("stage parameters of modes: gears without teeth and meshes of what is no gear are rejected") {
  const SceneFile place;
  const auto said = [&](const auto& spoil) {
    System s = layout_of(planetary_train(3));
    spoil(s);
    const std::string path = place.path(system_parameters(s), "system.toml");
    return message_of_input([&] { read_system_parameters(path); });
  };
  CHECK(said([](System&) {}).empty());
  CHECK(names(said([](System& s) { s.bodies[1].teeth = 0; }), {"[[body]]", "planet1", 0}));
  CHECK(names(said([](System& s) { s.meshes[0].side[1].body = 5; }), {"differ", "gears"}));
  CHECK(names(said([](System& s) { s.meshes[0].side[1].body = 0; }), {"differ", "gears"}));
}
