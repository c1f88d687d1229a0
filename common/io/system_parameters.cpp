#include "io/system_scene.h"

#include <array>
#include <cmath>
#include <functional>
#include <sstream>

#include "base/error.h"
#include "io/section_reader.h"
#include "io/stage_parameters_text.h"
#include "io/system_layout_text.h"
#include "io/variant.h"
#include "system/rigid_system.h"

namespace whine {
namespace {

constexpr const char* kModesStage = "the modes of a system";

// One key of a table of stage parameters: what is written is what is read.
class Table {
 public:
  explicit Table(std::ostringstream& out) : out_(&out) {}
  Table(const Source& source, const toml::table& table, const std::string& label)
      : source_(&source), table_(&table), label_(label) {}

  void number(const char* name, double& value, double least, double most) {
    if (out_) {
      *out_ << name << " = " << exact_text(value) << "\n";
      return;
    }
    const toml::node& node = found(name);
    value = node.value<double>().value_or(std::nan(""));
    if (!(value >= least && value <= most))
      source_->reject(node, text("'", name, "' in [", label_, "] = ", as_written(node),
                                 ": must be a number from ", least, " to ", most));
  }
  void whole(const char* name, int& value, int least, int most) {
    if (out_) {
      *out_ << name << " = " << value << "\n";
      return;
    }
    double number = value;
    this->number(name, number, least, most);
    value = static_cast<int>(number);
    if (value != number) source_->reject(found(name), text("'", name, "' must be a whole number"));
  }
  void word(const char* name, std::string& value) {
    if (out_) {
      *out_ << name << " = \"" << value << "\"\n";
      return;
    }
    const toml::node& node = found(name);
    const auto word = node.value<std::string>();
    if (!node.is_string() || !plain_name(*word))
      source_->reject(node, text("'", name, "' in [", label_, "] must be a name in quotes"));
    value = *word;
  }
  template <WordedChoice Choice>
  void choice(const char* name, Choice& value) {
    std::string chosen = name_of(value);
    word(name, chosen);
    if (out_) return;
    const std::optional<Choice> known = choice_of<Choice>(chosen);
    if (!known)
      source_->reject(found(name), text("'", name, "' in [", label_, "] = \"", chosen,
                                        "\": must be one of: ", kWordsOf<Choice>));
    value = *known;
  }
  void flag(const char* name, bool& value) {
    int number = value;
    whole(name, number, 0, 1);
    value = number != 0;
  }

 private:
  const toml::node& found(const char* name) const {
    const toml::node* node = table_->get(name);
    if (!node) source_->reject(*table_, text("[", label_, "] lacks '", name, "'"));
    return *node;
  }
  std::ostringstream* out_ = nullptr;
  const Source* source_ = nullptr;
  const toml::table* table_ = nullptr;
  std::string label_;
};

constexpr double kAnyNumber = 1e30, kFarthest = 1e3, kStiffest = 1e15, kMostTurn = 1e6;
constexpr int kMostTeeth = 2000, kMost = 1000;

void describe_table(Table& t, System::Body& body) {
  t.word("name", body.name);
  bool carrier = body.kind == System::BodyKind::carrier;
  t.flag("is_carrier", carrier);
  body.kind = carrier ? System::BodyKind::carrier : System::BodyKind::gear;
  t.whole("teeth", body.teeth, 0, kMostTeeth);
  t.whole("sense", body.sense, -1, 1);
  t.number("angle", body.angle, -kMostTurn, kMostTurn);
  t.number("x", body.centre[0], -kFarthest, kFarthest);
  t.number("y", body.centre[1], -kFarthest, kFarthest);
  t.number("radius", body.radius, 0, kFarthest);
  t.number("inertia", body.inertia, 0, kAnyNumber);
  t.whole("stands_on", body.on, System::kGround, kMost);
  t.number("bearing_stiffness", body.bearing.stiffness, 0, kStiffest);
  t.number("bearing_damping", body.bearing.damping, 0, kAnyNumber);
  t.number("bearing_mass", body.bearing.mass, 0, kAnyNumber);
}

void describe_table(Table& t, System::Mesh& mesh) {
  for (size_t s = 0; s < 2; ++s) {
    const std::string side = s == 0 ? "driver" : "driven";
    System::Side& own = mesh.side[s];
    t.whole((side + "_body").c_str(), own.body, 0, kMost);
    t.whole((side + "_sense").c_str(), own.sense, -1, 1);
    t.whole((side + "_tooth").c_str(), own.first_tooth, -(1 << 20), 1 << 20);
    bool trailing = own.flank == FlankSide::trailing;
    t.flag((side + "_trailing").c_str(), trailing);
    own.flank = trailing ? FlankSide::trailing : FlankSide::leading;
  }
  t.number("centre_distance", mesh.centre_distance, 0, kFarthest);
  t.number("direction", mesh.direction, -kMostTurn, kMostTurn);
  t.number("phase", mesh.phase, 0, 1);
  t.number("pressure_angle", mesh.pressure_angle, 0, 1.5);
  t.flag("ring_drives", mesh.ring_drives);
  t.number("stiffness", mesh.stiffness, 0, kStiffest);
}

void describe_table(Table& t, System::Drive& drive) {
  t.whole("body", drive.body, 0, kMost);
  t.choice("kind", drive.kind);
  t.number("torque", drive.torque, -kAnyNumber, kAnyNumber);
  t.number("stiffness", drive.stiffness, 0, kStiffest);
}

template <class Item>
void write_list(std::ostringstream& out, const char* name, const std::vector<Item>& list) {
  for (Item item : list) {
    out << "\n[[" << name << "]]\n";
    Table table(out);
    describe_table(table, item);
  }
}

template <class Item>
void read_list(const Source& source, const char* name, std::vector<Item>& list) {
  const toml::node* node = source.root().get(name);
  if (!node) return;
  const toml::array* tables = node->as_array();
  if (!tables || !tables->is_array_of_tables() || tables->size() > kMost)
    source.reject(*node, text("'", name, "' must be a list of at most ", kMost, " sections"));
  for (const toml::node& item : *tables) {
    Table table(source, *item.as_table(), name);
    describe_table(table, list.emplace_back());
  }
}

}  // namespace

std::string layout_text(const System& layout) {
  std::ostringstream out;
  write_list(out, "body", layout.bodies);
  write_list(out, "mesh", layout.meshes);
  write_list(out, "drive", layout.drives);
  return out.str();
}

std::string system_parameters(const System& layout) {
  return std::string(kStageParametersStart) + kModesStage + kStageParametersEnd + "\n" + layout_text(layout);
}

System layout_from(const Source& source) {
  System out;
  read_list(source, "body", out.bodies);
  read_list(source, "mesh", out.meshes);
  read_list(source, "drive", out.drives);
  const int bodies = static_cast<int>(out.bodies.size());
  if (bodies == 0) source.reject("lists no [[body]]");
  const auto there = [&](int body) { return body >= 0 && body < bodies; };
  for (const System::Body& body : out.bodies)
    if (body.sense == 0) source.reject(text("[[body]] '", body.name, "' has sense = 0; it must be -1 or 1"));
  for (const System::Body& body : out.bodies)
    if (!has_place(out, body))
      source.reject(text(
          "[[body]] '", body.name, "' stands on number ", body.on,
          ", which is no carrier on the ground; stands_on is -1, the ground, or the number of a carrier with stands_on = -1"));
  for (const System::Mesh& mesh : out.meshes)
    if (!there(mesh.side[0].body) || !there(mesh.side[1].body))
      source.reject(text("a [[mesh]] names a body that is not there; there are ", bodies));
  for (const System::Body& body : out.bodies)
    if (body.kind == System::BodyKind::gear && body.teeth == 0)
      source.reject(text("[[body]] '", body.name, "' is a gear with teeth = 0; it must have 1 at least"));
  for (const System::Mesh& mesh : out.meshes)
    for (const System::Side& side : mesh.side)
      if (mesh.side[0].body == mesh.side[1].body ||
          out.bodies[static_cast<size_t>(side.body)].kind == System::BodyKind::carrier)
        source.reject(text("a [[mesh]] of '", out.bodies[static_cast<size_t>(mesh.side[0].body)].name,
                           "' and '", out.bodies[static_cast<size_t>(mesh.side[1].body)].name,
                           "' is not of two gears that differ"));
  for (const System::Drive& drive : out.drives)
    if (!there(drive.body))
      source.reject(text("a [[drive]] names a body that is not there; there are ", bodies));
  return out;
}

System read_system_parameters(const std::string& path) {
  const Source source(path,
                      "stage parameters are out/<scene>/params/system.toml, made with: make modes SCENE=...");
  if (!source.is_stage_parameters() || source.stage_of() != kModesStage)
    source.reject("is not what the modes of a system depend on: give out/<scene>/params/system.toml");
  return layout_from(source);
}

}  // namespace whine
