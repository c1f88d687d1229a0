#include "io/codec.h"

#include <cmath>
#include <limits>
#include <sstream>
#include <type_traits>

#include "base/error.h"
#include "io/vtk.h"

namespace whine {
namespace {

using namespace ranges;

std::vector<std::string> words(const std::string& line) {
  std::istringstream in(line);
  std::vector<std::string> out;
  for (std::string word; in >> word;) out.push_back(word);
  return out;
}

Eigen::Index fixed_length(const std::string& axis) {
  for (const char* two : {"xy", "gear", "part", "side", "face", "edge", "direction"})
    if (axis == two) return 2;
  return -1;
}

h5::Label label(const Dataset& d) {
  return {d.units, d.meaning, d.axes, d.equation};
}

std::vector<std::size_t> sizes(const std::vector<Eigen::Index>& shape) {
  return {shape.begin(), shape.end()};
}

// --- shapes of members

std::vector<Eigen::Index> shape_of(const double&) {
  return {};
}
std::vector<Eigen::Index> shape_of(const int&) {
  return {};
}
std::vector<Eigen::Index> shape_of(const std::string&) {
  return {};
}
template <class T>
std::vector<Eigen::Index> shape_of(const Eigen::Matrix<T, Eigen::Dynamic, 1>& values) {
  return {values.size()};
}
std::vector<Eigen::Index> shape_of(const Eigen::Vector2d&) {
  return {2};
}
template <class T>
std::vector<Eigen::Index> shape_of(
    const Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>& values) {
  return {values.rows(), values.cols()};
}
// -1: an empty list does not say how large its matrices are.
std::vector<Eigen::Index> shape_of(const std::vector<MatrixRM>& values) {
  const auto count = static_cast<Eigen::Index>(values.size());
  if (values.empty()) return {0, -1, -1};
  return {count, values[0].rows(), values[0].cols()};
}
std::vector<Eigen::Index> shape_of(const std::vector<std::string>& values) {
  return {static_cast<Eigen::Index>(values.size())};
}
// Of a dataset with these known lengths: one axis more than a matrix, or a list of matrices, has divides the columns.
template <class Value>
std::vector<Eigen::Index> shape_along(const std::vector<Eigen::Index>& known, const Value& value) {
  std::vector<Eigen::Index> shape = shape_of(value);
  if constexpr (std::is_same_v<Value, std::vector<MatrixRM>> || std::is_same_v<Value, MatrixRM>) {
    const std::size_t last = shape.size() - 1;
    const Eigen::Index columns = shape[last];
    if (known.size() == shape.size() + 1 && known[last] > 0) {
      if (columns % known[last] != 0)
        fail(Failure::numerical, "a result has ", columns, " columns, no multiple of ", known[last]);
      shape.push_back(columns < 0 ? -1 : columns / known[last]);
      shape[last] = known[last];
    }
  }
  return shape;
}

// --- writing; shape: what is known of it

using AxisLengths = std::vector<Eigen::Index>;

template <class T>
void put(ArtifactWriter& out, const Dataset& d, const AxisLengths&, const T& value) {
  out.put(d.name, value, label(d));
}
void put(ArtifactWriter& out, const Dataset& d, const AxisLengths&, const Eigen::Vector2d& value) {
  out.put(d.name, Eigen::VectorXd(value), label(d));
}
void put(ArtifactWriter& out, const Dataset& d, const AxisLengths&, const std::vector<std::string>& value) {
  out.file().put(d.name, value, label(d));
}
void put(ArtifactWriter& out, const Dataset& d, const AxisLengths& known, const MatrixRM& value) {
  out.file().put(d.name, value.data(), sizes(shape_along(known, value)), label(d));
}
void put(ArtifactWriter& out, const Dataset& d, const AxisLengths& known,
         const std::vector<MatrixRM>& value) {
  AxisLengths shape = shape_along(known, value);
  for (std::size_t i = 0; i < shape.size(); ++i)
    if (shape[i] < 0) shape[i] = std::max<Eigen::Index>(0, known[i]);
  const Eigen::Index columns = shape.size() == 4 ? shape[2] * shape[3] : shape[2];
  std::vector<double> all;
  all.reserve(static_cast<std::size_t>(shape[0] * shape[1] * columns));
  for (const MatrixRM& rows : value) {
    if (rows.rows() != shape[1] || rows.cols() != columns)
      fail(Failure::numerical, "result ", d.name, " has parts of ", rows.rows(), " x ", rows.cols(),
           " and of ", shape[1], " x ", columns);
    all.insert(all.end(), rows.data(), rows.data() + rows.size());
  }
  out.file().put(d.name, all.data(), sizes(shape), label(d));
}

// --- reading

void take(const ArtifactReader& in, const Dataset& d, const AxisLengths&, double& value) {
  value = in.number(d.name, d.range);
}
void take(const ArtifactReader& in, const Dataset& d, const AxisLengths&, int& value) {
  value = in.whole(d.name, d.range);
}
void take(const ArtifactReader& in, const Dataset& d, const AxisLengths&, std::string& value) {
  value = in.word(d.name);
}
void take(const ArtifactReader& in, const Dataset& d, const AxisLengths& shape, Eigen::VectorXd& value) {
  value = in.vector(d.name, d.range, shape[0]);
}
void take(const ArtifactReader& in, const Dataset& d, const AxisLengths& shape, Eigen::VectorXi& value) {
  value = in.whole_vector(d.name, d.range, shape[0]);
}
void take(const ArtifactReader& in, const Dataset& d, const AxisLengths&, Eigen::Vector2d& value) {
  value = in.vector(d.name, d.range, 2);
}
void take(const ArtifactReader& in, const Dataset& d, const AxisLengths& shape, MatrixRM& value) {
  if (shape.size() == 2) {
    value = in.matrix(d.name, d.range, shape[0], shape[1]);
    return;
  }
  const auto [all, found] = in.doubles(d.name, d.range, shape);
  value = Eigen::Map<const MatrixRM>(all.data(), static_cast<Eigen::Index>(found[0]),
                                     static_cast<Eigen::Index>(found[1] * found[2]));
}
void take(const ArtifactReader& in, const Dataset& d, const AxisLengths& shape, MatrixRMi& value) {
  value = in.whole_matrix(d.name, d.range, shape[0], shape[1]);
}
void take(const ArtifactReader& in, const Dataset& d, const AxisLengths& shape,
          std::vector<MatrixRM>& value) {
  const auto [all, found] = in.doubles(d.name, d.range, shape);
  const std::size_t across = found.size() == 4 ? found[2] * found[3] : found[2];
  const auto rows = static_cast<Eigen::Index>(found[1]), columns = static_cast<Eigen::Index>(across);
  value.clear();
  value.reserve(found[0]);
  for (std::size_t i = 0; i < found[0]; ++i)
    value.push_back(Eigen::Map<const MatrixRM>(all.data() + i * found[1] * across, rows, columns));
}
void take(const ArtifactReader& in, const Dataset& d, const AxisLengths& shape,
          std::vector<std::string>& value) {
  value = in.words(d.name, shape).values;
}

}  // namespace

std::vector<Eigen::Index> Codec::known_shape(const std::string& axes) const {
  std::vector<Eigen::Index> shape;
  for (const std::string& axis : words(axes)) {
    const auto found = lengths_.find(axis);
    shape.push_back(found != lengths_.end() ? found->second : fixed_length(axis));
  }
  return shape;
}

void Codec::note_shape(const Dataset& d, const std::vector<Eigen::Index>& shape) {
  const std::vector<std::string> axes = words(d.axes);
  const std::vector<Eigen::Index> known = known_shape(d.axes);
  if (shape.size() != axes.size())
    fail(Failure::numerical, "result ", d.name, " has ", shape.size(), " axes, its description '", d.axes,
         "'");
  for (std::size_t i = 0; i < axes.size(); ++i) {
    if (shape[i] < 0) continue;
    if (known[i] >= 0 && shape[i] != known[i])
      fail(Failure::numerical, "result ", d.name, " has ", shape[i], i == 0 ? " rows" : " columns",
           ", expected ", known[i], " along ", axes[i]);
    lengths_.emplace(axes[i], shape[i]);
  }
}

void Codec::dataset(const Dataset& d, const Member& member) {
  const bool words = std::holds_alternative<std::string*>(member) ||
                     std::holds_alternative<std::vector<std::string>*>(member);
  if (!words && std::isinf(d.range.least) && std::isinf(d.range.most))
    fail(Failure::numerical, "dataset ", d.name, " has no range; its codec gives it one");
  if (list_) {
    list_->push_back(d);
    return;
  }
  if (out_ && record_ != Record::none) return put_record(d, member);
  std::visit(
      [&](auto* value) {
        if (in_) take(*in_, d, known_shape(d.axes), *value);
        note_shape(d, shape_along(known_shape(d.axes), *value));
        if (out_) put(*out_, d, known_shape(d.axes), *value);
      },
      member);
}

void Codec::put_record(const Dataset& d, const Member& member) {
  constexpr std::size_t kChunk = 16384;  // rows
  const auto* vector = std::get_if<Eigen::VectorXd*>(&member);
  const auto* matrix = std::get_if<MatrixRM*>(&member);
  if (!vector && !matrix) fail(Failure::numerical, "dataset ", d.name, " is no record of rows");
  std::vector<Eigen::Index> shape = vector ? shape_of(**vector) : shape_along(known_shape(d.axes), **matrix);
  const double* data = vector ? (*vector)->data() : (*matrix)->data();
  if (record_ == Record::append) {
    out_->file().append(d.name, data, static_cast<std::size_t>(rows_), static_cast<std::size_t>(shape[0]));
    return;
  }
  shape[0] = rows_;
  note_shape(d, shape);
  // Values in single precision (6e-8); coordinates along an axis in double, or neighbours in a long record would be equal.
  const bool coordinate = d.name == "/" + d.axes;
  out_->file().reserve(d.name, sizes(known_shape(d.axes)), kChunk, !coordinate, label(d));
}

void Codec::picture(const VtkGrid& grid) {
  if (!out_ || grid.point.rows() == 0) return;
  put_vtk(out_->file(), grid);
  picture_ = true;
}

void Codec::column(const Dataset& d, MatrixRM& values, Eigen::Index column, Eigen::Index columns) {
  Eigen::VectorXd one;
  if (out_) {
    if (values.cols() != columns)
      fail(Failure::numerical, "result ", d.name, " is of ", values.cols(), " columns instead of ", columns);
    one = values.col(column);
  }
  dataset(d, &one);
  if (!in_) return;
  if (values.cols() != columns || values.rows() != one.size()) values.resize(one.size(), columns);
  values.col(column) = one;
}

void Codec::numbers(const std::string& axis, int first, const std::string& meaning) {
  if (in_) return;
  Eigen::VectorXi values(length(axis));
  for (Eigen::Index i = 0; i < values.size(); ++i) values[i] = first + static_cast<int>(i);
  dataset({"/" + axis, "1", meaning, axis, kNumber}, &values);
}

bool Codec::optional(const std::string& name, bool there) const {
  return list_ || (in_ ? in_->has(name) : there);
}

void Codec::axis(const std::string& name, Eigen::Index length) {
  lengths_[name] = length;
}

Eigen::Index Codec::length(const std::string& axis) const {
  const auto found = lengths_.find(axis);
  return found == lengths_.end() ? 0 : found->second;
}

void Codec::parameters(const std::string& section, const KeyList& keys) const {
  if (out_) out_->parameters(section, keys);
  if (in_) in_->parameters(section, keys);
}

// --- what several artifacts have in common

void describe_gear(Codec& c, const std::string& role, BodyParameters& gear) {
  c.parameters(role, keys(gear.design).append(keys(gear.material)).append(keys(gear.discretisation).all()));
}

void describe_design(Codec& c, const std::string& section, GearDesign& design) {
  c.parameters(section, keys(design));
}

void describe_pair(Codec& c, GearPairParameters& a, bool fidelity) {
  for (int g = 0; g < kSides; ++g) describe_gear(c, kRole[g], a.gear[g]);
  c.parameters("mesh", keys(a.mesh));
  if (fidelity) c.parameters("fidelity", keys(a.fidelity).only({"contact", "width"}));
  c.parameters("discretisation", keys(a.contact));
}

void describe_motion(Codec& c, MotionParameters& a, bool time) {
  for (int g = 0; g < kSides; ++g) c.parameters(kRole[g], inertia_key(a.inertia[g]));
  c.parameters("damping", keys(a.damping));
  c.parameters("fidelity", keys(a.fidelity).without({"contact", "width"}));
  if (time) c.parameters("discretisation", keys(a.time));
}

void describe_torque(Codec& c, double& torque) {
  c(torque, "/parameters/operation/torque", "N m", kDrive, "", "torque on the driver");
}

void describe_speeds(Codec& c, MeshSpeeds& s) {
  for (const auto& [name, value] : {std::pair{"from", &s.frequency_from}, std::pair{"to", &s.frequency_to},
                                    std::pair{"step", &s.frequency_step}})
    c(*value, text("/parameters/operation/mesh_frequency_", name), "Hz", kFrequency, "",
      "speeds of the sweeps");
}

void describe_bearing_dampers(Codec& c, double& mean_stiffness, std::array<double, kSides>& damper) {
  constexpr Range kDamper{0, 1e12};
  c(mean_stiffness, "/parameters/damping/mean_stiffness", "N m-1", kStiff, "",
    "mean secant stiffness that sets the bearing dampers");
  for (int g = 0; g < kSides; ++g)
    c(damper[g], text("/parameters/damping/", kRole[g], "_bearing_damper"), "N m s", kDamper, "",
      text("torque damper at the axis of the ", kGearName[g]), "c = 2 ratio I w");
}

void describe_model(Codec& c, MotionModel& model, const std::string& meaning, DamperActs* damper_acts) {
  const std::string dataset = "/parameters/fidelity/model";
  std::string name = damper_acts ? name_of(model, *damper_acts) : name_of(model), known;
  c(name, dataset, "", meaning);
  if (!c.in()) return;
  for (const DamperActs acts : {DamperActs::always, DamperActs::contact})
    for (int i = 0; i <= static_cast<int>(MotionModel::pairs_hertz); ++i) {
      const auto own = static_cast<MotionModel>(i);
      if (acts == DamperActs::contact && (!damper_acts || own == MotionModel::finite_elements)) continue;
      if (known += (known.empty() ? "" : ", ") + name_of(own, acts); name != name_of(own, acts)) continue;
      model = own;
      if (damper_acts) *damper_acts = acts;
      return;
    }
  c.in()->reject(text("dataset ", dataset, " is '", name, "', which is none of: ", known));
}

void describe_certificate(Codec& c, double& least_gap, double& least_force, int& fallbacks) {
  c(least_gap, "/certificate/least_gap", "m", kLength, "",
    "least gap of a strip without force, over all steps", "d >= 0 where p = 0 (with Eq. 18, 20)");
  c(least_force, "/certificate/least_force", "N", kForce, "",
    "least force of a strip in contact, over all steps", "p >= 0 where d = 0 (with Eq. 18, 20)");
  c(fallbacks, "/certificate/fallbacks", "1", kNumber, "",
    "contact solutions that needed Lawson and Hanson's method");
}

void describe_backlash(Codec& c, double& margin) {
  if (c.optional("/backlash_margin", !std::isinf(margin)))
    c(margin, "/backlash_margin", "m", kLength, "", "least backlash left along the line of action");
  else if (c.in())
    margin = std::numeric_limits<double>::infinity();
}

void describe_backlash_left(Codec& c, Eigen::VectorXd& backlash_left) {
  if (c.optional("/backlash_left", backlash_left.size() > 0 && backlash_left.allFinite()))
    c(backlash_left, "/backlash_left", "m", kLength, "mesh_frequency",
      "backlash that the motion leaves along the line of action; below 0 back flanks would touch, which is not modelled");
  else if (c.in())
    backlash_left.setConstant(c.length("mesh_frequency"), std::numeric_limits<double>::infinity());
}

void describe_remarks(Codec& c, std::vector<Remark>& remarks) {
  if (!c.optional("/remark", !remarks.empty())) return;
  std::vector<std::string> words;
  Eigen::VectorXi warning(static_cast<Eigen::Index>(remarks.size()));
  for (const Remark& remark : remarks) {
    warning[static_cast<Eigen::Index>(words.size())] = remark.warning ? 1 : 0;
    words.push_back(remark.words);
  }
  c(words, "/remark", "remark", "what a reader has to know beside the numbers");
  c(warning, "/remark_is_warning", "1", kFlag, "remark",
    "1: something is wrong or left out; 0: out of the ordinary only");
  if (!c.in()) return;
  for (size_t i = 0; i < words.size(); ++i)
    remarks.push_back({warning[static_cast<Eigen::Index>(i)] == 1, words[i]});
}

void describe_root_place(Codec& c, const std::string& angle_name, Eigen::VectorXd& angle,
                         const std::string& phase_name, Eigen::VectorXd& phase, const std::string& axis) {
  c(angle, angle_name, "1", kRoll, axis, kRootAngle);
  c(phase, phase_name, "1", kPlace, axis, kRootPhase);
}

void describe_friction(Codec& c, FrictionLosses& losses) {
  constexpr Range kPower{-1e12, 1e12};  // W
  if (!c.optional("/friction_power", losses.power.size() > 0)) return;
  const char* const axis = "mesh_frequency";
  c(losses.coefficient, "/friction_coefficient", "1", kShare, axis,
    "coefficient of friction; of a train the mean over its meshes, weighted with what friction takes in each");
  c(losses.power, "/friction_power", "W", kPower, axis,
    "mean power that friction takes in all meshes, the vibration in the sliding speed", "mean of mu s F v");
  c(losses.efficiency, "/efficiency", "1", kSigned, axis,
    "share of the power that goes in that friction leaves: of the driver of a pair; of a train of the drives, and of what holds a member that turns on the ground",
    "1 - friction_power / sum of the T omega above 0");
}

void describe_hunting(Codec& c, int& periods) {
  if (c.optional("/hunting_periods", periods > 1))
    c(periods, "/hunting_periods", "1", kPeriods, "",
      "mesh periods of a hunting period, after which the same teeth meet, as far as teeth differ");
}

void describe_natural_frequency(Codec& c, double& frequency) {
  c(frequency, "/natural_frequency", "Hz", kFrequency, "",
    "natural frequency: mean over the period with the contact frozen under the static load");
}

std::string gear_title(const GearDesign& design) {
  return text(design.teeth, " teeth, module ", design.module * 1e3, " mm");
}

std::string pair_title(const GearMeshSpec& mesh, double torque) {
  return text(mesh.gear[0], " drives ", mesh.gear[1], " with ", torque, " N m");
}

void require_indices(const Codec& c, const std::string& name, const Eigen::Ref<const MatrixRMi>& index,
                     Eigen::Index count) {
  if (!c.in() || index.size() == 0) return;
  if (index.minCoeff() < 0 || index.maxCoeff() >= count)
    c.in()->reject(text("dataset ", name, " holds the number ",
                        index.minCoeff() < 0 ? index.minCoeff() : index.maxCoeff(), ", allowed are 0 to ",
                        count - 1));
}

}  // namespace whine
