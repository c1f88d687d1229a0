// A thin layer over HDF5: labelled datasets in, checked datasets out. Files are built and read in memory, so
// that the file system sees one write of the whole (io/publish.h) and a full disk cannot leave HDF5 half
// way; records of any length are written to a staged file on disk. Identical calls give identical bytes: no object times, no
// addresses, no padding that is not cleared.
//
// HDF5's own types stay in h5.cpp; this is private to the layer io/.
#pragma once
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace whine::h5 {

using Shape = std::vector<std::size_t>;  // empty: scalar

// What h5dump shows beside the numbers.
struct Label {
  std::string units;      // UDUNITS form, "1" if none
  std::string long_name;  // what it is
  std::string axes;       // names of the axes in index order, blank between; empty for a scalar
  std::string equation;   // optional: where it comes from
};

class Writer {
 public:
  Writer();
  // Into an existing file on disk, for what is more than memory should hold; it ends with close() instead of finish(). One at a
  // time. Error(io) of it and of all that follows names `path`, under which the file is to be published, and says what the system
  // said.
  Writer(const std::string& file, const std::string& path);
  ~Writer();
  Writer(const Writer&) = delete;
  Writer& operator=(const Writer&) = delete;

  // Every group on the way to `path` is made where it is missing. Values that are not finite, and shapes that
  // do not fit the data, are rejected with Error(numerical) naming the dataset.
  void group(const std::string& path);
  void put(const std::string& path, const double* data, const Shape& shape, const Label& label);
  void put(const std::string& path, const float* data, const Shape& shape, const Label& label);
  void put(const std::string& path, const int* data, const Shape& shape, const Label& label);
  void put(const std::string& path, const std::int64_t* data, const Shape& shape, const Label& label);
  void put(const std::string& path, const std::uint8_t* data, const Shape& shape, const Label& label);
  void put(const std::string& path, const std::vector<std::string>& data, const Label& label);
  void put(const std::string& path, const std::string& value, const Label& label);
  // A dataset, in single or double precision, whose rows come later, in chunks of `chunk` rows. Rows that do not come would be
  // zeros.
  void reserve(const std::string& path, const Shape& shape, std::size_t chunk, bool single,
               const Label& label);
  // `rows` rows from row `first` on. Error(numerical) as of put, or beyond what is reserved.
  void append(const std::string& path, const double* data, std::size_t first, std::size_t rows);
  // Attributes of an existing object ("/" is the root).
  void attribute(const std::string& path, const std::string& name, const std::string& value);
  void attribute(const std::string& path, const std::string& name, const std::vector<std::int64_t>& values);
  void attribute(const std::string& path, const std::string& name, int value);
  // Fixed-length ASCII, which VTK's reader asks for.
  void ascii_attribute(const std::string& path, const std::string& name, const std::string& value);

  // The bytes of the file, with a dimension scale (H5DS) attached to each axis of each dataset outside of /VTKHDF; the writer
  // is spent afterwards. Error(numerical) if datasets differ in the length of an axis.
  std::string finish();
  // The same of a file on disk.
  void close();

 private:
  void create(const std::string& name, bool on_disk);
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

class Reader {
 public:
  // bytes: a whole file; path and hint only name it in errors, which are all "<path>: <what>; <hint>".
  // Error(io) if this is no HDF5 file or a truncated one.
  Reader(const std::string& bytes, std::string path, std::string hint);
  ~Reader();
  Reader(const Reader&) = delete;
  Reader& operator=(const Reader&) = delete;

  bool has(const std::string& path) const;
  std::vector<std::string> children(const std::string& group) const;  // names in alphabetical order
  // Shape of a dataset; Error(input) if it is missing.
  Shape shape(const std::string& path) const;
  // All values in row-major order. Error(input): missing, other type class, values that are not finite.
  std::vector<double> doubles(const std::string& path) const;
  std::vector<int> ints(const std::string& path) const;
  std::vector<std::string> strings(const std::string& path) const;
  // Attributes; Error(input) if missing.
  std::string string_attribute(const std::string& path, const std::string& name) const;
  int int_attribute(const std::string& path, const std::string& name) const;

  // Throws Error(input): "<path>: <what>; <hint>".
  [[noreturn]] void reject(const std::string& what) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace whine::h5
