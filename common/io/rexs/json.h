// The JSON document of a REXS model (.rexsj).
//
// Private to the layer io/.
#pragma once
#include <string>

namespace Json {
class Value;
}

namespace whine {

// path: stands in messages. Comments are passed over; values keep where in `bytes` they stand. Throws Error(input) for broken JSON,
// a key twice in one object, more than kMostRexsDepth, or a document without a "model".
Json::Value rexs_json(const std::string& path, const std::string& bytes);

}  // namespace whine
