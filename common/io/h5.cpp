#include "io/h5.h"

#include <hdf5_hl.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <sstream>
#include <utility>

#include "base/error.h"
#include "io/h5_handle.h"
#include "io/h5_heaps.h"

namespace whine::h5 {
namespace {

// Large enough to be worth a filter; below it the chunk's book-keeping costs more than it saves.
constexpr std::size_t kFilterBytes = 8192;
constexpr std::size_t kChunkBytes = 1 << 20;

// HDF5 takes two files in memory for one if their names agree; the name is not stored.
std::string memory_name() {
  static std::atomic<long> count{0};
  return text("whine-", ++count, ".h5");
}

// Of no fixed length for attributes, which readers of other languages then show as text.
Handle string_type(std::size_t size = H5T_VARIABLE) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "copy a type");
  check(H5Tset_size(type, size), "set a string size");
  check(H5Tset_cset(type, H5T_CSET_UTF8), "set a character set");
  return type;
}

Handle space_of(const Shape& shape) {
  if (shape.empty()) return Handle(H5Screate(H5S_SCALAR), H5Sclose, "make a scalar space");
  const std::vector<hsize_t> extent(shape.begin(), shape.end());
  return Handle(H5Screate_simple(static_cast<int>(extent.size()), extent.data(), nullptr), H5Sclose,
                "make a space");
}

std::size_t count_of(const Shape& shape) {
  std::size_t count = 1;
  for (std::size_t n : shape) count *= n;
  return count;
}

// Groups of any size list their members in their header. HDF5 1.10 frees what it has not yet filled in where it comes upon
// damage in the other form, a heap with an index.
void list_in_header(hid_t group_creation) {
  check(H5Pset_link_phase_change(group_creation, 65535, 0), "select how groups list their members");
}

}  // namespace

// The bytes of a file that is made in memory. H5Fget_file_image clears a mark in the superblock and leaves its checksum as
// it was (1.10), so they are taken where HDF5 gives its memory back.
struct Image {
  std::string bytes;
  bool wanted = false;

  static void* take(std::size_t size, H5FD_file_image_op_t, void*) { return std::malloc(size); }
  static void* resize(void* memory, std::size_t size, H5FD_file_image_op_t, void*) {
    return std::realloc(memory, size);
  }
  static herr_t give_back(void* memory, H5FD_file_image_op_t, void* self) {
    auto& image = *static_cast<Image*>(self);
    if (image.wanted) {
      constexpr std::size_t kEndOfFile = 28;  // in the superblock; more memory may have been taken
      std::uint64_t size = 0;
      std::memcpy(&size, static_cast<const char*>(memory) + kEndOfFile, sizeof size);
      image.bytes.assign(static_cast<const char*>(memory), size);
    }
    std::free(memory);
    return 0;
  }
  static void* same(void* self) { return self; }
  static herr_t keep(void*) { return 0; }
};

struct Writer::Impl {
  hid_t file = -1;
  bool on_disk = false;
  Image image;

  // Datasets with axes, in the order in which they were made, and where each stands.
  struct WithAxes {
    std::string path;
    std::vector<std::string> axes;
    Shape shape;
  };
  std::vector<WithAxes> with_axes;
  std::map<std::string, std::size_t> extent_of;  // of each dimension scale, by its path

  // All of one length, so that they stand where they belong and not in a heap.
  void put(const std::string& path, const std::vector<std::string>& words, const Shape& shape,
           const Label& label) {
    std::size_t longest = 0;
    for (const std::string& word : words) longest = std::max(longest, word.size());
    std::string block;
    for (const std::string& word : words) block += word + std::string(longest + 1 - word.size(), '\0');
    const Handle type = string_type(longest + 1);
    put(path, type, type, longest + 1, block.data(), shape, label);
    // Names along an axis are text to xarray, by which it finds them: sel(mesh="sun-planet1").
    if (path == "/" + label.axes) text_attribute(object(path), "_Encoding", "utf-8");
  }

  void attribute(hid_t object, const std::string& name, hid_t file_type, hid_t memory_type, hid_t space,
                 const void* value) {
    const Handle id(H5Acreate2(object, name.c_str(), file_type, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose,
                    "make the attribute " + name);
    check(H5Awrite(id, memory_type, value), "write the attribute " + name);
  }

  void text_attribute(hid_t object, const std::string& name, const std::string& value) {
    const Handle type = string_type();
    const char* data = value.c_str();
    attribute(object, name, type, type, space_of({}), &data);
  }

  Handle object(const std::string& path) {
    return Handle(H5Oopen(file, path.c_str(), H5P_DEFAULT), H5Oclose, "open " + path);
  }

  void make_groups(const std::string& path) {
    for (std::size_t end = path.find('/', 1);; end = path.find('/', end + 1)) {
      const std::string part = path.substr(0, end);
      if (!part.empty() && H5Lexists(file, part.c_str(), H5P_DEFAULT) <= 0) {
        const Handle list(H5Pcreate(H5P_GROUP_CREATE), H5Pclose, "make a property list");
        check(H5Pset_obj_track_times(list, 0), "switch object times off");
        list_in_header(list);
        const Handle made(H5Gcreate2(file, part.c_str(), H5P_DEFAULT, list, H5P_DEFAULT), H5Gclose,
                          "make the group " + part);
      }
      if (end == std::string::npos) return;
    }
  }

  void put(const std::string& path, hid_t file_type, hid_t memory_type, std::size_t item_bytes,
           const void* data, const Shape& shape, const Label& label, std::size_t chunk_rows = 0) {
    if (label.units.empty() || label.long_name.empty() || (!shape.empty() && label.axes.empty())) {
      fail(Failure::numerical, "dataset ", path, " lacks units, long_name or axes");
    }
    const auto slash = path.rfind('/');
    if (slash != 0 && slash != std::string::npos) make_groups(path.substr(0, slash));
    const Handle space = space_of(shape);
    const Handle list(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "make a property list");
    check(H5Pset_obj_track_times(list, 0), "switch object times off");
    const std::size_t count = count_of(shape);
    if (!shape.empty() && item_bytes > 0 && count * item_bytes >= kFilterBytes) {
      // Whole rows per chunk, about a megabyte: readers take curves of one speed or one table at a time.
      std::vector<hsize_t> chunk(shape.begin(), shape.end());
      const std::size_t row = count / shape[0] * item_bytes;
      chunk[0] = std::clamp<hsize_t>(chunk_rows > 0 ? chunk_rows : kChunkBytes / row, 1, shape[0]);
      check(H5Pset_chunk(list, static_cast<int>(chunk.size()), chunk.data()), "set chunks of " + path);
      check(H5Pset_shuffle(list), "set the shuffle filter");
      check(H5Pset_deflate(list, 4), "set the deflate filter");
    }
    const Handle set(H5Dcreate2(file, path.c_str(), file_type, space, H5P_DEFAULT, list, H5P_DEFAULT),
                     H5Dclose, "make the dataset " + path);
    if (count > 0 && data) {
      check(H5Dwrite(set, memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data), "write the dataset " + path);
    }
    text_attribute(set, "units", label.units);
    text_attribute(set, "long_name", label.long_name);
    if (!shape.empty()) text_attribute(set, "axes", label.axes);
    if (!label.equation.empty()) text_attribute(set, "equation", label.equation);
    if (shape.empty() || path.starts_with("/VTKHDF")) return;
    std::istringstream words(label.axes);
    WithAxes made{path, {}, shape};
    for (std::string word; words >> word;) made.axes.push_back(word);
    if (made.axes.size() != shape.size())
      fail(Failure::numerical, "dataset ", path, " has ", shape.size(), " dimensions and the axes '",
           label.axes, "'");
    with_axes.push_back(std::move(made));
  }

  // Dimension scales (HDF5's H5DS), by which netCDF and xarray know the axes. A dataset of one axis that is called like it is
  // its scale; other axes have a scale without values, as netCDF has dimensions without a variable.
  void scale_axes() {
    for (const WithAxes& set : with_axes)
      if (set.axes.size() == 1 && name_in(set.path) == name_in(set.axes[0])) {
        const Handle id(H5Dopen2(file, set.path.c_str(), H5P_DEFAULT), H5Dclose, "open " + set.path);
        check(H5DSset_scale(id, name_in(set.path).c_str()), "make a scale of " + set.path);
        extent_of[set.path] = set.shape[0];
      }
    for (const WithAxes& set : with_axes)
      for (std::size_t i = 0; i < set.axes.size(); ++i) {
        const std::string scale = scale_of(set, i);
        if (scale == set.path) continue;
        const Handle id(H5Dopen2(file, set.path.c_str(), H5P_DEFAULT), H5Dclose, "open " + set.path);
        const Handle other(H5Dopen2(file, scale.c_str(), H5P_DEFAULT), H5Dclose, "open " + scale);
        check(H5DSattach_scale(id, other, static_cast<unsigned>(i)), "attach an axis to " + set.path);
      }
  }

  // "/ring_down/time" -> "time", "/ring_down".
  static std::string name_in(const std::string& path) { return path.substr(path.rfind('/') + 1); }
  static std::string folder_of(const std::string& path) {
    const auto slash = path.rfind('/');
    return slash == std::string::npos ? "" : path.substr(0, slash);
  }

  // The scale of an axis stands in the group of the dataset or in one above it; where there is none, it is made in its own.
  std::string scale_of(const WithAxes& set, std::size_t i) {
    const std::string& axis = set.axes[i];
    const bool elsewhere = axis.find('/') != std::string::npos;
    const std::string home = elsewhere ? "/" + folder_of(axis) : folder_of(set.path),
                      name = "/" + name_in(axis);
    for (std::string folder = home;; folder = folder_of(folder)) {
      const auto found = extent_of.find(folder + name);
      if (found != extent_of.end()) {
        if (found->second != set.shape[i])
          fail(Failure::numerical, "dataset ", set.path, " has the length ", set.shape[i], " along ", axis,
               ", which has ", found->second);
        return found->first;
      }
      if (folder.empty()) break;
    }
    return make_scale(home + name, set.shape[i]);
  }

  std::string make_scale(const std::string& path, std::size_t extent) {
    const Handle list(H5Pcreate(H5P_DATASET_CREATE), H5Pclose, "make a property list");
    check(H5Pset_obj_track_times(list, 0), "switch object times off");
    const Handle space = space_of({extent});
    const Handle id(H5Dcreate2(file, path.c_str(), H5T_STD_U8LE, space, H5P_DEFAULT, list, H5P_DEFAULT),
                    H5Dclose, "make the axis " + path + ", a name that something else may have");
    char name[80];  // the words by which netCDF knows a dimension without a variable
    std::snprintf(name, sizeof name, "This is a netCDF dimension but not a netCDF variable.%10zu", extent);
    check(H5DSset_scale(id, name), "make a scale of " + path);
    text_attribute(id, "units", "1");
    text_attribute(id, "long_name", "axis without values");
    text_attribute(id, "axes", name_in(path));
    extent_of[path] = extent;
    return path;
  }

  template <class T>
  void put(const std::string& path, const T* data, const Shape& shape, const Label& label) {
    if constexpr (std::is_floating_point_v<T>) {
      for (std::size_t i = 0; i < count_of(shape); ++i) {
        if (!std::isfinite(data[i])) {
          fail(Failure::numerical, "the result ", path, " is not finite (", data[i], " at index ", i,
               "); nothing is written");
        }
      }
    }
    put(path, Types<T>::file(), Types<T>::memory(), sizeof(T), data, shape, label);
  }
};

Writer::Writer() : impl_(std::make_unique<Impl>()) {
  create(memory_name(), false);
}

Writer::Writer(const std::string& file, const std::string& path) : impl_(std::make_unique<Impl>()) {
  refusal() = {path, ""};
  create(file, true);
}

void Writer::create(const std::string& name, bool on_disk) {
  silence();
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "make a property list");
  if (!on_disk) check(H5Pset_fapl_core(access, 1 << 20, 0), "select memory as a file");
  check(H5Pset_fclose_degree(access, H5F_CLOSE_STRONG), "select strong closing");
  // The format in which all but global heaps has a checksum: HDF5 then refuses what is damaged before it follows it.
  check(H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110), "select a file format");
  H5FD_file_image_callbacks_t calls{Image::take, nullptr,     Image::resize, Image::give_back,
                                    Image::same, Image::keep, &impl_->image};
  if (!on_disk) check(H5Pset_file_image_callbacks(access, &calls), "take its memory");
  const Handle creation(H5Pcreate(H5P_FILE_CREATE), H5Pclose, "make a property list");
  check(H5Pset_obj_track_times(creation, 0), "switch object times off");
  list_in_header(creation);
  impl_->file = H5Fcreate(name.c_str(), H5F_ACC_TRUNC, creation, access);
  impl_->on_disk = on_disk;
  if (impl_->file < 0) reject_deed(on_disk ? "make the file" : "make a file in memory");
}

Writer::~Writer() {
  if (impl_->file >= 0) H5Fclose(impl_->file);
  if (impl_->on_disk) refusal() = {};
}

void Writer::group(const std::string& path) {
  impl_->make_groups(path);
}

void Writer::put(const std::string& path, const double* data, const Shape& shape, const Label& label) {
  impl_->put(path, data, shape, label);
}
void Writer::put(const std::string& path, const float* data, const Shape& shape, const Label& label) {
  impl_->put(path, data, shape, label);
}
void Writer::put(const std::string& path, const int* data, const Shape& shape, const Label& label) {
  impl_->put(path, data, shape, label);
}
void Writer::put(const std::string& path, const std::int64_t* data, const Shape& shape, const Label& label) {
  impl_->put(path, data, shape, label);
}
void Writer::put(const std::string& path, const std::uint8_t* data, const Shape& shape, const Label& label) {
  impl_->put(path, data, shape, label);
}

void Writer::put(const std::string& path, const std::vector<std::string>& data, const Label& label) {
  impl_->put(path, data, {data.size()}, label);
}

void Writer::put(const std::string& path, const std::string& value, const Label& label) {
  impl_->put(path, std::vector<std::string>{value}, {}, label);
}

void Writer::reserve(const std::string& path, const Shape& shape, std::size_t chunk, bool single,
                     const Label& label) {
  impl_->put(path, single ? Types<float>::file() : Types<double>::file(), Types<double>::memory(),
             single ? sizeof(float) : sizeof(double), nullptr, shape, label, chunk);
}

void Writer::append(const std::string& path, const double* data, std::size_t first, std::size_t rows) {
  if (!refusal().words.empty()) reject_deed("close " + path);
  const Handle set(H5Dopen2(impl_->file, path.c_str(), H5P_DEFAULT), H5Dclose, "open " + path);
  const Handle space(H5Dget_space(set), H5Sclose, "get a space");
  std::vector<hsize_t> extent(static_cast<std::size_t>(std::max(H5Sget_simple_extent_ndims(space), 0)));
  H5Sget_simple_extent_dims(space, extent.data(), nullptr);
  if (extent.empty() || first + rows > extent[0])
    fail(Failure::numerical, "the record ", path, " gets rows beyond those that it has");
  std::vector<hsize_t> start(extent.size(), 0), count(extent);
  start[0] = first;
  count[0] = rows;
  const std::size_t numbers = count_of({count.begin(), count.end()});
  for (std::size_t i = 0; i < numbers; ++i)
    if (!std::isfinite(data[i]))
      fail(Failure::numerical, "the result ", path, " is not finite (", data[i], " in row ",
           first + i * rows / numbers, "); nothing is written");
  check(H5Sselect_hyperslab(space, H5S_SELECT_SET, start.data(), nullptr, count.data(), nullptr),
        "select rows of " + path);
  const Handle memory = space_of({count.begin(), count.end()});
  check(H5Dwrite(set, H5T_NATIVE_DOUBLE, memory, space, H5P_DEFAULT, data),
        text("write rows ", first, " to ", first + rows, " of ", path));
}

void Writer::attribute(const std::string& path, const std::string& name, const std::string& value) {
  impl_->text_attribute(impl_->object(path), name, value);
}

void Writer::attribute(const std::string& path, const std::string& name,
                       const std::vector<std::int64_t>& values) {
  impl_->attribute(impl_->object(path), name, H5T_STD_I64LE, H5T_NATIVE_INT64, space_of({values.size()}),
                   values.data());
}

void Writer::attribute(const std::string& path, const std::string& name, int value) {
  impl_->attribute(impl_->object(path), name, H5T_STD_I32LE, H5T_NATIVE_INT, space_of({}), &value);
}

void Writer::ascii_attribute(const std::string& path, const std::string& name, const std::string& value) {
  const Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "copy a type");
  check(H5Tset_size(type, value.size()), "set a string size");
  check(H5Tset_strpad(type, H5T_STR_NULLPAD), "set a string padding");
  impl_->attribute(impl_->object(path), name, type, type, space_of({}), value.data());
}

std::string Writer::finish() {
  impl_->scale_axes();
  impl_->image.wanted = true;
  check(H5Fclose(std::exchange(impl_->file, -1)), "close the file");
  return std::move(impl_->image.bytes);
}

void Writer::close() {
  impl_->scale_axes();
  check(H5Fclose(std::exchange(impl_->file, -1)), "close the file");
  if (!refusal().words.empty()) reject_deed("close its datasets");
}

struct Reader::Impl {
  std::string path, hint;
  std::size_t size = 0;  // of the file, in bytes
  hid_t file = -1;

  [[noreturn]] void reject(const std::string& what) const {
    fail(Failure::input, path, ": ", what, hint.empty() ? "" : "; ", hint);
  }

  // A soft, external or user-defined link leads to what the path does not say, out of the file, too.
  void require_hard(const std::string& name, H5L_type_t type) const {
    if (type != H5L_TYPE_HARD)
      reject(name + " is a link (HDF5 link type " + std::to_string(type) + "), and links are not followed");
  }

  // Whether an object stands at the end of the path. Rejects a path on which something else than a hard link stands.
  bool leads_to_object(const std::string& path) const {
    for (std::size_t end = path.find('/', 1);; end = path.find('/', end + 1)) {
      const std::string part = path.substr(0, end);
      H5L_info_t link{};
      if (part != "/" && H5Lget_info(file, part.c_str(), &link, H5P_DEFAULT) < 0) return false;
      if (part != "/") require_hard(part, link.type);
      if (end == std::string::npos) return true;
    }
  }

  // Values that stand in the file itself, as they are or by the filters that are written here.
  Handle dataset(const std::string& name) const {
    const hid_t id = leads_to_object(name) ? H5Dopen2(file, name.c_str(), H5P_DEFAULT) : -1;
    if (id < 0) reject("dataset " + name + " is missing or damaged");
    Handle set(id, H5Dclose, "open " + name);
    if (const std::string why = not_of_file(set); !why.empty()) reject("dataset " + name + " " + why);
    return set;
  }

  // The attribute of an object to which the path leads.
  Handle attribute(const std::string& path, const std::string& name) const {
    const hid_t id = leads_to_object(path)
                         ? H5Aopen_by_name(file, path.c_str(), name.c_str(), H5P_DEFAULT, H5P_DEFAULT)
                         : -1;
    if (id < 0) reject("attribute " + name + " of " + path + " is missing or damaged");
    return Handle(id, H5Aclose, "open the attribute " + name);
  }

  Shape shape_of(hid_t set) const {
    const Handle space(H5Dget_space(set), H5Sclose, "get a space");
    const int rank = H5Sget_simple_extent_ndims(space);
    std::vector<hsize_t> extent(static_cast<std::size_t>(std::max(rank, 0)));
    if (rank > 0) H5Sget_simple_extent_dims(space, extent.data(), nullptr);
    return Shape(extent.begin(), extent.end());
  }

  std::vector<std::string> take_strings(hid_t type, std::size_t count, const std::string& name,
                                        herr_t (*read)(hid_t, hid_t, void*), hid_t object) const {
    if (H5Tget_class(type) != H5T_STRING) reject(name + " is not text");
    std::vector<std::string> out;
    if (H5Tis_variable_str(type) > 0) {
      // What refers to a heap has a checksum in an attribute only.
      if (H5Iget_type(object) != H5I_ATTR) reject(name + " is text of no fixed length");
      const Handle memory = string_type();
      std::vector<char*> pointers(count, nullptr);
      if (count > 0 && read(object, memory, pointers.data()) < 0) reject(name + " cannot be read");
      for (char* pointer : pointers) {
        out.emplace_back(pointer ? pointer : "");
        if (pointer) H5free_memory(pointer);
      }
    } else {
      const std::size_t size = H5Tget_size(type);
      std::string block(size * count, '\0');
      if (count > 0 && read(object, type, block.data()) < 0) reject(name + " cannot be read");
      out.reserve(count);
      for (std::size_t i = 0; i < count; ++i) {
        const std::string item = block.substr(i * size, size);
        out.push_back(item.substr(0, item.find('\0')));
      }
    }
    return out;
  }

  // The number of values, before memory is taken for them. Deflate makes at most 1032 bytes of one, of the chunks that are
  // written here at most 1010: what a dataset holds is bounded by what is stored of it. In memory a value may be wider, a byte
  // become a double or a text; all that is taken at a time is bounded by the whole file, because a table of empty texts is
  // hardly stored at all: a file of 1 MiB never asks for 1 GiB.
  std::size_t stored_count(hid_t set, std::size_t item_bytes, std::size_t memory_bytes,
                           const std::string& name) const {
    constexpr double kMost = 1020;
    const Shape shape = shape_of(set);
    const double stored = std::min(static_cast<double>(H5Dget_storage_size(set)), static_cast<double>(size));
    double count = 1;
    for (std::size_t n : shape) count *= static_cast<double>(n);
    const double bytes = count * static_cast<double>(item_bytes),
                 memory = count * static_cast<double>(memory_bytes);
    if (bytes > kMost * stored)
      reject(text("dataset ", name, " says that it holds ", bytes, " bytes, but ", stored, " are stored"));
    if (memory > kMost * static_cast<double>(size))
      reject(text("dataset ", name, " would take ", memory, " bytes of memory, but the file has ", size));
    return count_of(shape);
  }

  template <class T>
  std::vector<T> numbers(const std::string& name, bool whole) const {
    const Handle set = dataset(name);
    const Handle type(H5Dget_type(set), H5Tclose, "get a type");
    const H5T_class_t kind = H5Tget_class(type);
    if (kind != H5T_INTEGER && (whole || kind != H5T_FLOAT)) {
      reject("dataset " + name + (whole ? " does not hold whole numbers" : " does not hold numbers"));
    }
    const std::size_t item = H5Tget_size(type);
    std::vector<T> out(stored_count(set, item, std::max(item, sizeof(T)), name));
    if (!out.empty() && H5Dread(set, Types<T>::memory(), H5S_ALL, H5S_ALL, H5P_DEFAULT, out.data()) < 0) {
      reject("dataset " + name + " cannot be read (damaged file)");
    }
    if constexpr (std::is_floating_point_v<T>) {
      for (T value : out) {
        if (!std::isfinite(value)) reject("dataset " + name + " holds a value that is not finite");
      }
    }
    return out;
  }
};

Reader::Reader(const std::string& bytes, std::string path, std::string hint)
    : impl_(std::make_unique<Impl>()) {
  silence();
  impl_->path = std::move(path);
  impl_->hint = std::move(hint);
  impl_->size = bytes.size();
  const auto broken = [&](const std::string& what) {
    fail(Failure::io, impl_->path, ": ", what, " (", bytes.size(), " bytes)", impl_->hint.empty() ? "" : "; ",
         impl_->hint);
  };
  static const std::string signature("\x89HDF\r\n\x1a\n", 8);
  if (bytes.empty()) broken("the file is empty");
  if (bytes.compare(0, 8, signature) != 0) broken("is not an HDF5 file");
  constexpr char kSuperblock = 3;  // of the format with checksums
  if (bytes.size() > 8 && bytes[8] != kSuperblock)
    broken("is of an earlier version of this program, or damaged");
  if (!heaps_are_sound(bytes)) broken("the file is damaged");
  const Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose, "make a property list");
  check(H5Pset_fapl_core(access, 1 << 20, 0), "select memory as a file");
  check(H5Pset_fclose_degree(access, H5F_CLOSE_STRONG), "select strong closing");
  // HDF5 copies the image; the const_cast only meets its signature.
  check(H5Pset_file_image(access, const_cast<char*>(bytes.data()), bytes.size()), "take a file image");
  impl_->file = H5Fopen(memory_name().c_str(), H5F_ACC_RDONLY, access);
  if (impl_->file < 0) broken("the file is truncated or damaged");
}

Reader::~Reader() {
  if (impl_->file >= 0) H5Fclose(impl_->file);
}

void Reader::reject(const std::string& what) const {
  impl_->reject(what);
}

bool Reader::has(const std::string& path) const {
  return impl_->leads_to_object(path);
}

std::vector<std::string> Reader::children(const std::string& group) const {
  std::vector<std::string> names;
  if (group != "/" && !has(group)) impl_->reject("group " + group + " is missing");
  const Handle id(H5Gopen2(impl_->file, group.c_str(), H5P_DEFAULT), H5Gclose, "open " + group);
  const auto collect = [](hid_t, const char* name, const H5L_info_t*, void* out) -> herr_t {
    static_cast<std::vector<std::string>*>(out)->push_back(name);
    return 0;
  };
  hsize_t start = 0;
  check(H5Literate(id, H5_INDEX_NAME, H5_ITER_INC, &start, collect, &names), "list " + group);
  return names;
}

Shape Reader::shape(const std::string& path) const {
  return impl_->shape_of(impl_->dataset(path));
}

std::vector<double> Reader::doubles(const std::string& path) const {
  return impl_->numbers<double>(path, false);
}

std::vector<int> Reader::ints(const std::string& path) const {
  return impl_->numbers<int>(path, true);
}

std::vector<std::string> Reader::strings(const std::string& path) const {
  const Handle set = impl_->dataset(path);
  const Handle type(H5Dget_type(set), H5Tclose, "get a type");
  const auto read = [](hid_t object, hid_t memory, void* out) {
    return H5Dread(object, memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, out);
  };
  const std::size_t item = H5Tget_size(type);  // once in a block, once as a text
  return impl_->take_strings(type, impl_->stored_count(set, item, 2 * item + sizeof(std::string), path),
                             "dataset " + path, read, set);
}

std::string Reader::string_attribute(const std::string& path, const std::string& name) const {
  const std::string what = "attribute " + name + " of " + path;
  const Handle id = impl_->attribute(path, name);
  const Handle type(H5Aget_type(id), H5Tclose, "get a type");
  const Handle space(H5Aget_space(id), H5Sclose, "get a space");
  const auto read = [](hid_t object, hid_t memory, void* out) { return H5Aread(object, memory, out); };
  if (H5Sget_simple_extent_npoints(space) != 1) impl_->reject(what + " is not one text");
  return impl_->take_strings(type, 1, what, read, id).at(0);
}

int Reader::int_attribute(const std::string& path, const std::string& name) const {
  const std::string what = "attribute " + name + " of " + path;
  const Handle id = impl_->attribute(path, name);
  const Handle type(H5Aget_type(id), H5Tclose, "get a type");
  const Handle space(H5Aget_space(id), H5Sclose, "get a space");
  int value = 0;
  if (H5Tget_class(type) != H5T_INTEGER || H5Sget_simple_extent_npoints(space) != 1 ||
      H5Aread(id, H5T_NATIVE_INT, &value) < 0) {
    impl_->reject(what + " is not one whole number");
  }
  return value;
}

}  // namespace whine::h5
