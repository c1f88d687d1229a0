// Prints where the values of each dataset of an HDF5 file stand: name, first byte, number of bytes. Chunks of a dataset
// are rows of their own; texts of variable length stand by their reference.
#include <hdf5.h>

#include <cstdio>
#include <string>

namespace {

herr_t show(hid_t file, const char* name, const H5O_info_t* info, void*) {
  if (info->type != H5O_TYPE_DATASET) return 0;
  const hid_t set = H5Dopen2(file, name, H5P_DEFAULT), list = H5Dget_create_plist(set),
              space = H5Dget_space(set);
  if (H5Pget_layout(list) == H5D_CHUNKED) {
    hsize_t chunks = 0;
    H5Dget_num_chunks(set, space, &chunks);
    for (hsize_t i = 0; i < chunks; ++i) {
      hsize_t offset[8];
      unsigned filters = 0;
      haddr_t at = 0;
      hsize_t size = 0;
      H5Dget_chunk_info(set, space, i, offset, &filters, &at, &size);
      std::printf("/%s %llu %llu\n", name, static_cast<unsigned long long>(at),
                  static_cast<unsigned long long>(size));
    }
  } else if (const haddr_t at = H5Dget_offset(set); at != HADDR_UNDEF) {
    std::printf("/%s %llu %llu\n", name, static_cast<unsigned long long>(at),
                static_cast<unsigned long long>(H5Dget_storage_size(set)));
  }
  H5Sclose(space);
  H5Pclose(list);
  H5Dclose(set);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 2) return 2;
  const hid_t file = H5Fopen(argv[1], H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file < 0) return 1;
  const herr_t status = H5Ovisit2(file, H5_INDEX_NAME, H5_ITER_INC, show, nullptr, H5O_INFO_BASIC);
  H5Fclose(file);
  return status < 0 ? 1 : 0;
}
