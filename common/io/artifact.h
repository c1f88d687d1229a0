// What all artifacts share: root attributes, /provenance, /parameters, publication; and the checks on
// reading.
//
// Private to the layer io/; the codecs (io/codec.h) say what stands in each artifact.
#pragma once
#include <Eigen/Core>
#include <memory>
#include <string>
#include <vector>

#include "base/matrix.h"
#include "io/h5.h"
#include "io/keys.h"
#include "io/provenance.h"
#include "io/publish.h"
#include "io/ranges.h"

namespace whine {

// The dataset /provenance/content_sha256 ends with the SHA-256 of the file in which these 64 digits are zeros. It is
// checked on the bytes of the file, so that HDF5 never parses a file that is not what its writer has made. No attribute:
// those are under a checksum of HDF5's own.
void put_seal(h5::Writer& file);
// The bytes of such a file with the digits that they ask for. Error(numerical) if there is no place for them.
std::string sealed(std::string bytes);

class ArtifactWriter {
 public:
  // kind: "static" for the schema "whine/static".
  ArtifactWriter(std::string path, const std::string& kind, int version, const std::string& title,
                 const Provenance& provenance);
  // The same into a staged file on disk, for records of any length.
  static ArtifactWriter on_disk(std::string path, const std::string& kind, int version,
                                const std::string& title, const Provenance& provenance);

  h5::Writer& file() { return *file_; }

  void put(const std::string& name, double value, const h5::Label& label);
  void put(const std::string& name, int value, const h5::Label& label);
  void put(const std::string& name, const std::string& value, const h5::Label& label);
  void put(const std::string& name, const Eigen::VectorXd& values, const h5::Label& label);
  void put(const std::string& name, const Eigen::VectorXi& values, const h5::Label& label);
  void put(const std::string& name, const MatrixRM& values, const h5::Label& label);
  void put(const std::string& name, const MatrixRMi& values, const h5::Label& label);

  // /parameters/<section>/<key> for the keys that are held.
  void parameters(const std::string& section, const KeyList& keys);

  // Writes the file whole or not at all. Error(input) if an input is not what it was when the stage read it.
  void publish();

 private:
  ArtifactWriter(std::string path, std::unique_ptr<StagedFile> staged, const std::string& kind, int version,
                 const std::string& title, const Provenance& provenance);

  std::string path_;
  std::vector<std::string> inputs_, sha256_;  // "role=path", and what was recorded of it
  std::unique_ptr<StagedFile> staged_;        // or nothing
  std::unique_ptr<h5::Writer> file_;
};

// Values of a dataset, row by row.
template <class Value>
struct Block {
  std::vector<Value> values;
  h5::Shape shape;
};

class ArtifactReader {
 public:
  // Rejects everything that is not the given schema in the given version.
  ArtifactReader(const std::string& path, const std::string& kind, int version);

  virtual ~ArtifactReader() = default;

  virtual bool has(const std::string& name) const;
  // Throws Error(input): "<path>: <what>; <hint>".
  [[noreturn]] void reject(const std::string& what) const;
  // Values of a dataset. Error(input) if a number is out of range or the shape is another; a length of -1 is any.
  virtual Block<double> doubles(const std::string& name, const Range& range,
                                const std::vector<Eigen::Index>& shape) const;
  virtual Block<int> ints(const std::string& name, const Range& range,
                          const std::vector<Eigen::Index>& shape) const;
  virtual Block<std::string> words(const std::string& name, const std::vector<Eigen::Index>& shape) const;

  double number(const std::string& name, const Range& range = {}) const;
  int whole(const std::string& name, const Range& range = {}) const;
  std::string word(const std::string& name) const;
  Eigen::VectorXd vector(const std::string& name, const Range& range, Eigen::Index size = -1) const;
  Eigen::VectorXi whole_vector(const std::string& name, const Range& range, Eigen::Index size = -1) const;
  MatrixRM matrix(const std::string& name, const Range& range, Eigen::Index rows = -1,
                  Eigen::Index columns = -1) const;
  MatrixRMi whole_matrix(const std::string& name, const Range& range, Eigen::Index rows = -1,
                         Eigen::Index columns = -1) const;

  void parameters(const std::string& section, const KeyList& keys) const;

 protected:
  ArtifactReader() = default;  // of values that come from elsewhere
  virtual void rejected(const std::string& what) const;

 private:
  std::unique_ptr<h5::Reader> file_;
};

}  // namespace whine
