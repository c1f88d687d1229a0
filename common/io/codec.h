// How an artifact is stored: one function describes its datasets, each once, with name, unit, meaning, axes, range and the
// member that holds it. Writing, reading, the checks of shapes and the page of datasets all walk that function:
//
//   void describe(Codec& c, StaticResult& a) {
//     c(a.mesh_phase, "/mesh_phase", "1", kPhase, "mesh_phase", "mesh phase");
//     c(a.transmission_error, "/transmission_error", "m", kLength, "mesh_phase", "...");
//     c(a.direction, "/parameters/operation/direction", "", "...");  // words and choices have no unit and no range
//   }
//   std::string title(const StaticResult& a) { return "..."; }
//   template struct ArtifactFile<StaticResult>;
//
// Datasets of one file that share an axis have the same length along it; the first one sets it. Axes of directions and gears
// (xy, gear, ...) have the length 2.
//
// Private to the layer io/.
#pragma once
#include <Eigen/Core>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "base/choice.h"
#include "base/error.h"
#include "base/matrix.h"
#include "io/artifact.h"
#include "io/ranges.h"
#include "results/friction_losses.h"
#include "results/remark.h"

namespace whine {

struct VtkGrid;

struct Dataset {
  std::string name;        // "/certificate/least_gap"
  std::string units;       // UDUNITS form, "1" if none
  std::string meaning;     // long_name
  std::string axes;        // in index order, blank between; empty for a scalar
  Range range = {};        // of its numbers
  std::string equation{};  // where it comes from
};

// A list of matrices is one dataset with three axes, the first along the list. With one axis more than it has, the columns of a matrix,
// or of a list of matrices, are along the last two, of which the length of the first is known.
using Member = std::variant<double*, int*, std::string*, Eigen::VectorXd*, Eigen::VectorXi*, Eigen::Vector2d*,
                            MatrixRM*, MatrixRMi*, std::vector<MatrixRM>*, std::vector<std::string>*>;

class Codec {
 public:
  explicit Codec(ArtifactWriter& out) : out_(&out) {}
  explicit Codec(const ArtifactReader& in) : in_(&in) {}
  // Lists the datasets, with the optional ones.
  explicit Codec(std::vector<Dataset>& list) : list_(&list) {}

  // Writes the member, or reads and checks it, or lists the dataset. Error(numerical) for numbers without a range. A writer
  // fails with Error(numerical) and a reader with Error(input) if the length along an axis is not that of the axis; a reader
  // also if a number is out of range.
  void dataset(const Dataset& dataset, const Member& member);

  // What dataset() does with members from here on, for records that come piece by piece: whole again with Record::none;
  // reserve: `rows` rows along the first axis; append: the rows of the member from `rows` on. To readers and lists it is nothing.
  enum class Record { none, reserve, append };
  void record(Record what, Eigen::Index rows = 0) {
    record_ = what;
    rows_ = rows;
  }

  // dataset(), the arguments in the order in which they are read; meaning and equation, which may be long, last.
  template <class Value>
  void operator()(Value& value, const std::string& name, const std::string& units, const Range& range,
                  const std::string& axes, const std::string& meaning, const std::string& equation = "") {
    dataset({name, units, meaning, axes, range, equation}, &value);
  }

  // Words and choices. A list of choices is stored as the words along its axis or, without axes, as one line of them.
  template <class Value>
  void operator()(Value& value, const std::string& name, const std::string& axes,
                  const std::string& meaning) {
    const Dataset described{name, "1", meaning, axes};
    if constexpr (WordedChoice<Value>)
      choice(described, value);
    else if constexpr (requires { requires WordedChoice<typename Value::value_type>; })
      axes.empty() ? choices(described, value) : column_of_choices(described, value);
    else
      dataset(described, &value);
  }

  // The picture of the artifact for ParaView, written if it has points. It is not read.
  void picture(const VtkGrid& grid);
  bool has_picture() const { return picture_; }

 private:
  template <WordedChoice Choice>
  void choice(const Dataset& dataset, Choice& choice) {
    std::string word = name_of(choice);
    this->dataset(dataset, &word);
    if (!in_) return;
    const auto found = choice_of<Choice>(word);
    if (!found)
      in_->reject(text("dataset ", dataset.name, " is '", word, "', which is none of: ", kWordsOf<Choice>));
    choice = *found;
  }

  template <WordedChoice Choice>
  void column_of_choices(const Dataset& dataset, std::vector<Choice>& list) {
    std::vector<std::string> words;
    words.reserve(list.size());
    for (const Choice choice : list) words.push_back(name_of(choice));
    this->dataset(dataset, &words);
    if (!in_) return;
    list.clear();
    for (const std::string& word : words) {
      const auto found = choice_of<Choice>(word);
      if (!found)
        in_->reject(
            text("dataset ", dataset.name, " holds '", word, "', which is none of: ", kWordsOf<Choice>));
      list.push_back(*found);
    }
  }

  template <WordedChoice Choice>
  void choices(const Dataset& dataset, std::vector<Choice>& list) {
    std::string line = names_of(list);
    this->dataset(dataset, &line);
    if (!in_) return;
    const auto found = choices_in<Choice>(line);
    if (!found)
      in_->reject(
          text("dataset ", dataset.name, " is '", line, "', which is no list of: ", kWordsOf<Choice>));
    list = *found;
  }

 public:
  // One column of a matrix of `columns` columns, each of which is a dataset of its own.
  void column(const Dataset& dataset, MatrixRM& values, Eigen::Index column, Eigen::Index columns);

  // Whether the file has an optional part: what `there` says to a writer, whether dataset `name` stands in the file to a
  // reader.
  bool optional(const std::string& name, bool there) const;

  // Writes the dataset /<axis> with first, first + 1, ...: the numbers of harmonics, by which xarray knows them. No reader
  // wants it.
  void numbers(const std::string& axis, int first, const std::string& meaning);

  // Sets the length of an axis before a dataset does.
  void axis(const std::string& name, Eigen::Index length);
  Eigen::Index length(const std::string& axis) const;  // 0 if no dataset has it

  // /parameters/<section>/<key> of all keys of a part.
  void parameters(const std::string& section, const KeyList& keys) const;

  bool lists() const { return list_ != nullptr; }
  ArtifactWriter* out() const { return out_; }      // nullptr unless it writes
  const ArtifactReader* in() const { return in_; }  // nullptr unless it reads

 private:
  std::vector<Eigen::Index> known_shape(const std::string& axes) const;  // -1: not yet known
  void note_shape(const Dataset& dataset, const std::vector<Eigen::Index>& shape);
  void put_record(const Dataset& dataset, const Member& member);

  ArtifactWriter* out_ = nullptr;
  const ArtifactReader* in_ = nullptr;
  std::vector<Dataset>* list_ = nullptr;
  std::map<std::string, Eigen::Index> lengths_;
  bool picture_ = false;
  Record record_ = Record::none;
  Eigen::Index rows_ = 0;
};

// --- what several artifacts have in common

void describe_design(Codec& codec, const std::string& section, GearDesign& design);
// With material and discretisation.
void describe_gear(Codec& codec, const std::string& section, BodyParameters& gear);
// Gears, mesh, model level of the contact and its discretisation; fidelity: false leaves the model level out.
void describe_pair(Codec& codec, GearPairParameters& a, bool fidelity = true);
// What a motion has beside: inertias, damping, model levels; time: with the discretisation of time.
void describe_motion(Codec& codec, MotionParameters& a, bool time = true);
void describe_torque(Codec& codec, double& torque);
// Speeds of sweeps, Hz.
void describe_speeds(Codec& codec, MeshSpeeds& speeds);
// N m-1, N m s: bearing dampers and the mean stiffness that sets them.
void describe_bearing_dampers(Codec& codec, double& mean_stiffness, std::array<double, kSides>& damper);
// What a motion was computed with, by its name; of maps together with the rule of a lumped model's damper.
void describe_model(Codec& codec, MotionModel& model, const std::string& meaning,
                    DamperActs* damper_acts = nullptr);
// Left out where back flanks are ignored: the margin (m) is then infinite.
void describe_backlash(Codec& codec, double& margin);
// Of a sweep: (mesh_frequency) m, backlash that is left, stored and left out likewise.
void describe_backlash_left(Codec& codec, Eigen::VectorXd& backlash_left);
void describe_remarks(Codec& codec, std::vector<Remark>& remarks);

// How well the contact conditions hold, worst over all steps: m, N, contact solutions by the slower method.
void describe_certificate(Codec& codec, double& least_gap, double& least_force, int& fallbacks);
// Losses by friction between the flanks, where it acts.
void describe_friction(Codec& c, FrictionLosses& losses);
// What the place of the largest root stress of a motion means.
inline constexpr const char *
    kRootAngle =
       "angle (rad) of the root's tangent against the centre line of the tooth where the stress is largest of what is sustained for 1/64 of a mesh period",
   *kRootPhase = "phase of the tooth's pair in its mesh then, 0 at the pitch point";
// Of a gear, (axis): where the largest root stress of a motion stands.
void describe_root_place(Codec& c, const std::string& angle_name, Eigen::VectorXd& angle,
                         const std::string& phase_name, Eigen::VectorXd& phase, const std::string& axis);
// Mesh periods of a hunting period, left out where all teeth are alike: 1.
void describe_hunting(Codec& codec, int& periods);
void describe_natural_frequency(Codec& codec, double& frequency);

std::string gear_title(const GearDesign& design);
std::string pair_title(const GearMeshSpec& mesh, double torque);

// Numbers that index arrays later are checked on reading: 0 to count - 1.
void require_indices(const Codec& codec, const std::string& name, const Eigen::Ref<const MatrixRMi>& index,
                     Eigen::Index count);

}  // namespace whine
