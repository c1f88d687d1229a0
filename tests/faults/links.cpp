// links <artifact> <kind> [<other file>]: puts in place of the dataset /transmission_error of an artifact one that draws its values
// from elsewhere: soft (a link in the file), external (a link to another file), storage (bytes of another file), virtual (a dataset of
// another file); or one that is stored by a filter that artifacts do not have: filter.
#include <hdf5.h>

#include <cstdio>
#include <string>

int main(int argc, char** argv) {
  if (argc < 3) return 2;
  const std::string kind = argv[2];
  const char *const other = argc > 3 ? argv[3] : "", *const name = "/transmission_error";
  const hid_t access = H5Pcreate(H5P_FILE_ACCESS);
  H5Pset_libver_bounds(access, H5F_LIBVER_V110, H5F_LIBVER_V110);
  const hid_t file = H5Fopen(argv[1], H5F_ACC_RDWR, access), old = H5Dopen2(file, name, H5P_DEFAULT),
              space = H5Dget_space(old), list = H5Pcreate(H5P_DATASET_CREATE);
  hsize_t shape[H5S_MAX_RANK];
  const int rank = H5Sget_simple_extent_dims(space, shape, nullptr);
  const hssize_t count = H5Sget_simple_extent_npoints(space);
  H5Dclose(old);
  herr_t done = H5Ldelete(file, name, H5P_DEFAULT);
  if (kind == "soft")
    done |= H5Lcreate_soft("/unloaded_transmission_error", file, name, H5P_DEFAULT, H5P_DEFAULT);
  if (kind == "external") done |= H5Lcreate_external(other, name, file, name, H5P_DEFAULT, H5P_DEFAULT);
  if (kind == "storage") done |= H5Pset_external(list, other, 0, static_cast<hsize_t>(count) * 8);
  if (kind == "virtual") done |= H5Pset_virtual(list, space, other, name, space);
  if (kind == "filter") {
    done |= H5Pset_chunk(list, rank, shape);
    done |= H5Pset_fletcher32(list);
  }
  if (kind == "storage" || kind == "virtual" || kind == "filter") {
    const hid_t made = H5Dcreate2(file, name, H5T_IEEE_F64LE, space, H5P_DEFAULT, list, H5P_DEFAULT);
    done |= made < 0 ? -1 : H5Dclose(made);
  }
  done |= H5Fclose(file);
  if (done < 0) std::fprintf(stderr, "links: HDF5 made no %s\n", kind.c_str());
  return done < 0 ? 1 : 0;
}
