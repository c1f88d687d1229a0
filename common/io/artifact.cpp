#include "io/artifact.h"

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>

#include "base/error.h"
#include "base/tool.h"
#include "io/artifact_place.h"
#include "io/compatibility.h"
#include "io/provenance.h"
#include "io/publish.h"
#include "results/motion_model.h"

namespace whine {
namespace {

const std::string kFamily = "whine/";

h5::Label record(const std::string& long_name, const std::string& axes = "") {
  return {"1", long_name, axes, ""};
}

bool is_hdf5(const std::string& bytes) {
  return bytes.compare(0, 4, "\x89HDF") == 0;
}

const std::string kSealed = "/provenance/content_sha256";
const std::string kSeal = "sha256 of this file with zeros in place of these digits: ";
const std::string kUnsealed(64, '0');

// Of an artifact whose content is what its writer has published. Error(io) otherwise; what is no HDF5 file is left to
// its reader.
std::string artifact_bytes(const std::string& path) {
  std::string bytes = read_bytes(path, rebuild_advice(path));
  if (!is_hdf5(bytes)) return bytes;
  const auto reject = [&](const char* what) {
    fail(Failure::io, path, ": ", what, " (", bytes.size(), " bytes); ", rebuild_advice(path));
  };
  const auto at = bytes.find(kSeal);
  if (at == std::string::npos || bytes.size() - at < kSeal.size() + kUnsealed.size())
    reject("carries no content hash: it is truncated, damaged or of an earlier version of this program");
  const auto digits = bytes.begin() + static_cast<std::ptrdiff_t>(at + kSeal.size());
  std::string found(kUnsealed);
  std::swap_ranges(found.begin(), found.end(), digits);
  if (sha256(bytes) != found) reject("is not what was written: truncated, damaged or edited");
  std::copy(found.begin(), found.end(), digits);
  return bytes;
}

Origin origin_of(const h5::Reader& file) {
  Origin out;
  out.schema = file.string_attribute("/", "schema");
  if (out.schema.compare(0, kFamily.size(), kFamily) != 0) {
    file.reject("is a file of '" + out.schema + "', not of this program");
  }
  out.schema_version = file.int_attribute("/", "schema_version");
  out.title = file.string_attribute("/", "title");
  const auto word = [&](const std::string& name) {
    const auto words = file.strings("/provenance/" + name);
    return words.empty() ? std::string() : words.front();
  };
  out.tool = word("tool");
  out.version = word("version");
  out.command = word("command");
  const auto roles = file.strings("/provenance/input_role");
  const auto paths = file.strings("/provenance/input_path");
  const auto hashes = file.strings("/provenance/input_sha256");
  if (paths.size() != roles.size() || hashes.size() != roles.size()) {
    file.reject("/provenance names inputs of different number");
  }
  for (std::size_t i = 0; i < roles.size(); ++i) out.inputs.push_back({roles[i], paths[i], hashes[i]});
  out.history = file.strings("/provenance/history");
  const std::string operation = "/parameters/operation/", model = "/parameters/fidelity/model";
  out.has_torque = file.has(operation + "torque");
  if (out.has_torque) out.torque = file.doubles(operation + "torque").at(0);
  if (file.has(operation + "direction")) out.direction = file.strings(operation + "direction").at(0);
  if (file.has(model)) out.model = file.strings(model).at(0);
  if (motion_model_of(out.model) == MotionModel::finite_elements) out.model.clear();
  return out;
}

Eigen::Index as_index(std::size_t value) {
  return static_cast<Eigen::Index>(value);
}

}  // namespace

void put_seal(h5::Writer& file) {
  file.put(kSealed, kSeal + kUnsealed,
           record("content hash, which readers check before they parse the file"));
}

std::string sealed(std::string bytes) {
  const auto at = bytes.find(kSeal);
  if (at == std::string::npos || bytes.size() - at < kSeal.size() + kUnsealed.size())
    fail(Failure::numerical, "the file has no place for its content hash");
  bytes.replace(at + kSeal.size(), kUnsealed.size(), kUnsealed);
  return bytes.replace(at + kSeal.size(), kUnsealed.size(), sha256(bytes));
}

Origin read_origin(const std::string& path) {
  return origin_of(h5::Reader(artifact_bytes(path), path, rebuild_advice(path)));
}

namespace {

// hashes: of files that were read before, by path.
void require_fresh_inputs(const std::string& artifact, std::map<std::string, std::string>& hashes) {
  const Origin origin = read_origin(artifact);
  if (const std::string wrong = misplaced(artifact, origin); !wrong.empty())
    fail(Failure::input, artifact, ": ", wrong, "; ", rebuild_advice(artifact));
  for (const InputRecord& input : origin.inputs) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(input.path, ignored)) continue;
    const auto [hash, first] = hashes.try_emplace(input.path);
    if (first) hash->second = sha256_of_file(input.path);
    if (hash->second != input.sha256)
      fail(Failure::input, artifact, ": is stale: its input '", input.role, "', ", input.path,
           ", is not what it was; ", rebuild_advice(artifact));
  }
}

}  // namespace

void require_fresh(const std::string& artifact) {
  std::map<std::string, std::string> none;
  require_fresh_inputs(artifact, none);
}

Provenance made_by(int argc, char** argv, std::vector<std::string> inputs) {
  std::map<std::string, std::string> known_inputs;  // of the inputs, which a thousand variants share
  Provenance out{program_name(argv[0]), command_line(argc, argv), std::move(inputs), {}};
  std::map<std::string, std::string>
      known;  // a file in two roles, as the body of gears that are alike, is read once
  for (const std::string& input : out.inputs) {
    const std::string path = input.substr(input.find('=') + 1);
    const auto [hash, first] = known.try_emplace(path);
    if (first) {
      // No target makes stage parameters of a scene.
      const bool artifact = path.ends_with(".h5");
      // One that is missing has no hash: its reader knows what to advise.
      if (artifact || std::filesystem::exists(path)) {
        const std::string bytes = read_bytes(path, artifact ? rebuild_advice(path) : "");
        hash->second = sha256(bytes);
        if (is_hdf5(bytes)) require_fresh_inputs(path, known_inputs);
      }
    }
    out.sha256.push_back(hash->second);
  }
  return out;
}

std::string recorded_input(const std::string& artifact, const std::string& role) {
  for (const auto& input : read_origin(artifact).inputs) {
    if (input.role == role) return input.sha256;
  }
  fail(Failure::input, artifact, ": records no input '", role, "'; ", rebuild_advice(artifact));
}

void require_made_from(const std::string& artifact, const std::string& role, const std::string& input) {
  if (recorded_input(artifact, role) == sha256_of_file(input)) return;
  fail(Failure::input, artifact, ": is stale: its input '", role, "' was not what ", input, " is now; ",
       rebuild_advice(artifact));
}

ArtifactWriter::ArtifactWriter(std::string path, const std::string& kind, int version,
                               const std::string& title, const Provenance& provenance)
    : ArtifactWriter(std::move(path), nullptr, kind, version, title, provenance) {}

ArtifactWriter ArtifactWriter::on_disk(std::string path, const std::string& kind, int version,
                                       const std::string& title, const Provenance& provenance) {
  auto staged = std::make_unique<StagedFile>(path);
  return ArtifactWriter(std::move(path), std::move(staged), kind, version, title, provenance);
}

ArtifactWriter::ArtifactWriter(std::string path, std::unique_ptr<StagedFile> staged, const std::string& kind,
                               int version, const std::string& title, const Provenance& provenance)
    : path_(std::move(path)),
      inputs_(provenance.inputs),
      sha256_(provenance.sha256),
      staged_(std::move(staged)),
      file_(staged_ ? std::make_unique<h5::Writer>(staged_->temporary(), path_)
                    : std::make_unique<h5::Writer>()) {
  put_seal(*file_);
  file_->attribute("/", "schema", kFamily + kind);
  file_->attribute("/", "schema_version", version);
  file_->attribute("/", "title", title);
  file_->group("/parameters");

  std::vector<std::string> roles, paths, hashes, history;
  std::map<std::string, std::string> known;  // hashes by path
  std::set<std::string> named;               // lines of the history
  for (const std::string& input : provenance.inputs) {
    const auto equals = input.find('=');
    if (equals == std::string::npos) fail(Failure::numerical, "input '", input, "' is not role=path");
    const std::string place = input.substr(equals + 1);
    roles.push_back(input.substr(0, equals));
    paths.push_back(recorded_path(place));
    const auto [hash, first] = known.try_emplace(place);
    const std::string bytes = first ? artifact_bytes(place) : "";
    if (first) hash->second = sha256(bytes);
    hashes.push_back(hash->second);
    if (!is_hdf5(bytes)) continue;
    const Origin origin = origin_of(h5::Reader(bytes, place, rebuild_advice(place)));
    std::vector<std::string> lines = origin.history;
    lines.push_back(origin.tool + " " + origin.version + ": " + origin.command);
    for (const std::string& line : lines)
      if (named.insert(line).second) history.push_back(line);
  }
  const std::string folder = "/provenance/";
  file_->put(folder + "tool", provenance.tool, record("program that made this file"));
  file_->put(folder + "version", std::string(kVersion), record("version of the program"));
  file_->put(folder + "command", provenance.command, record("command, paths relative to its working folder"));
  file_->put(folder + "blas", blas_name(), record("linear algebra library"));
  file_->put(folder + "input_role", roles, record("role of each input", "input"));
  file_->put(folder + "input_path", paths,
             record("path of each input, relative to the working folder", "input"));
  file_->put(folder + "input_sha256", hashes, record("SHA-256 of each input file", "input"));
  file_->put(folder + "history", history, record("earlier stages, oldest first", "stage"));
}

void ArtifactWriter::put(const std::string& name, double value, const h5::Label& label) {
  file_->put(name, &value, {}, label);
}

void ArtifactWriter::put(const std::string& name, int value, const h5::Label& label) {
  file_->put(name, &value, {}, label);
}

void ArtifactWriter::put(const std::string& name, const std::string& value, const h5::Label& label) {
  file_->put(name, value, label);
}

void ArtifactWriter::put(const std::string& name, const Eigen::VectorXd& values, const h5::Label& label) {
  file_->put(name, values.data(), {static_cast<std::size_t>(values.size())}, label);
}

void ArtifactWriter::put(const std::string& name, const Eigen::VectorXi& values, const h5::Label& label) {
  file_->put(name, values.data(), {static_cast<std::size_t>(values.size())}, label);
}

void ArtifactWriter::put(const std::string& name, const MatrixRM& values, const h5::Label& label) {
  file_->put(name, values.data(),
             {static_cast<std::size_t>(values.rows()), static_cast<std::size_t>(values.cols())}, label);
}

void ArtifactWriter::put(const std::string& name, const MatrixRMi& values, const h5::Label& label) {
  file_->put(name, values.data(),
             {static_cast<std::size_t>(values.rows()), static_cast<std::size_t>(values.cols())}, label);
}

void ArtifactWriter::publish() {
  std::map<std::string, std::string> now;
  for (std::size_t i = 0; i < sha256_.size(); ++i) {
    const std::string place = inputs_[i].substr(inputs_[i].find('=') + 1);
    const auto [hash, first] = now.try_emplace(place);
    if (first) hash->second = sha256_of_file(place);
    if (hash->second != sha256_[i])
      fail(Failure::input, path_, ": is not written, because its input ", place,
           " was replaced while it was being made; ", rebuild_advice(path_));
  }
  if (!staged_) return whine::publish(path_, sealed(file_->finish()));
  file_->close();
  staged_->seal(kSeal);
  staged_->publish();
}

ArtifactReader::ArtifactReader(const std::string& path, const std::string& kind, int version)
    : file_(std::make_unique<h5::Reader>(artifact_bytes(path), path, rebuild_advice(path))) {
  const std::string schema = file_->string_attribute("/", "schema");
  if (schema != kFamily + kind)
    file_->reject(text("is '", schema, "', but '", kFamily + kind, "' is wanted here"));
  const int found = file_->int_attribute("/", "schema_version");
  if (found != version) file_->reject(text("is schema version ", found, ", this program reads ", version));
}

namespace {

template <class Values>
void require_range(const h5::Reader& file, const std::string& name, const Range& range,
                   const Values& values) {
  for (const auto value : values)
    if (const std::string why = outside(range, value); !why.empty())
      file.reject("dataset " + name + " " + why);
}

// Names both shapes if they differ.
h5::Shape required_shape(const h5::Reader& file, const std::string& name,
                         const std::vector<Eigen::Index>& wanted) {
  if (!file.has(name))
    file.reject(text("has no dataset ", name, ": it is schema version ",
                     file.int_attribute("/", "schema_version"),
                     " as another state of the program wrote it, or damaged"));
  const h5::Shape shape = file.shape(name);
  bool same = shape.size() == wanted.size();
  for (std::size_t i = 0; same && i < shape.size(); ++i)
    same = wanted[i] < 0 || as_index(shape[i]) == wanted[i];
  if (same) return shape;
  const auto shown = [](const auto& extents) {
    std::string out;
    for (auto extent : extents) {
      const auto number = static_cast<long long>(extent);
      out += (out.empty() ? "" : " x ") + (number < 0 ? std::string("any") : std::to_string(number));
    }
    return out.empty() ? std::string("scalar") : out;
  };
  file.reject("dataset " + name + " has shape " + shown(shape) + ", expected " + shown(wanted));
}

}  // namespace

bool ArtifactReader::has(const std::string& name) const {
  return file_->has(name);
}

void ArtifactReader::reject(const std::string& what) const {
  rejected(what);
  fail(Failure::input, what);
}

void ArtifactReader::rejected(const std::string& what) const {
  file_->reject(what);
}

Block<double> ArtifactReader::doubles(const std::string& name, const Range& range,
                                      const std::vector<Eigen::Index>& shape) const {
  const h5::Shape found = required_shape(*file_, name, shape);
  Block<double> block{file_->doubles(name), found};
  require_range(*file_, name, range, block.values);
  return block;
}

Block<int> ArtifactReader::ints(const std::string& name, const Range& range,
                                const std::vector<Eigen::Index>& shape) const {
  const h5::Shape found = required_shape(*file_, name, shape);
  Block<int> block{file_->ints(name), found};
  require_range(*file_, name, range, block.values);
  return block;
}

Block<std::string> ArtifactReader::words(const std::string& name,
                                         const std::vector<Eigen::Index>& shape) const {
  const h5::Shape found = required_shape(*file_, name, shape);
  return {file_->strings(name), found};
}

double ArtifactReader::number(const std::string& name, const Range& range) const {
  return doubles(name, range, {}).values.at(0);
}

int ArtifactReader::whole(const std::string& name, const Range& range) const {
  return ints(name, range, {}).values.at(0);
}

std::string ArtifactReader::word(const std::string& name) const {
  return words(name, {}).values.at(0);
}

Eigen::VectorXd ArtifactReader::vector(const std::string& name, const Range& range, Eigen::Index size) const {
  const auto block = doubles(name, range, {size});
  return Eigen::Map<const Eigen::VectorXd>(block.values.data(), as_index(block.values.size()));
}

Eigen::VectorXi ArtifactReader::whole_vector(const std::string& name, const Range& range,
                                             Eigen::Index size) const {
  const auto block = ints(name, range, {size});
  return Eigen::Map<const Eigen::VectorXi>(block.values.data(), as_index(block.values.size()));
}

MatrixRM ArtifactReader::matrix(const std::string& name, const Range& range, Eigen::Index rows,
                                Eigen::Index columns) const {
  const auto [values, shape] = doubles(name, range, {rows, columns});
  return Eigen::Map<const MatrixRM>(values.data(), as_index(shape[0]), as_index(shape[1]));
}

MatrixRMi ArtifactReader::whole_matrix(const std::string& name, const Range& range, Eigen::Index rows,
                                       Eigen::Index columns) const {
  const auto [values, shape] = ints(name, range, {rows, columns});
  return Eigen::Map<const MatrixRMi>(values.data(), as_index(shape[0]), as_index(shape[1]));
}

}  // namespace whine
