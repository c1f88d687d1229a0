// From the bytes of a file to a REXS model and back: the text of the model, out of its zip archive (.rexsz) where it is in one, and
// the archive with another text in its place.
//
// Private to the layer io/.
#pragma once
#include <string>

#include "io/rexs/rexs.h"

namespace whine {

inline constexpr const char* kByteOrderMark = "\xef\xbb\xbf";
inline constexpr size_t kMostRexsBytes = 64u << 20;  // of a model; one of a whole gearbox has less than 10 MB
inline constexpr size_t kMostRexsEntries = 10'000;   // of an archive

// Throws Error(input): path, why, what is wanted.
[[noreturn]] void reject_rexs(const std::string& path, const std::string& why);

bool is_rexs_archive(const std::string& bytes);

// archive: bytes of the file at `path`, which stands in messages. Throws Error(input) for an archive that is damaged, that holds
// no model or several, one of more than kMostRexsBytes, or more than kMostRexsEntries.
std::string model_in_archive(const std::string& path, const std::string& archive);

// All other entries, the name and the time of the model's entry stay.
std::string archive_with_model(const std::string& path, const std::string& archive, const std::string& model);

// The model as text, XML or JSON without a byte order mark, of the bytes of a file, of kMostRexsNodes at most; what it says. Errors as
// read_rexs.
std::string rexs_text(const std::string& path, std::string bytes);
RexsModel parse_rexs(const std::string& path, const std::string& text);

// The number of an id of a component or reference, as it is written ("012" is 12); what: of what, for the message. Throws
// Error(input) for what is no whole number from 0 on.
int rexs_id(const std::string& path, const std::string& word, const char* what);

}  // namespace whine
