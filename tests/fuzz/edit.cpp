// Changes an artifact through HDF5: a file whose structure is sound and whose content is not what a reader expects. Bytes
// changed at random hardly ever give one, since HDF5 checks its structures by checksums.
#include <hdf5.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <random>
#include <string>
#include <vector>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t room);

namespace {

struct Image {
  std::string bytes;
  bool wanted = false;  // not before the file is open: a damaged one may say any size
};

void* take(std::size_t size, H5FD_file_image_op_t, void*) {
  return std::malloc(size);
}
void* resize(void* memory, std::size_t size, H5FD_file_image_op_t, void*) {
  return std::realloc(memory, size);
}
// The whole file when it is closed: its size stands in the superblock.
herr_t give_back(void* memory, H5FD_file_image_op_t why, void* out) {
  auto& image = *static_cast<Image*>(out);
  if (image.wanted && why == H5FD_FILE_IMAGE_OP_FILE_CLOSE) {
    std::uint64_t size = 0;
    std::memcpy(&size, static_cast<const char*>(memory) + 28, sizeof size);
    image.bytes.assign(static_cast<const char*>(memory), size);
  }
  std::free(memory);
  return 0;
}

herr_t name_of(hid_t, const char* name, const H5O_info_t* info, void* out) {
  // The hash would be missing, and the file rejected before any reader sees it.
  if (info->type == H5O_TYPE_DATASET && std::strcmp(name, "provenance/content_sha256") != 0)
    static_cast<std::vector<std::string>*>(out)->push_back(name);
  return 0;
}

class Edit {
 public:
  Edit(hid_t file, unsigned seed) : file_(file), random_(seed) {
    H5Ovisit2(file, H5_INDEX_NAME, H5_ITER_INC, name_of, &names_, H5O_INFO_BASIC);
  }

  void any() {
    if (names_.empty()) return;
    const std::string name = names_[below(names_.size())], other = names_[below(names_.size())];
    switch (below(8)) {
      case 0:
        H5Ldelete(file_, name.c_str(), H5P_DEFAULT);
        break;
      case 1:
        values(name);
        break;
      case 2:
        anew(name);
        break;
      case 3:
        H5Ldelete(file_, name.c_str(), H5P_DEFAULT);
        H5Lcreate_hard(file_, other.c_str(), file_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT);
        break;
      case 4:
        H5Ldelete(file_, name.c_str(), H5P_DEFAULT);
        H5Lcreate_soft(below(2) ? other.c_str() : name.c_str(), file_, name.c_str(), H5P_DEFAULT,
                       H5P_DEFAULT);
        break;
      case 5:
        H5Ldelete(file_, name.c_str(), H5P_DEFAULT);
        H5Gclose(H5Gcreate2(file_, name.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
        break;
      case 6:
        attribute();
        break;
      default:
        for (int i = 0; i < 4; ++i) values(names_[below(names_.size())]);
    }
  }

 private:
  std::size_t below(std::size_t n) { return random_() % n; }

  double number() {
    static const double odd[] = {0,
                                 -1,
                                 1,
                                 2,
                                 0.5,
                                 -0.5,
                                 1e-300,
                                 1e300,
                                 1e18,
                                 -1e9,
                                 1 << 16,
                                 1 << 30,
                                 4e9,
                                 1e-9,
                                 std::numeric_limits<double>::quiet_NaN(),
                                 std::numeric_limits<double>::infinity()};
    return odd[below(std::size(odd))];
  }

  // Some values of a dataset, others than they were.
  void values(const std::string& name) {
    const hid_t set = H5Dopen2(file_, name.c_str(), H5P_DEFAULT);
    if (set < 0) return;
    const hid_t type = H5Dget_type(set), space = H5Dget_space(set);
    const hssize_t count = H5Sget_simple_extent_npoints(space);
    if (count > 0 && static_cast<double>(H5Tget_size(type)) * static_cast<double>(count) > 1e6) {
      H5Sclose(space);
      H5Tclose(type);
      H5Dclose(set);
      return;
    }
    if (count > 0 && H5Tget_class(type) == H5T_STRING && H5Tis_variable_str(type) == 0) {
      std::string block(H5Tget_size(type) * static_cast<std::size_t>(count), '\0');
      H5Dread(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, block.data());
      block[below(block.size())] = static_cast<char>(below(256));
      H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, block.data());
    } else if (count > 0 && H5Tget_class(type) != H5T_VLEN) {
      std::vector<double> block(static_cast<std::size_t>(count));
      H5Dread(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, block.data());
      for (std::size_t i = 0; i <= below(3); ++i) block[below(block.size())] = number();
      H5Dwrite(set, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, block.data());
    }
    H5Sclose(space);
    H5Tclose(type);
    H5Dclose(set);
  }

  // Another type and another shape, perhaps of terabytes that nobody has written.
  void anew(const std::string& name) {
    static const hsize_t extents[] = {0,   1,    2,       3,          5,          8,
                                      100, 5000, 1 << 20, 1ull << 31, 1ull << 33, 1ull << 60};
    hsize_t shape[4];
    const int rank = static_cast<int>(below(5));
    std::fill(shape, shape + 4, 1);
    for (int i = 0; i < rank; ++i) shape[i] = extents[below(below(2) ? 6 : std::size(extents))];
    const hid_t space =
        rank == 0 ? H5Screate(below(4) ? H5S_SCALAR : H5S_NULL) : H5Screate_simple(rank, shape, nullptr);
    const hid_t list = H5Pcreate(H5P_DATASET_CREATE);
    if (rank > 0 && below(2)) {
      hsize_t chunk[4];
      for (int i = 0; i < rank; ++i) chunk[i] = std::clamp<hsize_t>(shape[i], 1, below(2) ? 8 : 1 << 16);
      H5Pset_chunk(list, rank, chunk);
      if (below(2)) H5Pset_deflate(list, 1);
    }
    hid_t type = -1;
    switch (below(7)) {
      case 0:
        type = H5Tcopy(H5T_STD_I64LE);
        break;
      case 1:
        type = H5Tcopy(H5T_STD_U8LE);
        break;
      case 2:
        type = H5Tcopy(H5T_C_S1);
        H5Tset_size(type, below(2) ? 1 + below(64) : 1u << 28);
        break;
      case 3:
        type = H5Tcopy(H5T_C_S1);
        H5Tset_size(type, H5T_VARIABLE);
        break;
      case 4:
        type = H5Tcreate(H5T_OPAQUE, 1 + below(100));
        break;
      case 5:
        type = H5Tvlen_create(H5T_NATIVE_DOUBLE);
        break;
      default:
        type = H5Tcopy(H5T_IEEE_F64LE);
    }
    H5Ldelete(file_, name.c_str(), H5P_DEFAULT);
    const hid_t set = H5Dcreate2(file_, name.c_str(), type, space, H5P_DEFAULT, list, H5P_DEFAULT);
    if (set >= 0) H5Dclose(set);
    H5Tclose(type);
    H5Pclose(list);
    H5Sclose(space);
    if (below(2)) values(name);
  }

  // schema, schema_version or title of the file.
  void attribute() {
    static const char* const roots[] = {"schema", "schema_version", "title"};
    static const char* const words[] = {"whine/mesh",
                                        "whine/body",
                                        "whine/static",
                                        "whine/impact",
                                        "whine/sweep",
                                        "whine/loaded",
                                        "whine/response",
                                        "whine/jump_map",
                                        "whine/error_budget",
                                        "whine/harris_map",
                                        "whine/variant",
                                        "whine/study",
                                        "whine/",
                                        ""};
    const char* name = roots[below(3)];
    H5Adelete(file_, name);
    if (below(8) == 0) return;
    const hid_t space = H5Screate(H5S_SCALAR);
    const hid_t type = below(4) ? H5Tcopy(H5T_C_S1) : H5Tcopy(H5T_NATIVE_INT);
    const bool text = H5Tget_class(type) == H5T_STRING;
    const std::string word = words[below(std::size(words))];
    const char* pointer = word.c_str();
    const int number = static_cast<int>(below(12));
    if (text) H5Tset_size(type, H5T_VARIABLE);
    const hid_t made = H5Acreate2(file_, name, type, space, H5P_DEFAULT, H5P_DEFAULT);
    if (text) {
      H5Awrite(made, type, &pointer);
    } else {
      H5Awrite(made, type, &number);
    }
    H5Aclose(made);
    H5Tclose(type);
    H5Sclose(space);
  }

  hid_t file_;
  std::mt19937 random_;
  std::vector<std::string> names_;
};

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t room,
                                               unsigned int seed) {
  if (seed % 4 == 0) return LLVMFuzzerMutate(data, size, room);
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  Image image;
  const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
  H5Pset_fapl_core(access, 1 << 16, 0);
  H5Pset_fclose_degree(access, H5F_CLOSE_STRONG);
  H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110);
  H5FD_file_image_callbacks_t calls{
      take,  nullptr, resize, give_back, [](void* same) { return same; }, [](void*) -> herr_t { return 0; },
      &image};
  H5Pset_file_image_callbacks(access, &calls);
  H5Pset_file_image(access, data, size);
  const hid_t file = H5Fopen("edit", H5F_ACC_RDWR, access);
  H5Pclose(access);
  if (file < 0) return LLVMFuzzerMutate(data, size, room);
  Edit edit(file, seed);
  for (unsigned times = 1 + seed / 4 % 3; times > 0; --times) edit.any();
  image.wanted = true;
  H5Fclose(file);
  if (image.bytes.empty() || image.bytes.size() > room) return LLVMFuzzerMutate(data, size, room);
  std::memcpy(data, image.bytes.data(), image.bytes.size());
  return image.bytes.size();
}
