#include "io/h5_handle.h"

namespace whine::h5 {

void note_refusal() {
  Refusal& by_system = refusal();
  if (by_system.path.empty() || !by_system.words.empty()) return;
  const auto read = [](unsigned, const H5E_error2_t* error, void* words) -> herr_t {
    const std::string said = error->desc ? error->desc : "", mark = "error message = '";
    if (const auto at = said.find(mark); at != std::string::npos) {
      const auto from = at + mark.size();
      *static_cast<std::string*>(words) = said.substr(from, said.find('\'', from) - from);
    }
    return 0;
  };
  H5Ewalk2(H5E_DEFAULT, H5E_WALK_UPWARD, read, &by_system.words);
}

std::string not_of_file(hid_t dataset) {
  const Handle list(H5Dget_create_plist(dataset), H5Pclose, "get a property list");
  if (H5Pget_layout(list) == H5D_VIRTUAL || H5Pget_external_count(list) != 0)
    return "has its values in another file, and other files are not followed";
  for (int i = 0; i < H5Pget_nfilters(list); ++i) {
    std::size_t parameters = 0;
    unsigned flags = 0;
    const H5Z_filter_t filter =
        H5Pget_filter2(list, static_cast<unsigned>(i), &flags, &parameters, nullptr, 0, nullptr, nullptr);
    if (filter != H5Z_FILTER_SHUFFLE && filter != H5Z_FILTER_DEFLATE)
      return text("is stored by the HDF5 filter ", filter, ", which is none of shuffle and deflate");
  }
  return "";
}

}  // namespace whine::h5
