// response.h5: what a sweep says, per speed.
#pragma once
#include <string>

#include "io/provenance.h"
#include "results/response.h"

namespace whine {

class Codec;

void describe(Codec& codec, ResponseResult& a);
void write(const std::string& path, const ResponseResult& a, const Provenance& provenance);
ResponseResult read_response(const std::string& path);

}  // namespace whine
